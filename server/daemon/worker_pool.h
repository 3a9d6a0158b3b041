// Threads for work that is asked for by peers and touches nothing of the station. Jobs take turns part by part, so that
// a long one does not keep short ones waiting.
#pragma once

#include <atomic>
#include <condition_variable>
#include <deque>
#include <memory>
#include <mutex>
#include <thread>
#include <vector>

#include "server/net/server.h"

namespace posed {

class WorkerPool {
 public:
  class Job {
   public:
    Job(net::ConnectionId whose, std::size_t how_many) : peer(whose), parts(how_many) {}
    virtual ~Job() = default;
    // On worker `worker`, while other parts run on others. Each part once; asks `dropped` now and then.
    virtual void run(std::size_t part, std::size_t worker) = 0;

    const net::ConnectionId peer;
    const std::size_t parts;
    std::atomic<bool> dropped{false};  // nobody waits for it any more
  };

  static constexpr std::size_t kMostWaiting = 20'000;  // parts of all jobs

  explicit WorkerPool(std::size_t threads);
  ~WorkerPool();  // drops all jobs

  std::size_t threads() const { return threads_.size(); }
  // False where too much waits.
  [[nodiscard]] bool add(std::shared_ptr<Job> job);
  // The peer is gone: its jobs are dropped.
  void drop(net::ConnectionId peer);

 private:
  struct Turn {
    std::shared_ptr<Job> job;
    std::size_t next;  // part
  };
  void work(std::size_t worker);

  std::mutex mutex_;
  std::condition_variable more_;
  std::deque<Turn> turns_;
  std::size_t waiting_ = 0;
  bool stopping_ = false;
  std::vector<std::shared_ptr<Job>> running_;  // one a worker
  std::vector<std::thread> threads_;
};

}  // namespace posed
