// Goals and bindings as documents of the scene (paper, "Positioning by constraints"). Plain values.
#pragma once

#include <optional>
#include <string>

#include "common/math.h"
#include "common/patched.h"

namespace posed {

// Where on a figure a goal takes hold: a segment's touch point, a point of it, or a named site.
struct Attachment {
  std::string segment;        // empty for a bare site
  std::optional<Vec3> point;  // segment's frame
  std::string site;           // "right_hand/fingertip" names segment right_hand and site fingertip
  bool operator==(const Attachment&) const = default;
};

struct Goal {
  std::string id;
  std::string figure;
  Attachment at;
  Vec3 position{0.0, 0.0, 0.0};  // world, m
  double weight = 10.0;          // >= 0; 0 is off
  double tolerance = 0.0;        // m
  bool enabled = true;
  std::string label;
  std::string user;  // JSON text of at most 4 KiB, kept verbatim; empty: none
};

struct GoalEdit {
  std::string id;      // empty: FIGURE.SEGMENT.position
  std::string figure;  // empty: the only figure, else "body"
  std::optional<Attachment> at;
  std::optional<Vec3> position;
  Patched<double> weight;
  Patched<double> tolerance;
  Patched<bool> enabled;
  Patched<std::string> label;
  Patched<std::string> user;
};

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
