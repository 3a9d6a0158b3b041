#include "server/net/listener.h"

#include <chrono>
#include <stdexcept>

#include "common/log.h"
#include "server/net/connection.h"

namespace posed::net {
namespace {

namespace asio = boost::asio;
using asio::ip::tcp;
using boost::system::error_code;

constexpr auto kBackOff = std::chrono::milliseconds(100);

std::string show(const tcp::endpoint& endpoint) {
  const std::string address = endpoint.address().to_string();
  return (endpoint.address().is_v6() ? '[' + address + ']' : address) + ':' + std::to_string(endpoint.port());
}

[[noreturn]] void refuse(const error_code& error, const tcp::endpoint& endpoint) {
  const std::string host = endpoint.address().to_string();
  const std::string where = "port " + std::to_string(endpoint.port()) + " on " + host;
  if (error == asio::error::address_in_use) {
    throw std::runtime_error(where + " is in use; is posed already running? choose another with --listen");
  }
  if (error == asio::error::access_denied) {
    throw std::runtime_error(where + " needs rights that posed does not have; choose one from 1024 on with --listen");
  }
  if (error == boost::system::errc::address_not_available) {
    throw std::runtime_error(host + " is no address of this machine; choose another with --listen");
  }
  throw std::runtime_error("cannot listen at " + where + ": " + error.message() + "; choose another with --listen");
}

}  // namespace

tcp::endpoint endpoint_of(const std::string& host, std::uint16_t port) {
  error_code error;
  const auto address = asio::ip::make_address(host, error);
  if (!error) return {address, port};
  asio::io_context io;
  tcp::resolver resolver(io);
  const auto found = resolver.resolve(host, std::to_string(port), error);
  if (error || found.empty()) {
    throw std::runtime_error("\"" + host +
                             "\" is no address and no host name; --listen takes HOST:PORT, as in 127.0.0.1:" +
                             std::to_string(proto::kDefaultPort));
  }
  return found.begin()->endpoint();
}

Listener::Listener(Hub& hub, const tcp::endpoint& endpoint) : hub_(hub), acceptor_(hub.io), retry_(hub.io) {
  error_code error;
  acceptor_.open(endpoint.protocol(), error);
  if (error) refuse(error, endpoint);
  acceptor_.set_option(tcp::acceptor::reuse_address(true), error);
  acceptor_.bind(endpoint, error);
  if (error) refuse(error, endpoint);
  acceptor_.listen(asio::socket_base::max_listen_connections, error);
  if (error) refuse(error, endpoint);
  port_ = acceptor_.local_endpoint().port();
}

void Listener::start() {
  accept_next();
}

void Listener::stop() {
  error_code ignored;
  acceptor_.close(ignored);
  retry_.cancel();
}

void Listener::accept_next() {
  acceptor_.async_accept([this](error_code error, tcp::socket socket) {
    if (error == asio::error::operation_aborted || !acceptor_.is_open()) return;
    if (!error) {
      welcome(std::move(socket));
      return accept_next();
    }
    if (error == asio::error::connection_aborted) return accept_next();
    // Out of descriptors or memory: the peer stays in the queue, and trying at once again would spin.
    log_warning("cannot take a connection: " + error.message());
    retry_.expires_after(kBackOff);
    retry_.async_wait([this](error_code cancelled) {
      if (!cancelled && acceptor_.is_open()) accept_next();
    });
  });
}

void Listener::welcome(tcp::socket socket) {
  if (hub_.connections.size() >= hub_.options.limits.connections) {
    add(hub_.tally.refused);
    if (!std::exchange(full_told_, true)) {
      log_warning("there are " + std::to_string(hub_.connections.size()) + " connections; no more are taken");
    }
    return;
  }
  full_told_ = false;
  error_code error;
  const tcp::endpoint peer = socket.remote_endpoint(error);
  if (error) return;
  if (!hub_.guests.enter(peer.address(), hub_.clock.now())) return add(hub_.tally.refused);
  add(hub_.tally.accepted);
  const ConnectionId id = hub_.next_id++;
  const auto connection = std::make_shared<Connection>(hub_, std::move(socket), id, show(peer), peer.address());
  hub_.connections.emplace(id, connection);
  connection->start();
}

}  // namespace posed::net
