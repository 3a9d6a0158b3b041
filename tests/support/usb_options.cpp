#include "tests/support/usb_options.h"

#include <sstream>

#include "tests/support/liberty_emulator.h"

namespace posed::test {

std::vector<std::uint8_t> descriptors_of(const UsbTestbedOptions& o) {
  std::vector<int> endpoints;
  std::istringstream words(o.endpoints);
  int count = 0;
  for (std::string word; words >> word; ++count) {
    const bool interrupt = word.ends_with('i');
    const int type = interrupt ? 3 : 2, interval = interrupt ? 5 : 0;
    const std::vector<int> one{7, 5, std::stoi(word, nullptr, 16), type, o.packet & 0xff, o.packet >> 8, interval};
    endpoints.insert(endpoints.end(), one.begin(), one.end());
  }
  const int usb = o.packet > 64 ? 2 : 1, total = 18 + 7 * count;
  std::vector<int> all{18, 1, 0, usb, 0xff, 0, 0, 64, o.vendor & 0xff, o.vendor >> 8, o.product & 0xff, o.product >> 8,
                       0,  1, 0, 0,   0,    1};
  const std::vector<int> configuration{9, 2, total, 0, 1, 1, 0, 0x80, 50, 9, 4, 0, 0, count, 0xff, 0, 0, 0};
  all.insert(all.end(), configuration.begin(), configuration.end());
  all.insert(all.end(), endpoints.begin(), endpoints.end());
  return {all.begin(), all.end()};
}

std::unique_ptr<TrackerEmulator> device_of(const UsbTestbedOptions& options) {
  return options.make_device ? options.make_device() : std::make_unique<LibertyEmulator>(options.stations);
}

}  // namespace posed::test
