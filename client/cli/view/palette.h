// The colours of the drawing, in one place, as numbers of the palette of 256. Left is cool, right is warm, the middle
// is neutral; a goal has the colour of its state. As in the browser's viewer.
#pragma once

#include <algorithm>
#include <array>

#include "client/cli/view/cell.h"
#include "common/pose.h"

namespace posed::view {

enum class Tone { middle, left, right, object };

// `light` from 0 to 1.
inline int shaded(Tone tone, double light) {
  static constexpr std::array<std::array<int, 5>, 4> kRamps{
      {{241, 245, 249, 252, 255}, {24, 67, 74, 110, 153}, {95, 137, 173, 180, 223}, {236, 238, 240, 242, 244}}};
  const auto& ramp = kRamps[static_cast<std::size_t>(tone)];
  return ramp[static_cast<std::size_t>(std::clamp(light, 0.0, 1.0) * 4.999)];
}

inline int color_of(GoalState state) {
  switch (state) {
    case GoalState::reached:
      return 78;
    case GoalState::balanced:
      return 214;
    case GoalState::limited:
      return 209;
    case GoalState::unreachable:
      return 203;
    case GoalState::off:
      break;
  }
  return 245;
}

inline constexpr int kFloor = 238, kFloorLine = 242;
inline constexpr std::array kAxes{167, 71, 68};  // X, Y, Z
inline constexpr int kPin = 179, kSensor = 183, kCamera = 116;
inline constexpr Style kFrame{240}, kFrameActive{110}, kTitle{250}, kTitleActive{153, -1, true}, kDim{245}, kPlain{},
    kStrong{-1, -1, true}, kGood{78}, kWarning{214}, kBad{203, -1, true}, kKey{153, -1, true};

}  // namespace posed::view
