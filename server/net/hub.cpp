#include "server/net/hub.h"

#include "server/net/connection.h"

namespace posed::net {

void Hub::remove(Connection& connection) {
  subscriptions.remove_all(&connection);
  if (connection.opened()) {
    subtract(tally.peers);
    handlers.closed(connection.id());
  }
  guests.leave(connection.remote());
  connections.erase(connection.id());
  if (stopping && connections.empty()) io.stop();
}

}  // namespace posed::net
