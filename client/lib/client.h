// A connection to the daemon for scripts and tools: calls that wait for their reply, and streams that are read frame by
// frame. Replies and frames share one connection; frames that come in between are kept. One thread at a time.
//
// Errors: what the daemon refused has its code ("unknown_segment"); otherwise `bad_address`, `cannot_connect`,
// `connection_lost`, `timeout` or `bad_reply`. After `connection_lost` and `bad_reply` every call fails, unless the
// connection is kept (keep_connected).
#pragma once

#include <chrono>
#include <functional>
#include <memory>
#include <string>
#include <string_view>

#include "common/result.h"
#include "proto/codec.h"

namespace posed::client {

// Who we say that we are.
struct Identity {
  std::string token;      // empty: none is asked for
  std::string user;       // empty: the token's
  std::string authority;  // a file in PEM of whose certificates to trust; empty: those of the system
  // With `user`, whose edits these are, in every connection that says the same. Empty: the daemon gives one, which the
  // connections that are made anew say again.
  std::string resume = {};
  std::string program = {};  // "posectl 0.1.0": who is said to be there. All empty: no hello is said.
};

class Client {
 public:
  using Duration = std::chrono::milliseconds;

  // `address` as in "tcp://127.0.0.1:19870". The time-out is also that of the calls to come.
  static Result<Client> connect(std::string_view address, Duration timeout = std::chrono::seconds(5),
                                Identity identity = {});
  ~Client();
  Client(Client&&) noexcept;
  Client& operator=(Client&&) noexcept;

  void set_timeout(Duration timeout);
  // A connection that is lost is made anew, for as long as `patience`, by the next call and by next(), and subscribes
  // to what it had subscribed to. The call whose reply was lost fails all the same: what it asked for may have been
  // done.
  void keep_connected(Duration patience);
  std::uint64_t reconnected() const;  // how often
  // Called while a solve.batch that asks for "progress" is waited for.
  void on_progress(std::function<void(std::uint64_t done, std::uint64_t of)> told);

  // Both give the JSON text of the result.
  Result<std::string> call(std::string_view method, std::string_view params_json = "{}");
  Result<std::string> request(const proto::Params& params);

  // call<proto::StatusResult>(proto::SessionStatus{})
  template <class R, class P>
  Result<R> call(const P& params) {
    auto result = request(params);
    if (!result) return result.error();
    return proto::decode_message<R>(*result);
  }

  Status subscribe(const proto::StreamSubscribe& subscription);
  Status unsubscribe(proto::Stream stream);
  // The next frame of any stream; acknowledged if its subscription has credit. Error "woken": by wake().
  Result<proto::Incoming> next(Duration timeout);
  // From any thread: next() returns, at once or when it is called.
  void wake();
  // Frames that the daemon left out because we read too slowly, or that came while nobody asked for them.
  std::uint64_t lost(proto::Stream stream) const;

 private:
  struct Impl;
  explicit Client(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace posed::client
