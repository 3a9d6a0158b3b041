// Connections that wait for the moment when their rate lets a frame go: one timer for them all. Network thread only.
#pragma once

#include <boost/asio/steady_timer.hpp>
#include <map>
#include <memory>
#include <vector>

#include "common/time.h"

namespace posed::net {

class Connection;

class Wakes {
 public:
  Wakes(boost::asio::io_context& io, const Clock& clock) : clock_(clock), timer_(io) {}

  // Calls the connection's wake(due) then, unless it is gone.
  void at(Nanoseconds due, std::weak_ptr<Connection> connection);

 private:
  void arm();
  void fire();

  const Clock& clock_;
  boost::asio::steady_timer timer_;
  std::map<Nanoseconds, std::vector<std::weak_ptr<Connection>>> waiting_;
};

}  // namespace posed::net
