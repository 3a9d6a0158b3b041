#include "server/tracker/liberty/header.h"

#include <algorithm>

#include "server/tracker/error_letter.h"

namespace posed::tracker {
namespace {

constexpr int kMaxText = 256;

struct AnswerSize {
  std::uint8_t command;
  int min, max;
};

constexpr AnswerSize kAnswers[] = {
    {kCommandActiveStations, 4, 4},  // ^U
    {'F', 4, 4},
    {'U', 4, 4},
    {'R', 4, 4},
    {'Z', 4, 4},
    {'D', 4, 4},
    {'L', 4, 4},
    {0x05, 4, 4},
    {'H', 12, 12},
    {'G', 12, 12},
    {'N', 12, 12},
    {'B', 12, 12},
    {'A', 36, 36},
    {'X', 16, 16},
    {'Y', 16, 16},
    {'O', 80, 80},
    {0x0F, 8, 8},
    {0x14, 36, 72},
    {0x16, 3, 512},
};

constexpr std::string_view kErrorTexts[] = {
    "",
    "invalid command",
    "invalid station",
    "invalid parameter",
    "too few parameters",
    "too many parameters",
    "parameter below its limit",
    "parameter above its limit",
    "no communication with the sensor board",
    "sensor processor 1 does not start",
    "sensor processor 2 does not start",
    "sensor processor 3 does not start",
    "sensor processor 4 does not start",
    "no sensor processors",
    "the source does not start",
    "memory",
    "excess characters",
    "must leave UTH mode",
    "the source's memory cannot be read, defaults are used",
    "read-only",
    "a message that is not fatal",
    "the distortion map cannot be loaded",
    "sensor synchronisation",
    "a firmware upgrade is required",
    "a firmware upgrade is recommended",
};

bool station_or_none(const LibertyHeader& header, int stations) {
  return header.station >= 0 && header.station <= stations;
}

}  // namespace

LibertyHeader parse_liberty_header(std::span<const std::uint8_t> bytes) {
  LibertyHeader header;
  header.tag = {static_cast<char>(bytes[0]), static_cast<char>(bytes[1])};
  header.station = bytes[2];
  header.command = bytes[3];
  header.error = bytes[4];
  header.size = static_cast<std::int16_t>(static_cast<std::uint16_t>(bytes[6] | bytes[7] << 8));
  return header;
}

bool is_data(const LibertyHeader& header, int stations, std::size_t body_size) {
  return (header.command == kCommandContinuous || header.command == kCommandPoll) && header.station >= 1 &&
         header.station <= stations && (no_error(header.error) || is_letter(header.error)) &&
         header.size == static_cast<int>(body_size);
}

bool is_answer(const LibertyHeader& header, int stations) {
  return no_error(header.error) && station_or_none(header, stations) &&
         std::any_of(std::begin(kAnswers), std::end(kAnswers), [&](const AnswerSize& answer) {
           return answer.command == header.command && header.size >= answer.min && header.size <= answer.max;
         });
}

bool is_complaint(const LibertyHeader& header, int stations) {
  // The vendor's own software knows codes up to 36, and 70 to 72, which are letters when they stand on data.
  const bool code =
      (header.error >= 1 && header.error <= 36 && header.error != 0x20) || (header.error >= 70 && header.error <= 72);
  return code && station_or_none(header, stations) && header.size >= 0 && header.size <= kMaxText;
}

bool printable(std::span<const std::uint8_t> text) {
  return std::all_of(text.begin(), text.end(), [](std::uint8_t c) {
    return (c >= 0x20 && c < 0x7f) || c == '\r' || c == '\n' || c == '\t' || c == '\0';
  });
}

std::string_view liberty_error_text(std::uint8_t error) {
  return error < std::size(kErrorTexts) ? kErrorTexts[error] : std::string_view{};
}

}  // namespace posed::tracker
