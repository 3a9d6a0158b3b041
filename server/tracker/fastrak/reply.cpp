#include "server/tracker/fastrak/reply.h"

#include <algorithm>
#include <cstdlib>
#include <string>
#include <string_view>

#include "server/tracker/error_letter.h"

namespace posed::tracker {
namespace {

constexpr std::size_t kMost = 256;  // the longest that is documented has some 110
constexpr std::string_view kError = "*ERROR*", kCode = "EC";
constexpr int kUnnamedError = -1000;

int error_of(std::string_view text) {
  if (text.find(kError) == std::string_view::npos) return 0;
  const std::size_t code = text.rfind(kCode);
  const int number =
      code == std::string_view::npos ? 0 : std::atoi(std::string(text.substr(code + kCode.size())).c_str());
  return number < 0 ? number : kUnnamedError;
}

std::string_view error_text(int error) {
  switch (error) {
    case -1:
      return "a field is missing";
    case -2:
      return "not a number";
    case -3:
      return "out of range";
    case -4:
      return "the frequency";
    case -5:
      return "its buffer";
    case -99:
      return "a command that it does not know";
    default:
      return "";
  }
}

}  // namespace

TextReply examine_text_reply(std::span<const std::uint8_t> bytes, int stations) {
  TextReply found;
  const auto wrong = [&](std::size_t at, auto holds) { return bytes.size() > at && !holds(bytes[at]); };
  if (wrong(0, [](std::uint8_t c) { return c == '2'; })) return found;
  if (wrong(1, [&](std::uint8_t c) { return c == ' ' || (c >= '1' && c <= '0' + stations); })) return found;
  if (wrong(2, is_letter)) return found;
  std::size_t at = 3;
  for (; at < bytes.size() && at < kMost; ++at) {
    // A complaint repeats what was typed, control codes and all.
    if (bytes[at] == 0 || bytes[at] > 0x7e) return found;
    if (bytes[at] == '\n' && bytes[at - 1] == '\r') break;
  }
  if (at >= kMost) return found;
  if (at >= bytes.size()) {
    found.state = TextReply::State::partial;
    return found;
  }
  found.state = TextReply::State::whole;
  found.size = at + 1;
  found.reply.station = bytes[1] == ' ' ? 0 : bytes[1] - '0';
  found.reply.command = bytes[2];
  const std::span<const std::uint8_t> text = bytes.subspan(3, at - 4);
  found.reply.body.assign(text.begin(), text.end());
  found.reply.error = error_of(std::string(text.begin(), text.end()));
  return found;
}

std::string complaint_text(int error) {
  const std::string_view text = error_text(error);
  return "the tracker complains of " + std::string(text.empty() ? "a command" : text) + " (error " +
         std::to_string(error) + ")";
}

}  // namespace posed::tracker
