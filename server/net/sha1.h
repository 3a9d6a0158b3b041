// SHA-1 (RFC 3174) and base64, as the WebSocket handshake asks for them. Nothing here keeps a secret.
#pragma once

#include <string>
#include <string_view>

namespace posed::net {

std::string sha1(std::string_view bytes);  // 20 bytes
std::string base64(std::string_view bytes);

}  // namespace posed::net
