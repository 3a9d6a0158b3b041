// How the emulated trackers write numbers: little-endian in binary mode, fixed columns in ASCII mode.
#pragma once

#include <cstdint>
#include <cstdio>
#include <cstring>
#include <string>
#include <string_view>
#include <vector>

namespace posed::test {

using Bytes = std::vector<std::uint8_t>;

inline void put_text(Bytes& to, std::string_view text) {
  to.insert(to.end(), text.begin(), text.end());
}

inline void put_u16(Bytes& to, std::uint32_t v) {
  to.push_back(static_cast<std::uint8_t>(v));
  to.push_back(static_cast<std::uint8_t>(v >> 8));
}

inline void put_u32(Bytes& to, std::uint32_t v) {
  put_u16(to, v & 0xffff);
  put_u16(to, v >> 16);
}

inline void put_f32(Bytes& to, double v) {
  const auto single = static_cast<float>(v);
  std::uint32_t bits = 0;
  std::memcpy(&bits, &single, sizeof bits);
  put_u32(to, bits);
}

inline std::string format(const char* pattern, double v) {
  char text[40];
  std::snprintf(text, sizeof text, pattern, v);
  return text;
}

}  // namespace posed::test
