#include "server/tracker/viper/frame.h"

#include <array>

#include "server/tracker/little_endian.h"

namespace posed::tracker {
namespace {

constexpr std::size_t kCrc = 4;
constexpr std::size_t kMostCommand = 2048;  // the longest that is known, a refusal, has some 220 bytes

constexpr std::array<std::uint16_t, 256> kTable = [] {
  std::array<std::uint16_t, 256> table{};
  for (unsigned i = 0; i < table.size(); ++i) {
    unsigned value = i;
    for (int bit = 0; bit < 8; ++bit) value = (value & 1) ? (value >> 1) ^ 0xA001u : value >> 1;
    table[i] = static_cast<std::uint16_t>(value);
  }
  return table;
}();

void put(std::string& to, std::uint32_t word) {
  for (int shift = 0; shift < 32; shift += 8) to += static_cast<char>(word >> shift & 0xff);
}

bool begins(std::span<const std::uint8_t> bytes, std::uint32_t preamble) {
  for (std::size_t i = 0; i < 4 && i < bytes.size(); ++i) {
    if (bytes[i] != (preamble >> (8 * i) & 0xff)) return false;
  }
  return true;
}

}  // namespace

std::uint16_t crc16(std::span<const std::uint8_t> bytes) {
  unsigned value = 0;
  for (const std::uint8_t byte : bytes) value = value >> 8 ^ kTable[(value ^ byte) & 0xff];
  return static_cast<std::uint16_t>(value);
}

ViperFrame examine_viper_frame(std::span<const std::uint8_t> bytes) {
  ViperFrame frame;
  frame.pose = begins(bytes, kViperPosePreamble);
  if (!frame.pose && !begins(bytes, kViperCommandPreamble)) return {};
  if (bytes.size() < kViperHeader) {
    frame.size = kViperHeader;
    return frame;
  }
  const std::size_t size = kViperHeader + u32_at(bytes, 4);
  if (frame.pose) {
    if (size < kViperPoseSize || size > kViperPoseSize + kViperMostSensors * kViperSensorSize) return {};
    if ((size - kViperPoseSize) % kViperSensorSize != 0) return {};
  } else if (size < kViperCommandSize || size > kMostCommand) {
    return {};
  }
  frame.size = size;
  if (bytes.size() < size) return frame;
  frame.whole = crc16(bytes.first(size - kCrc)) == u32_at(bytes, size - kCrc);
  return frame.whole ? frame : ViperFrame{};
}

std::string viper_command(ViperCommand command, ViperAction action, std::span<const std::uint32_t> payload,
                          ViperArguments about) {
  constexpr std::uint32_t kAnyUnit = 0xffffffff;
  std::string frame;
  put(frame, kViperCommandPreamble);
  put(frame, static_cast<std::uint32_t>(kViperCommandSize - kViperHeader + 4 * payload.size()));
  put(frame, kAnyUnit);
  put(frame, command);
  put(frame, static_cast<std::uint32_t>(action));
  put(frame, about.sensor);
  put(frame, about.qualifier);
  for (const std::uint32_t word : payload) put(frame, word);
  put(frame, crc16({reinterpret_cast<const std::uint8_t*>(frame.data()), frame.size()}));
  return frame;
}

}  // namespace posed::tracker
