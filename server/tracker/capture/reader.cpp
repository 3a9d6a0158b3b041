#include "server/tracker/capture/reader.h"

#include <charconv>
#include <filesystem>
#include <system_error>
#include <utility>

#include "server/tracker/capture/capture.h"
#include "server/tracker/capture/decoders.h"

namespace posed::tracker {
namespace {

int digit(char c) {
  if (c >= '0' && c <= '9') return c - '0';
  return c >= 'a' && c <= 'f' ? c - 'a' + 10 : -1;
}

bool parse_hex(std::string_view text, std::vector<std::uint8_t>& bytes) {
  bytes.clear();
  for (std::size_t i = 0; i + 1 < text.size(); i += 2) {
    if (digit(text[i]) < 0 || digit(text[i + 1]) < 0) return false;
    bytes.push_back(static_cast<std::uint8_t>(digit(text[i]) << 4 | digit(text[i + 1])));
  }
  return text.size() % 2 == 0;
}

template <class T>
bool parse_number(std::string_view text, T& value) {
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc{} && end == text.data() + text.size();
}

}  // namespace

Result<CaptureReader> CaptureReader::open(const std::string& path) {
  std::error_code ignored;
  std::ifstream file(path, std::ios::binary);
  if (!file || std::filesystem::is_directory(path, ignored)) {
    return Error{"not_available", "cannot read the capture " + path, "", "posed --capture FOLDER makes them"};
  }
  CaptureReader reader(path, std::move(file));
  std::string line;
  if (!reader.read_line(line) || line != kCaptureFormat) {
    return Error{"invalid_params", path + " is no capture: its first line is not " + kCaptureFormat, "",
                 "posed --capture FOLDER makes them"};
  }
  // The device is told by the first decoder.
  if (!reader.read_line(line) || !line.starts_with("decoder ")) return reader.bad_line("a decoder comes first");
  auto made = make_decoder(std::string_view(line).substr(8));
  if (!made) return reader.bad_line(made.error().message);
  reader.decoder_ = std::move(made->decoder);
  reader.device_ = std::move(made->device);
  return reader;
}

Result<CaptureReader::Step> CaptureReader::next() {
  Step step;
  for (std::string line; read_line(line);) {
    const std::string_view text = line;
    const std::size_t blank = text.find(' ');
    const std::string_view word = text.substr(0, blank);
    const std::string_view rest = blank == std::string_view::npos ? std::string_view{} : text.substr(blank + 1);
    if (word == "decoder") {
      auto made = make_decoder(rest);
      if (!made) return bad_line(made.error().message);
      bad_before_ = bad_bytes();
      decoder_ = std::move(made->decoder);
    } else if (word == "expect") {
      int station = 0;
      if (!parse_number(rest, station) || station < 0 || station > 64) return bad_line("expect takes a station");
      decoder_->expect_up_to(station);
    } else if (word == "lost") {
      decoder_->lost_bytes();
    } else if (parse_number(word, step.t_ns) && parse_hex(rest, step.bytes)) {
      return step;
    } else {
      return bad_line("it is neither decoder, expect, lost nor a time with bytes in hexadecimal");
    }
  }
  step.end = true;
  return step;
}

// A program that was killed leaves a line without an end.
bool CaptureReader::read_line(std::string& line) {
  ++number_;
  return std::getline(file_, line) && !file_.eof();
}

Error CaptureReader::bad_line(std::string why) const {
  return {"invalid_params", path_ + ", line " + std::to_string(number_) + ": " + std::move(why), "",
          "cut the file before that line, or capture anew"};
}

}  // namespace posed::tracker
