// Where a daemon listens, as people write it.
#pragma once

#include <string>
#include <string_view>

#include "common/result.h"

namespace posed::client {

struct Address {
  std::string host;
  std::string port;
  bool tls = false;

  std::string text() const;  // "127.0.0.1:19870", "[::1]:19870"
};

// "tcp://HOST:PORT" or "tls://HOST:PORT"; "tcp://" and the port may be left out. An address of IP version 6 stands in
// brackets.
Result<Address> parse_address(std::string_view text);

}  // namespace posed::client
