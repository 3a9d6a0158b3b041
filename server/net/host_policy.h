// Who may talk to the HTTP side. Browsers send other people's pages our way; this keeps those from driving the daemon.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace posed::net {

class HostPolicy {
 public:
  // `strict`: only names of ours. `hosts`, `origins`: as in Options.
  HostPolicy(bool strict, const std::vector<std::string>& hosts, const std::vector<std::string>& origins);

  // Of a Host header. A name that is not ours is another site's that was made to point here (DNS rebinding): its page
  // would be of our own origin. Addresses can't be rebound.
  bool host_allowed(std::string_view host) const;
  // Of a WebSocket's Origin header: our own page has the host that it was fetched from.
  bool origin_allowed(std::string_view origin, std::string_view host) const;

 private:
  bool strict_;
  std::vector<std::string> hosts_, origins_;
};

// "[::1]:19870" -> "::1", "localhost:19870" -> "localhost"; lower case.
std::string host_without_port(std::string_view host);

}  // namespace posed::net
