// VIPER's frames: a preamble, the size of what follows, words, a CRC. Both ways.
// Source: the SDK's protocol headers as the public drivers have them; CRC-16/ARC (reflected 0xA001, from 0), kept in a
// word. Pure.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace posed::tracker {

inline constexpr std::uint32_t kViperCommandPreamble = 0x43525056;  // VPRC
inline constexpr std::uint32_t kViperPosePreamble = 0x50525056;     // VPRP

inline constexpr std::size_t kViperHeader = 8;        // preamble and size
inline constexpr std::size_t kViperCommandSize = 32;  // of a whole one without a payload
inline constexpr std::size_t kViperPoseSize = 28;     // of a whole one without sensors
inline constexpr std::size_t kViperSensorSize = 32;
inline constexpr std::uint32_t kViperMostSensors = 16;

enum class ViperAction : std::uint32_t { set = 0, get = 1, reset = 2, ack = 3, nak = 4, ack_with_warning = 5 };

enum ViperCommand : std::uint32_t {
  kViperHemisphere = 0,
  kViperFilter = 1,
  kViperFrameRate = 6,
  kViperUnits = 7,
  kViperStationMap = 10,
  kViperContinuous = 19,
};

std::uint16_t crc16(std::span<const std::uint8_t> bytes);

// The frame that `bytes` begin with. size 0: none; more than there are bytes: the rest has not come yet. A whole frame
// has the size that its words say, and the right CRC.
struct ViperFrame {
  std::size_t size = 0;
  bool whole = false;
  bool pose = false;
};
ViperFrame examine_viper_frame(std::span<const std::uint8_t> bytes);

// Whom a command is about, and how; most need neither.
struct ViperArguments {
  std::uint32_t sensor = 0;  // from 0; ~0u: all
  std::uint32_t qualifier = 0;
};
// A command, to any unit.
std::string viper_command(ViperCommand command, ViperAction action, std::span<const std::uint32_t> payload = {},
                          ViperArguments about = {});

}  // namespace posed::tracker
