// The part of the kernel's usbfs that libusb talks to, played for umockdev: the ioctls of one device node.
// It leaves out: permissions, control transfers (all stall), isochronous endpoints, the pace of interrupt endpoints,
// suspension. Source: linux/usbdevice_fs.h; umockdev's documentation. Thread-safe.
#pragma once

#include <umockdev.h>

#include <cstdint>
#include <deque>
#include <functional>
#include <list>
#include <mutex>
#include <string>
#include <vector>

namespace posed::test {

class Usbfs {
 public:
  using Written = std::function<void(std::uint8_t endpoint, const std::vector<std::uint8_t>& bytes)>;

  explicit Usbfs(int packet) : packet_(packet) {}
  ~Usbfs();
  Usbfs(const Usbfs&) = delete;
  Usbfs& operator=(const Usbfs&) = delete;

  void on_write(Written written) { written_ = std::move(written); }  // set before the first ioctl
  gboolean handle(UMockdevIoctlClient* client);                      // on umockdev's thread
  void vanish(UMockdevIoctlClient* client);                          // its file was closed

  void open_node(const std::string& path);  // makes the FIFO that stands for the device node
  void send(std::uint8_t endpoint, const std::vector<std::uint8_t>& bytes);  // ends with a short packet
  void pull_out(int error_number);                                           // -ESHUTDOWN or -EPROTO
  void put_back();
  void fail_claims(int error_number, int how_often);
  void fail_next_read(std::uint8_t endpoint, int error_number);
  void forget_unread(std::uint8_t endpoint);
  std::size_t unread(std::uint8_t endpoint) const;
  int claims() const;
  bool claimed() const;

 private:
  struct Urb {
    UMockdevIoctlData* data;    // the urb as its client has it
    UMockdevIoctlData* buffer;  // may be null
    gulong address;             // in the client
    UMockdevIoctlClient* client;
  };
  struct Packet {
    std::uint8_t endpoint;
    std::vector<std::uint8_t> bytes;
  };

  void submit(UMockdevIoctlClient* client, UMockdevIoctlData* argument);
  void reap(UMockdevIoctlClient* client, UMockdevIoctlData* argument);
  void discard(UMockdevIoctlClient* client, UMockdevIoctlData* argument);
  void claim(UMockdevIoctlClient* client);
  void match();
  void finish(std::list<Urb>::iterator urb, int status, int length);
  void ring();
  static void release(Urb& urb);

  mutable std::mutex mutex_;
  int packet_;
  Written written_;
  int node_ = -1;
  bool ringing_ = false;  // the node is writable: something can be reaped
  bool gone_ = false;
  std::list<Urb> flying_, done_;
  std::deque<Packet> packets_;
  UMockdevIoctlClient* owner_ = nullptr;
  int claims_ = 0, claim_error_ = 0, claim_failures_ = 0;
};

}  // namespace posed::test
