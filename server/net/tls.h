// TLS on a socket that does not block, by OpenSSL. Network thread only, but for the context's constructor.
#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>

struct ssl_st;
struct ssl_ctx_st;

namespace posed::net {

class TlsContext {
 public:
  // Files in PEM: a certificate with those that lead to its root, and its key. Throws std::runtime_error with one
  // sentence that names the cure.
  TlsContext(const std::filesystem::path& certificate, const std::filesystem::path& key);
  ~TlsContext();
  TlsContext(const TlsContext&) = delete;

  ssl_ctx_st* get() const { return context_; }

 private:
  ssl_ctx_st* context_;
};

// The server's side. Both calls are as recv and send: -1 with errno (EAGAIN: later), 0 at the end.
class TlsStream {
 public:
  TlsStream(const TlsContext& context, int socket);
  ~TlsStream();
  TlsStream(const TlsStream&) = delete;

  long receive(char* data, std::size_t size);
  // What was refused with EAGAIN has to come again, with the same bytes in front.
  long send(const char* data, std::size_t size);
  // Holds bytes that the socket no longer shows.
  bool pending() const;
  // Tells the peer that no more will come.
  void end();

 private:
  ssl_st* ssl_;
};

}  // namespace posed::net
