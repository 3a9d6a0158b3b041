// A file of what a tracker's decoder was fed, to be replayed: the same bytes at the same times give the same Frames
// again. Lines of text:
//
//   posed.capture/1
//   decoder DESCRIPTION    a fresh one, as Decoder::description says
//   expect STATION         the highest active one; 0: not known
//   lost                   the line lost bytes here
//   T HEX                  bytes, and when they arrived (ns, daemon clock)
//
// A line that is cut off at the end of the file is none. One thread.
#pragma once

#include <fstream>
#include <memory>
#include <span>
#include <string>

#include "common/result.h"
#include "common/time.h"
#include "server/tracker/decoder.h"

namespace posed::tracker {

inline constexpr const char* kCaptureFormat = "posed.capture/1";

class Capture {
 public:
  // Errors: not_available where the file is there already or cannot be written.
  static Result<std::unique_ptr<Capture>> create(const std::string& path);

  void begin(const Decoder& decoder, int expected);
  void lost();
  void bytes(std::span<const std::uint8_t> bytes, Nanoseconds t_ns);
  bool good() const { return file_.good(); }  // false: the disk is full; what is there can be replayed
  const std::string& path() const { return path_; }

 private:
  Capture(std::string path, std::ofstream file);

  std::string path_;
  std::ofstream file_;
  std::string line_;
  Nanoseconds flushed_ns_ = 0;
};

}  // namespace posed::tracker
