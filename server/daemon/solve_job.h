// The problems of one `solve` or `solve.batch` on the workers: solves them, puts the answer together and hands it to
// the station's loop.
#pragma once

#include <mutex>
#include <string>
#include <vector>

#include "server/daemon/loop.h"
#include "server/daemon/problem.h"
#include "server/daemon/responder.h"
#include "server/daemon/worker_pool.h"

namespace posed {

// Each worker's own.
using ProblemSolvers = std::vector<ProblemSolver>;

class SolveJob final : public WorkerPool::Job {
 public:
  static constexpr std::size_t kMaxAnswerBytes = 64 << 20;

  struct Station {
    Loop& loop;
    net::Server& server;
    const Clock& clock;
    ProblemSolvers& solvers;
    Method method;  // where a problem names none
  };
  struct Work {
    proto::SolveBatch batch;
    // One a problem; null where that problem has an error.
    std::vector<std::shared_ptr<ProblemFigure>> figures;
    proto::PoseFields fields;
    bool alone = false;  // a `solve`: the answer is the result itself
  };

  SolveJob(net::ConnectionId peer, Station station, Work work, Responder responder);
  void run(std::size_t part, std::size_t worker) override;

 private:
  proto::Solved solve(std::size_t part, std::size_t worker);
  void done(std::size_t part, std::string text);
  void answer(const std::string& result);
  void fail(const Error& error);

  const Station station_;
  const Work work_;
  Responder responder_;
  std::mutex mutex_;
  std::vector<std::string> texts_;
  std::size_t done_ = 0, bytes_ = 0;
  Nanoseconds told_ = 0;  // when progress was last
  bool failed_ = false;
};

}  // namespace posed
