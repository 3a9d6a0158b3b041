// A third visitor of the codec's descriptions, besides the one that reads and the one that writes: it writes down the
// JSON Schema of what a message may have.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "proto/describe_results.h"

namespace posed::proto {

// The daemon refuses fields that it does not know, and takes null for what is left out; it never says null.
enum class Direction { to_daemon, from_daemon };

template <class T>
Json object_schema(Direction direction);

inline Json whole() {
  return {{"type", "integer"}, {"minimum", 0}};
}
inline Json share() {
  return {{"type", "number"}, {"exclusiveMinimum", 0}, {"maximum", 1}};
}
inline Json ref(const char* place) {
  return {{"$ref", place}};
}
inline Json or_null(Json schema) {
  return {{"anyOf", {std::move(schema), {{"type", "null"}}}}};
}

// Values whose reading and writing are written by hand (read.cpp, write.cpp) have their schemas by hand, too.
template <class T>
struct ByHand;
template <class T>
concept HasHand = requires(Direction d) {
  ByHand<T>::schema(d);
};

#define POSED_SCHEMA(Type, ...)                                                      \
  template <>                                                                        \
  struct ByHand<Type> {                                                              \
    static Json schema(Direction direction) { return (void)direction, __VA_ARGS__; } \
  };
POSED_SCHEMA(bool, Json{{"type", "boolean"}})
POSED_SCHEMA(int, Json{{"type", "integer"}})
POSED_SCHEMA(std::int64_t, Json{{"type", "integer"}})
POSED_SCHEMA(std::uint32_t, whole())
POSED_SCHEMA(std::uint64_t, whole())
POSED_SCHEMA(double, Json{{"type", "number"}})
POSED_SCHEMA(std::string, Json{{"type", "string"}})
POSED_SCHEMA(Vec3, ref("#/components/schemas/vector"))
POSED_SCHEMA(Quat, ref("#/components/schemas/quaternion"))
POSED_SCHEMA(Transform, ref("#/components/schemas/transform"))
POSED_SCHEMA(FigureDocument, ref("figure.schema.json"))
POSED_SCHEMA(SceneDocument, ref("scene.schema.json"))
POSED_SCHEMA(Shape, ref("figure.schema.json#/$defs/shape"))
POSED_SCHEMA(Attachment, ref("scene.schema.json#/$defs/place"))
POSED_SCHEMA(GoalBase, ref("scene.schema.json#/$defs/goal/properties/relative_to"))
POSED_SCHEMA(GoalWeight, ref("scene.schema.json#/$defs/goal/properties/weight"))
POSED_SCHEMA(GoalTolerance, ref("scene.schema.json#/$defs/goal/properties/tolerance"))
POSED_SCHEMA(JointValue, ref("scene.schema.json#/$defs/joint_value"))
POSED_SCHEMA(Axes, ref("scene.schema.json#/$defs/binding/properties/axes"))
POSED_SCHEMA(BindingTarget, ref("scene.schema.json#/$defs/binding/properties/to"))
POSED_SCHEMA(Pin, ref("scene.schema.json#/$defs/figure/properties/pins/additionalProperties"))
POSED_SCHEMA(JointHold, direction == Direction::to_daemon ? Json{{"type", {"boolean", "number"}}}
                                                          : Json{{"anyOf", {{{"const", true}}, {{"type", "number"}}}}})
POSED_SCHEMA(
    DeviceFilter,
    Json{{"anyOf",
          {{{"const", "off"}},
           {{"type", "object"},
            {"required", {"sensitivity", "low", "high", "max"}},
            {"additionalProperties", false},
            {"properties", {{"sensitivity", share()}, {"low", share()}, {"high", share()}, {"max", share()}}}}}}})
POSED_SCHEMA(Start, Json{{"oneOf",
                          {{{"enum", {"rest", "current"}}},
                           {{"type", "object"},
                            {"required", {"q"}},
                            {"additionalProperties", false},
                            {"properties", {{"q", {{"type", "array"}, {"items", {{"type", "number"}}}}}}}}}}})
POSED_SCHEMA(FigureChoice,
             Json{{"oneOf",
                   {{{"type", "string"}},
                    {{"type", "object"},
                     {"required", {"template"}},
                     {"additionalProperties", false},
                     {"properties", {{"template", {{"type", "string"}}}, {"stature", {{"type", "number"}}}}}},
                    ref("figure.schema.json")}}})
POSED_SCHEMA(GoalFrame::Because, Json{{"type", "object"},
                                      {"minProperties", 1},
                                      {"properties",
                                       {{"goal", {{"type", "string"}}},
                                        {"pin", {{"type", "string"}}},
                                        {"limit", {{"type", "string"}}},
                                        {"side", {{"enum", {"min", "max", "swing"}}}},
                                        {"beyond_m", {{"type", "number"}}},
                                        {"figure", {{"type", "string"}}}}}})
POSED_SCHEMA(ProblemEntry, object_schema<Problem>(direction))
POSED_SCHEMA(Edit, Json{{"type", "object"},
                        {"required", {"method"}},
                        {"additionalProperties", false},
                        {"properties",
                         {{"method", {{"type", "string"}}},
                          {"params", {{"description", "As of that method."}, {"type", "object"}}}}}})
POSED_SCHEMA(Solved, Json{{"anyOf",
                           {object_schema<SolveResult>(direction),
                            {{"type", "object"},
                             {"required", {"error"}},
                             {"properties", {{"error", object_schema<Error>(direction)}}}}}}})
POSED_SCHEMA(AppliedResult,
             Json{{"anyOf", {object_schema<EditResult>(direction), object_schema<ClearResult>(direction)}}})
#undef POSED_SCHEMA

template <class T>
struct Schema;

template <class T>
Json schema_of(Direction direction) {
  if constexpr (HasHand<T>)
    return ByHand<T>::schema(direction);
  else
    return Schema<T>::of(direction);
}

template <class E>
requires std::is_enum_v<E>
struct Schema<E> {
  static Json of(Direction) {
    Json words = Json::array();
    for (const char* name : EnumNames<E>::names) words.push_back(name);
    return {{"enum", std::move(words)}};
  }
};
template <class T>
requires Described<T>
struct Schema<T> {
  static Json of(Direction direction) { return object_schema<T>(direction); }
};
template <class T>
struct Schema<std::optional<T>> {
  static Json of(Direction direction) {
    return direction == Direction::to_daemon ? or_null(schema_of<T>(direction)) : schema_of<T>(direction);
  }
};
template <class T>
struct Schema<Patched<T>> {
  static Json of(Direction direction) { return or_null(schema_of<T>(direction)); }
};
template <class T>
struct Schema<std::vector<T>> {
  static Json of(Direction direction) { return {{"type", "array"}, {"items", schema_of<T>(direction)}}; }
};
template <class T>
struct Schema<std::map<std::string, T>> {
  static Json of(Direction direction) {
    return {{"type", "object"}, {"additionalProperties", schema_of<T>(direction)}};
  }
};

// The visitor. Values stay as they are made, which is what holds where a field is left out.
class Fields {
 public:
  static constexpr bool kReads = true;

  explicit Fields(Direction direction) : direction_(direction) {}

  template <class T>
  void required(const char* key, T&) {
    properties_[key] = schema_of<T>(direction_);
    required_.push_back(key);
  }
  template <class T>
  bool optional(const char* key, T& value) {
    Json schema = schema_of<T>(direction_);
    if constexpr (std::is_arithmetic_v<T> || std::is_enum_v<T> || std::is_same_v<T, std::string>) {
      const Json fallback = write(value);
      if (direction_ == Direction::to_daemon && fallback != "") schema["default"] = fallback;
    }
    properties_[key] = std::move(schema);
    return false;
  }
  template <class Text>
  void verbatim(const char* key, Text&) {
    properties_[key] = ref("scene.schema.json#/$defs/user");
  }
  void constant(const char* key, const Json& value) { properties_[key] = {{"const", value}}; }
  void reserved(const char*, const char* = nullptr) {}
  void fail(const char*, const std::string&, const std::string& = {}) {}
  void fail_at(const char*, const char*, const std::string&, const std::string& = {}) {}
  void fail_below(const Error&) {}
  bool has(const char*) const { return false; }

  Json take() {
    Json schema = {{"type", "object"}};
    if (!required_.empty()) schema["required"] = std::move(required_);
    if (direction_ == Direction::to_daemon) schema["additionalProperties"] = false;
    schema["properties"] = std::move(properties_);
    return schema;
  }

 private:
  Direction direction_;
  Json properties_ = Json::object(), required_ = Json::array();
};

template <class T>
Json fields_of(Fields& fields) {
  T message{};
  describe(fields, message);
  // Written, and of no use to who reads.
  if constexpr (std::is_same_v<T, HelloResult>) {
    Writer writer;
    describe(writer, message);
    const Json said = writer.take();
    for (const char* key : {"axes", "limits"}) fields.constant(key, said.at(key));
  }
  return fields.take();
}

template <class T>
Json object_schema(Direction direction) {
  Fields fields(direction);
  if constexpr (std::is_same_v<T, Clocks>) {  // it has references only
    Nanoseconds t = 0, utc = 0;
    Clocks clocks{t, utc};
    describe(fields, clocks);
    return fields.take();
  } else {
    return fields_of<T>(fields);
  }
}

}  // namespace posed::proto
