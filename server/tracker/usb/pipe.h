// An open USB device: one interface, claimed; bytes written to its OUT endpoint, chunks read from one or two IN
// endpoints. Reads run all the time. One thread, the one that runs the bus's events. Source: libusb 1.0 documentation
// ("Asynchronous device I/O", "Caveats").
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "common/result.h"
#include "server/tracker/line.h"
#include "server/tracker/time_source.h"
#include "server/tracker/usb/bus.h"

struct libusb_device_handle;
struct libusb_transfer;

namespace posed::tracker {

// Those that a model is known to use; 0: whichever it has.
struct UsbAddresses {
  std::uint8_t out = 0, in = 0;
  std::uint8_t stream = 0;  // where data come apart from replies; 0: they do not
};

struct UsbEndpoint {
  std::uint8_t address = 0;  // 0: there is none
  bool interrupt = false;    // else bulk
  int packet = 0;            // bytes, as the descriptor says
};

struct UsbEndpoints {
  int interface = 0;
  UsbEndpoint out, in, stream;
};

class UsbPipe final : public Line {
 public:
  // `wanted`: the endpoints to use where the device has them; else its first pair is taken. `stopping` ends the wait.
  // Errors: not_available, with the cure as hint.
  static Result<std::unique_ptr<UsbPipe>> open(UsbBus& bus, UsbDevicePtr device, UsbAddresses wanted, TimeSource now,
                                               const std::function<bool()>& stopping);
  ~UsbPipe() override;  // cancels what flies, releases, closes
  UsbPipe(const UsbPipe&) = delete;
  UsbPipe& operator=(const UsbPipe&) = delete;

  bool write(std::string_view bytes) override;
  void wait(std::chrono::milliseconds at_most) override { bus_.handle_events(at_most); }
  std::vector<Chunk> take() override;  // of both IN endpoints, in the order of their arrival
  Trouble trouble() const override { return trouble_; }

 private:
  struct Read;
  UsbPipe(UsbBus& bus, UsbDevicePtr device, libusb_device_handle* handle, TimeSource now);
  bool begin(const UsbEndpoint& endpoint);
  void submit(Read& read);
  static void on_read(libusb_transfer* transfer);
  void finish(Read& read);

  UsbBus& bus_;
  UsbDevicePtr device_;
  libusb_device_handle* handle_;
  TimeSource now_;
  bool claimed_ = false;
  UsbEndpoints endpoints_;
  std::uint8_t stalled_ = 0;  // the endpoint that has halted
  std::vector<std::unique_ptr<Read>> reads_;
  std::vector<Chunk> chunks_;
  bool closing_ = false, gap_ = false;
  Trouble trouble_ = Trouble::none;
};

}  // namespace posed::tracker
