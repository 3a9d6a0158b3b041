// The 8-byte header of a LIBERTY-family binary frame, and which headers can be true.
// Source: LIBERTY User Manual URM03PH156 Rev H: frame header, command replies, error codes.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace posed::tracker {

inline constexpr std::size_t kLibertyHeaderSize = 8;

inline constexpr std::uint8_t kCommandContinuous = 'C';
inline constexpr std::uint8_t kCommandPoll = 'P';
inline constexpr std::uint8_t kCommandActiveStations = 0x15;  // ^U

struct LibertyHeader {
  std::array<char, 2> tag{};
  int station = 0;           // 1-based; 0: of none
  std::uint8_t command = 0;  // that made the device speak
  std::uint8_t error = 0;    // 0 or a blank: none
  int size = 0;              // bytes of the body that follows
};

LibertyHeader parse_liberty_header(std::span<const std::uint8_t> bytes);  // at least 8

bool is_data(const LibertyHeader& header, int stations, std::size_t body_size);
bool is_answer(const LibertyHeader& header, int stations);     // to a query, of the size that the manual gives it
bool is_complaint(const LibertyHeader& header, int stations);  // an error code, and a text of modest length

inline bool no_error(std::uint8_t error) {
  return error == 0x00 || error == 0x20;
}  // binary mode or not, either is seen
bool printable(std::span<const std::uint8_t> text);

std::string_view liberty_error_text(std::uint8_t error);  // "invalid command"; of a code that is not known: ""

}  // namespace posed::tracker
