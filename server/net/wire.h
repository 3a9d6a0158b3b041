// Bytes in and out of one socket, in the clear or through TLS. Nothing waits, nothing raises a signal.
#pragma once

#include <sys/uio.h>

#include <cstddef>
#include <memory>

#include "server/net/tls.h"

namespace posed::net {

class Wire {
 public:
  explicit Wire(int socket) : socket_(socket) {}

  // The peer has begun with the first byte of TLS, which is still to be read.
  void encrypt(const TlsContext& context) { tls_ = std::make_unique<TlsStream>(context, socket_); }
  bool encrypted() const { return tls_ != nullptr; }
  // What the peer sends first, which stays unread.
  static constexpr int kNothingYet = -1, kNothingEver = -2;
  int first_byte() const;

  // As recv and sendmsg: -1 with errno, 0 at the end. What was not taken comes again, in the same parts.
  long receive(char* data, std::size_t size);
  long send(const iovec* parts, std::size_t count);
  bool pending() const { return tls_ && tls_->pending(); }
  void end() {
    if (tls_) tls_->end();
  }

 private:
  int socket_;
  std::unique_ptr<TlsStream> tls_;
};

inline constexpr int kTlsHandshake = 0x16;

}  // namespace posed::net
