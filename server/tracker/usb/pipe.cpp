#include "server/tracker/usb/pipe.h"

#include <libusb.h>

#include <algorithm>
#include <utility>

#include "server/tracker/usb/claim.h"

namespace posed::tracker {
namespace {

constexpr int kReads = 16;  // at 240 Hz, some 60 ms that this thread may sleep without a loss
constexpr unsigned kWriteTimeoutMs = 1000;
constexpr auto kLongestClose = std::chrono::seconds(2);

}  // namespace

struct UsbPipe::Read {
  UsbPipe* pipe;
  libusb_transfer* transfer = nullptr;
  std::vector<std::uint8_t> buffer;
  bool flying = false;

  ~Read() { libusb_free_transfer(transfer); }
};

Result<std::unique_ptr<UsbPipe>> UsbPipe::open(UsbBus& bus, UsbDevicePtr device, UsbAddresses wanted, TimeSource now,
                                               const std::function<bool()>& stopping) {
  const UsbIdentity who = UsbBus::identity(device);
  const auto endpoints = find_usb_endpoints(device, wanted);
  if (!endpoints) return endpoints.error();
  libusb_device_handle* handle = nullptr;
  if (const int code = libusb_open(device.get(), &handle); code != LIBUSB_SUCCESS) return usb_open_error(code, who);

  std::unique_ptr<UsbPipe> pipe(new UsbPipe(bus, std::move(device), handle, std::move(now)));
  pipe->endpoints_ = *endpoints;
  if (const int code = claim_usb_interface(bus, handle, endpoints->interface, stopping); code != LIBUSB_SUCCESS) {
    return usb_open_error(code, who);
  }
  pipe->claimed_ = true;
  if (!pipe->begin(endpoints->in) || (endpoints->stream.address && !pipe->begin(endpoints->stream))) {
    return usb_open_error(LIBUSB_ERROR_IO, who);
  }
  return pipe;
}

UsbPipe::UsbPipe(UsbBus& bus, UsbDevicePtr device, libusb_device_handle* handle, TimeSource now)
    : bus_(bus), device_(std::move(device)), handle_(handle), now_(std::move(now)) {}

UsbPipe::~UsbPipe() {
  closing_ = true;
  const auto flying = [](const auto& read) { return read->flying; };
  for (const auto& read : reads_) {
    if (read->flying) libusb_cancel_transfer(read->transfer);
  }
  const auto deadline = std::chrono::steady_clock::now() + kLongestClose;
  while (std::any_of(reads_.begin(), reads_.end(), flying) && std::chrono::steady_clock::now() < deadline) {
    bus_.handle_events(std::chrono::milliseconds(50));
  }
  if (claimed_) libusb_release_interface(handle_, endpoints_.interface);
  libusb_close(handle_);
  // A transfer that the kernel never gave back may still be written to: better to lose its memory than to free it.
  for (auto& read : reads_) {
    if (read->flying) static_cast<void>(read.release());
  }
}

bool UsbPipe::begin(const UsbEndpoint& endpoint) {
  // One packet a read: where a cycle fills its packets to the brim no short packet ends a longer read, and the cycle
  // would wait for the next one.
  const auto size = static_cast<std::size_t>(endpoint.packet);
  for (int i = 0; i < kReads; ++i) {
    auto read = std::make_unique<Read>();
    read->pipe = this;
    read->buffer.resize(size);
    read->transfer = libusb_alloc_transfer(0);
    if (!read->transfer) return false;
    const auto fill = endpoint.interrupt ? libusb_fill_interrupt_transfer : libusb_fill_bulk_transfer;
    fill(read->transfer, handle_, endpoint.address, read->buffer.data(), endpoint.packet, on_read, read.get(), 0);
    reads_.push_back(std::move(read));
    submit(*reads_.back());
  }
  return trouble_ == Trouble::none;
}

void UsbPipe::submit(Read& read) {
  const int code = libusb_submit_transfer(read.transfer);
  read.flying = code == LIBUSB_SUCCESS;
  if (read.flying || trouble_ != Trouble::none) return;
  trouble_ = code == LIBUSB_ERROR_NO_DEVICE ? Trouble::gone : Trouble::error;
}

void UsbPipe::on_read(libusb_transfer* transfer) {
  Read& read = *static_cast<Read*>(transfer->user_data);
  read.pipe->finish(read);
}

void UsbPipe::finish(Read& read) {
  read.flying = false;
  const libusb_transfer& transfer = *read.transfer;
  switch (transfer.status) {
    case LIBUSB_TRANSFER_COMPLETED:
    case LIBUSB_TRANSFER_TIMED_OUT:
      if (transfer.actual_length > 0) {
        const auto end = read.buffer.begin() + transfer.actual_length;
        chunks_.push_back({{read.buffer.begin(), end}, now_(), std::exchange(gap_, false)});
      }
      break;
    case LIBUSB_TRANSFER_OVERFLOW:
      gap_ = true;
      break;  // its length means nothing
    case LIBUSB_TRANSFER_STALL:
      stalled_ = transfer.endpoint;
      gap_ = true;
      return;
    case LIBUSB_TRANSFER_CANCELLED:
      return;
    case LIBUSB_TRANSFER_NO_DEVICE:
      trouble_ = Trouble::gone;
      return;
    case LIBUSB_TRANSFER_ERROR:
      // The first sign of an unplugged device on some host controllers, so not worth another try on this handle.
      if (trouble_ == Trouble::none) trouble_ = Trouble::error;
      return;
  }
  if (!closing_ && trouble_ == Trouble::none) submit(read);
}

bool UsbPipe::write(std::string_view bytes) {
  if (trouble_ != Trouble::none) return false;
  std::vector<std::uint8_t> copy(bytes.begin(), bytes.end());
  const UsbEndpoint& out = endpoints_.out;
  const auto send = [&](int size) {
    int written = 0;
    const auto transfer = out.interrupt ? libusb_interrupt_transfer : libusb_bulk_transfer;
    const int code = transfer(handle_, out.address, copy.data(), size, &written, kWriteTimeoutMs);
    if (code == LIBUSB_SUCCESS && written == size) return true;
    trouble_ = code == LIBUSB_ERROR_NO_DEVICE ? Trouble::gone : Trouble::error;
    return false;
  };
  const int size = static_cast<int>(copy.size());
  if (!send(size)) return false;
  // A device may wait for a short packet to end what it reads.
  return size == 0 || out.packet == 0 || size % out.packet != 0 || send(0);
}

std::vector<Chunk> UsbPipe::take() {
  // Not in the callback: this call waits for the device.
  if (const std::uint8_t halted = std::exchange(stalled_, std::uint8_t{0}); halted && trouble_ == Trouble::none) {
    libusb_clear_halt(handle_, halted);
    for (const auto& read : reads_) {
      if (!read->flying) submit(*read);
    }
  }
  return std::exchange(chunks_, {});
}

}  // namespace posed::tracker
