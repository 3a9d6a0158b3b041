#include "server/tracker/registry.h"

#include <charconv>
#include <ctime>
#include <functional>
#include <string>
#include <utility>

#include "common/names.h"
#include "server/tracker/capture/replay.h"
#include "server/tracker/driver.h"
#include "server/tracker/fastrak/session.h"
#include "server/tracker/fastrak/settings.h"
#include "server/tracker/isotrak/session.h"
#include "server/tracker/liberty/session.h"
#include "server/tracker/serial/port.h"
#include "server/tracker/simulated.h"
#include "server/tracker/spacemouse/port.h"
#include "server/tracker/spacemouse/session.h"
#include "server/tracker/usb/port.h"
#include "server/tracker/viper/session.h"

namespace posed::tracker {
namespace {

using Made = Result<std::unique_ptr<Tracker>>;

struct Wishes {
  std::string_view arg;  // what follows KIND:
  TimeSource now;
  const TrackerOptions& options;
};

template <class T>
bool parse_number(std::string_view text, T& value) {
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc{} && end == text.data() + text.size();
}

std::string id_of(std::string_view kind, const Wishes& wishes) {
  return wishes.options.id.empty() ? std::string(kind) : wishes.options.id;
}

Made make_simulated(const Wishes& wishes) {
  const std::string_view arg = wishes.arg;
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
  options.id = id_of("simulated", wishes);
  return std::unique_ptr<Tracker>(std::make_unique<SimulatedTracker>(std::move(options), wishes.now));
}

// Where a tracker is to be looked for: on USB, or at a serial port.
struct Place {
  std::string path;    // empty: USB
  unsigned baud = 0;   // of a serial port
  std::string device;  // on USB: its serial number or its port; empty: any
};

// `usb`, `serial`: what the family has. A path may hold an @ itself: the last one counts.
Result<Place> parse_place(std::string_view kind, std::string_view arg, bool usb, bool serial, unsigned baud) {
  const std::string said = std::string(kind) + ":" + std::string(arg);
  constexpr std::string_view kWhich = "usb:";
  if (arg.empty() || arg == "usb" || arg.starts_with(kWhich)) {
    Place place;
    if (arg.starts_with(kWhich)) place.device = arg.substr(kWhich.size());
    if (arg == kWhich) {
      return Error{"invalid_params", said + " says no serial number and no port", "",
                   said + "1-2.3, or " + std::string(kind) + ":usb for any"};
    }
    if (usb) return place;
    return Error{"invalid_params", "there is no " + std::string(kind) + " on USB", "",
                 "name its serial port, as in " + std::string(kind) + ":/dev/ttyS0"};
  }
  if (!serial) {
    return Error{"invalid_params", said + " names a place where posed does not look for a " + std::string(kind), "",
                 std::string(kind) + " or " + std::string(kind) + ":usb"};
  }
  Place place{std::string(arg), baud, ""};
  if (const std::size_t at = arg.rfind('@'); at != std::string_view::npos) {
    if (!parse_number(arg.substr(at + 1), place.baud) || place.baud < 1200) {
      return Error{"invalid_params", said + " does not end in a baud rate", "",
                   "as in " + std::string(kind) + ":" + std::string(arg.substr(0, at)) + "@115200"};
    }
    place.path = arg.substr(0, at);
  }
  if (!place.path.starts_with('/')) {
    return Error{
        "invalid_params", said + " names neither usb nor a serial port's path", "",
        std::string(kind) + (usb ? ":usb or " : ":/dev/ttyS0 or ") + std::string(kind) + ":/dev/ttyUSB0@115200"};
  }
  return place;
}

std::unique_ptr<Port> port_at(const Place& place, std::string_view kind, const TimeSource& now) {
  if (place.path.empty()) return std::make_unique<UsbPort>(std::string(kind), place.device, now);
  return std::make_unique<SerialPort>(place.path, place.baud, now);
}

using MakeSession = std::function<std::unique_ptr<Session>()>;

std::string capture_path(const std::string& folder, std::string_view id) {
  const std::time_t seconds = utc_now() / 1'000'000'000;
  std::tm utc{};
  ::gmtime_r(&seconds, &utc);
  char stamp[40];
  std::strftime(stamp, sizeof stamp, "-%Y%m%dT%H%M%SZ.capture", &utc);
  return folder + "/" + std::string(id) + stamp;
}

Made make_driver(std::string_view kind, double rate_hz, std::unique_ptr<Port> port, const Wishes& wishes,
                 MakeSession make_session, Abilities can = {}, Preferences defaults = {}) {
  DriverParts parts{id_of(kind, wishes), std::string(kind),  rate_hz, std::move(port), nullptr, std::move(make_session),
                    std::move(can),      std::move(defaults)};
  if (!wishes.options.capture_folder.empty()) {
    auto capture = Capture::create(capture_path(wishes.options.capture_folder, id_of(kind, wishes)));
    if (!capture) return capture.error();
    parts.capture = std::move(*capture);
  }
  return std::unique_ptr<Tracker>(std::make_unique<Driver>(std::move(parts)));
}

Made make_liberty_family(const LibertyFamily& family, const Wishes& wishes) {
  const auto place = parse_place(family.kind, wishes.arg, true, true, 115200);
  if (!place) return place.error();
  LibertyOptions options;
  options.id = id_of(family.kind, wishes);
  options.family = family;
  options.baud = place->baud;
  return make_driver(
      family.kind, family.rate_hz, port_at(*place, family.kind, wishes.now), wishes,
      [options] { return std::make_unique<LibertySession>(options); }, liberty_abilities(family),
      liberty_defaults(family));
}

Made make_liberty(const Wishes& wishes) {
  return make_liberty_family(kLiberty, wishes);
}

Made make_patriot(const Wishes& wishes) {
  return make_liberty_family(kPatriot, wishes);
}

Made make_fastrak(const Wishes& wishes) {
  const auto place = parse_place("fastrak", wishes.arg, true, true, 115200);
  if (!place) return place.error();
  FastrakOptions options;
  options.id = id_of("fastrak", wishes);
  options.baud = place->baud;
  return make_driver(
      "fastrak", 120, port_at(*place, "fastrak", wishes.now), wishes,
      [options] { return std::make_unique<FastrakSession>(options); }, fastrak_abilities(kFastrakStations),
      fastrak_defaults());
}

Made make_isotrak(const Wishes& wishes) {
  const auto place = parse_place("isotrak", wishes.arg, false, true, 19200);
  if (!place) return place.error();
  IsotrakOptions options;
  options.id = id_of("isotrak", wishes);
  options.baud = place->baud;
  return make_driver(
      "isotrak", 60, port_at(*place, "isotrak", wishes.now), wishes,
      [options] { return std::make_unique<IsotrakSession>(options); }, fastrak_abilities(kIsotrakStations),
      fastrak_defaults());
}

Made make_viper(const Wishes& wishes) {
  const auto place = parse_place("viper", wishes.arg, true, false, 0);
  if (!place) return place.error();
  ViperOptions options;
  options.id = id_of("viper", wishes);
  return make_driver(
      "viper", 240, port_at(*place, "viper", wishes.now), wishes,
      [options] { return std::make_unique<ViperSession>(options); }, viper_abilities(), viper_defaults());
}

Made make_spacemouse(const Wishes& wishes) {
  const auto place = parse_place("spacemouse", wishes.arg, true, false, 0);
  if (!place) return place.error();
  return make_driver("spacemouse", 60, std::make_unique<SpacemousePort>(wishes.now, place->device), wishes,
                     [id = id_of("spacemouse", wishes)] { return std::make_unique<SpacemouseSession>(id); });
}

Made make_replay(const Wishes& wishes) {
  constexpr std::string_view kFast = "@fast";
  std::string_view file = wishes.arg;
  const bool flat_out = file.ends_with(kFast);
  if (flat_out) file.remove_suffix(kFast.size());
  if (file.empty()) {
    return Error{"invalid_params", "replay needs a file", "",
                 "replay:FILE or replay:FILE@fast; posed --capture FOLDER makes them"};
  }
  auto reader = CaptureReader::open(std::string(file));
  if (!reader) return reader.error();
  return std::unique_ptr<Tracker>(std::make_unique<ReplayTracker>(std::move(*reader), flat_out, wishes.now));
}

struct Family {
  std::string_view kind;
  Made (*make)(const Wishes& wishes);
};

constexpr Family kFamilies[] = {
    {"simulated", make_simulated},   {"liberty", make_liberty}, {"patriot", make_patriot},
    {"fastrak", make_fastrak},       {"isotrak", make_isotrak}, {"viper", make_viper},
    {"spacemouse", make_spacemouse}, {"replay", make_replay},
};

}  // namespace

std::vector<std::string_view> tracker_kinds() {
  std::vector<std::string_view> kinds;
  for (const Family& family : kFamilies) kinds.push_back(family.kind);
  return kinds;
}

Made make_tracker(std::string_view spec, TimeSource now, const TrackerOptions& options) {
  const std::size_t split = spec.find(':');
  const std::string_view kind = spec.substr(0, split);
  const std::string_view arg = split == std::string_view::npos ? std::string_view{} : spec.substr(split + 1);
  std::vector<std::string> names;
  std::string known;
  for (const Family& family : kFamilies) {
    if (family.kind == kind) return family.make({arg, std::move(now), options});
    names.emplace_back(family.kind);
    known += " " + names.back();
  }
  return Error{"invalid_params", "no kind of tracker is called \"" + std::string(kind) + "\"; there are:" + known, "",
               did_you_mean(kind, names)};
}

}  // namespace posed::tracker
