// What the connections of one server share. Network thread only, but for the tally.
#pragma once

#include <boost/asio/io_context.hpp>
#include <memory>
#include <unordered_map>
#include <vector>

#include "server/net/guests.h"
#include "server/net/http_site.h"
#include "server/net/server.h"
#include "server/net/subscriptions.h"
#include "server/net/wakes.h"

namespace posed::net {

struct Hub {
  Hub(Options options_, Handlers handlers_, const Clock& clock_, bool loopback)
      : options(std::move(options_)),
        handlers(std::move(handlers_)),
        clock(clock_),
        // A page that another site has led here can do nothing without a token; where none is asked for, names count.
        site(HostPolicy(loopback || !options.tokens, options.hosts, options.origins), options.viewer, options.tokens),
        scratch(64 << 10) {}

  const Options options;
  const Handlers handlers;
  const Clock& clock;
  Tally tally;
  HttpSite site;
  Subscriptions subscriptions;
  std::vector<char> scratch;      // every read goes here first: a connection that is silent has no buffer
  boost::asio::io_context io{1};  // before the connections, after all that they use when its handlers are destroyed
  Wakes wakes{io, clock};
  std::unordered_map<ConnectionId, std::shared_ptr<Connection>> connections;
  Guests guests{options.limits};
  ConnectionId next_id = 1;
  bool stopping = false;

  void remove(Connection& connection);
};

}  // namespace posed::net
