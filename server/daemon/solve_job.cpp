#include "server/daemon/solve_job.h"

#include "server/scene/errors.h"

namespace posed {
namespace {

constexpr Nanoseconds kProgressPeriod = 100'000'000;

}  // namespace

SolveJob::SolveJob(net::ConnectionId peer_id, Station station, Work work, Responder responder)
    : Job(peer_id, work.batch.problems.size()),
      station_(station),
      work_(std::move(work)),
      responder_(std::move(responder)),
      texts_(parts),
      told_(station.clock.now()) {}

void SolveJob::run(std::size_t part, std::size_t worker) {
  if (dropped) return;
  const proto::Solved solved = solve(part, worker);
  if (dropped) return;
  if (work_.alone && solved.error) return fail(*solved.error);
  done(part, proto::encode_solved(solved));
}

proto::Solved SolveJob::solve(std::size_t part, std::size_t worker) {
  const proto::ProblemEntry& entry = work_.batch.problems[part];
  if (entry.error) return {{}, entry.error};
  Result<proto::SolveResult> result = station_.solvers[worker].solve(
      {entry.problem, work_.batch, *work_.figures[part], work_.fields}, station_.method, station_.clock, dropped);
  if (result) return {std::move(*result), {}};
  const std::string path = work_.alone ? "/params" : "/params/problems/" + std::to_string(part);
  return {{}, below(path, std::move(result.error()))};
}

void SolveJob::done(std::size_t part, std::string text) {
  const std::lock_guard lock(mutex_);
  if (failed_) return;
  bytes_ += text.size();
  texts_[part] = std::move(text);
  ++done_;
  if (bytes_ > kMaxAnswerBytes) {
    failed_ = true;
    dropped = true;
    return fail({"too_large", "the answer is larger than 64 MiB", "/params/problems",
                 R"(send it in parts, or ask for less, as in "fields":["q"])"});
  }
  if (done_ == parts) return answer(work_.alone ? std::move(texts_[0]) : proto::join_solved(texts_));
  const Nanoseconds now = station_.clock.now();
  if (!work_.batch.progress || now - told_ < kProgressPeriod) return;
  told_ = now;
  station_.server.notify(peer, std::make_shared<const std::string>(responder_.progress_text(done_, parts)));
}

// A large text is made here, and only sent there.
void SolveJob::answer(const std::string& result) {
  station_.loop.post(
      [responder = responder_, text = responder_.reply_text(result)]() mutable { responder.deliver(std::move(text)); });
}

void SolveJob::fail(const Error& error) {
  station_.loop.post([responder = responder_, error]() mutable { responder.error(error); });
}

}  // namespace posed
