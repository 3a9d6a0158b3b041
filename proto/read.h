// Private to the codec: reads described structs from JSON, and remembers the first error with its path.
#pragma once

#include <cmath>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "common/math.h"
#include "common/patched.h"
#include "common/result.h"
#include "proto/enums.h"

namespace posed::proto {

using Json = nlohmann::ordered_json;

class Reader;

template <class T>
concept Described = requires(Reader& r, T& t) {
  describe(r, t);
};

// Where in the text we are, and what is wrong first. A context is shared by all readers of one text.
struct ReadContext {
  std::string path;
  std::optional<Error> error;
  bool strict = true;  // unknown fields are errors (the daemon's side); else they are ignored (the client's)

  void fail(const char* code, std::string message, std::string hint = {}) {
    if (!error) error = Error{code, std::move(message), path, std::move(hint)};
  }
};

// Appends to the path for a scope.
class At {
 public:
  At(ReadContext& context, std::string_view part) : context_(context), size_(context.path.size()) {
    context_.path += '/';
    for (const char c : part) {
      if (c == '~')
        context_.path += "~0";
      else if (c == '/')
        context_.path += "~1";
      else
        context_.path += c;
    }
  }
  ~At() { context_.path.resize(size_); }
  At(const At&) = delete;
  At& operator=(const At&) = delete;

 private:
  ReadContext& context_;
  std::size_t size_;
};

void read(ReadContext& c, const Json& j, bool& out);
void read(ReadContext& c, const Json& j, int& out);
void read(ReadContext& c, const Json& j, std::uint32_t& out);
void read(ReadContext& c, const Json& j, std::uint64_t& out);
void read(ReadContext& c, const Json& j, std::int64_t& out);
void read(ReadContext& c, const Json& j, double& out);
void read(ReadContext& c, const Json& j, std::string& out);
void read(ReadContext& c, const Json& j, Vec3& out);
void read(ReadContext& c, const Json& j, Quat& out);       // [x,y,z,w], unit within 1e-3, then normalised
void read(ReadContext& c, const Json& j, Transform& out);  // [x,y,z,qx,qy,qz,qw]
void read(ReadContext& c, const Json& j, Attachment& out);
void read(ReadContext& c, const Json& j, Shape& out);
void read(ReadContext& c, const Json& j, Limit& out);
void read(ReadContext& c, const Json& j, Swing& out);
void read(ReadContext& c, const Json& j, GoalBase& out);
void read(ReadContext& c, const Json& j, GoalWeight& out);
void read(ReadContext& c, const Json& j, GoalTolerance& out);
void read(ReadContext& c, const Json& j, JointValue& out);
void read(ReadContext& c, const Json& j, Axes& out);
void read(ReadContext& c, const Json& j, Start& out);
void read(ReadContext& c, const Json& j, GoalFrame::Because& out);
void read(ReadContext& c, const Json& j, std::pair<std::string, std::string>& out);

bool expect_object(ReadContext& c, const Json& j);
bool expect_array(ReadContext& c, const Json& j);

template <class E>
requires std::is_enum_v<E>
void read(ReadContext& c, const Json& j, E& out) {
  if (!j.is_string()) return c.fail("wrong_type", "a word was expected", enum_words<E>());
  const auto& text = j.get_ref<const std::string&>();
  for (std::size_t i = 0; i < EnumNames<E>::names.size(); ++i) {
    if (text == EnumNames<E>::names[i]) return void(out = static_cast<E>(i));
  }
  // Not "\"" + ...: GCC 12 warns falsely of an overlap in it.
  c.fail("invalid_params", std::string("\"").append(text, 0, 64).append("\" is not a word that is known here"),
         enum_words<E>());
}

template <class T>
void read(ReadContext& c, const Json& j, std::optional<T>& out) {
  if (j.is_null()) return out.reset();
  read(c, j, out.emplace());
}

template <class T>
void read(ReadContext& c, const Json& j, Patched<T>& out) {
  if (j.is_null()) return void(out = Patched<T>::reset());
  T value{};
  read(c, j, value);
  out = Patched<T>(std::move(value));
}

template <class T>
void read(ReadContext& c, const Json& j, std::vector<T>& out) {
  if (!expect_array(c, j)) return;
  out.clear();
  for (const Json& item : j) {
    const At at(c, std::to_string(out.size()));
    read(c, item, out.emplace_back());
    if (c.error) return;
  }
}

template <class T>
void read(ReadContext& c, const Json& j, std::map<std::string, T>& out) {
  if (!expect_object(c, j)) return;
  out.clear();
  for (const auto& [key, item] : j.items()) {
    const At at(c, key);
    read(c, item, out[key]);
    if (c.error) return;
  }
}

// The visitor of describe() that reads one object.
class Reader {
 public:
  static constexpr bool kReads = true;

  Reader(ReadContext& context, const Json& object) : context_(context), object_(object) {}

  template <class T>
  void required(const char* key, T& out) {
    if (!optional(key, out)) {
      fail_at(key, "missing_field", std::string("the field \"") + key + "\" is missing",
              std::string("add \"") + key + "\"");
    }
  }

  template <class T>
  bool optional(const char* key, T& out) {
    known_.push_back(key);
    const auto found = object_.find(key);
    if (found == object_.end() || context_.error) return found != object_.end();
    const At at(context_, key);
    read(context_, *found, out);
    return true;
  }

  // Any JSON, at most 4 KiB of text, kept as it is.
  void verbatim(const char* key, std::string& text);
  void verbatim(const char* key, Patched<std::string>& text);

  // A field that the protocol reserves. Only `allowed` (JSON text; null: nothing) may be said today.
  void reserved(const char* key, const char* allowed = nullptr);

  void fail(const char* code, std::string message, std::string hint = {}) {
    context_.fail(code, std::move(message), std::move(hint));
  }
  void fail_at(const char* key, const char* code, std::string message, std::string hint = {}) {
    const At at(context_, key);
    context_.fail(code, std::move(message), std::move(hint));
  }
  // An error of a part, whose path begins at this object.
  void fail_below(Error error) {
    if (context_.error) return;
    error.path = context_.path + error.path;
    context_.error = std::move(error);
  }
  const std::vector<std::string>& known() const { return known_; }  // fields that were asked for
  bool has(const char* key) const { return object_.contains(key); }
  bool ok() const { return !context_.error; }

  // Unknown fields are errors, with the nearest name as a hint.
  void finish();

 private:
  ReadContext& context_;
  const Json& object_;
  std::vector<std::string> known_;
};

template <Described T>
void read(ReadContext& c, const Json& j, T& out) {
  if (!expect_object(c, j)) return;
  Reader reader(c, j);
  describe(reader, out);
  reader.finish();
}

// No text can exhaust the stack, nor take more than its length (times its logarithm) in time. Errors: "parse_error".
Result<Json> parse(std::string_view text);

}  // namespace posed::proto
