#include "tests/bench/stream/child.h"

#include <arpa/inet.h>
#include <fcntl.h>
#include <netinet/in.h>
#include <sched.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

#include <cstdio>
#include <exception>
#include <stdexcept>

namespace posed::test {
namespace {

Nanoseconds read_clock(clockid_t clock) {
  timespec time{};
  clock_gettime(clock, &time);
  return time.tv_sec * 1'000'000'000LL + time.tv_nsec;
}

bool listens(std::uint16_t port) {
  const int fd = socket(AF_INET, SOCK_STREAM, 0);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(port);
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  const bool connected = connect(fd, reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0;
  close(fd);
  return connected;
}

void begin_child() {
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  pin_to_core(kServerCore);
}

}  // namespace

Nanoseconds monotonic_now() {
  return read_clock(CLOCK_MONOTONIC);
}

bool pin_to_core(int core) {
  cpu_set_t one;
  CPU_ZERO(&one);
  CPU_SET(static_cast<std::size_t>(core), &one);
  return sched_setaffinity(0, sizeof one, &one) == 0;
}

std::uint16_t free_port() {
  const int fd = socket(AF_INET, SOCK_STREAM, 0);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  socklen_t size = sizeof address;
  const bool found = bind(fd, reinterpret_cast<const sockaddr*>(&address), size) == 0 &&
                     getsockname(fd, reinterpret_cast<sockaddr*>(&address), &size) == 0;
  close(fd);
  if (!found) throw std::runtime_error("there is no free port");
  return ntohs(address.sin_port);
}

Child::Child(const std::function<void(const std::function<void(std::uint16_t)>&)>& serve) {
  int ends[2];
  if (pipe(ends) != 0) throw std::runtime_error("cannot make a pipe");
  std::fflush(nullptr);
  pid_ = fork();
  if (pid_ == 0) {
    begin_child();
    close(ends[0]);
    try {
      serve([&](std::uint16_t port) {
        if (write(ends[1], &port, sizeof port) != sizeof port) _exit(1);
      });
    } catch (const std::exception& error) {
      std::fprintf(stderr, "bench_stream, in a server: %s\n", error.what());
    }
    _exit(1);
  }
  close(ends[1]);
  const bool told = read(ends[0], &port_, sizeof port_) == sizeof port_;
  close(ends[0]);
  if (!told) throw std::runtime_error("a server did not start");
}

Child::Child(const std::vector<std::string>& command, std::uint16_t port) : port_(port) {
  std::vector<char*> words;
  for (const std::string& word : command) words.push_back(const_cast<char*>(word.c_str()));
  words.push_back(nullptr);
  pid_ = fork();
  if (pid_ == 0) {
    begin_child();
    const int nowhere = open("/dev/null", O_RDWR);
    for (const int fd : {0, 1, 2}) dup2(nowhere, fd);
    execvp(words[0], words.data());
    _exit(127);
  }
  for (int i = 0; i < 1000; ++i) {
    if (listens(port_)) return;
    usleep(10'000);
  }
  kill(pid_, SIGKILL);
  waitpid(pid_, nullptr, 0);
  throw std::runtime_error(command[0] + " did not start to listen");
}

Child::~Child() {
  kill(pid_, SIGKILL);
  waitpid(pid_, nullptr, 0);
}

Nanoseconds Child::cpu_ns() const {
  clockid_t clock;
  if (clock_getcpuclockid(pid_, &clock) != 0) throw std::runtime_error("a server is gone");
  return read_clock(clock);
}

std::size_t Child::resident_bytes() const {
  const std::string name = "/proc/" + std::to_string(pid_) + "/statm";
  std::FILE* const file = std::fopen(name.c_str(), "r");
  long size = 0, resident = 0, shared = 0;
  if (!file || std::fscanf(file, "%ld %ld %ld", &size, &resident, &shared) != 3)
    throw std::runtime_error("a server is gone");
  std::fclose(file);
  return static_cast<std::size_t>((resident - shared) * sysconf(_SC_PAGESIZE));
}

}  // namespace posed::test
