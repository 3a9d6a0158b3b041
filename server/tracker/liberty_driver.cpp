#include "server/tracker/liberty_driver.h"

#include <chrono>
#include <utility>

#include "server/tracker/liberty_models.h"
#include "server/tracker/liberty_session.h"
#include "server/tracker/status_board.h"
#include "server/tracker/usb_bus.h"
#include "server/tracker/usb_pipe.h"

namespace posed::tracker {
namespace {

using namespace std::chrono_literals;

constexpr auto kRescan = 1s;

std::string told(const Error& error) {
  return error.message + ": " + error.hint;
}

}  // namespace

LibertyDriver::LibertyDriver(LibertyDriverOptions options, TimeSource now)
    : options_(std::move(options)), now_(std::move(now)) {}

LibertyDriver::~LibertyDriver() {
  stop();
}

const std::string& LibertyDriver::kind() const {
  static const std::string kind = "liberty";
  return kind;
}

void LibertyDriver::start(Sink sink) {
  thread_ = std::thread([this, sink = std::move(sink)]() mutable { run(std::move(sink)); });
}

void LibertyDriver::stop() {
  stopping_ = true;
  {
    const std::lock_guard lock(mutex_);
    if (bus_) bus_->interrupt();
  }
  if (thread_.joinable()) thread_.join();
}

void LibertyDriver::run(Sink sink) {
  StatusBoard board(std::move(sink), liberty_models()[0].rate_hz);
  board.set(State::searching, "");
  auto bus = UsbBus::open(kPolhemusVendor);
  if (!bus) {
    board.set(State::failed, told(bus.error()));
    return;
  }
  const auto lend = [&](UsbBus* lent) {
    const std::lock_guard lock(mutex_);
    bus_ = lent;
  };
  lend(bus->get());
  serve(**bus, board);
  lend(nullptr);
}

void LibertyDriver::serve(UsbBus& bus, StatusBoard& board) {
  while (!stopping_) {
    bus.take_change();
    if (!try_devices(bus, board) && !stopping_) rest(bus, board);
  }
}

// True where a device was served, for however long.
bool LibertyDriver::try_devices(UsbBus& bus, StatusBoard& board) {
  State state = State::searching;
  std::string message;
  for (const UsbDevicePtr& device : bus.devices()) {
    const UsbIdentity who = UsbBus::identity(device);
    if (const LibertyModel* model = liberty_by_loader(who.product); model && message.empty()) {
      message = firmware_advice(*model, who);
    }
    const LibertyModel* model = liberty_by_product(who.product);
    if (!model) continue;
    board.set(State::starting, "");
    auto pipe = UsbPipe::open(bus, device, model->endpoints, now_, [this] { return stopping_.load(); });
    if (pipe) {
      LibertySession(bus, **pipe, *model, options_, board, stopping_).run();
      if ((*pipe)->trouble() == UsbPipe::Trouble::error) rest(bus, board);
      return true;
    }
    state = State::failed;
    message = told(pipe.error());
  }
  board.set(state, std::move(message));
  return false;
}

// Until something on the bus changes, but no longer than the rescan takes: not every system announces devices.
void LibertyDriver::rest(UsbBus& bus, StatusBoard& board) {
  const auto deadline = std::chrono::steady_clock::now() + kRescan;
  while (!stopping_ && !bus.take_change() && std::chrono::steady_clock::now() < deadline) {
    bus.handle_events(100ms);
    board.tick();
  }
}

}  // namespace posed::tracker
