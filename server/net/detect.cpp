#include "server/net/detect.h"

namespace posed::net {

Detected detect(std::string_view first_bytes) {
  constexpr std::string_view kMethods[] = {"GET ",     "HEAD ",  "POST ",    "PUT ",  "DELETE ",
                                           "OPTIONS ", "PATCH ", "CONNECT ", "TRACE "};
  if (first_bytes.starts_with('\x16')) return Detected::tls;
  for (const std::string_view method : kMethods) {
    if (first_bytes.substr(0, method.size()) == method) return Detected::http;
    if (method.substr(0, first_bytes.size()) == first_bytes) return Detected::undecided;
  }
  return Detected::lines;
}

}  // namespace posed::net
