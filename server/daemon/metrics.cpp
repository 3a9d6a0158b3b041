#include "server/daemon/metrics.h"

namespace posed {

std::string metrics_page(const proto::StatsData& stats, const net::Counters& counters, std::uint64_t revision) {
  std::string page;
  const auto add = [&](const char* name, const char* type, const char* help, const std::string& value) {
    page.append("# HELP posed_")
        .append(name)
        .append(" ")
        .append(help)
        .append("\n# TYPE posed_")
        .append(name)
        .append(" ");
    page.append(type).append("\nposed_").append(name).append(" ").append(value).append("\n");
  };
  add("tracker_frames_total", "counter", "Frames that trackers handed up.", std::to_string(stats.frames));
  add("solves_total", "counter", "Figures solved.", std::to_string(stats.solves));
  add("solve_seconds", "gauge", "Median time of a solve in the last second.", std::to_string(1e-6 * stats.solve_us));
  add("sample_to_send_seconds", "gauge", "Median time from a sample's arrival to its encoded pose in the last second.",
      std::to_string(1e-6 * stats.sample_to_send_us));
  const auto age = [&](const char* name, const char* help, double us) {
    add(name, "gauge", help, std::to_string(1e-6 * us));
  };
  age("frame_age_seconds", "Median age of stream frames when the kernel took them, in the last second.",
      stats.frame_age_us);
  age("frame_age_p99_seconds", "The same, of the oldest in a hundred.", stats.frame_age_p99_us);
  age("acked_age_seconds", "Median age of stream frames when a viewer acknowledged them, in the last second.",
      stats.acked_age_us);
  age("acked_age_p99_seconds", "The same, of the oldest in a hundred.", stats.acked_age_p99_us);
  add("connections", "gauge", "Peers connected now.", std::to_string(stats.connections));
  add("stream_frames_total", "counter", "Stream frames handed to the kernel.", std::to_string(counters.frames));
  add("stream_dropped_total", "counter", "Stream frames that a newer one replaced before a slow peer took them.",
      std::to_string(counters.dropped));
  add("lines_total", "counter", "Lines received.", std::to_string(counters.lines));
  add("received_bytes_total", "counter", "Bytes received.", std::to_string(counters.bytes_in));
  add("sent_bytes_total", "counter", "Bytes sent.", std::to_string(counters.bytes_out));
  add("scene_revision", "gauge", "Revision of the scene.", std::to_string(revision));
  return page;
}

}  // namespace posed
