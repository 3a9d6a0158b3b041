// A USB bus that is not there, with an emulated tracker at each port that is asked for: unmodified libusb and an
// unmodified driver run against it, in this process or a child, under umockdev-wrapper. It plays the kernel's usbfs;
// see usb_usbfs.h for what that leaves out. Thread-safe. Those of a process are on one bus.
#pragma once

#include <functional>
#include <memory>
#include <string>

#include "tests/support/liberty_emulator.h"
#include "tests/support/tracker_testbed.h"
#include "tests/support/usb_options.h"

namespace posed::test {

class UsbTestbed final : public TrackerTestbed {
 public:
  // Null, with the reason, where umockdev's preload library is not in this process.
  static std::unique_ptr<UsbTestbed> make(UsbTestbedOptions options, std::string& reason);
  ~UsbTestbed() override;

  std::string place() const override { return "usb"; }
  void plug() override;
  void pull() override { unplug(); }
  bool held() const override { return claimed(); }
  void inject(std::string bytes) override;
  // `as_error`: flying transfers end with a protocol error instead of "no device", as on some host controllers.
  void unplug(bool as_error = false);
  bool plugged() const;

  void with_device(const std::function<void(LibertyEmulator&)>& act) { with<LibertyEmulator>(act); }
  template <class T>
  T ask(T (LibertyEmulator::*question)() const) {
    T answer{};
    with_device([&](LibertyEmulator& device) { answer = (device.*question)(); });
    return answer;
  }

  // Faults. Each holds until it is set back to 0.
  void fail_claims(int error_number, int how_often = -1);  // of CLAIMINTERFACE; -1: always
  void fail_next_read(int error_number);                   // one flying read of answers ends so
  void fail_next_stream_read(int error_number);            // one of the stream's own endpoint
  int empty_writes() const;                                // that end what fills its packets
  int claims() const;                                      // granted so far
  bool claimed() const;                                    // at present

 private:
  class Kernel;
  UsbTestbed(UsbTestbedOptions options, std::unique_ptr<TrackerEmulator> device);
  void carry(const TrackerEmulator::Output& output) override;
  bool ready() override;

  UsbTestbedOptions options_;
  std::unique_ptr<Kernel> kernel_;
};

}  // namespace posed::test
