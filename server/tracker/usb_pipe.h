// An open USB device as a pair of bulk endpoints: one interface, claimed; bytes written out, chunks read in. Reads run
// all the time. One thread, the one that runs the bus's events.
// Source: libusb 1.0 documentation ("Asynchronous device I/O", "Caveats").
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "common/result.h"
#include "server/tracker/time_source.h"
#include "server/tracker/usb_bus.h"

struct libusb_device_handle;
struct libusb_transfer;

namespace posed::tracker {

struct UsbEndpoints {
  std::uint8_t out = 0, in = 0;  // addresses
  int in_packet = 0;             // bytes, as the descriptor says
};

struct UsbChunk {
  std::vector<std::uint8_t> bytes;
  Nanoseconds t_ns = 0;  // when they arrived
  bool gap = false;      // some were lost before these
};

class UsbPipe {
 public:
  enum class Trouble { none, unplugged, error };

  // `wanted`: the pair to use where the device has it; else its first bulk pair is taken. `stopping` ends the wait.
  // Errors: not_available, with the cure as hint.
  static Result<std::unique_ptr<UsbPipe>> open(UsbBus& bus, UsbDevicePtr device, UsbEndpoints wanted, TimeSource now,
                                               const std::function<bool()>& stopping);
  ~UsbPipe();  // cancels what flies, releases, closes
  UsbPipe(const UsbPipe&) = delete;
  UsbPipe& operator=(const UsbPipe&) = delete;

  bool write(std::string_view bytes);  // at most a second; false: Trouble
  std::vector<UsbChunk> take();        // what arrived since the last call
  // error: a transfer failed, as it also does when a device is pulled out. Either way this pipe is done.
  Trouble trouble() const { return trouble_; }
  const UsbEndpoints& endpoints() const { return endpoints_; }

 private:
  struct Read;
  UsbPipe(UsbBus& bus, UsbDevicePtr device, libusb_device_handle* handle, TimeSource now);
  bool begin();
  void submit(Read& read);
  static void on_read(libusb_transfer* transfer);
  void finish(Read& read);

  UsbBus& bus_;
  UsbDevicePtr device_;
  libusb_device_handle* handle_;
  TimeSource now_;
  bool claimed_ = false;
  UsbEndpoints endpoints_;
  std::vector<std::unique_ptr<Read>> reads_;
  std::vector<UsbChunk> chunks_;
  bool closing_ = false, stalled_ = false, gap_ = false;
  Trouble trouble_ = Trouble::none;
};

}  // namespace posed::tracker
