#include "client/cli/output.h"

namespace posed::cli {

int list_trackers(const Session& session) {
  return request<proto::TrackerListResult>(session, proto::TrackerList{}, [](const proto::TrackerListResult& list) {
    if (list.trackers.empty()) print_line("no trackers");
    for (const proto::TrackerEntry& tracker : list.trackers) {
      std::string sensors;
      for (const std::string& sensor : tracker.sensors) sensors += ' ' + sensor;
      std::string line = format("%s  %s  %.0f Hz  %llu frames", tracker.tracker.c_str(), tracker.state.c_str(),
                                tracker.rate_hz, static_cast<unsigned long long>(tracker.frames));
      if (tracker.bad_bytes > 0) {
        line += format("  %llu bad bytes", static_cast<unsigned long long>(tracker.bad_bytes));
      }
      if (!sensors.empty()) line += " " + sensors;
      if (!tracker.message.empty()) line += "  " + tracker.message;
      print_line(line);
    }
  });
}

}  // namespace posed::cli
