// A decoder from its description.
#pragma once

#include <memory>
#include <string>
#include <string_view>

#include "common/result.h"
#include "server/tracker/decoder.h"

namespace posed::tracker {

struct DescribedDecoder {
  std::unique_ptr<Decoder> decoder;
  std::string device;  // of its Frames
};

// Error invalid_params: the description says what no decoder says of itself.
Result<DescribedDecoder> make_decoder(std::string_view description);

}  // namespace posed::tracker
