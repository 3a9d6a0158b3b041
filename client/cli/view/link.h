// The connection to the daemon, on a thread of its own: a slow answer or a lost connection never holds up the screen.
#pragma once

#include <deque>
#include <map>
#include <memory>
#include <mutex>
#include <thread>

#include "client/cli/view/edits.h"
#include "client/cli/view/station.h"
#include "client/lib/client.h"

namespace posed::view {

class Link {
 public:
  // Follows `client` until it goes out of scope; nobody else may use it meanwhile. `figure`: only this one; empty: all.
  Link(client::Client& client, std::string figure, double max_rate_hz);
  ~Link();
  Link(const Link&) = delete;
  Link& operator=(const Link&) = delete;

  // Readable when station() has changed; to be read empty by heard().
  int changed() const { return changed_; }
  void heard() const;
  Station station() const;

  // The number of the edit. One that still waits and has the same key is replaced: it never goes.
  std::uint64_t send(Edit edit);

  // All entities, asked for.
  static Result<std::shared_ptr<const Entities>> ask(client::Client& client, const Entities& before);

 private:
  struct Numbered {
    Edit edit;
    std::uint64_t number;
  };

  void run();
  Status subscribe();
  Status subscribe_to(proto::Stream stream);  // newest wins, as often as poses come
  Status follow();                            // one step; what is wrong with the connection
  void do_edits();
  void take(const proto::Incoming& frame);
  void tell(const Station& now);
  void note(std::string text, bool bad);

  client::Client& client_;
  const std::string figure_;
  const double max_rate_hz_;
  int changed_ = -1;

  mutable std::mutex mutex_;  // what follows
  Station shown_;
  std::deque<Numbered> edits_;
  std::uint64_t sent_ = 0;
  bool ended_ = false;

  // Of the thread.
  Station now_;
  bool subscribed_ = false, stale_ = true, first_frame_ = true;
  std::int64_t asked_t_ns_ = 0;
  std::uint64_t reconnected_ = 0;
  std::optional<std::int64_t> clock_offset_;
  std::deque<std::int64_t> arrivals_;
  std::thread thread_;
};

}  // namespace posed::view
