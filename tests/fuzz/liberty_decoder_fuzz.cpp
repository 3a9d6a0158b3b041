// The LIBERTY decoder on bytes from a hostile device. The first byte chooses the output list and what is known of the
// stations, the second where the rest is cut in two.
#include <utility>

#include "server/tracker/liberty/decoder.h"
#include "tests/fuzz/decoder_fuzz.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace posed::tracker;
  if (size < 2) return 0;
  LibertyFormat format;
  if (data[0] & 1) format.items = {2, 4, 1};
  if (data[0] & 2) format.stations = 4;
  const int stations = format.stations;
  LibertyDecoder one = std::move(*LibertyDecoder::make(std::move(format)));
  LibertyDecoder other = one;
  one.expect_up_to(data[0] >> 6);
  other.expect_up_to(data[0] >> 6);
  fuzz::check_decoder(one, other, stations, {data + 2, size - 2}, data[1], (data[0] & 4) != 0);
  return 0;
}
