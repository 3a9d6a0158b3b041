// What is drawn of a station in one view: floor, objects, figures with their pins, goals, sensors, cameras. Pure.
#pragma once

#include <string>

#include "client/cli/view/camera.h"
#include "client/cli/view/canvas.h"
#include "client/cli/view/station.h"

namespace posed::view {

struct Pane {
  int column = 0, row = 0;  // of its top left character
  Size size;
  View view = View::top;
  Camera camera;
};

// `chosen`: the goal that stands out. `moved`: goals that are on their way to another place in the world.
void draw_scenery(Grid& grid, const Pane& pane, const Station& station, const std::string& chosen,
                  const std::map<std::string, Vec3>& moved, Glyphs glyphs);

// Around all figures, goals and objects; a metre about the origin where there is nothing.
Box bounds(const Station& station);

}  // namespace posed::view
