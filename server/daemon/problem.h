// A stateless problem and its answer: a pure function of what it is given, on any thread.
#pragma once

#include <atomic>
#include <memory>
#include <mutex>
#include <optional>
#include <string>

#include "common/time.h"
#include "proto/messages.h"
#include "server/daemon/figure_group.h"
#include "server/scene/scene.h"

namespace posed {

// The figure of a problem. One that is not in the scene is made when it is first asked for, on the thread that asks;
// the problems of a batch share it.
class ProblemFigure {
 public:
  explicit ProblemFigure(const SceneFigure& present);
  explicit ProblemFigure(const proto::FigureChoice& choice);

  // Errors: paths begin at the problem, "/figure/segments/3".
  const Result<SceneFigure>& get();
  bool in_scene() const { return in_scene_; }

 private:
  const bool in_scene_;
  std::once_flag once_;
  proto::FigureChoice choice_;
  std::optional<Result<SceneFigure>> made_;
};

inline constexpr Nanoseconds kProblemDeadline = 1'000'000'000;  // where the problem names none

struct ProblemTask {
  const proto::Problem& problem;
  const proto::ProblemSetting& common;  // for what the problem leaves out
  ProblemFigure& figure;
  proto::PoseFields fields;
};

// Keeps a solver from problem to problem. One a thread.
class ProblemSolver {
 public:
  // Errors: paths begin at the problem ("/goals/0/at").
  Result<proto::SolveResult> solve(const ProblemTask& task, Method fallback, const Clock& clock,
                                   const std::atomic<bool>& dropped);

 private:
  std::unique_ptr<FigureGroup> group_;
};

}  // namespace posed
