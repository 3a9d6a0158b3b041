// Where on the page what is. Pure.
#pragma once

#include <array>

#include "client/cli/view/camera.h"
#include "client/cli/view/cell.h"

namespace posed::view {

struct Area {
  int column = 0, row = 0, columns = 0, rows = 0;
  bool empty() const { return columns <= 0 || rows <= 0; }
};

struct Layout {
  Area frame;                           // the box around the panes
  std::array<Area, 4> panes;            // by View; empty: not shown
  Area list;                            // of goals, with its border; empty: there is no room for it
  int words = 0;                        // the first of the lines of words at the bottom
  int split_column = 0, split_row = 0;  // of the lines between the panes; 0: none

  // By View: the dots of each pane.
  std::array<std::array<int, 2>, 4> dots() const;
};

// `alone`: this view only. `list`: if there is room.
Layout layout(Size size, bool alone, View view, bool list);

inline constexpr Size kLeast{40, 12};  // less is not drawn

}  // namespace posed::view
