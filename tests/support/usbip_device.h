// A USB device as the kernel's virtual host controller (vhci) wants one: it sends each URB over a socket and gets its
// result back. No packets and no pace: a read ends where the device's packet is short, and that is said here.
// Source: the kernel's Documentation/usb/usbip_protocol.rst; USB 2.0, chapter 9. Thread-safe.
#pragma once

#include <array>
#include <cstdint>
#include <deque>
#include <functional>
#include <list>
#include <mutex>
#include <span>
#include <vector>

namespace posed::test {

class UsbipDevice {
 public:
  using Bytes = std::vector<std::uint8_t>;
  using Written = std::function<void(std::uint8_t endpoint, const Bytes& bytes)>;
  using Send = std::function<void(const Bytes& bytes)>;  // to the kernel

  // `descriptors`: the device's 18 bytes, and its configuration behind them. `packet`: of all endpoints but 0.
  UsbipDevice(Bytes descriptors, int packet, Written written, Send send);

  void hear(std::span<const std::uint8_t> bytes);                  // from the kernel, cut anywhere
  void say(std::uint8_t endpoint, std::span<const std::uint8_t>);  // packets for the host, once it reads
  std::size_t unread(std::uint8_t endpoint) const;                 // packets
  void forget();                                                   // the socket is another one: nothing flies any more

 private:
  struct Read {
    std::uint32_t number;
    std::uint8_t endpoint;
    std::size_t room;
  };
  struct Packet {
    std::uint8_t endpoint;
    Bytes bytes;
  };

  bool take_one();
  void submitted(std::uint32_t number, std::uint8_t endpoint, std::size_t length, std::span<const std::uint8_t> setup,
                 std::span<const std::uint8_t> data);
  void controlled(std::uint32_t number, std::span<const std::uint8_t> setup, std::size_t room);
  void unlinked(std::uint32_t number, std::uint32_t which);
  void match();
  void answer(std::uint32_t number, int status, std::size_t length, std::span<const std::uint8_t> data);

  mutable std::mutex mutex_;
  const Bytes descriptors_;
  const std::size_t packet_;
  const Written written_;
  const Send send_;
  Bytes heard_;
  std::list<Read> reads_;
  std::deque<Packet> packets_;
  std::uint8_t configuration_ = 0;
};

}  // namespace posed::test
