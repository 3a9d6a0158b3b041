#include "server/daemon/worker_pool.h"

#include <sys/resource.h>

#include <algorithm>

namespace posed {
namespace {

constexpr int kNice = 10;  // live poses come first where cores are few

}  // namespace

WorkerPool::WorkerPool(std::size_t threads) : running_(std::max<std::size_t>(threads, 1)) {
  for (std::size_t i = 0; i < running_.size(); ++i) threads_.emplace_back([this, i] { work(i); });
}

WorkerPool::~WorkerPool() {
  {
    const std::lock_guard lock(mutex_);
    stopping_ = true;
    turns_.clear();
    for (auto& job : running_) {
      if (job) job->dropped = true;
    }
  }
  more_.notify_all();
  for (std::thread& thread : threads_) thread.join();
}

bool WorkerPool::add(std::shared_ptr<Job> job) {
  {
    const std::lock_guard lock(mutex_);
    if (waiting_ > 0 && waiting_ + job->parts > kMostWaiting) return false;
    waiting_ += job->parts;
    turns_.push_back({std::move(job), 0});
  }
  more_.notify_all();
  return true;
}

void WorkerPool::drop(net::ConnectionId peer) {
  const std::lock_guard lock(mutex_);
  for (auto& job : running_) {
    if (job && job->peer == peer) job->dropped = true;
  }
  std::erase_if(turns_, [&](const Turn& turn) {
    if (turn.job->peer != peer) return false;
    turn.job->dropped = true;
    waiting_ -= turn.job->parts - turn.next;
    return true;
  });
}

void WorkerPool::work(std::size_t worker) {
  ::setpriority(PRIO_PROCESS, 0, kNice);  // of this thread alone, on Linux
  std::unique_lock lock(mutex_);
  for (;;) {
    more_.wait(lock, [this] { return stopping_ || !turns_.empty(); });
    if (stopping_) return;
    Turn turn = std::move(turns_.front());
    turns_.pop_front();
    const std::size_t part = turn.next++;
    --waiting_;
    running_[worker] = turn.job;
    const std::shared_ptr<Job> job = turn.job;
    if (turn.next < job->parts) turns_.push_back(std::move(turn));
    lock.unlock();
    job->run(part, worker);
    lock.lock();
    running_[worker].reset();
  }
}

}  // namespace posed
