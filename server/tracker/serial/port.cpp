#include "server/tracker/serial/port.h"

#include <sys/file.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <boost/asio/serial_port.hpp>
#include <cerrno>
#include <filesystem>
#include <system_error>
#include <thread>
#include <utility>
#include <vector>

#include "server/tracker/holder.h"
#include "server/tracker/serial/stream_line.h"

namespace posed::tracker {
namespace {

namespace fs = std::filesystem;
using Stream = boost::asio::serial_port;

// The serial ports that there are, for the message; those of USB adapters by the names that stay.
std::string ports_there() {
  std::string found;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator("/dev/serial/by-id", error)) found += " " + entry.path().string();
  for (const auto& entry : fs::directory_iterator("/dev", error)) {
    const std::string name = entry.path().filename();
    if (name.starts_with("ttyUSB") || name.starts_with("ttyACM")) found += " " + entry.path().string();
  }
  return found.empty() ? "; no serial adapter is plugged in" : "; there are:" + found;
}

boost::system::error_code set_up(Stream& stream, unsigned baud) {
  boost::system::error_code error;
  stream.set_option(Stream::baud_rate(baud), error);
  if (!error) stream.set_option(Stream::character_size(8), error);
  if (!error) stream.set_option(Stream::parity(Stream::parity::none), error);
  if (!error) stream.set_option(Stream::stop_bits(Stream::stop_bits::one), error);
  if (!error) stream.set_option(Stream::flow_control(Stream::flow_control::none), error);
  return error;
}

// Two programs at one serial line would each get half of the bytes.
bool keep_others_out(int fd) {
  ::ioctl(fd, TIOCEXCL);
  return ::flock(fd, LOCK_EX | LOCK_NB) == 0;
}

// Some terminals outlast their closing, and would stay locked.
void let_others_in(Stream& stream) {
  ::ioctl(stream.native_handle(), TIOCNXCL);
}

}  // namespace

struct SerialPort::Loop {
  boost::asio::io_context io{1};
};

SerialPort::SerialPort(std::string path, unsigned baud, TimeSource now)
    : path_(std::move(path)), baud_(baud), now_(std::move(now)), loop_(std::make_unique<Loop>()) {}

SerialPort::~SerialPort() = default;

Opened SerialPort::open(const std::function<bool()>&) {
  std::error_code ignored;
  const fs::path node = fs::canonical(path_, ignored);
  if (const std::string holder = holder_of(node); !node.empty() && !holder.empty()) {
    return serial_open_error(EBUSY, path_, holder);
  }
  Stream stream(loop_->io);
  boost::system::error_code error;
  stream.open(path_, error);
  if (error) return serial_open_error(error.value(), path_, "");
  if (!keep_others_out(stream.native_handle())) return serial_open_error(EBUSY, path_, holder_of(node));
  if (const auto unfit = set_up(stream, baud_)) {
    return {nullptr, State::failed,
            path_ + " does not take " + std::to_string(baud_) + " baud (" + unfit.message() +
                "): give another, as in " + path_ + "@115200"};
  }
  return {std::make_unique<StreamLine<Stream>>(loop_->io, std::move(stream), now_, let_others_in), State::starting, ""};
}

bool SerialPort::rest(std::chrono::milliseconds at_most) {
  std::this_thread::sleep_for(at_most);
  return false;
}

void SerialPort::interrupt() {
  loop_->io.stop();
}

Opened serial_open_error(int code, const std::string& path, const std::string& holder) {
  const auto failed = [](std::string message) { return Opened{nullptr, State::failed, std::move(message)}; };
  switch (code) {
    case ENOENT:
    case ENODEV:
    case ENXIO:
    case EIO:
      return {nullptr, State::searching, "there is no serial port " + path + ports_there()};
    case EACCES:
    case EPERM:
      return failed("no permission to open " + path +
                    ": join the group that owns it (sudo usermod -aG dialout $USER, then log in again)");
    case EBUSY:
    case EWOULDBLOCK:
      return failed(path + " is in use by " + (holder.empty() ? "another program" : holder) +
                    ": close the program that holds it (the vendor's, VRPN, a terminal, another posed)");
    case ENOTTY:
    case EINVAL:
      return failed(path + " is no serial port: give the device node, as in /dev/ttyS0 or /dev/ttyUSB0");
    default:
      return failed(path + " cannot be opened: " + std::generic_category().message(code) +
                    ": unplug the adapter and plug it in again");
  }
}

}  // namespace posed::tracker
