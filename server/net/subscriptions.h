// Who gets which lines: by stream and key, the connections that subscribed.
#pragma once

#include <algorithm>
#include <map>
#include <utility>
#include <vector>

#include "server/net/subscription.h"

namespace posed::net {

class Connection;

class Subscriptions {
 public:
  void add(Connection* connection, proto::Stream stream, std::uint32_t key) {
    remove(connection, stream);
    lists_[{stream, key}].connections.push_back(connection);
  }

  void remove(Connection* connection, proto::Stream stream) {
    for (auto it = lists_.lower_bound({stream, 0}); it != lists_.end() && it->first.first == stream;) {
      auto& connections = it->second.connections;
      std::erase(connections, connection);
      it = connections.empty() ? lists_.erase(it) : std::next(it);
    }
  }

  void remove_all(Connection* connection) {
    for (int stream = 0; stream < proto::kStreams; ++stream) remove(connection, static_cast<proto::Stream>(stream));
  }

  // `visit` must not change the subscriptions. Another connection comes first each time: the last one waits for the
  // sends of all before it.
  template <class Visit>
  void for_each(proto::Stream stream, std::uint32_t key, const Visit& visit) {
    const auto found = lists_.find({stream, key});
    if (found == lists_.end()) return;
    auto& [connections, turn] = found->second;
    const std::size_t count = connections.size();
    turn = (turn + 1) % count;
    for (std::size_t i = turn; i < count; ++i) visit(*connections[i]);
    for (std::size_t i = 0; i < turn; ++i) visit(*connections[i]);
  }

 private:
  struct List {
    std::vector<Connection*> connections;
    std::size_t turn = 0;
  };
  std::map<std::pair<proto::Stream, std::uint32_t>, List> lists_;
};

}  // namespace posed::net
