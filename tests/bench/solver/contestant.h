// One solver in the race. What is timed is `solve` alone: goals and start are handed over before, the answer is taken
// after, so that nobody pays for another's coordinates.
//
// A peer is one file NAME_peer.cpp with one function below, built when its library is there (see CMakeLists.txt).
#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "tests/bench/solver/problems.h"

namespace posed::test {

// Starts that a solver with restarts has, ours and the best of the peers alike; it stops at the first that solves.
inline constexpr int kStarts = 8;

class Contestant {
 public:
  virtual ~Contestant() = default;
  virtual std::string who() const = 0;
  // A solver that needs many milliseconds gets fewer problems and fewer runs of each.
  virtual bool slow() const { return false; }

  // `start`: HingeFigure's coordinates. `stream`: it is the answer to the frame before, and near. Called before each
  // solve, so a solve that is timed again does the same work again. Problems of one set have the same points in the
  // same order.
  virtual void prepare(const Problem& problem, std::span<const double> start, bool stream) = 0;
  virtual void solve() = 0;
  // HingeFigure's coordinates; the root's quaternion of unit length.
  virtual void answer(std::span<double> x) const = 0;
};

std::unique_ptr<Contestant> springs_contestant(const HingeFigure& figure);
std::unique_ptr<Contestant> mujoco_peer(const HingeFigure& figure);
std::unique_ptr<Contestant> ceres_peer(const HingeFigure& figure);
std::unique_ptr<Contestant> kdl_peer(const HingeFigure& figure);
std::unique_ptr<Contestant> simbody_peer(const HingeFigure& figure);

}  // namespace posed::test
