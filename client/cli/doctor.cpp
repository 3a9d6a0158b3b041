// What is wrong between a tracker and its user: who is on the bus, who may open it, who has it, and what the daemon
// says. Looks only; changes nothing.
#include <unistd.h>

#include <algorithm>
#include <charconv>
#include <filesystem>
#include <fstream>

#include "client/cli/output.h"
#include "common/usb_products.h"

namespace posed::cli {
namespace {

namespace fs = std::filesystem;

std::vector<fs::path> entries(const fs::path& folder) {
  std::vector<fs::path> found;
  std::error_code error;
  for (fs::directory_iterator at(folder, error), end; !error && at != end; at.increment(error))
    found.push_back(at->path());
  std::sort(found.begin(), found.end());
  return found;
}

std::string first_line(const fs::path& path) {
  std::ifstream file(path);
  std::string line;
  std::getline(file, line);
  return line;
}

int number(const std::string& text, int base) {
  int value = -1;
  std::from_chars(text.data(), text.data() + text.size(), value, base);
  return value;
}

// Of the process that has the node open, where we may see that.
std::string holder(const fs::path& root, const std::string& node) {
  for (const fs::path& process : entries(root / "proc")) {
    const std::string pid = process.filename();
    if (number(pid, 10) <= 0) continue;
    for (const fs::path& descriptor : entries(process / "fd")) {
      std::error_code ignored;
      if (fs::read_symlink(descriptor, ignored) == node) return first_line(process / "comm") + " (process " + pid + ")";
    }
  }
  return {};
}

class Doctor {
 public:
  explicit Doctor(fs::path root) : root_(std::move(root)) {}

  void good(const std::string& text) { print_line("ok    " + text); }
  void bad(const std::string& text, const std::string& cure) {
    ++complaints_;
    print_line("WRONG " + text);
    print_line("      " + cure);
  }
  int complaints() const { return complaints_; }

  void usb() {
    int seen = 0;
    for (const fs::path& device : entries(root_ / "sys/bus/usb/devices")) {
      if (number(first_line(device / "idVendor"), 16) != kPolhemusVendor) continue;
      ++seen;
      const int product = number(first_line(device / "idProduct"), 16);
      const std::string serial = first_line(device / "serial");
      const std::string where = device.filename().string() + (serial.empty() ? "" : ", serial number " + serial);
      tracker(device, product, where);
    }
    if (seen == 0) good("no Polhemus tracker is on USB: if one should be, switch it on and look at its cable");
  }

  void hidraw() {
    for (const fs::path& device : entries(root_ / "sys/class/hidraw")) {
      std::ifstream uevent(device / "device/uevent");
      std::string id, name;
      for (std::string line; std::getline(uevent, line);) {
        if (line.starts_with("HID_ID=")) id = line.substr(7);
        if (line.starts_with("HID_NAME=")) name = line.substr(9);
      }
      // Bus, vendor and product. Logitech makes much else: its products count by their name.
      const bool own = id.find(":0000256F:") != std::string::npos;
      const bool logitech = id.find(":0000046D:") != std::string::npos && name.find("Space") != std::string::npos;
      if (own || logitech) node("/dev/" + device.filename().string(), name.empty() ? "a SpaceMouse" : name, false);
    }
  }

  void serial() {
    for (const fs::path& port : entries(root_ / "dev")) {
      const std::string name = port.filename();
      if (!name.starts_with("ttyUSB") && !name.starts_with("ttyACM")) continue;
      const std::string path = "/dev/" + name;
      if (::access(port.c_str(), R_OK | W_OK) != 0)
        bad("you may not open " + path, "join its group and log in again: sudo adduser $USER dialout");
      else if (const std::string who = holder(root_, path); !who.empty())
        good(path + " is open in " + who);
      else
        good(path + " can be opened, as in posed --tracker fastrak:" + path + "@115200");
    }
  }

  void rules() {
    constexpr const char* kFile = "udev/rules.d/60-posed-trackers.rules";
    for (const char* folder : {"etc", "lib", "usr/lib"}) {
      if (fs::exists(root_ / folder / kFile)) return good("the udev rules are installed");
    }
    bad("the udev rules are not installed: only root may open a tracker on USB",
        "sudo cp deploy/60-posed-trackers.rules /etc/udev/rules.d/ && sudo udevadm control --reload && "
        "sudo udevadm trigger");
  }

 private:
  void tracker(const fs::path& device, int product, const std::string& where) {
    for (const UsbProduct& known : kPolhemusProducts) {
      const std::string name(known.name);
      if (known.loader != 0 && product == known.loader) {
        return bad(
            "a " + name + " waits for its firmware (" + where + ")",
            "the firmware is Polhemus' own: uncomment its line in 60-posed-trackers.rules, and plug it in again");
      }
      if (product != known.product) continue;
      if (!known.served) return bad("a " + name + " is on USB (" + where + ")", "posed can not drive it yet");
      for (const fs::path& interface : entries(device)) {
        std::error_code none;
        const fs::path driver = fs::read_symlink(interface / "driver", none);
        if (driver.empty() || driver.filename() == "usb" || driver.filename() == "usbfs") continue;
        bad("the kernel's " + driver.filename().string() + " has the " + name + " (" + where + ")",
            "take the tracker from it: sudo rmmod " + driver.filename().string());
      }
      char path[48];
      std::snprintf(path, sizeof path, "/dev/bus/usb/%03d/%03d", number(first_line(device / "busnum"), 10),
                    number(first_line(device / "devnum"), 10));
      return node(path, "a " + name + " (" + where + ")", true);
    }
    bad(format("a Polhemus device that posed does not know is on USB: 0f44:%04x (", product) + where + ")",
        "posed --capture FOLDER does not help here; tell us the number and what it is");
  }

  void node(const std::string& path, const std::string& what, bool usb) {
    const std::string local = (root_ / path.substr(1)).string();
    if (::access(local.c_str(), R_OK | W_OK) != 0)
      return bad("you may not open " + what + " at " + path,
                 "install the udev rules (see below), and plug it in again; over ssh join the group plugdev, too");
    const std::string who = holder(root_, path);
    if (who.empty())
      good(what + " at " + path + " can be opened");
    else if (who.starts_with("posed ") || !usb)
      good(what + " is open in " + who);
    else
      bad(what + " is open in " + who, "end that program: a tracker on USB has one owner");
  }

  const fs::path root_;
  int complaints_ = 0;
};

void ask_daemon(Doctor& doctor, const std::string& host, const client::Identity& identity) {
  auto client = client::Client::connect(host, std::chrono::seconds(5), identity);
  if (!client) return doctor.bad("no daemon answers at " + host + ": " + client.error().message, "start it: posed");
  const auto status = client->call<proto::StatusResult>(proto::SessionStatus{});
  if (!status) return doctor.bad("the daemon says: " + status.error().message, status.error().hint);
  if (status->daemon.version != POSED_VERSION)
    doctor.bad("the daemon is of version " + status->daemon.version + ", posectl of " + POSED_VERSION,
               "install both from one package, and start the daemon anew");
  else
    doctor.good("the daemon at " + host + " is of version " + status->daemon.version);
  const auto list = client->call<proto::TrackerListResult>(proto::TrackerList{});
  if (!list) return doctor.bad("the daemon says: " + list.error().message, list.error().hint);
  if (list->trackers.empty()) doctor.good("it has no tracker: posed --tracker KIND starts one");
  for (const proto::TrackerEntry& tracker : list->trackers) {
    const std::string text = tracker.tracker + " is " + tracker.state;
    if (tracker.state == "streaming" && tracker.message.empty())
      doctor.good(text + format(" at %.0f Hz, with %zu sensors", tracker.rate_hz, tracker.sensors.size()));
    else
      doctor.bad(text, tracker.message.empty() ? "wait a moment, and ask again" : tracker.message);
  }
}

}  // namespace

int run_doctor(const std::string& host, const client::Identity& identity, const std::string& root) {
  Doctor doctor(root);
  ask_daemon(doctor, host, identity);
  doctor.usb();
  doctor.hidraw();
  doctor.serial();
  doctor.rules();
  print_line(doctor.complaints() == 0 ? "all is well" : format("%d things are wrong", doctor.complaints()));
  return doctor.complaints() == 0 ? kDone : kRefused;
}

}  // namespace posed::cli
