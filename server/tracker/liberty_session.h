// One conversation with a LIBERTY over an open pipe: make it quiet, set it up, listen, start it again when it falls
// silent, make it quiet at the end. One thread, the driver's.
// Source: LIBERTY User Manual URM03PH156 Rev H, commands; their order as the public drivers have it.
#pragma once

#include <atomic>
#include <chrono>
#include <optional>
#include <string>
#include <string_view>

#include "server/tracker/liberty_decoder.h"
#include "server/tracker/liberty_driver.h"
#include "server/tracker/liberty_models.h"
#include "server/tracker/status_board.h"
#include "server/tracker/usb_bus.h"
#include "server/tracker/usb_pipe.h"

namespace posed::tracker {

class LibertySession {
 public:
  LibertySession(UsbBus& bus, UsbPipe& pipe, const LibertyModel& model, const LibertyDriverOptions& options,
                 StatusBoard& board, const std::atomic<bool>& stopping);

  void run();  // until `stopping` or the pipe is in trouble

 private:
  using Milliseconds = std::chrono::milliseconds;

  bool alive() const { return !stopping_ && pipe_.trouble() == UsbPipe::Trouble::none; }
  bool set_up();  // false: trouble_ says why
  bool make_quiet();
  bool ask_stations();                 // fills stations_
  void listen(Milliseconds patience);  // while frames come; returns when none has come for so long
  void decode();
  void hear(const LibertyReply& reply);

  UsbBus& bus_;
  UsbPipe& pipe_;
  const LibertyDriverOptions& options_;
  StatusBoard& board_;
  const std::atomic<bool>& stopping_;
  LibertyDecoder decoder_;
  int rate_hz_;
  std::optional<unsigned> stations_;  // bit 0 is station 1: those that are plugged in and switched on
  std::string trouble_;
  std::string complaint_;  // of the device, since it was set up last
};

}  // namespace posed::tracker
