// Bodies drawn as solids: a ray through each dot, met with the shape. Pure.
#pragma once

#include <functional>
#include <optional>

#include "client/cli/view/camera.h"
#include "client/cli/view/canvas.h"
#include "common/figure.h"

namespace posed::view {

struct Hit {
  double depth;
  Vec3 normal;  // shape's frame, any length
};
// Where a ray first meets a shape; both in the shape's frame.
std::optional<Hit> meet(const Shape& shape, const Vec3& origin, const Vec3& direction);

// Every dot of the shape; `color` of how much light falls there, 0 to 1. What is thinner than a dot is drawn a dot
// wide.
void draw_shape(Canvas& canvas, const Camera& camera, const Shape& shape, const Transform& world_from_shape,
                Layer layer, int part, const std::function<int(double)>& color);

// A sphere around it, in its own frame.
struct Ball {
  Vec3 center;
  double radius;
};
Ball around(const Shape& shape);

}  // namespace posed::view
