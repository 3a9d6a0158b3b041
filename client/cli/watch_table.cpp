#include <algorithm>

#include "client/cli/output.h"
#include "client/cli/watch.h"
#include "client/lib/clock.h"

namespace posed::cli {
namespace {

constexpr std::size_t kAges = 100;
constexpr const char *kHome = "\x1b[H", *kEndOfLine = "\x1b[K\n", *kClearBelow = "\x1b[J";

using client::steady_now;
using Lines = std::vector<std::string>;

Lines lines_of(const proto::PoseData& data) {
  Lines lines;
  for (const proto::FigurePose& figure : data.figures) {
    lines.push_back(format("%s  %s  cost %.4g  revision %llu", figure.figure.c_str(),
                           std::string(proto::name_of(figure.status)).c_str(), figure.cost,
                           static_cast<unsigned long long>(data.revision)));
    lines.push_back(format("  %-32s %-11s %10s  %26s  %8s", "goal", "state", "error mm", "touch m", "force"));
    for (const proto::GoalFrame& goal : figure.goals) {
      lines.push_back(format("  %-32s %-11s %10.1f  %8.4f %8.4f %8.4f  %8.3f", goal.id.c_str(),
                             std::string(proto::name_of(goal.state)).c_str(), goal.error * 1e3, goal.touch.x,
                             goal.touch.y, goal.touch.z, glm::length(goal.force)));
    }
  }
  return lines;
}

Lines lines_of(const proto::TrackerData& data) {
  Lines lines{format("%-20s  %26s  %35s  %s", data.device.c_str(), "position m", "quat_xyzw", "buttons")};
  for (const proto::SensorData& sensor : data.sensors) {
    const Vec3& p = sensor.position;
    const std::array<double, 4> q = xyzw(sensor.rotation);
    std::string line = format("  %-18s  %8.4f %8.4f %8.4f  %8.4f %8.4f %8.4f %8.4f  %7x", sensor.sensor.c_str(), p.x,
                              p.y, p.z, q[0], q[1], q[2], q[3], sensor.buttons);
    for (const std::string& flag : sensor.flags) line += ' ' + flag;
    lines.push_back(std::move(line));
  }
  return lines;
}

Lines lines_of(const proto::StatsData& s) {
  const auto row = [](const char* name, double value, const char* unit) {
    return format("  %-36s %12.1f %s", name, value, unit);
  };
  return {row("tracker frames", static_cast<double>(s.frames), ""),
          row("solves", static_cast<double>(s.solves), ""),
          row("solve, median", s.solve_us, "us"),
          row("sample to encoded line, median", s.sample_to_send_us, "us"),
          row("age of frames when sent, median", s.frame_age_us, "us"),
          row("age of frames when sent, p99", s.frame_age_p99_us, "us"),
          row("age of frames when seen, median", s.acked_age_us, "us"),
          row("age of frames when seen, p99", s.acked_age_p99_us, "us"),
          row("connections", s.connections, ""),
          row("frames dropped for slow viewers", static_cast<double>(s.dropped), "")};
}

struct Shown {
  Nanoseconds t_ns;
  Lines lines;
};

template <class Data>
Result<Shown> read(const std::string& text) {
  const auto data = proto::decode_message<Data>(text);
  if (!data) return data.error();
  return Shown{data->t_ns, lines_of(*data)};
}

}  // namespace

Table::Table(client::Client& client) : clock_offset_(client::clock_offset(client)) {}

std::string Table::age(Nanoseconds t_ns) {
  if (!clock_offset_) return "";
  if (ages_ms_.size() == kAges) ages_ms_.erase(ages_ms_.begin());
  ages_ms_.push_back(1e-6 * static_cast<double>(steady_now() + *clock_offset_ - t_ns));
  return format("  age %.1f ms, at most %.1f", ages_ms_.back(), *std::max_element(ages_ms_.begin(), ages_ms_.end()));
}

Result<std::string> Table::screen(const proto::Incoming& frame, std::uint64_t lost) {
  const auto shown = *frame.stream == proto::Stream::pose      ? read<proto::PoseData>(frame.data)
                     : *frame.stream == proto::Stream::tracker ? read<proto::TrackerData>(frame.data)
                                                               : read<proto::StatsData>(frame.data);
  if (!shown) return shown.error();
  const Nanoseconds seen = steady_now();
  if (last_seen_ != 0 && frame.seq > last_seq_) {
    const double rate = 1e9 * static_cast<double>(frame.seq - last_seq_) / static_cast<double>(seen - last_seen_);
    rate_hz_ = rate_hz_ == 0.0 ? rate : 0.9 * rate_hz_ + 0.1 * rate;
  }
  last_seq_ = frame.seq;
  last_seen_ = seen;

  std::string text = kHome;
  text += format("%s  t %.3f s  %.1f Hz", std::string(proto::stream_name(*frame.stream)).c_str(),
                 1e-9 * static_cast<double>(shown->t_ns), rate_hz_);
  text +=
      age(shown->t_ns) + format("  left out %llu  (Ctrl-C ends)", static_cast<unsigned long long>(lost)) + kEndOfLine;
  for (const std::string& line : shown->lines) text += line + kEndOfLine;
  return text + kClearBelow;
}

}  // namespace posed::cli
