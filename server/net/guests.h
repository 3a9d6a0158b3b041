// What each address takes of us: its connections, and how often it begins what costs more than a line. Network thread
// only.
#pragma once

#include <boost/asio/ip/address.hpp>
#include <cstddef>
#include <map>

#include "common/time.h"
#include "server/net/server.h"

namespace posed::net {

class Guests {
 public:
  using Address = boost::asio::ip::address;

  explicit Guests(const Limits& limits) : limits_(limits) {}

  // A further connection. False: it has as many as it may.
  bool enter(const Address& address, Nanoseconds now);
  void leave(const Address& address);
  // A TLS handshake; an HTTP request. False: it has had its share for now.
  bool may_encrypt(const Address& address, Nanoseconds now);
  bool may_ask(const Address& address, Nanoseconds now);

  std::size_t remembered() const { return guests_.size(); }

 private:
  // A second's worth at once, then as it comes in.
  struct Share {
    double left = 0.0;
    Nanoseconds at = 0;
    bool fresh = true;

    bool take(double rate, Nanoseconds now);
  };
  struct Guest {
    std::size_t connections = 0;
    Share handshakes, requests;
    Nanoseconds seen = 0;
  };

  void forget(Nanoseconds now);

  const Limits& limits_;
  std::map<Address, Guest> guests_;
  Nanoseconds forgot_ = 0;
};

}  // namespace posed::net
