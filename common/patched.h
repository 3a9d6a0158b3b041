// A field of an edit: left out (keep), null (back to the default), or a value.
#pragma once

#include <type_traits>
#include <utility>
#include <variant>

namespace posed {

template <class T>
class Patched {
 public:
  Patched() = default;
  Patched(T value) : state_(std::in_place_index<2>, std::move(value)) {}
  template <class U>
  requires(std::is_convertible_v<U, T> && !std::is_same_v<U, T>) Patched(U value) : Patched(T(std::move(value))) {}
  static Patched reset() {
    Patched p;
    p.state_.template emplace<1>();
    return p;
  }

  bool named() const { return state_.index() != 0; }
  bool is_reset() const { return state_.index() == 1; }
  const T* value() const { return std::get_if<2>(&state_); }

  // Changes `target` as the edit says; `fallback` is the default that null restores.
  void apply(T& target, const T& fallback = T{}) const {
    if (is_reset()) target = fallback;
    if (value()) target = *value();
  }

 private:
  struct Reset {};
  std::variant<std::monostate, Reset, T> state_;
};

}  // namespace posed
