#include "server/tracker/spacemouse/port.h"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <boost/asio/posix/stream_descriptor.hpp>
#include <cerrno>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <optional>
#include <string_view>
#include <system_error>
#include <thread>
#include <utility>
#include <vector>

#include "server/tracker/owners.h"
#include "server/tracker/serial/stream_line.h"

namespace posed::tracker {
namespace {

namespace fs = std::filesystem;
using Stream = boost::asio::posix::stream_descriptor;

constexpr unsigned kLogitech = 0x046d, k3Dconnexion = 0x256f;

// 3Dconnexion's first products go by Logitech's number, with which keyboards go, too.
constexpr unsigned kOfLogitech[] = {0xc603, 0xc605, 0xc606, 0xc621, 0xc623, 0xc625,
                                    0xc626, 0xc627, 0xc628, 0xc629, 0xc62b, 0xc640};
// Their mice and keypads, which have no cap.
constexpr unsigned kNoCap[] = {0xc650, 0xc651, 0xc654, 0xc655, 0xc656, 0xc657, 0xc658, 0xc664, 0xc665, 0xc668};

bool is_spacemouse(unsigned vendor, unsigned product) {
  if (vendor == kLogitech)
    return std::find(std::begin(kOfLogitech), std::end(kOfLogitech), product) != std::end(kOfLogitech);
  return vendor == k3Dconnexion && std::find(std::begin(kNoCap), std::end(kNoCap), product) == std::end(kNoCap);
}

struct Found {
  std::string node;
  DevicePlace place;
};

// HID_ID=0003:0000046D:0000C626 is bus, vendor, product; HID_UNIQ the serial number, HID_PHYS the port with the
// interface behind a slash. Nothing where it is no SpaceMouse.
std::optional<DevicePlace> read_description(const fs::path& uevent) {
  std::ifstream file(uevent);
  DevicePlace place;
  bool fits = false;
  for (std::string line; std::getline(file, line);) {
    unsigned bus = 0, vendor = 0, product = 0;
    if (std::sscanf(line.c_str(), "HID_ID=%x:%x:%x", &bus, &vendor, &product) == 3)
      fits = is_spacemouse(vendor, product);
    if (line.starts_with("HID_UNIQ=")) place.serial = line.substr(9);
    if (line.starts_with("HID_PHYS=")) place.port = line.substr(9, line.find('/') - 9);
  }
  if (!fits) return std::nullopt;
  return place;
}

// A receiver shows itself as several devices, one of which is the cap: usage page 1, usage 8 (multi-axis controller) at
// the beginning of its report descriptor. Where that cannot be read, it is believed.
bool has_cap(const fs::path& descriptor) {
  std::ifstream file(descriptor, std::ios::binary);
  char begin[4] = {};
  if (!file.read(begin, sizeof begin)) return true;
  return std::string_view(begin, sizeof begin) == std::string_view("\x05\x01\x09\x08", 4);
}

std::vector<Found> devices_of(const HidrawPaths& paths) {
  std::vector<Found> found;
  std::error_code error;
  for (fs::directory_iterator at(paths.descriptions, error), end; !error && at != end; at.increment(error)) {
    const fs::path device = at->path() / "device";
    const auto place = read_description(device / "uevent");
    if (place && has_cap(device / "report_descriptor"))
      found.push_back({paths.nodes + "/" + at->path().filename().string(), *place});
  }
  std::sort(found.begin(), found.end(), [](const Found& a, const Found& b) { return a.node < b.node; });
  return found;
}

std::string why_not(int code, const std::string& node) {
  if (code == EACCES || code == EPERM) {
    return "no permission to open the SpaceMouse " + node +
           ": install posed's udev rule (deploy/60-posed-trackers.rules) and plug it in again";
  }
  return "the SpaceMouse " + node + " cannot be opened: " + std::generic_category().message(code) +
         ": unplug it and plug it in again";
}

}  // namespace

struct SpacemousePort::Loop {
  boost::asio::io_context io{1};
};

SpacemousePort::SpacemousePort(TimeSource now, std::string wanted, HidrawPaths paths)
    : now_(std::move(now)), wanted_(std::move(wanted)), paths_(std::move(paths)), loop_(std::make_unique<Loop>()) {
  Owners::of_process().take(this, wanted_);
}

SpacemousePort::~SpacemousePort() {
  Owners::of_process().forget(this);
}

Opened SpacemousePort::open(const std::function<bool()>&) {
  Opened opened{nullptr, State::searching, "no SpaceMouse is plugged in"};
  Owners& owners = Owners::of_process();
  std::vector<Found> devices = devices_of(paths_);
  std::stable_partition(devices.begin(), devices.end(),
                        [&](const Found& device) { return owners.own(this, device.place); });
  for (const auto& [node, place] : devices) {
    // hidraw is everybody's: two trackers would both hear the first.
    const bool anothers = wanted_.empty() && owners.anothers(this, place);
    if (anothers || !place.is(wanted_)) {
      opened.message += anothers ? "; " + node + " is another tracker's of this station"
                                 : "; there is --tracker spacemouse:usb:" + place.name();
      continue;
    }
    const int fd = ::open(node.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC);
    if (fd < 0) {
      opened = {nullptr, State::failed, why_not(errno, node)};
      continue;
    }
    if (wanted_.empty()) owners.take(this, place.name());
    return {std::make_unique<StreamLine<Stream>>(loop_->io, Stream(loop_->io, fd), now_), State::starting, ""};
  }
  return opened;
}

bool SpacemousePort::rest(std::chrono::milliseconds at_most) {
  std::this_thread::sleep_for(at_most);
  return false;
}

void SpacemousePort::interrupt() {
  loop_->io.stop();
}

}  // namespace posed::tracker
