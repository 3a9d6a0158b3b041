#include "tests/support/usb_testbed.h"

#include <umockdev.h>

#include <atomic>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <mutex>
#include <sstream>
#include <utility>
#include <vector>

#include "tests/support/usb_usbfs.h"

namespace posed::test {
namespace {

std::string hex(const std::vector<std::uint8_t>& bytes) {
  std::string text;
  for (const std::uint8_t byte : bytes) {
    char two[3];
    std::snprintf(two, sizeof two, "%02x", byte);
    text += two;
  }
  return text;
}

// The one that umockdev has for a process, while any device is there; and the addresses of its bus.
struct Bus {
  UMockdevTestbed* testbed = umockdev_testbed_new();
  int address = 0;
  ~Bus() { g_object_unref(testbed); }

  static std::shared_ptr<Bus> get() {
    static std::mutex mutex;
    static std::weak_ptr<Bus> shared;
    const std::lock_guard lock(mutex);
    auto bus = shared.lock();
    if (!bus) shared = bus = std::make_shared<Bus>();
    return bus;
  }
};

}  // namespace

class UsbTestbed::Kernel {
 public:
  Kernel(int packet, Usbfs::Written written) : usbfs(packet) {
    usbfs.on_write(std::move(written));
    handler = umockdev_ioctl_base_new();
    g_signal_connect(handler, "handle-ioctl", G_CALLBACK(on_ioctl), &usbfs);
    g_signal_connect(handler, "client-vanished", G_CALLBACK(on_vanished), &usbfs);
  }

  ~Kernel() {
    if (!node.empty()) umockdev_testbed_detach_ioctl(testbed, node.c_str(), nullptr);
    g_object_unref(handler);
  }

  // umockdev's thread.
  static gboolean on_ioctl(UMockdevIoctlBase*, UMockdevIoctlClient* client, gpointer usbfs) {
    return static_cast<Usbfs*>(usbfs)->handle(client);
  }
  static void on_vanished(UMockdevIoctlBase*, UMockdevIoctlClient* client, gpointer usbfs) {
    static_cast<Usbfs*>(usbfs)->vanish(client);
  }

  Usbfs usbfs;
  std::shared_ptr<Bus> bus = Bus::get();
  UMockdevTestbed* testbed = bus->testbed;
  UMockdevIoctlBase* handler = nullptr;
  std::string node, path;
  std::atomic<bool> plugged{false};
  std::atomic<int> empty_writes{0};
};

std::unique_ptr<UsbTestbed> UsbTestbed::make(UsbTestbedOptions options, std::string& reason) {
  const char* preloaded = std::getenv("LD_PRELOAD");
  if (!preloaded || !std::strstr(preloaded, "libumockdev-preload")) {
    reason = "it must run under umockdev-wrapper";
    return nullptr;
  }
  auto device = device_of(options);
  return std::unique_ptr<UsbTestbed>(new UsbTestbed(std::move(options), std::move(device)));
}

UsbTestbed::UsbTestbed(UsbTestbedOptions options, std::unique_ptr<TrackerEmulator> device)
    : TrackerTestbed(std::move(device)), options_(std::move(options)) {
  const auto written = [this](std::uint8_t endpoint, const std::vector<std::uint8_t>& bytes) {
    if (bytes.empty()) ++kernel_->empty_writes;
    if (endpoint == options_.out) with_tracker([&](TrackerEmulator& heard) { heard.write(bytes); });
  };
  kernel_ = std::make_unique<Kernel>(options_.packet, written);
  kernel_->path = "/devices/usb1/1-" + std::to_string(options_.port);
  begin();
}

UsbTestbed::~UsbTestbed() {
  end();
}

bool UsbTestbed::ready() {
  return kernel_->usbfs.unread(options_.in) == 0 && kernel_->usbfs.unread(options_.stream) == 0;
}

void UsbTestbed::carry(const TrackerEmulator::Output& output) {
  kernel_->usbfs.send(output.cycle && options_.stream ? options_.stream : options_.in, output.bytes);
}

void UsbTestbed::plug() {
  Kernel& i = *kernel_;
  const int address = ++i.bus->address;
  char number[12];
  std::snprintf(number, sizeof number, "%03d", address);
  if (!i.node.empty()) umockdev_testbed_detach_ioctl(i.testbed, i.node.c_str(), nullptr);
  i.node = std::string("/dev/bus/usb/001/") + number;
  gchar* root = umockdev_testbed_get_root_dir(i.testbed);
  i.usbfs.put_back();
  i.usbfs.open_node(root + i.node);
  g_free(root);
  umockdev_testbed_attach_ioctl(i.testbed, i.node.c_str(), i.handler, nullptr);
  // Without the line "N:", which would make the node a regular file.
  std::ostringstream text;
  text << "P: " << i.path << "\nE: SUBSYSTEM=usb\nE: DRIVER=usb\nE: BUSNUM=001\nE: DEVNUM=" << number
       << "\nE: DEVNAME=" << i.node
       << "\nE: DEVTYPE=usb_device\nA: bConfigurationValue=1\\n\nA: busnum=1\\n\nA: devnum=" << address
       << "\\n\nA: speed=" << (options_.packet > 64 ? 480 : 12) << "\\n\n"
       << (options_.serial.empty() ? "" : "A: serial=" + options_.serial + "\\n\n")
       << "H: descriptors=" << hex(descriptors_of(options_)) << "\n";
  GError* error = nullptr;
  if (!umockdev_testbed_add_from_string(i.testbed, text.str().c_str(), &error)) {
    std::fprintf(stderr, "umockdev: %s\n", error->message);
    std::abort();
  }
  i.plugged = true;
}

void UsbTestbed::unplug(bool as_error) {
  Kernel& i = *kernel_;
  i.plugged = false;
  i.usbfs.pull_out(as_error ? EPROTO : ESHUTDOWN);
  const std::string path = "/sys" + i.path;
  umockdev_testbed_uevent(i.testbed, path.c_str(), "remove");
  umockdev_testbed_remove_device(i.testbed, path.c_str());
}

bool UsbTestbed::plugged() const {
  return kernel_->plugged;
}

void UsbTestbed::fail_claims(int error_number, int how_often) {
  kernel_->usbfs.fail_claims(error_number, how_often);
}
void UsbTestbed::fail_next_read(int error_number) {
  kernel_->usbfs.fail_next_read(options_.in, error_number);
}
void UsbTestbed::inject(std::string bytes) {
  kernel_->usbfs.send(options_.in, {bytes.begin(), bytes.end()});
}
void UsbTestbed::fail_next_stream_read(int error_number) {
  kernel_->usbfs.fail_next_read(options_.stream, error_number);
}
int UsbTestbed::empty_writes() const {
  return kernel_->empty_writes;
}
int UsbTestbed::claims() const {
  return kernel_->usbfs.claims();
}
bool UsbTestbed::claimed() const {
  return kernel_->usbfs.claimed();
}

}  // namespace posed::test
