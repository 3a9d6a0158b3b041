// Numbers as the trackers send them.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>

#include "common/math.h"

namespace posed::tracker {

inline std::uint32_t u32_at(std::span<const std::uint8_t> bytes, std::size_t at) {
  return static_cast<std::uint32_t>(bytes[at]) | static_cast<std::uint32_t>(bytes[at + 1]) << 8 |
         static_cast<std::uint32_t>(bytes[at + 2]) << 16 | static_cast<std::uint32_t>(bytes[at + 3]) << 24;
}

inline std::int16_t i16_at(std::span<const std::uint8_t> bytes, std::size_t at) {
  return static_cast<std::int16_t>(static_cast<std::uint16_t>(bytes[at] | bytes[at + 1] << 8));
}

inline double f32_at(std::span<const std::uint8_t> bytes, std::size_t at) {
  return std::bit_cast<float>(u32_at(bytes, at));
}

inline Vec3 vec3_at(std::span<const std::uint8_t> bytes, std::size_t at) {
  return {f32_at(bytes, at), f32_at(bytes, at + 4), f32_at(bytes, at + 8)};
}

// w first, as all of them have it.
inline Quat quat_at(std::span<const std::uint8_t> bytes, std::size_t at) {
  return Quat(f32_at(bytes, at), f32_at(bytes, at + 4), f32_at(bytes, at + 8), f32_at(bytes, at + 12));
}

}  // namespace posed::tracker
