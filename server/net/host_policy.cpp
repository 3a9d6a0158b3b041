#include "server/net/host_policy.h"

#include <arpa/inet.h>
#include <unistd.h>

#include <algorithm>

namespace posed::net {
namespace {

std::string lower(std::string_view text) {
  std::string result(text);
  for (char& c : result) c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  return result;
}

bool is_address(const std::string& host) {
  in6_addr address;
  return ::inet_pton(AF_INET, host.c_str(), &address) == 1 || ::inet_pton(AF_INET6, host.c_str(), &address) == 1;
}

}  // namespace

std::string host_without_port(std::string_view host) {
  if (host.starts_with('[')) {
    const std::size_t end = host.find(']');
    return lower(host.substr(1, end == std::string_view::npos ? end : end - 1));
  }
  host = host.substr(0, host.find(':'));
  if (host.ends_with('.')) host.remove_suffix(1);
  return lower(host);
}

HostPolicy::HostPolicy(bool strict, const std::vector<std::string>& hosts, const std::vector<std::string>& origins)
    : strict_(strict) {
  for (const std::string& host : hosts) hosts_.push_back(host_without_port(host));
  for (const std::string& origin : origins) origins_.push_back(lower(origin));
  char name[256] = {};
  if (::gethostname(name, sizeof(name) - 1) == 0) hosts_.push_back(host_without_port(name));
}

bool HostPolicy::host_allowed(std::string_view host) const {
  if (!strict_) return true;
  const std::string name = host_without_port(host);
  return is_address(name) || name == "localhost" || name.ends_with(".localhost") ||
         std::find(hosts_.begin(), hosts_.end(), name) != hosts_.end();
}

bool HostPolicy::origin_allowed(std::string_view origin, std::string_view host) const {
  const std::string from = lower(origin);
  if (std::find(origins_.begin(), origins_.end(), from) != origins_.end()) return true;
  const std::size_t scheme = from.find("://");
  return scheme != std::string::npos && from.substr(scheme + 3) == lower(host);
}

}  // namespace posed::net
