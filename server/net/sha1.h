// SHA-1 and base64 of OpenSSL, as the WebSocket handshake asks for them (RFC 6455, 4.2.2). Nothing here keeps a secret.
#pragma once

#include <string>
#include <string_view>

namespace posed::net {

std::string sha1(std::string_view bytes);  // 20 bytes
std::string base64(std::string_view bytes);

}  // namespace posed::net
