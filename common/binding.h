// Bindings as documents of the scene: a sensor that moves a goal, an object, a camera or a joint. Plain values.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "common/math.h"
#include "common/patched.h"

namespace posed {

// Of the world: along, and about.
struct Axes {
  bool x = false, y = false, z = false, rx = false, ry = false, rz = false;
  bool moves() const { return x || y || z; }
  bool turns() const { return rx || ry || rz; }
  bool operator==(const Axes&) const = default;
};
inline constexpr Axes kMoves{true, true, true, false, false, false};
inline constexpr Axes kTurns{false, false, false, true, true, true};
inline constexpr Axes kAllAxes{true, true, true, true, true, true};

// One of goal, object, camera and joint is named.
struct BindingTarget {
  std::string goal, object, camera;
  std::string joint, figure;  // figure left out: the only one, else "body"
  bool operator==(const BindingTarget&) const = default;
};

// The target moves only while this button of the sensor is held.
struct Clutch {
  int button = 0;  // 0 is the first
};

// What a button of the sensor does when it is pressed.
struct ButtonAction {
  enum class Do {
    recenter,  // relative mode: back to where the document has the target, and on from there
    toggle,    // the target stays where it is, or follows again
    save       // the scene is saved as it stands
  };
  int button = 0;  // 0 is the first
  Do act = Do::recenter;
  bool operator==(const ButtonAction&) const = default;
};
inline constexpr std::array kButtonActionNames{"recenter", "toggle", "save"};  // on the wire and for people

// The target as the sensor sees it: how the one is fixed to the other.
struct SensorOffset {
  Vec3 position{0.0, 0.0, 0.0};
  Quat rotation{1.0, 0.0, 0.0, 0.0};  // sensor_from_target
};

// Casiez, Roussel and Vogel, "1 Euro Filter", CHI 2012: a low pass whose cutoff grows with the speed.
struct OneEuro {
  double min_cutoff_hz = 1.0;
  double beta = 0.0;  // Hz for each m/s, or rad/s
  double d_cutoff_hz = 1.0;
};
struct BindingFilter {
  std::optional<OneEuro> one_euro;
  double predict_ms = 0.0;
};

struct Binding {
  enum class Mode { absolute, relative };
  std::string id;
  std::string sensor;        // "simulated:1"
  BindingTarget to;          // what it moves
  std::optional<Axes> axes;  // those of the target that follow the sensor; in a scene always said
  Mode mode = Mode::absolute;
  std::optional<Clutch> clutch;
  std::vector<ButtonAction> buttons;
  double scale = 1.0;  // of positions
  std::optional<SensorOffset> offset;
  std::optional<BindingFilter> filter;
  std::string label;
  std::string user;
};

struct BindingEdit {
  std::string id;  // empty: SENSOR with ':' as '.'
  std::optional<std::string> sensor;
  std::optional<BindingTarget> to;
  Patched<Axes> axes;
  Patched<Binding::Mode> mode;
  Patched<Clutch> clutch;
  Patched<std::vector<ButtonAction>> buttons;
  Patched<double> scale;
  Patched<SensorOffset> offset;
  Patched<BindingFilter> filter;
  Patched<std::string> label;
  Patched<std::string> user;
};

}  // namespace posed
