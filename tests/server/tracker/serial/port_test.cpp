#include "server/tracker/serial/port.h"

#include <gtest/gtest.h>

#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include "tests/support/fastrak_emulator.h"
#include "tests/support/pty_testbed.h"

extern char** environ;

namespace posed::tracker {
namespace {

bool never() {
  return false;
}
Nanoseconds no_time() {
  return 0;
}

struct SerialPortTest : testing::Test {
  test::PtyTestbed bed{std::make_unique<test::FastrakEmulator>()};
};

TEST_F(SerialPortTest, CarriesBothWays) {
  bed.plug();
  SerialPort port(bed.place(), 115200, no_time);
  Opened opened = port.open(never);
  ASSERT_TRUE(opened.line) << opened.message;
  ASSERT_TRUE(opened.line->write("l1\r"));
  std::string heard;
  for (int i = 0; i < 500 && heard.find('\n') == std::string::npos; ++i) {
    opened.line->wait(std::chrono::milliseconds(20));
    for (const Chunk& chunk : opened.line->take()) heard.append(chunk.bytes.begin(), chunk.bytes.end());
  }
  EXPECT_EQ(heard, "21l1100\r\n");
  EXPECT_EQ(opened.line->trouble(), Line::Trouble::none);
  bed.pull();
  for (int i = 0; i < 500 && opened.line->trouble() == Line::Trouble::none; ++i) {
    opened.line->wait(std::chrono::milliseconds(20));
  }
  EXPECT_EQ(opened.line->trouble(), Line::Trouble::gone);
  EXPECT_FALSE(opened.line->write("c"));
}

TEST_F(SerialPortTest, AnInterruptEndsAWait) {
  bed.plug();
  SerialPort port(bed.place(), 115200, no_time);
  Opened opened = port.open(never);
  ASSERT_TRUE(opened.line);
  port.interrupt();  // comes to nothing where nobody waits, and spoils nothing
  opened.line->wait(std::chrono::milliseconds(1));
  EXPECT_TRUE(opened.line->write("l1\r"));
}

TEST_F(SerialPortTest, OneThatIsNotThereIsSearchedFor) {
  SerialPort port(bed.place(), 115200, no_time);
  const Opened opened = port.open(never);
  EXPECT_FALSE(opened.line);
  EXPECT_EQ(opened.state, State::searching);
  EXPECT_NE(opened.message.find("there is no serial port " + bed.place()), std::string::npos) << opened.message;
}

TEST_F(SerialPortTest, AFileIsNone) {
  const std::string path = testing::TempDir() + "no_serial_port";
  std::ofstream(path) << "hello\n";
  SerialPort port(path, 115200, no_time);
  const Opened opened = port.open(never);
  EXPECT_FALSE(opened.line);
  EXPECT_EQ(opened.state, State::failed);
  EXPECT_NE(opened.message.find("is no serial port"), std::string::npos) << opened.message;
  std::filesystem::remove(path);
}

TEST_F(SerialPortTest, ABaudRateThatThereIsNotIsToldOf) {
  bed.plug();
  SerialPort port(bed.place(), 115201, no_time);
  const Opened opened = port.open(never);
  EXPECT_FALSE(opened.line);
  EXPECT_EQ(opened.state, State::failed);
  EXPECT_NE(opened.message.find("115201 baud"), std::string::npos) << opened.message;
}

TEST_F(SerialPortTest, WhoHoldsItIsNamed) {
  bed.plug();
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, bed.node().c_str(), O_RDWR | O_NOCTTY, 0);
  char name[] = "sleep", seconds[] = "300";
  char* words[] = {name, seconds, nullptr};
  pid_t child = 0;
  ASSERT_EQ(posix_spawnp(&child, name, &actions, nullptr, words, environ), 0);
  posix_spawn_file_actions_destroy(&actions);

  SerialPort port(bed.place(), 115200, no_time);
  const Opened opened = port.open(never);
  kill(child, SIGKILL);
  waitpid(child, nullptr, 0);
  EXPECT_FALSE(opened.line);
  EXPECT_EQ(opened.state, State::failed);
  EXPECT_NE(opened.message.find("is in use by sleep (process " + std::to_string(child) + ")"), std::string::npos)
      << opened.message;
  EXPECT_TRUE(port.open(never).line);
}

TEST_F(SerialPortTest, ASecondOfOursIsKeptOut) {
  bed.plug();
  SerialPort port(bed.place(), 115200, no_time), other(bed.place(), 115200, no_time);
  {
    const Opened first = port.open(never);
    ASSERT_TRUE(first.line);
    const Opened second = other.open(never);
    EXPECT_FALSE(second.line);
    EXPECT_NE(second.message.find("is in use by"), std::string::npos) << second.message;
  }
  EXPECT_TRUE(other.open(never).line);
}

TEST(SerialErrors, EachNamesThePortAndACure) {
  for (const int code : {ENOENT, ENXIO, EACCES, EBUSY, ENOTTY, EMFILE}) {
    const Opened opened = serial_open_error(code, "/dev/ttyS7", "");
    EXPECT_NE(opened.message.find("/dev/ttyS7"), std::string::npos) << opened.message;
    EXPECT_EQ(opened.state, code == ENOENT || code == ENXIO ? State::searching : State::failed);
  }
  const std::string denied = serial_open_error(EACCES, "/dev/ttyS7", "").message;
  EXPECT_NE(denied.find("dialout"), std::string::npos);
}

}  // namespace
}  // namespace posed::tracker
