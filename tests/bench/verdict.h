// Whether all that a benchmark promises was held; with --quick that says nothing.
#pragma once

#include <cstdio>

namespace posed::test {

struct Verdict {
  int held = 0, missed = 0;

  // `pattern` takes the value and the bar, as in "%.2f times the floor, at most %.1f".
  __attribute__((format(printf, 3, 0))) void judge(bool holds, const char* pattern, double value, double bar) {
    ++(holds ? held : missed);
    std::printf("   %-6s ", holds ? "held" : "MISSED");
    std::printf(pattern, value, bar);
    std::printf("\n");
  }
};

}  // namespace posed::test
