// Bindings as documents of the scene: a sensor that moves a goal or an object. Plain values.
#pragma once

#include <optional>
#include <string>

#include "common/patched.h"

namespace posed {

struct Axes {
  bool x = true, y = true, z = true;
  bool rotation = false;  // rx, ry and rz, which go together
};

// One of the two is named.
struct BindingTarget {
  std::string goal, object;
  bool operator==(const BindingTarget&) const = default;
};

struct Binding {
  enum class Mode { absolute, relative };
  std::string id;
  std::string sensor;  // "simulated:1"
  BindingTarget to;    // what it moves
  Axes axes;           // those of the target that follow the sensor
  Mode mode = Mode::absolute;
  double scale = 1.0;  // of positions
  std::string label;
  std::string user;
};

// Goals follow with their position, objects with their rotation, too.
inline Axes default_axes(const BindingTarget& to) {
  Axes axes;
  axes.rotation = !to.object.empty();
  return axes;
}

struct BindingEdit {
  std::string id;  // empty: SENSOR with ':' as '.'
  std::optional<std::string> sensor;
  std::optional<BindingTarget> to;
  Patched<Axes> axes;
  Patched<Binding::Mode> mode;
  Patched<double> scale;
  Patched<std::string> label;
  Patched<std::string> user;
};

}  // namespace posed
