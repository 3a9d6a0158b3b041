#include "server/tracker/capture/capture.h"

#include <filesystem>
#include <system_error>
#include <utility>

namespace posed::tracker {
namespace {

constexpr Nanoseconds kFlushEvery = 1'000'000'000;  // a crash costs no more

}  // namespace

Result<std::unique_ptr<Capture>> Capture::create(const std::string& path) {
  std::error_code ignored;
  if (std::filesystem::exists(path, ignored)) {
    return Error{"not_available", "the file " + path + " is there already", "", "move it away, or capture elsewhere"};
  }
  std::ofstream file(path, std::ios::binary);
  if (!file) return Error{"not_available", "cannot write " + path, "", "give a folder that exists and may be written"};
  return std::unique_ptr<Capture>(new Capture(path, std::move(file)));
}

Capture::Capture(std::string path, std::ofstream file) : path_(std::move(path)), file_(std::move(file)) {
  file_ << kCaptureFormat << "\n";
}

void Capture::begin(const Decoder& decoder, int expected) {
  file_ << "decoder " << decoder.description() << "\nexpect " << expected << "\n";
}

void Capture::lost() {
  file_ << "lost\n";
}

void Capture::bytes(std::span<const std::uint8_t> bytes, Nanoseconds t_ns) {
  static constexpr char kDigits[] = "0123456789abcdef";
  line_ = std::to_string(t_ns) + " ";
  for (const std::uint8_t byte : bytes) {
    line_ += kDigits[byte >> 4];
    line_ += kDigits[byte & 0xf];
  }
  line_ += '\n';
  file_ << line_;
  if (t_ns - flushed_ns_ < kFlushEvery) return;
  flushed_ns_ = t_ns;
  file_.flush();
}

}  // namespace posed::tracker
