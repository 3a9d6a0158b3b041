// Bytes cut into lines: where the pieces were cut makes no difference. The first byte says how long a line may be.
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "proto/framing.h"
#include "tests/fuzz/require.h"

namespace {

using posed::fuzz::require;

struct Cut {
  std::vector<std::string> lines;
  std::string rest;
  bool good = true;
};

// `step` decides the size of each piece; 0: all at once.
Cut cut_up(std::string_view text, std::size_t step, std::size_t limit) {
  posed::proto::LineSplitter splitter(limit);
  Cut cut;
  std::size_t size = step;
  while (!text.empty() && cut.good) {
    size = step == 0 ? text.size() : size * 7 % 13 % step + 1;
    const std::string_view piece = text.substr(0, size);
    text.remove_prefix(piece.size());
    cut.good = splitter.push(piece);
    while (const auto line = splitter.next()) {
      require(!line->empty() && line->size() <= limit && line->find('\n') == std::string_view::npos, "no line", *line);
      cut.lines.emplace_back(*line);
    }
  }
  if (cut.good) cut.rest = splitter.rest();
  return cut;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  const std::size_t limit = 1 + data[0];
  const std::string_view text(reinterpret_cast<const char*>(data) + 1, size - 1);
  const Cut whole = cut_up(text, 0, limit);
  for (const std::size_t step : {1u, 3u, 12u}) {
    const Cut pieces = cut_up(text, step, limit);
    require(pieces.lines == whole.lines && pieces.rest == whole.rest && pieces.good == whole.good, "cut otherwise",
            text);
  }
  return 0;
}
