// The kinds of tracker there are: one row a family.
#pragma once

#include <memory>
#include <string_view>
#include <vector>

#include "common/result.h"
#include "server/tracker/time_source.h"
#include "server/tracker/tracker.h"

namespace posed::tracker {

// `spec` is KIND[:ARG], as after --tracker:
//   simulated[:SEED[@RATE]]  two sensors that swing; RATE in Hz, 1..1000
//   liberty[:usb]            a LIBERTY on USB
// The tracker's id is its kind. Errors: not_available for a family that is known and not served yet, invalid_params for
// a word that is none, each with a hint.
Result<std::unique_ptr<Tracker>> make_tracker(std::string_view spec, TimeSource now);

std::vector<std::string_view> tracker_kinds();  // all that are known, served or not

}  // namespace posed::tracker
