#include "client/lib/address.h"

#include <charconv>

#include "proto/messages.h"

namespace posed::client {

std::string Address::text() const {
  return (host.find(':') == std::string::npos ? host : '[' + host + ']') + ':' + port;
}

Result<Address> parse_address(std::string_view text) {
  const auto wrong = [&](const char* message) {
    return Error{"bad_address", '"' + std::string(text) + "\" " + message, "", "as in tcp://127.0.0.1:19870"};
  };
  std::string_view left = text;
  Address address;
  if (const std::size_t scheme = left.find("://"); scheme != std::string_view::npos) {
    address.tls = left.starts_with("tls://");
    if (!address.tls && !left.starts_with("tcp://")) return wrong("does not begin with tcp:// or tls://");
    left.remove_prefix(scheme + 3);
  }
  if (left.ends_with('/')) left.remove_suffix(1);

  if (left.starts_with('[')) {
    const std::size_t end = left.find(']');
    if (end == std::string_view::npos) return wrong("has no closing bracket");
    address.host = left.substr(1, end - 1);
    left.remove_prefix(end + 1);
    if (!left.empty() && left.front() != ':') return wrong("has something other than a port behind the bracket");
  } else {
    const std::size_t colon = left.find(':');
    if (colon != std::string_view::npos && left.find(':', colon + 1) != std::string_view::npos) {
      return wrong("has an address with colons outside of brackets");
    }
    address.host = left.substr(0, colon);
    left.remove_prefix(std::min(colon, left.size()));
  }
  if (address.host.empty()) return wrong("names no host");
  if (left.empty()) {
    address.port = std::to_string(proto::kDefaultPort);
    return address;
  }
  left.remove_prefix(1);
  int port = 0;
  const auto [end, error] = std::from_chars(left.data(), left.data() + left.size(), port);
  if (error != std::errc{} || end != left.data() + left.size() || port < 1 || port > 65535) {
    return wrong("has no port from 1 to 65535");
  }
  address.port = std::to_string(port);
  return address;
}

}  // namespace posed::client
