#include "tests/support/usbip_device.h"

#include <algorithm>
#include <cerrno>
#include <utility>

namespace posed::test {
namespace {

enum Command : std::uint32_t { kSubmit = 1, kUnlink = 2, kSubmitted = 3, kUnlinked = 4 };
constexpr std::size_t kHeader = 48;  // bytes of each message; all numbers are big-endian

std::uint32_t word(std::span<const std::uint8_t> bytes, std::size_t at) {
  return static_cast<std::uint32_t>(bytes[at]) << 24 | static_cast<std::uint32_t>(bytes[at + 1]) << 16 |
         static_cast<std::uint32_t>(bytes[at + 2]) << 8 | bytes[at + 3];
}
void put(UsbipDevice::Bytes& bytes, std::size_t at, std::uint32_t value) {
  for (std::size_t k = 0; k < 4; ++k) bytes[at + k] = static_cast<std::uint8_t>(value >> (24 - 8 * k));
}

}  // namespace

UsbipDevice::UsbipDevice(Bytes descriptors, int packet, Written written, Send send)
    : descriptors_(std::move(descriptors)),
      packet_(static_cast<std::size_t>(packet)),
      written_(std::move(written)),
      send_(std::move(send)) {}

void UsbipDevice::hear(std::span<const std::uint8_t> bytes) {
  const std::lock_guard lock(mutex_);
  heard_.insert(heard_.end(), bytes.begin(), bytes.end());
  while (take_one()) continue;
}

void UsbipDevice::say(std::uint8_t endpoint, std::span<const std::uint8_t> bytes) {
  const std::lock_guard lock(mutex_);
  for (std::size_t at = 0; at < bytes.size(); at += packet_) {
    const auto part = bytes.subspan(at, std::min(packet_, bytes.size() - at));
    packets_.push_back({endpoint, {part.begin(), part.end()}});
  }
  match();
}

std::size_t UsbipDevice::unread(std::uint8_t endpoint) const {
  const std::lock_guard lock(mutex_);
  return static_cast<std::size_t>(
      std::count_if(packets_.begin(), packets_.end(), [&](const Packet& p) { return p.endpoint == endpoint; }));
}

void UsbipDevice::forget() {
  const std::lock_guard lock(mutex_);
  heard_.clear(), reads_.clear(), packets_.clear();
  configuration_ = 0;
}

// One whole message, if there is one. Fields by their place: command, number, device, direction, endpoint; then of a
// submission flags, length, three for isochronous transfers and the setup packet; of an unlinking whose number.
bool UsbipDevice::take_one() {
  if (heard_.size() < kHeader) return false;
  const std::span<const std::uint8_t> head(heard_);
  const std::uint32_t command = word(head, 0), number = word(head, 4);
  const bool in = word(head, 12) == 1;
  const std::size_t length = command == kSubmit ? word(head, 24) : 0, carried = in ? 0 : length;
  if (heard_.size() < kHeader + carried) return false;
  const auto endpoint = static_cast<std::uint8_t>(word(head, 16) | (in ? 0x80u : 0u));
  if (command == kSubmit)
    submitted(number, endpoint, length, head.subspan(40, 8), head.subspan(kHeader, carried));
  else
    unlinked(number, word(head, 20));
  heard_.erase(heard_.begin(), heard_.begin() + static_cast<std::ptrdiff_t>(kHeader + carried));
  return true;
}

void UsbipDevice::submitted(std::uint32_t number, std::uint8_t endpoint, std::size_t length,
                            std::span<const std::uint8_t> setup, std::span<const std::uint8_t> data) {
  if ((endpoint & 0x7f) == 0) return controlled(number, setup, length);
  if (endpoint & 0x80) {
    reads_.push_back({number, endpoint, length});
    return match();
  }
  answer(number, 0, length, {});
  if (written_) written_(endpoint, {data.begin(), data.end()});
}

// What a host asks of a device before it is of any use; all else stalls.
void UsbipDevice::controlled(std::uint32_t number, std::span<const std::uint8_t> setup, std::size_t room) {
  const std::uint8_t request = setup[1], value_low = setup[2], value_high = setup[3];
  const std::size_t device = std::min<std::size_t>(18, descriptors_.size());
  const std::span<const std::uint8_t> all(descriptors_);
  const auto give = [&](std::span<const std::uint8_t> bytes) {
    const auto part = bytes.first(std::min(room, bytes.size()));
    answer(number, 0, part.size(), part);
  };
  const std::uint8_t none[2] = {0, 0};
  if ((setup[0] & 0x60) != 0) return answer(number, -EPIPE, 0, {});  // not a standard request
  switch (request) {
    case 0:  // GET_STATUS
      return give(none);
    case 6:  // GET_DESCRIPTOR
      if (value_high == 1) return give(all.first(device));
      if (value_high == 2 && value_low == 0) return give(all.subspan(device));
      return answer(number, -EPIPE, 0, {});
    case 8:  // GET_CONFIGURATION
      return give({&configuration_, 1});
    case 9:  // SET_CONFIGURATION
      configuration_ = value_low;
      return answer(number, 0, 0, {});
    case 1:   // CLEAR_FEATURE
    case 3:   // SET_FEATURE
    case 11:  // SET_INTERFACE
      return answer(number, 0, 0, {});
    default:
      return answer(number, -EPIPE, 0, {});
  }
}

void UsbipDevice::unlinked(std::uint32_t number, std::uint32_t which) {
  const auto read = std::find_if(reads_.begin(), reads_.end(), [&](const Read& r) { return r.number == which; });
  Bytes reply(kHeader);
  put(reply, 0, kUnlinked);
  put(reply, 4, number);
  if (read != reads_.end()) {
    put(reply, 20, static_cast<std::uint32_t>(-ECONNRESET));
    reads_.erase(read);
  }
  send_(reply);
}

// Packets to those who wait for them: a read ends with a short packet, or full.
void UsbipDevice::match() {
  for (auto read = reads_.begin(); read != reads_.end() && !packets_.empty();) {
    const Read one = *read;
    Bytes data;
    bool ended = false;
    while (!ended && data.size() + packet_ <= one.room) {
      const auto next = std::find_if(packets_.begin(), packets_.end(),
                                     [&](const Packet& packet) { return packet.endpoint == one.endpoint; });
      if (next == packets_.end()) break;
      data.insert(data.end(), next->bytes.begin(), next->bytes.end());
      ended = next->bytes.size() < packet_;
      packets_.erase(next);
    }
    // A device that has no more for now, after full packets only, would leave the read half full: none here does.
    if (data.empty()) {
      ++read;
      continue;
    }
    read = reads_.erase(read);
    answer(one.number, 0, data.size(), data);
  }
}

void UsbipDevice::answer(std::uint32_t number, int status, std::size_t length, std::span<const std::uint8_t> data) {
  Bytes reply(kHeader);
  put(reply, 0, kSubmitted);
  put(reply, 4, number);
  put(reply, 20, static_cast<std::uint32_t>(status));
  put(reply, 24, static_cast<std::uint32_t>(length));
  reply.insert(reply.end(), data.begin(), data.end());
  send_(reply);
}

}  // namespace posed::test
