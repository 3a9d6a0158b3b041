#include "server/tracker/usb_pipe.h"

#include <libusb.h>

#include <algorithm>
#include <utility>

#include "server/tracker/usb_claim.h"

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

Result<std::unique_ptr<UsbPipe>> UsbPipe::open(UsbBus& bus, UsbDevicePtr device, UsbEndpoints wanted, TimeSource now,
                                               const std::function<bool()>& stopping) {
  const UsbIdentity who = UsbBus::identity(device);
  libusb_device_handle* handle = nullptr;
  if (const int code = libusb_open(device.get(), &handle); code != LIBUSB_SUCCESS) return usb_open_error(code, who);

  std::unique_ptr<UsbPipe> pipe(new UsbPipe(bus, std::move(device), handle, std::move(now)));
  if (const int code = claim_usb_interface(bus, handle, stopping); code != LIBUSB_SUCCESS) {
    return usb_open_error(code, who);
  }
  pipe->claimed_ = true;
  const auto endpoints = find_usb_endpoints(pipe->device_, wanted);
  if (!endpoints) return endpoints.error();
  pipe->endpoints_ = *endpoints;
  if (!pipe->begin()) return usb_open_error(LIBUSB_ERROR_IO, who);
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
  if (claimed_) libusb_release_interface(handle_, 0);
  libusb_close(handle_);
  // A transfer that the kernel never gave back may still be written to: better to lose its memory than to free it.
  for (auto& read : reads_) {
    if (read->flying) static_cast<void>(read.release());
  }
}

bool UsbPipe::begin() {
  // One packet a read: where a cycle fills its packets to the brim no short packet ends a longer read, and the cycle
  // would wait for the next one.
  const auto size = static_cast<std::size_t>(endpoints_.in_packet);
  for (int i = 0; i < kReads; ++i) {
    auto read = std::make_unique<Read>();
    read->pipe = this;
    read->buffer.resize(size);
    read->transfer = libusb_alloc_transfer(0);
    if (!read->transfer) return false;
    libusb_fill_bulk_transfer(read->transfer, handle_, endpoints_.in, read->buffer.data(), endpoints_.in_packet,
                              on_read, read.get(), 0);
    reads_.push_back(std::move(read));
    submit(*reads_.back());
  }
  return trouble_ == Trouble::none;
}

void UsbPipe::submit(Read& read) {
  const int code = libusb_submit_transfer(read.transfer);
  read.flying = code == LIBUSB_SUCCESS;
  if (read.flying || trouble_ != Trouble::none) return;
  trouble_ = code == LIBUSB_ERROR_NO_DEVICE ? Trouble::unplugged : Trouble::error;
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
      stalled_ = gap_ = true;
      return;
    case LIBUSB_TRANSFER_CANCELLED:
      return;
    case LIBUSB_TRANSFER_NO_DEVICE:
      trouble_ = Trouble::unplugged;
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
  int written = 0;
  const int code = libusb_bulk_transfer(handle_, endpoints_.out, copy.data(), static_cast<int>(copy.size()), &written,
                                        kWriteTimeoutMs);
  if (code == LIBUSB_SUCCESS && written == static_cast<int>(copy.size())) return true;
  trouble_ = code == LIBUSB_ERROR_NO_DEVICE ? Trouble::unplugged : Trouble::error;
  return false;
}

std::vector<UsbChunk> UsbPipe::take() {
  // Not in the callback: this call waits for the device.
  if (std::exchange(stalled_, false) && trouble_ == Trouble::none) {
    libusb_clear_halt(handle_, endpoints_.in);
    for (const auto& read : reads_) {
      if (!read->flying) submit(*read);
    }
  }
  return std::exchange(chunks_, {});
}

}  // namespace posed::tracker
