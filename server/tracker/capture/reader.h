// Reads a capture line by line and feeds a decoder as it was fed then. Pure but for the file; one thread.
#pragma once

#include <fstream>
#include <memory>
#include <string>
#include <vector>

#include "common/result.h"
#include "server/tracker/decoder.h"

namespace posed::tracker {

class CaptureReader {
 public:
  // Errors: not_available where it cannot be read, invalid_params where it is no capture.
  static Result<CaptureReader> open(const std::string& path);

  const std::string& device() const { return device_; }  // of its Frames
  struct Step {
    bool end = false;
    Nanoseconds t_ns = 0;
    std::vector<std::uint8_t> bytes;
  };
  // Goes on to the next bytes. Error invalid_params names the line.
  Result<Step> next();
  // What comes of them where they arrive at `now`.
  Heard feed(const Step& step, Nanoseconds now) { return decoder_->feed(step.bytes, now); }
  std::uint64_t bad_bytes() const { return bad_before_ + (decoder_ ? decoder_->bad_bytes() : 0); }

 private:
  CaptureReader(std::string path, std::ifstream file) : path_(std::move(path)), file_(std::move(file)) {}
  bool read_line(std::string& line);  // false: the end
  Error bad_line(std::string why) const;

  std::string path_;
  std::ifstream file_;
  long number_ = 0;  // of the line
  std::string device_;
  std::unique_ptr<Decoder> decoder_;
  std::uint64_t bad_before_ = 0;
};

}  // namespace posed::tracker
