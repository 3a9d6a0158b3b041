#include "tests/support/usb_testbed.h"

#include <umockdev.h>

#include <atomic>
#include <cerrno>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <mutex>
#include <sstream>
#include <thread>

#include "tests/support/usb_usbfs.h"

namespace posed::test {
namespace {

std::string hex(const std::vector<int>& bytes) {
  std::string text;
  for (const int byte : bytes) {
    char two[3];
    std::snprintf(two, sizeof two, "%02x", static_cast<unsigned>(byte) & 0xffu);
    text += two;
  }
  return text;
}

std::string descriptors(const UsbTestbedOptions& o) {
  std::vector<int> endpoints;
  std::istringstream words(o.endpoints);
  int count = 0;
  for (std::string word; words >> word; ++count) {
    const std::vector<int> one{7, 5, std::stoi(word, nullptr, 16), 2, o.packet & 0xff, o.packet >> 8, 0};
    endpoints.insert(endpoints.end(), one.begin(), one.end());
  }
  const int usb = o.packet > 64 ? 2 : 1, total = 18 + 7 * count;
  std::vector<int> all{18, 1, 0, usb, 0xff, 0, 0, 64, o.vendor & 0xff, o.vendor >> 8, o.product & 0xff, o.product >> 8,
                       0,  1, 0, 0,   0,    1};
  const std::vector<int> configuration{9, 2, total, 0, 1, 1, 0, 0x80, 50, 9, 4, 0, 0, count, 0xff, 0, 0, 0};
  all.insert(all.end(), configuration.begin(), configuration.end());
  all.insert(all.end(), endpoints.begin(), endpoints.end());
  return hex(all);
}

}  // namespace

class UsbTestbed::Impl {
 public:
  explicit Impl(UsbTestbedOptions o) : options(std::move(o)), device(options.stations), usbfs(options.packet) {
    usbfs.on_write([this](std::uint8_t endpoint, const std::vector<std::uint8_t>& bytes) {
      if (endpoint != options.out) return;
      const std::lock_guard lock(mutex);
      device.write(bytes);
    });
    testbed = umockdev_testbed_new();
    handler = umockdev_ioctl_base_new();
    g_signal_connect(handler, "handle-ioctl", G_CALLBACK(on_ioctl), &usbfs);
    g_signal_connect(handler, "client-vanished", G_CALLBACK(on_vanished), &usbfs);
    ticker = std::thread([this] { run(); });
  }

  ~Impl() {
    stopping = true;
    ticker.join();
    if (!node.empty()) umockdev_testbed_detach_ioctl(testbed, node.c_str(), nullptr);
    g_object_unref(handler);
    g_object_unref(testbed);
  }

  // umockdev's thread.
  static gboolean on_ioctl(UMockdevIoctlBase*, UMockdevIoctlClient* client, gpointer usbfs) {
    return static_cast<Usbfs*>(usbfs)->handle(client);
  }
  static void on_vanished(UMockdevIoctlBase*, UMockdevIoctlClient* client, gpointer usbfs) {
    static_cast<Usbfs*>(usbfs)->vanish(client);
  }

  void run() {
    using namespace std::chrono;
    const auto begun = steady_clock::now();
    const auto period = nanoseconds(1'000'000'000 / options.rate_hz);
    for (long n = 1; !stopping; ++n) {
      // Small steps: answers must not wait for the next cycle.
      while (steady_clock::now() < begun + n * period && !stopping) {
        std::this_thread::sleep_until(std::min(begun + n * period, steady_clock::now() + milliseconds(1)));
        deliver();
      }
      {
        const std::lock_guard lock(mutex);
        device.tick();
      }
      deliver();
    }
  }

  void deliver() {
    // What nobody reads stays in the device, which has its own rules for what it then keeps.
    if (usbfs.unread(options.in) > 0) return;
    std::deque<std::vector<std::uint8_t>> output;
    {
      const std::lock_guard lock(mutex);
      output = device.take();
    }
    for (const auto& bytes : output) usbfs.send(options.in, bytes);
  }

  UsbTestbedOptions options;
  std::mutex mutex;  // of device
  LibertyEmulator device;
  Usbfs usbfs;
  UMockdevTestbed* testbed = nullptr;
  UMockdevIoctlBase* handler = nullptr;
  std::string node;
  int address = 0;
  std::atomic<bool> plugged{false}, stopping{false};
  std::thread ticker;
};

std::unique_ptr<UsbTestbed> UsbTestbed::make(UsbTestbedOptions options, std::string& reason) {
  const char* preloaded = std::getenv("LD_PRELOAD");
  if (!preloaded || !std::strstr(preloaded, "libumockdev-preload")) {
    reason = "it must run under umockdev-wrapper";
    return nullptr;
  }
  return std::unique_ptr<UsbTestbed>(new UsbTestbed(std::make_unique<Impl>(std::move(options))));
}

UsbTestbed::UsbTestbed(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
UsbTestbed::~UsbTestbed() = default;

void UsbTestbed::plug() {
  Impl& i = *impl_;
  ++i.address;
  char number[12];
  std::snprintf(number, sizeof number, "%03d", i.address);
  if (!i.node.empty()) umockdev_testbed_detach_ioctl(i.testbed, i.node.c_str(), nullptr);
  i.node = std::string("/dev/bus/usb/001/") + number;
  gchar* root = umockdev_testbed_get_root_dir(i.testbed);
  i.usbfs.put_back();
  i.usbfs.open_node(root + i.node);
  g_free(root);
  umockdev_testbed_attach_ioctl(i.testbed, i.node.c_str(), i.handler, nullptr);
  // Without the line "N:", which would make the node a regular file.
  std::ostringstream text;
  text << "P: /devices/usb1\nE: SUBSYSTEM=usb\nE: DRIVER=usb\nE: BUSNUM=001\nE: DEVNUM=" << number
       << "\nE: DEVNAME=" << i.node
       << "\nE: DEVTYPE=usb_device\nA: bConfigurationValue=1\\n\nA: busnum=1\\n\nA: devnum=" << i.address
       << "\\n\nA: speed=" << (i.options.packet > 64 ? 480 : 12) << "\\n\nH: descriptors=" << descriptors(i.options)
       << "\n";
  GError* error = nullptr;
  if (!umockdev_testbed_add_from_string(i.testbed, text.str().c_str(), &error)) {
    std::fprintf(stderr, "umockdev: %s\n", error->message);
    std::abort();
  }
  i.plugged = true;
}

void UsbTestbed::unplug(bool as_error) {
  Impl& i = *impl_;
  i.plugged = false;
  i.usbfs.pull_out(as_error ? EPROTO : ESHUTDOWN);
  umockdev_testbed_uevent(i.testbed, "/sys/devices/usb1", "remove");
  umockdev_testbed_remove_device(i.testbed, "/sys/devices/usb1");
}

bool UsbTestbed::plugged() const {
  return impl_->plugged;
}

void UsbTestbed::with_device(const std::function<void(LibertyEmulator&)>& act) {
  const std::lock_guard lock(impl_->mutex);
  act(impl_->device);
}

void UsbTestbed::fail_claims(int error_number, int how_often) {
  impl_->usbfs.fail_claims(error_number, how_often);
}
void UsbTestbed::fail_next_read(int error_number) {
  impl_->usbfs.fail_next_read(impl_->options.in, error_number);
}
void UsbTestbed::inject(std::string bytes) {
  impl_->usbfs.send(impl_->options.in, {bytes.begin(), bytes.end()});
}
int UsbTestbed::claims() const {
  return impl_->usbfs.claims();
}
bool UsbTestbed::claimed() const {
  return impl_->usbfs.claimed();
}

}  // namespace posed::test
