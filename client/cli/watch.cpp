#include <array>

#include "client/cli/output.h"

namespace posed::cli {
namespace {

using proto::Stream;

constexpr int kCredit = 3;  // a terminal that stalls wakes to what is, not to what was

double seconds(Nanoseconds t_ns) {
  return static_cast<double>(t_ns) * 1e-9;
}

std::string show(const proto::PoseData& data) {
  std::string line =
      format("t %.3f s  revision %llu", seconds(data.t_ns), static_cast<unsigned long long>(data.revision));
  for (const proto::FigurePose& figure : data.figures) {
    line += "  " + figure.figure + ' ' + std::string(proto::name_of(figure.status));
    for (const proto::GoalFrame& goal : figure.goals) {
      line +=
          format("  %s %s %.1f mm", goal.id.c_str(), std::string(proto::name_of(goal.state)).c_str(), goal.error * 1e3);
    }
  }
  return line;
}

std::string show(const proto::TrackerData& data) {
  std::string line = format("t %.3f s  %s", seconds(data.t_ns), data.device.c_str());
  for (const proto::SensorData& sensor : data.sensors) {
    const Vec3& p = sensor.position;
    const std::array<double, 4> q = xyzw(sensor.rotation);
    line += format("  %s [%.4f %.4f %.4f] m [%.4f %.4f %.4f %.4f]", sensor.sensor.c_str(), p.x, p.y, p.z, q[0], q[1],
                   q[2], q[3]);
    if (sensor.buttons != 0) line += format(" buttons %x", sensor.buttons);
    for (const std::string& flag : sensor.flags) line += ' ' + flag;
  }
  return line;
}

std::string show(const proto::StatsData& data) {
  return format(
      "t %.3f s  frames %llu  solves %llu  solve %.1f us  sample to send %.1f us  connections %d  dropped %llu",
      seconds(data.t_ns), static_cast<unsigned long long>(data.frames), static_cast<unsigned long long>(data.solves),
      data.solve_us, data.sample_to_send_us, data.connections, static_cast<unsigned long long>(data.dropped));
}

template <class Data>
Result<std::string> read_and_show(const std::string& text) {
  const auto data = proto::decode_message<Data>(text);
  if (!data) return data.error();
  return show(*data);
}

Result<std::string> show(const proto::Incoming& frame) {
  switch (*frame.stream) {
    case Stream::pose:
      return read_and_show<proto::PoseData>(frame.data);
    case Stream::tracker:
      return read_and_show<proto::TrackerData>(frame.data);
    case Stream::stats:
      return read_and_show<proto::StatsData>(frame.data);
    case Stream::scene:
      return frame.data;  // a document or a patch: its text says it best
  }
  return frame.data;
}

}  // namespace

int run_watch(const Session& session, const Watch& watch) {
  proto::StreamSubscribe subscription;
  subscription.stream = watch.stream;
  subscription.max_rate_hz = watch.rate_hz;
  if (watch.stream != Stream::scene) subscription.credit = kCredit;
  if (!watch.figure.empty()) subscription.figures = {watch.figure};
  if (watch.stream == Stream::pose && !session.json) subscription.fields = {"goals"};
  const Status subscribed = session.client.subscribe(subscription);
  if (!subscribed) return fail(subscribed.error());

  std::uint64_t lost = 0;
  for (std::uint64_t shown = 0; watch.count == 0 || shown < watch.count;) {
    const auto frame = session.client.next(std::chrono::hours(1));
    if (!frame && frame.error().code == "timeout") continue;
    if (!frame) return fail(frame.error());
    const auto text = session.json ? Result<std::string>(frame->data) : show(*frame);
    if (!text) return fail(text.error());
    print_line(*text);
    ++shown;
    const std::uint64_t lost_now = session.client.lost(watch.stream);
    if (lost_now > lost) {
      std::fprintf(stderr, "posectl: %llu frames were left out\n", static_cast<unsigned long long>(lost_now - lost));
    }
    lost = lost_now;
  }
  return kDone;
}

}  // namespace posed::cli
