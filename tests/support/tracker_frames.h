// What a Polhemus device makes of a measured pose before it says it: the stylus' tip, the alignment of the source's
// frame, boresight. All in inches and degrees. Source: LIBERTY and FASTRAK manuals, commands N, A, B; that an
// alignment's points are in the frame of the one before, so that alignments accumulate, and that boresight turns about
// the sensor's own axes.
#pragma once

#include <array>

#include "tests/support/tracker_emulator.h"

namespace posed::test {

class SensorFrames {
 public:
  using Point = std::array<double, 3>;
  using Matrix = std::array<double, 9>;  // rows

  void set_tip(const Point& tip);
  // The present frame's points that become the origin, lie on +X, and on +Y's side.
  void align(const Point& origin, const Point& x, const Point& y);
  void reset_alignment();
  // As the sensor is now is to be `reference`'s angles; its place too, where `origin`.
  void boresight(const SourcePose& measured, const SourcePose& reference, bool origin);
  void reset_boresight();

  SourcePose of(const SourcePose& measured) const;

 private:
  SourcePose aligned(const SourcePose& measured) const;

  static constexpr Matrix kIdentity{1, 0, 0, 0, 1, 0, 0, 0, 1};
  bool plain_ = true;  // nothing of all that was ever said
  Point tip_{}, origin_{}, bore_origin_{};
  Matrix axes_ = kIdentity;  // of the alignment, in columns, in the source's frame
  Matrix bore_ = kIdentity;
};

}  // namespace posed::test
