// The ISOTRAK II decoder on bytes from a hostile device. The first byte says what is known of the stations, the second
// where the rest is cut in two.
#include "server/tracker/isotrak/decoder.h"
#include "tests/fuzz/decoder_fuzz.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace posed::tracker;
  if (size < 2) return 0;
  IsotrakDecoder one({}), other({});
  one.expect_up_to(data[0] >> 6);
  other.expect_up_to(data[0] >> 6);
  fuzz::check_decoder(one, other, 2, {data + 2, size - 2}, data[1], (data[0] & 4) != 0);
  return 0;
}
