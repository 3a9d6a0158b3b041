// The FASTRAK decoder on bytes from a hostile device. The first byte chooses the output list, binary or ASCII, and what
// is known of the stations, the second where the rest is cut in two.
#include <utility>

#include "server/tracker/fastrak/decoder.h"
#include "tests/fuzz/decoder_fuzz.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace posed::tracker;
  if (size < 2) return 0;
  FastrakFormat format;
  if (data[0] & 1) format.items = {2, 4, 1};
  if (data[0] & 2) format.binary = false;
  if (data[0] & 8) format.items = {52, 61, 1};
  const int stations = format.stations;
  FastrakDecoder one = std::move(*FastrakDecoder::make(std::move(format)));
  FastrakDecoder other = one;
  one.expect_up_to(data[0] >> 6);
  other.expect_up_to(data[0] >> 6);
  fuzz::check_decoder(one, other, stations, {data + 2, size - 2}, data[1], (data[0] & 4) != 0);
  return 0;
}
