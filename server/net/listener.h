// The listening socket. Network thread only, but for the constructor.
#pragma once

#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/steady_timer.hpp>

#include "server/net/hub.h"

namespace posed::net {

// Of an address or a host name. Throws std::runtime_error with a sentence that names the cure.
boost::asio::ip::tcp::endpoint endpoint_of(const std::string& host, std::uint16_t port);

class Listener {
 public:
  // Binds and listens; throws as endpoint_of does.
  Listener(Hub& hub, const boost::asio::ip::tcp::endpoint& endpoint);

  std::uint16_t port() const { return port_; }
  void start();
  void stop();

 private:
  void accept_next();
  void welcome(boost::asio::ip::tcp::socket socket);

  Hub& hub_;
  boost::asio::ip::tcp::acceptor acceptor_;
  boost::asio::steady_timer retry_;
  std::uint16_t port_ = 0;
  bool full_told_ = false;
};

}  // namespace posed::net
