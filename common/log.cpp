#include "common/log.h"

#include <unistd.h>

#include <atomic>
#include <string>

namespace posed {
namespace {
std::atomic<LogLevel> threshold{LogLevel::info};
constexpr std::string_view kNames[] = {"debug", "info", "warning", "error"};
}  // namespace

void set_log_level(LogLevel level) {
  threshold = level;
}

void log(LogLevel level, std::string_view text) {
  if (level < threshold.load(std::memory_order_relaxed)) return;
  std::string line = "posed: ";
  line.append(kNames[static_cast<int>(level)]).append(": ").append(text).append("\n");
  // One write a line: lines of different threads do not mix. A broken standard error is nothing to stop for.
  [[maybe_unused]] const auto written = ::write(STDERR_FILENO, line.data(), line.size());
}

}  // namespace posed
