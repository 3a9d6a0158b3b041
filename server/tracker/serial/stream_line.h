// A Line over whatever Asio can read from and write to: a serial port, a device node. For this library's .cpp files
// alone, since it brings Asio. One thread, which also runs the io_context here.
#pragma once

#include <boost/asio/buffer.hpp>
#include <boost/asio/io_context.hpp>
#include <boost/asio/write.hpp>
#include <boost/system/error_code.hpp>

#include <array>
#include <optional>
#include <utility>

#include "server/tracker/line.h"
#include "server/tracker/time_source.h"

namespace posed::tracker {

template <class Stream>
class StreamLine final : public Line {
 public:
  // `stream` is open; `io` outlives the line and is used by nobody else. `before_close` may be empty.
  StreamLine(boost::asio::io_context& io, Stream stream, TimeSource now, void (*before_close)(Stream&) = nullptr)
      : io_(io), stream_(std::move(stream)), now_(std::move(now)), before_close_(before_close) {
    read();
  }

  ~StreamLine() override {
    if (before_close_) before_close_(stream_);
    boost::system::error_code ignored;
    stream_.close(ignored);
    io_.restart();
    io_.poll();  // handlers hold this line
  }

  bool write(std::string_view bytes) override {
    if (trouble_ != Trouble::none) return false;
    std::optional<boost::system::error_code> done;
    boost::asio::async_write(stream_, boost::asio::buffer(bytes.data(), bytes.size()),
                             [&done](boost::system::error_code error, std::size_t) { done = error; });
    // Reads go on meanwhile, so that a device that is talking is heard.
    const auto deadline = std::chrono::steady_clock::now() + kWriteTime;
    while (!done && std::chrono::steady_clock::now() < deadline) {
      io_.restart();
      io_.run_one_until(deadline);
    }
    if (!done) {
      boost::system::error_code ignored;
      stream_.cancel(ignored);  // the read, too: this line is done
      while (!done) {
        io_.restart();
        io_.run_one();
      }
      trouble_ = Trouble::error;
    } else if (*done) {
      trouble_ = Trouble::gone;
    }
    return trouble_ == Trouble::none;
  }

  void wait(std::chrono::milliseconds at_most) override {
    io_.restart();
    if (chunks_.empty()) io_.run_one_for(at_most);
    io_.poll();
  }

  std::vector<Chunk> take() override { return std::exchange(chunks_, {}); }
  Trouble trouble() const override { return trouble_; }

 private:
  static constexpr auto kWriteTime = std::chrono::seconds(1);

  void read() {
    stream_.async_read_some(boost::asio::buffer(buffer_), [this](boost::system::error_code error, std::size_t size) {
      if (size > 0) {
        chunks_.push_back({{buffer_.begin(), buffer_.begin() + static_cast<std::ptrdiff_t>(size)}, now_(), false});
      }
      if (!error) return read();
      // The end of the file, an input error: what a port says whose adapter was pulled out.
      if (trouble_ == Trouble::none) trouble_ = Trouble::gone;
    });
  }

  boost::asio::io_context& io_;
  Stream stream_;
  TimeSource now_;
  void (*before_close_)(Stream&);
  std::array<std::uint8_t, 4096> buffer_{};
  std::vector<Chunk> chunks_;
  Trouble trouble_ = Trouble::none;
};

}  // namespace posed::tracker
