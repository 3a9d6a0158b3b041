#include "tests/support/usb_kernel_testbed.h"

#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <utility>

namespace posed::test {
namespace {

namespace fs = std::filesystem;
using namespace std::chrono_literals;

const fs::path kController = "/sys/devices/platform/vhci_hcd.0", kDevices = "/sys/bus/usb/devices";
constexpr int kFree = 4;  // VDEV_ST_NULL

template <class Condition>
bool wait_until(Condition condition) {
  for (int i = 0; i < 2000; ++i) {
    if (condition()) return true;
    std::this_thread::sleep_for(5ms);
  }
  return false;
}

std::string first_word(const fs::path& file) {
  std::ifstream in(file);
  std::string word;
  in >> word;
  return word;
}

// Of the controller's table: "hub port sta spd dev sockfd local_busid". A port's state, or the first that is free.
int state_of(int wanted) {
  std::ifstream table(kController / "status");
  std::string line;
  while (std::getline(table, line)) {
    std::istringstream words(line);
    std::string hub;
    int port = 0, state = 0;
    if (words >> hub >> port >> state && hub == "hs" && port == wanted) return state;
  }
  return -1;
}
int free_port() {
  for (int port = 0; port < 8; ++port) {
    if (state_of(port) == kFree) return port;
  }
  return -1;
}

// Its folder among the devices; empty where the kernel has none of its identity.
fs::path folder_of(const UsbTestbedOptions& options) {
  char vendor[5], product[5];
  std::snprintf(vendor, sizeof vendor, "%04x", options.vendor);
  std::snprintf(product, sizeof product, "%04x", options.product);
  std::error_code none;
  for (const auto& entry : fs::directory_iterator(kDevices, none)) {
    if (first_word(entry.path() / "idVendor") == vendor && first_word(entry.path() / "idProduct") == product)
      return entry.path();
  }
  return {};
}

[[noreturn]] void give_up(const char* what) {
  std::perror(what);
  std::abort();
}

}  // namespace

std::unique_ptr<UsbKernelTestbed> UsbKernelTestbed::make(UsbTestbedOptions options, std::string& reason) {
  if (::access((kController / "attach").c_str(), W_OK) == 0)
    return std::unique_ptr<UsbKernelTestbed>(new UsbKernelTestbed(std::move(options)));
  reason = "it must run as root under a kernel with a virtual USB host controller (vhci_hcd)";
  return nullptr;
}

UsbKernelTestbed::UsbKernelTestbed(UsbTestbedOptions options)
    : TrackerTestbed(device_of(options)),
      options_(std::move(options)),
      device_(
          descriptors_of(options_), options_.packet,
          [this](std::uint8_t endpoint, const UsbipDevice::Bytes& bytes) {
            if (endpoint == options_.out) with_tracker([&](TrackerEmulator& heard) { heard.write(bytes); });
          },
          [this](const UsbipDevice::Bytes& bytes) { send(bytes); }) {
  begin();
}

UsbKernelTestbed::~UsbKernelTestbed() {
  end();
  pull();
}

void UsbKernelTestbed::plug() {
  int ends[2];
  if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends) != 0) give_up("socketpair");
  port_ = free_port();
  const int speed = options_.packet > 64 ? 3 : 2;  // enum usb_device_speed: high, full
  device_.forget();
  {
    const std::lock_guard lock(socket_mutex_);
    socket_ = ends[0];
  }
  server_ = std::thread([this, socket = ends[0]] { serve(socket); });
  std::ofstream attach(kController / "attach");
  attach << port_ << ' ' << ends[1] << ' ' << 0x10002 << ' ' << speed << std::flush;
  if (!attach) give_up("vhci refuses the device");
  ::close(ends[1]);
  if (!wait_until([this] { return ::access(node().c_str(), F_OK) == 0; })) give_up("udev makes no node");
}

void UsbKernelTestbed::pull() {
  if (port_ < 0) return;
  std::ofstream(kController / "detach") << port_ << std::flush;
  {
    const std::lock_guard lock(socket_mutex_);
    ::shutdown(socket_, SHUT_RDWR);
  }
  server_.join();
  {
    const std::lock_guard lock(socket_mutex_);
    ::close(std::exchange(socket_, -1));
  }
  if (!wait_until([this] { return state_of(port_) == kFree && folder_of(options_).empty(); }))
    give_up("the device does not leave the bus");
  port_ = -1;
}

bool UsbKernelTestbed::held() const {
  const fs::path folder = folder_of(options_);
  std::error_code none;
  const fs::path driver = fs::read_symlink(folder / (folder.filename().string() + ":1.0") / "driver", none);
  return driver.filename() == "usbfs";
}

std::string UsbKernelTestbed::node() const {
  const fs::path folder = folder_of(options_);
  if (folder.empty()) return "";
  const std::string bus = first_word(folder / "busnum"), number = first_word(folder / "devnum");
  char path[40];
  std::snprintf(path, sizeof path, "/dev/bus/usb/%03d/%03d", std::atoi(bus.c_str()), std::atoi(number.c_str()));
  return path;
}

bool UsbKernelTestbed::ready() {
  return device_.unread(options_.in) == 0 && device_.unread(options_.stream) == 0;
}

void UsbKernelTestbed::carry(const TrackerEmulator::Output& output) {
  device_.say(output.cycle && options_.stream ? options_.stream : options_.in, output.bytes);
}

void UsbKernelTestbed::inject(std::string bytes) {
  device_.say(options_.in, {reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()});
}

void UsbKernelTestbed::serve(int socket) {
  std::array<std::uint8_t, 65536> buffer;
  while (true) {
    const ssize_t count = ::recv(socket, buffer.data(), buffer.size(), 0);
    if (count <= 0) return;
    device_.hear({buffer.data(), static_cast<std::size_t>(count)});
  }
}

void UsbKernelTestbed::send(const UsbipDevice::Bytes& bytes) {
  const std::lock_guard lock(socket_mutex_);
  for (std::size_t at = 0; at < bytes.size() && socket_ >= 0;) {
    const ssize_t count = ::send(socket_, bytes.data() + at, bytes.size() - at, MSG_NOSIGNAL);
    if (count <= 0) return;  // unplugged
    at += static_cast<std::size_t>(count);
  }
}

}  // namespace posed::test
