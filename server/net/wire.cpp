#include "server/net/wire.h"

#include <sys/socket.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>

namespace posed::net {

int Wire::first_byte() const {
  unsigned char byte = 0;
  const auto got = ::recv(socket_, &byte, 1, MSG_PEEK | MSG_DONTWAIT);
  if (got == 1) return byte;
  return got < 0 && (errno == EAGAIN || errno == EINTR) ? kNothingYet : kNothingEver;
}

long Wire::receive(char* data, std::size_t size) {
  if (tls_) return tls_->receive(data, size);
  return ::recv(socket_, data, size, MSG_DONTWAIT);
}

long Wire::send(const iovec* parts, std::size_t count) {
  if (!tls_) {
    if (count == 1) return ::send(socket_, parts->iov_base, parts->iov_len, MSG_NOSIGNAL | MSG_DONTWAIT);
    msghdr message{};
    message.msg_iov = const_cast<iovec*>(parts);
    message.msg_iovlen = count;
    return ::sendmsg(socket_, &message, MSG_NOSIGNAL | MSG_DONTWAIT);
  }
  if (count == 1) return tls_->send(static_cast<const char*>(parts->iov_base), parts->iov_len);
  std::array<char, 16 << 10> record;  // the most that goes out at once
  std::size_t size = 0;
  for (std::size_t i = 0; i < count && size < record.size(); ++i) {
    const std::size_t part = std::min(parts[i].iov_len, record.size() - size);
    std::memcpy(record.data() + size, parts[i].iov_base, part);
    size += part;
  }
  return tls_->send(record.data(), size);
}

}  // namespace posed::net
