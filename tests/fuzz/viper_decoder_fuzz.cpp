// The VIPER decoder on bytes from a hostile device. Bit 0 of the first byte has the CRC of each frame put right, so
// that what lies behind it is reached; the second byte says where the rest is cut in two.
#include <algorithm>
#include <vector>

#include "server/tracker/little_endian.h"
#include "server/tracker/viper/decoder.h"
#include "server/tracker/viper/frame.h"
#include "tests/fuzz/decoder_fuzz.h"

namespace {

void put_crcs_right(std::vector<std::uint8_t>& bytes) {
  using namespace posed::tracker;
  for (std::size_t at = 0; at + kViperPoseSize <= bytes.size();) {
    const std::uint32_t preamble = u32_at(bytes, at);
    const std::size_t size = std::size_t{8} + u32_at(bytes, at + 4);
    if ((preamble != kViperPosePreamble && preamble != kViperCommandPreamble) || size < kViperPoseSize ||
        size > bytes.size() - at) {
      ++at;
      continue;
    }
    const std::uint32_t crc = crc16(std::span(bytes).subspan(at, size - 4));
    for (std::size_t i = 0; i < 4; ++i) bytes[at + size - 4 + i] = static_cast<std::uint8_t>(crc >> (8 * i));
    at += size;
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace posed::tracker;
  if (size < 2) return 0;
  std::vector<std::uint8_t> bytes(data + 2, data + size);
  if (data[0] & 1) put_crcs_right(bytes);
  ViperDecoder one({}), other({});
  fuzz::check_decoder(one, other, static_cast<int>(kViperMostSensors), bytes, data[1], (data[0] & 4) != 0);
  return 0;
}
