// The whole page as it should stand on the terminal. Pure.
#pragma once

#include "client/cli/view/canvas.h"
#include "client/cli/view/desk.h"
#include "client/cli/view/station.h"

namespace posed::view {

struct Meter {
  std::string where;                  // the daemon's address
  std::optional<double> terminal_ms;  // from sending a page until the terminal has shown it
};

Grid page(Size size, const Station& station, const Desk& desk, const Meter& meter, Glyphs glyphs, double now);

// Its lines without colours.
std::string plain_text(const Grid& grid);

}  // namespace posed::view
