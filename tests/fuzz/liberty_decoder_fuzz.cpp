// The LIBERTY decoder on bytes from a hostile device. The first byte chooses the output list and where the rest is cut
// in two; whatever comes, frames are well formed and bytes are all accounted for.
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <span>

#include "server/tracker/liberty_decoder.h"

namespace {

using namespace posed;
using namespace posed::tracker;

void require(bool holds) {
  if (!holds) std::abort();
}

std::size_t check(const LibertyOutput& out, int stations) {
  std::size_t samples = 0;
  for (const Frame& frame : out.frames) {
    require(!frame.samples.empty());
    int last = 0;
    for (const Sample& sample : frame.samples) {
      require(sample.station > last && sample.station <= stations);
      last = sample.station;
      require(finite(sample.position) && finite(sample.rotation));
      require(std::abs(glm::length(sample.rotation) - 1.0) < 1e-9);
      require(((sample.flags & kFlagError) != 0) == (sample.error_letter != 0));
      ++samples;
    }
  }
  return samples;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size < 2) return 0;
  LibertyFormat format;
  if (data[0] & 1) format.items = {2, 4, 1};
  if (data[0] & 2) format.stations = 4;
  const int stations = format.stations;
  const bool loses = (data[0] & 4) != 0;
  LibertyDecoder decoder = std::move(*LibertyDecoder::make(std::move(format)));
  LibertyDecoder whole = decoder;
  decoder.expect_up_to(data[0] >> 6);
  whole.expect_up_to(data[0] >> 6);

  const std::span<const std::uint8_t> bytes(data + 2, size - 2);
  const std::size_t cut = bytes.empty() ? 0 : data[1] % (bytes.size() + 1);
  const LibertyOutput first = decoder.feed(bytes.first(cut), 1);
  if (loses) decoder.lost_bytes();
  const LibertyOutput second = decoder.feed(bytes.subspan(cut), 2);
  const std::size_t samples = check(first, stations) + check(second, stations);
  require(decoder.bad_bytes() <= bytes.size());
  if (loses) return 0;

  const LibertyOutput all = whole.feed(bytes, 1);
  require(check(all, stations) == samples);
  require(all.frames.size() == first.frames.size() + second.frames.size());
  require(all.replies.size() == first.replies.size() + second.replies.size());
  require(whole.bad_bytes() == decoder.bad_bytes());
  return 0;
}
