// The device's side of Usbfs: packets that wait for a read, plugs that are pulled, faults.
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>

#include <linux/usbdevice_fs.h>

#include "tests/support/usb_usbfs.h"

namespace posed::test {

void Usbfs::send(std::uint8_t endpoint, const std::vector<std::uint8_t>& bytes) {
  const std::lock_guard lock(mutex_);
  if (gone_) return;
  for (std::size_t at = 0; at < bytes.size(); at += static_cast<std::size_t>(packet_)) {
    const std::size_t size = std::min(bytes.size() - at, static_cast<std::size_t>(packet_));
    const auto begin = bytes.begin() + static_cast<std::ptrdiff_t>(at);
    packets_.push_back({endpoint, {begin, begin + static_cast<std::ptrdiff_t>(size)}});
  }
  match();
}

// Gives waiting packets to flying reads: a read ends with a short packet, or full.
void Usbfs::match() {
  for (auto urb = flying_.begin(); urb != flying_.end() && !packets_.empty();) {
    const auto here = urb++;
    auto& fields = *reinterpret_cast<usbdevfs_urb*>(here->data->data);
    if (!(fields.endpoint & 0x80) || !here->buffer) continue;
    int filled = 0;
    bool ended = false;
    while (!ended && filled + packet_ <= fields.buffer_length) {
      const auto next = std::find_if(packets_.begin(), packets_.end(),
                                     [&](const Packet& packet) { return packet.endpoint == fields.endpoint; });
      if (next == packets_.end()) break;
      std::memcpy(here->buffer->data + filled, next->bytes.data(), next->bytes.size());
      filled += static_cast<int>(next->bytes.size());
      ended = static_cast<int>(next->bytes.size()) < packet_;
      packets_.erase(next);
    }
    if (ended || filled == fields.buffer_length) finish(here, 0, filled);
    // Not ended by the device: a real read would stay half full. Nothing in these tests needs that.
    else if (filled > 0)
      finish(here, 0, filled);
  }
}

void Usbfs::pull_out(int error_number) {
  const std::lock_guard lock(mutex_);
  gone_ = true;
  packets_.clear();
  owner_ = nullptr;
  while (!flying_.empty()) finish(flying_.begin(), -error_number, 0);
  ring();
}

void Usbfs::put_back() {
  const std::lock_guard lock(mutex_);
  gone_ = false;
}

void Usbfs::fail_claims(int error_number, int how_often) {
  const std::lock_guard lock(mutex_);
  claim_error_ = error_number;
  claim_failures_ = how_often;
}

void Usbfs::fail_next_read(std::uint8_t endpoint, int error_number) {
  const std::lock_guard lock(mutex_);
  const auto read = std::find_if(flying_.begin(), flying_.end(), [&](const Urb& urb) {
    return reinterpret_cast<usbdevfs_urb*>(urb.data->data)->endpoint == endpoint;
  });
  if (read != flying_.end()) finish(read, -error_number, 0);
}

void Usbfs::forget_unread(std::uint8_t endpoint) {
  const std::lock_guard lock(mutex_);
  std::erase_if(packets_, [&](const Packet& packet) { return packet.endpoint == endpoint; });
}

std::size_t Usbfs::unread(std::uint8_t endpoint) const {
  const std::lock_guard lock(mutex_);
  return static_cast<std::size_t>(std::count_if(packets_.begin(), packets_.end(),
                                                [&](const Packet& packet) { return packet.endpoint == endpoint; }));
}

int Usbfs::claims() const {
  const std::lock_guard lock(mutex_);
  return claims_;
}

bool Usbfs::claimed() const {
  const std::lock_guard lock(mutex_);
  return owner_ != nullptr;
}

}  // namespace posed::test
