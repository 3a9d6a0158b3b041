#include "server/tracker/registry.h"

#include <charconv>
#include <string>
#include <utility>

#include "common/names.h"
#include "server/tracker/liberty_driver.h"
#include "server/tracker/simulated.h"

namespace posed::tracker {
namespace {

using Made = Result<std::unique_ptr<Tracker>>;

template <class T>
bool parse_number(std::string_view text, T& value) {
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc{} && end == text.data() + text.size();
}

Made make_simulated(std::string_view arg, TimeSource now) {
  SimulatedOptions options;
  const std::size_t split = arg.find('@');
  const std::string_view seed = arg.substr(0, split);
  const bool rate_given = split != std::string_view::npos;
  if ((!seed.empty() && !parse_number(seed, options.seed)) ||
      (rate_given && !parse_number(arg.substr(split + 1), options.rate_hz)) || options.rate_hz < 1 ||
      options.rate_hz > 1000) {
    return Error{"invalid_params", "simulated:" + std::string(arg) + " is not SEED or SEED@RATE", "",
                 "whole numbers, RATE from 1 to 1000, as in simulated:7@120"};
  }
  return std::unique_ptr<Tracker>(std::make_unique<SimulatedTracker>(std::move(options), std::move(now)));
}

Made make_liberty(std::string_view arg, TimeSource now) {
  if (!arg.empty() && arg != "usb") {
    return Error{"not_available", "a liberty on a serial line is not served yet", "", "liberty or liberty:usb"};
  }
  return std::unique_ptr<Tracker>(std::make_unique<LibertyDriver>(LibertyDriverOptions{}, std::move(now)));
}

struct Family {
  std::string_view kind;
  Made (*make)(std::string_view arg, TimeSource now);  // null: not served yet
};

constexpr Family kFamilies[] = {
    {"simulated", make_simulated}, {"liberty", make_liberty}, {"patriot", nullptr},    {"fastrak", nullptr},
    {"isotrak", nullptr},          {"viper", nullptr},        {"spacemouse", nullptr}, {"replay", nullptr},
};

}  // namespace

std::vector<std::string_view> tracker_kinds() {
  std::vector<std::string_view> kinds;
  for (const Family& family : kFamilies) kinds.push_back(family.kind);
  return kinds;
}

Made make_tracker(std::string_view spec, TimeSource now) {
  const std::size_t split = spec.find(':');
  const std::string_view kind = spec.substr(0, split);
  const std::string_view arg = split == std::string_view::npos ? std::string_view{} : spec.substr(split + 1);
  std::vector<std::string> names;
  std::string known, served;
  for (const Family& family : kFamilies) {
    if (family.kind == kind && family.make) return family.make(arg, std::move(now));
    names.emplace_back(family.kind);
    known += " " + names.back();
    if (family.make) served += " " + names.back();
  }
  for (const Family& family : kFamilies) {
    if (family.kind != kind) continue;
    return Error{"not_available", "trackers of the kind " + std::string(kind) + " are not served yet", "",
                 "served are:" + served};
  }
  return Error{"invalid_params", "no kind of tracker is called \"" + std::string(kind) + "\"; there are:" + known, "",
               did_you_mean(kind, names)};
}

}  // namespace posed::tracker
