// Bindings as documents of the scene: a sensor that moves a goal. Plain values.
#pragma once

#include <optional>
#include <string>

#include "common/patched.h"

namespace posed {

struct Axes {
  bool x = true, y = true, z = true;
};

struct Binding {
  enum class Mode { absolute, relative };
  std::string id;
  std::string sensor;  // "simulated:1"
  std::string goal;    // the goal that it moves
  Axes axes;           // those of the goal that follow the sensor
  Mode mode = Mode::absolute;
  double scale = 1.0;
  std::string label;
  std::string user;
};

struct BindingEdit {
  std::string id;  // empty: SENSOR with ':' as '.'
  std::optional<std::string> sensor;
  std::optional<std::string> goal;
  Patched<Axes> axes;
  Patched<Binding::Mode> mode;
  Patched<double> scale;
  Patched<std::string> label;
  Patched<std::string> user;
};

}  // namespace posed
