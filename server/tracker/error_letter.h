// The letter that a Polhemus record carries where it is not quite well.
#pragma once

#include <cstdint>

namespace posed::tracker {

// Of a FASTRAK or ISOTRAK receiver that is not plugged in: its numbers mean nothing, so it is absent.
inline constexpr char kNoSignal = 'l';

inline bool is_letter(std::uint8_t c) {
  return (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z');
}

}  // namespace posed::tracker
