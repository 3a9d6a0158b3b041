// Simbody behind plain values: its headers do not compile as C++20, so simbody_rig.cpp is C++17, and this header is
// both.
#pragma once

#include <memory>
#include <vector>

namespace posed::test {

struct SimbodyBody {
  int parent = -1;
  double position[3], quat_wxyz[4];  // of the joint's frame in the parent's
  int hinges = 0;                    // the root: 0, and free; universal: 2; ball: 3
  double axes[2][3];                 // universal
  double min[3], max[3];             // rad, infinite where there is no limit
};

struct SimbodyMarker {
  int body = 0;
  double point[3], weight = 0.0;
};

// Coordinates are HingeFigure's.
class SimbodyRig {
 public:
  SimbodyRig(const std::vector<SimbodyBody>& bodies, const std::vector<SimbodyMarker>& markers);
  ~SimbodyRig();

  void aim(int marker, const double* target);
  void start_at(const double* x);
  void solve();
  void answer(double* x) const;

 private:
  struct Inside;
  std::unique_ptr<Inside> in_;
};

}  // namespace posed::test
