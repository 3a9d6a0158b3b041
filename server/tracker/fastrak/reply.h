// What FASTRAK and ISOTRAK II say besides data, in ASCII also where they stream in binary: a 2, the station or a blank,
// the letter of the command, text, CR LF. Source: FASTRAK manual OPM00PI002 Rev G, command replies and error text.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

#include "server/tracker/decoder.h"

namespace posed::tracker {

struct TextReply {
  enum class State { none, partial, whole };
  State state = State::none;  // none: these bytes do not begin one
  std::size_t size = 0;       // of a whole one
  Reply reply;                // error: the number after EC, negative; the body is the text
};

TextReply examine_text_reply(std::span<const std::uint8_t> bytes, int stations);

std::string complaint_text(int error);  // what to tell of an error

}  // namespace posed::tracker
