// posectl view: the four views of the paper in a terminal, live.
#pragma once

#include <optional>
#include <string>

#include "client/cli/view/canvas.h"
#include "client/cli/view/cell.h"
#include "client/lib/client.h"

namespace posed::view {

struct Options {
  std::string where;   // the daemon's address, to be shown
  std::string figure;  // empty: all
  double max_rate_hz = 60.0;
  std::optional<Glyphs> glyphs;  // none: what the terminal can show
  std::optional<Size> size;      // of --once; none: the terminal's, else 80 x 24
};

// Until the user quits, or is told to by a signal. Errors: "no_terminal", and those of the client.
Status run(client::Client& client, const Options& options);
// One picture, as text.
Result<std::string> once(client::Client& client, const Options& options);

}  // namespace posed::view
