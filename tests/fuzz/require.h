// What the targets of texts share.
#pragma once

#include <cstdio>
#include <cstdlib>
#include <string_view>

namespace posed::fuzz {

inline void require(bool holds, const char* what, std::string_view text) {
  if (holds) return;
  std::fprintf(stderr, "%s: %.*s\n", what, static_cast<int>(text.size()), text.data());
  std::abort();
}

}  // namespace posed::fuzz
