// The kinds of tracker there are: one row a family.
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "common/result.h"
#include "server/tracker/time_source.h"
#include "server/tracker/tracker.h"

namespace posed::tracker {

struct TrackerOptions {
  std::string capture_folder;  // where each tracker on a line writes what it hears (ID-UTC.capture); empty: nowhere
  std::string id = {};         // empty: the kind
};

// `spec` is KIND[:ARG], as after --tracker:
//   simulated[:SEED[@RATE]]   two sensors that swing; RATE in Hz, 1..1000
//   liberty patriot fastrak   on USB (KIND, KIND:usb or KIND:usb:WHICH), or at a serial port: KIND:/dev/ttyS0[@BAUD]
//   isotrak:/dev/ttyS0[@BAUD]
//   viper[:usb[:WHICH]]
//   spacemouse[:usb[:WHICH]]  through hidraw
//     WHICH: the device's serial number, or the port that it is plugged in at ("1-2.3"); posectl doctor tells both
//   replay:FILE[@fast]        a capture, at its own pace or flat out
// The tracker's id is its kind, or TrackerOptions::id; a replay's is that of the tracker that was captured. Errors:
// invalid_params for a word that is none and a place that cannot be, not_available for a file that cannot be read or
// written; each with a hint.
Result<std::unique_ptr<Tracker>> make_tracker(std::string_view spec, TimeSource now,
                                              const TrackerOptions& options = {});

std::vector<std::string_view> tracker_kinds();  // all that there are

}  // namespace posed::tracker
