// What a request's Accept-Encoding says (RFC 9110, 12.5.3).
#pragma once

#include <string_view>

namespace posed::net {

// Whether gzip is welcome, and no less than the plain bytes. Of a header that is not there, or that makes no sense: no.
bool prefers_gzip(std::string_view accept_encoding);

}  // namespace posed::net
