// posectl doctor on a machine that is made of files.
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <string>

namespace {

namespace fs = std::filesystem;

class Doctor : public ::testing::Test {
 protected:
  Doctor() {
    std::string name = (fs::temp_directory_path() / "posed-doctor-XXXXXX").string();
    root_ = mkdtemp(name.data());
  }
  ~Doctor() override { fs::remove_all(root_); }

  void write(const std::string& path, const std::string& text) const {
    fs::create_directories((root_ / path).parent_path());
    std::ofstream(root_ / path) << text << '\n';
  }
  void plug(const std::string& product, const std::string& serial = "") const {
    const std::string device = "sys/bus/usb/devices/1-4";
    write(device + "/idVendor", "0f44");
    write(device + "/idProduct", product);
    write(device + "/busnum", "1");
    write(device + "/devnum", "7");
    if (!serial.empty()) write(device + "/serial", serial);
  }
  // Of a daemon that is not there; the exit code is 1 for that alone.
  std::string say() const {
    FILE* pipe =
        popen((POSED_PROGRAMS "/posectl --host tcp://127.0.0.1:1 doctor --root " + root_.string()).c_str(), "r");
    std::string out;
    char chunk[4096];
    while (const std::size_t got = fread(chunk, 1, sizeof chunk, pipe)) out.append(chunk, got);
    EXPECT_EQ(WEXITSTATUS(pclose(pipe)), 1);
    return out;
  }
  static bool has(const std::string& text, std::string_view part) { return text.find(part) != std::string::npos; }

  fs::path root_;
};

TEST_F(Doctor, SaysThatNobodyIsThere) {
  const std::string said = say();
  EXPECT_TRUE(has(said, "WRONG no daemon answers at tcp://127.0.0.1:1")) << said;
  EXPECT_TRUE(has(said, "no Polhemus tracker is on USB")) << said;
  EXPECT_TRUE(has(said, "the udev rules are not installed")) << said;
  EXPECT_TRUE(has(said, "2 things are wrong")) << said;
}

TEST_F(Doctor, KnowsWhoIsOnTheBus) {
  write("etc/udev/rules.d/60-posed-trackers.rules", "");
  plug("ff20", "12345");
  EXPECT_TRUE(has(say(), "WRONG you may not open a LIBERTY HS (1-4, serial number 12345) at /dev/bus/usb/001/007"))
      << say();
  write("dev/bus/usb/001/007", "");
  EXPECT_TRUE(has(say(), "ok    a LIBERTY HS (1-4, serial number 12345) at /dev/bus/usb/001/007 can be opened"))
      << say();
  EXPECT_TRUE(has(say(), "1 things are wrong")) << "the daemon alone: " << say();
  plug("ff21");
  EXPECT_TRUE(has(say(), "WRONG a LIBERTY HS waits for its firmware")) << say();
  plug("cf01");
  EXPECT_TRUE(has(say(), "WRONG a G4 is on USB")) << say();
  plug("1234");
  EXPECT_TRUE(has(say(), "posed does not know is on USB: 0f44:1234")) << say();
}

TEST_F(Doctor, NamesWhoHasIt) {
  plug("ef12");
  write("dev/bus/usb/001/007", "");
  write("proc/4711/comm", "PiMgr");
  fs::create_directories(root_ / "proc/4711/fd");
  fs::create_symlink("/dev/bus/usb/001/007", root_ / "proc/4711/fd/9");
  EXPECT_TRUE(has(say(), "WRONG a PATRIOT (1-4) is open in PiMgr (process 4711)")) << say();
  write("proc/4711/comm", "posed");
  EXPECT_TRUE(has(say(), "ok    a PATRIOT (1-4) is open in posed (process 4711)")) << say();
  fs::create_directories(root_ / "sys/bus/usb/devices/1-4/1-4:1.0");
  fs::create_symlink("/sys/bus/usb/drivers/usbserial_generic", root_ / "sys/bus/usb/devices/1-4/1-4:1.0/driver");
  EXPECT_TRUE(has(say(), "the kernel's usbserial_generic has the PATRIOT")) << say();
}

TEST_F(Doctor, LooksAtSerialPortsAndSpacemice) {
  write("dev/ttyUSB0", "");
  EXPECT_TRUE(has(say(), "/dev/ttyUSB0 can be opened")) << say();
  write("sys/class/hidraw/hidraw3/device/uevent",
        "HID_ID=0003:0000256F:0000C635\nHID_NAME=3Dconnexion SpaceMouse Compact");
  EXPECT_TRUE(has(say(), "WRONG you may not open 3Dconnexion SpaceMouse Compact at /dev/hidraw3")) << say();
  write("dev/hidraw3", "");
  EXPECT_TRUE(has(say(), "ok    3Dconnexion SpaceMouse Compact at /dev/hidraw3 can be opened")) << say();
  write("sys/class/hidraw/hidraw3/device/uevent", "HID_ID=0003:0000046D:0000C534\nHID_NAME=Logitech Mouse");
  EXPECT_FALSE(has(say(), "hidraw3")) << "a mouse is none";
}

}  // namespace
