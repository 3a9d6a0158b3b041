// The SpaceMouse decoder on reports from a hostile device: each is led by its length, since a read is one report.
#include <algorithm>

#include "server/tracker/spacemouse/decoder.h"
#include "tests/fuzz/decoder_fuzz.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace posed::tracker;
  SpacemouseDecoder decoder{SpacemouseFormat{}};
  posed::Nanoseconds now = 0;
  for (std::size_t at = 0; at < size;) {
    const std::size_t length = std::min<std::size_t>(data[at] % 64, size - at - 1);
    now += data[at] / 64 * 7'000'000;
    const Heard heard = decoder.feed({data + at + 1, length}, now);
    fuzz::require(heard.frames.size() <= 1);
    fuzz::samples_in(heard, 1);
    at += 1 + length;
  }
  return 0;
}
