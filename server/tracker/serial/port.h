// A tracker at a serial port: 8 data bits, no parity, one stop bit, no handshake. Serial over USB (a ttyUSB or ttyACM)
// comes and goes with its adapter.
// Source: Boost.Asio documentation (serial_port); termios(3), ioctl_tty(2) for what keeps others out.
#pragma once

#include <memory>
#include <string>

#include "server/tracker/port.h"
#include "server/tracker/time_source.h"

namespace posed::tracker {

class SerialPort final : public Port {
 public:
  // `path`: of the device node, or a symbolic link to it as in /dev/serial/by-id.
  SerialPort(std::string path, unsigned baud, TimeSource now);
  ~SerialPort() override;

  Opened open(const std::function<bool()>& stopping) override;
  bool rest(std::chrono::milliseconds at_most) override;
  void interrupt() override;

 private:
  struct Loop;
  std::string path_;
  unsigned baud_;
  TimeSource now_;
  std::unique_ptr<Loop> loop_;
};

// What to tell where opening failed with `code`, an errno; `holder`: who else has it open, as holder_of says.
Opened serial_open_error(int code, const std::string& path, const std::string& holder);

}  // namespace posed::tracker
