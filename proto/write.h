// Private to the codec: writes described structs as JSON, fields in the order of their description.
#pragma once

#include <nlohmann/json.hpp>

#include "proto/read.h"

namespace posed::proto {

Json write(const Vec3& v);
Json write(const Quat& q);
Json write(const Transform& t);
Json write(const Attachment& a);
Json write(const Shape& s);
Json write(const Limit& l);
Json write(const Swing& s);
Json write(const GoalBase& b);
Json write(const GoalWeight& w);
Json write(const GoalTolerance& t);
Json write(const JointValue& v);
Json write(const Axes& a);
Json write(const Start& s);
Json write(const GoalFrame::Because& b);
Json write(const std::pair<std::string, std::string>& pair);

template <class T>
requires std::is_arithmetic_v<T> || std::is_same_v<T, std::string> Json write(const T& value) {
  return value;
}

template <class E>
requires std::is_enum_v<E> Json write(E value) {
  return word(value);
}

template <Described T>
Json write(const T& value);
template <class T>
Json write(const std::vector<T>& items);
template <class T>
Json write(const std::map<std::string, T>& items);

template <class T>
Json write(const std::optional<T>& value) {
  return value ? write(*value) : Json(nullptr);
}

template <class T>
Json write(const std::vector<T>& items) {
  Json j = Json::array();
  for (const T& item : items) j.push_back(write(item));
  return j;
}

template <class T>
Json write(const std::map<std::string, T>& items) {
  Json j = Json::object();
  // Straight to the end: assigning by key would look for each among all before it.
  auto& members = j.get_ref<Json::object_t&>();
  for (const auto& [key, item] : items) members.emplace_back(key, write(item));
  return j;
}

// The visitor of describe() that writes one object. What is empty or left out is not written.
class Writer {
 public:
  static constexpr bool kReads = false;

  template <class T>
  void required(const char* key, const T& value) {
    object_[key] = write(value);
  }

  template <class T>
  bool optional(const char* key, const T& value) {
    if (!empty(value)) object_[key] = write(value);
    return true;
  }
  template <class T>
  bool optional(const char* key, const Patched<T>& value) {
    if (value.is_reset()) object_[key] = nullptr;
    if (value.value()) object_[key] = write(*value.value());
    return true;
  }

  void verbatim(const char* key, const std::string& text) {
    if (!text.empty()) object_[key] = Json::parse(text, nullptr, false);
  }
  void verbatim(const char* key, const Patched<std::string>& text) {
    if (text.is_reset()) object_[key] = nullptr;
    if (text.value()) verbatim(key, *text.value());
  }

  void constant(const char* key, Json value) { object_[key] = std::move(value); }
  void reserved(const char*, const char* = nullptr) {}
  void fail(const char*, const std::string&, const std::string& = {}) {}
  void fail_at(const char*, const char*, const std::string&, const std::string& = {}) {}
  bool has(const char*) const { return false; }
  bool ok() const { return true; }

  Json take() { return std::move(object_); }

 private:
  template <class T>
  static bool empty(const T& value) {
    if constexpr (requires { value.has_value(); })
      return !value.has_value();
    else if constexpr (requires { value.empty(); })
      return value.empty();
    else
      return false;
  }

  Json object_ = Json::object();
};

template <Described T>
Json write(const T& value) {
  Writer writer;
  describe(writer, const_cast<T&>(value));  // a Writer changes nothing; one description serves both ways
  return writer.take();
}

}  // namespace posed::proto
