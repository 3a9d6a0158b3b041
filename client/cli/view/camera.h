// Where the four views look from, as in the paper's Figure 2. The orthographic three share one centre and one scale;
// the fourth orbits. Pure. World: metres, X forward, Y left, Z up. Screen: dots, x to the right, y down.
#pragma once

#include <array>
#include <optional>

#include "common/math.h"

namespace posed::view {

enum class View { top, perspective, front, side };  // in reading order: top stands over front, so that Y runs alike
inline constexpr std::array kViews{View::top, View::perspective, View::front, View::side};

// A view as it is drawn: straight rays through the dots of a pane.
struct Camera {
  Vec3 right, up, back;       // world directions of the screen's right and up, and out of the screen
  Vec3 eye;                   // orthographic: the centre of what is seen
  bool perspective = false;   // else orthographic
  double scale = 1.0;         // orthographic: dots a metre; perspective: dots a metre at 1 m
  double x0 = 0.0, y0 = 0.0;  // where the screen's centre is

  struct Point {
    double x, y, depth;  // depth: metres along the view, orthographic from the eye's plane
  };
  std::optional<Point> project(const Vec3& world) const;  // none: behind the eye
  double metres_a_dot(double depth) const { return perspective ? depth / scale : 1.0 / scale; }

  // The ray through a dot, as the ray through the centre and what it changes by, a dot to the right and a dot down. A
  // point at `depth` is origin + depth * direction.
  struct Rays {
    Vec3 origin, origin_x, origin_y;
    Vec3 direction, direction_x, direction_y;
  };
  Rays rays() const;

  static constexpr double kNear = 0.05;  // m, of perspective views
};

struct Box {
  Vec3 low{1e300, 1e300, 1e300}, high{-1e300, -1e300, -1e300};
  bool empty() const { return low.x > high.x; }
  void add(const Vec3& point, double radius = 0.0);
};

// What a viewer moves.
class Cameras {
 public:
  // For a pane of so many dots.
  Camera camera(View view, int width, int height) const;

  // Frames a box; the directions of the views stay. `panes`: the dots of each view's pane, in the order of View.
  void fit(const Box& box, const std::array<std::array<int, 2>, 4>& panes);
  void orbit(double yaw, double pitch);  // rad
  // So many dots to the right and up, in a pane of this view.
  void pan(View view, int width, int height, double right, double up);
  void zoom(double factor);  // of all four; below 1 comes nearer

 private:
  Vec3 centre_{0.0, 0.0, 0.9};
  double span_ = 2.3;  // m across the shorter side of an orthographic pane
  double yaw_ = -0.62, pitch_ = 0.22, distance_ = 4.4;
};

}  // namespace posed::view
