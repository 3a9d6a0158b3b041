// Tells the faces of the port apart by the first bytes that a peer sends.
#pragma once

#include <string_view>

namespace posed::net {

enum class Detected { undecided, http, lines, tls };

// HTTP begins with a method and a space, TLS with a byte that begins no line. Undecided only while more bytes could
// still make one.
Detected detect(std::string_view first_bytes);

}  // namespace posed::net
