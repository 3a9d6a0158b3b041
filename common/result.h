// Bad input is a value, not an exception: a Result holds either what was asked for or an Error that names the field and
// says what would be right. To take the one when it holds the other is a bug of ours: std::bad_variant_access.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <variant>

namespace posed {

struct Error {
  std::string code;     // stable and short, as in the protocol's table: "unknown_segment"
  std::string message;  // one clear sentence
  std::string path;     // a JSON pointer to the field, "/params/at"; may be empty
  std::string hint;     // the cure; may be empty
};

template <class T>
class [[nodiscard]] Result {
 public:
  Result(T value) : state_(std::in_place_index<0>, std::move(value)) {}
  Result(Error error) : state_(std::in_place_index<1>, std::move(error)) {}

  explicit operator bool() const { return state_.index() == 0; }
  T& value() { return std::get<0>(state_); }
  const T& value() const { return std::get<0>(state_); }
  T* operator->() { return &value(); }
  const T* operator->() const { return &value(); }
  T& operator*() { return value(); }
  const T& operator*() const { return value(); }
  Error& error() { return std::get<1>(state_); }
  const Error& error() const { return std::get<1>(state_); }

 private:
  std::variant<T, Error> state_;
};

// Success without a value.
struct Ok {};
using Status = Result<Ok>;

}  // namespace posed
