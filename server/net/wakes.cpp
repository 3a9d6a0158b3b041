#include "server/net/wakes.h"

#include "server/net/connection.h"

namespace posed::net {

void Wakes::at(Nanoseconds due, std::weak_ptr<Connection> connection) {
  const bool first = waiting_.empty() || due < waiting_.begin()->first;
  waiting_[due].push_back(std::move(connection));
  if (first) arm();
}

void Wakes::arm() {
  timer_.expires_after(std::chrono::nanoseconds(std::max<Nanoseconds>(0, waiting_.begin()->first - clock_.now())));
  timer_.async_wait([this](boost::system::error_code error) {
    if (!error) fire();
  });
}

void Wakes::fire() {
  // In taking its turn a connection may ask for the next one.
  while (!waiting_.empty() && waiting_.begin()->first <= clock_.now()) {
    const auto now = waiting_.extract(waiting_.begin());
    for (const auto& waiting : now.mapped()) {
      if (const auto connection = waiting.lock()) connection->wake(now.key());
    }
  }
  if (!waiting_.empty()) arm();
}

}  // namespace posed::net
