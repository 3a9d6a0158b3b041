#include "client/cli/watch.h"

#include <unistd.h>

#include <array>

#include "client/cli/output.h"

namespace posed::cli {
namespace {

using proto::Stream;

constexpr double kTableHz = 15.0;
constexpr std::chrono::seconds kPatience{60};  // with a daemon that is being restarted
constexpr int kCredit = 3;                     // a terminal that stalls wakes to what is, not to what was

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

std::string show(const proto::CameraData& data) {
  std::string line = format("t %.3f s", seconds(data.t_ns));
  for (const proto::CameraFrame& camera : data.cameras) {
    const Vec3& p = camera.world_from_camera.position;
    const std::array<double, 4> q = xyzw(camera.world_from_camera.rotation);
    line += format("  %s [%.4f %.4f %.4f] m [%.4f %.4f %.4f %.4f]", camera.camera.c_str(), p.x, p.y, p.z, q[0], q[1],
                   q[2], q[3]);
  }
  return line;
}

std::string show(const proto::StatsData& data) {
  return format(
      "t %.3f s  frames %llu  solves %llu  solve %.1f us  sample to send %.1f us  connections %d  dropped %llu  age "
      "p50 %.0f "
      "p99 %.0f us  acked p50 %.0f p99 %.0f us",
      seconds(data.t_ns), static_cast<unsigned long long>(data.frames), static_cast<unsigned long long>(data.solves),
      data.solve_us, data.sample_to_send_us, data.connections, static_cast<unsigned long long>(data.dropped),
      data.frame_age_us, data.frame_age_p99_us, data.acked_age_us, data.acked_age_p99_us);
}

template <class Data>
Result<std::string> read_and_show(const std::string& text) {
  const auto data = proto::decode_message<Data>(text);
  if (!data) return data.error();
  return show(*data);
}

}  // namespace

Result<std::string> show_line(const proto::Incoming& frame) {
  switch (*frame.stream) {
    case Stream::pose:
      return read_and_show<proto::PoseData>(frame.data);
    case Stream::tracker:
      return read_and_show<proto::TrackerData>(frame.data);
    case Stream::stats:
      return read_and_show<proto::StatsData>(frame.data);
    case Stream::camera:
      return read_and_show<proto::CameraData>(frame.data);
    case Stream::scene:
      return frame.data;  // a document or a patch: its text says it best
  }
  return frame.data;
}

int run_watch(const Session& session, const Watch& watch) {
  using Form = Watch::Form;
  Form form = watch.form;
  if (session.json) form = Form::lines;
  if ((watch.stream == Stream::scene || watch.stream == Stream::camera) && form != Form::lines) {
    if (form != Form::automatic)
      return fail({"bad_usage", "this stream is no table: watch it as lines", "", "leave out --csv and --table"});
    form = Form::lines;
  }
  if (form == Form::automatic) form = isatty(STDOUT_FILENO) ? Form::table : Form::lines;

  Csv csv(session.client);
  std::optional<Table> table;
  if (form == Form::table) table.emplace(session.client);
  const auto shown = [&](const proto::Incoming& frame) -> Result<std::string> {
    if (form == Form::csv) return csv.rows(frame);
    if (form == Form::table) return table->screen(frame, session.client.lost(watch.stream));
    auto line = session.json ? Result<std::string>(frame.data) : show_line(frame);
    if (line) *line += '\n';
    return line;
  };

  proto::StreamSubscribe subscription;
  subscription.stream = watch.stream;
  subscription.max_rate_hz = watch.rate_hz > 0.0 || form != Form::table ? watch.rate_hz : kTableHz;
  if (watch.stream != Stream::scene) subscription.credit = kCredit;
  if (!watch.figure.empty()) subscription.figures = {watch.figure};
  if (watch.stream == Stream::pose && !session.json)
    subscription.fields = {form == Form::csv ? "world_from_segment" : "goals"};
  const Status subscribed = session.client.subscribe(subscription);
  if (!subscribed) return fail(subscribed.error());
  session.client.keep_connected(kPatience);

  std::uint64_t lost = 0, reconnected = 0;
  for (std::uint64_t count = 0; watch.count == 0 || count < watch.count;) {
    const auto frame = session.client.next(std::chrono::hours(1));
    if (!frame && frame.error().code == "timeout") continue;
    if (!frame) return fail(frame.error());
    const auto text = shown(*frame);
    if (!text) return fail(text.error());
    std::fwrite(text->data(), 1, text->size(), stdout);
    std::fflush(stdout);
    ++count;
    if (form == Form::table) continue;
    if (const std::uint64_t now = session.client.lost(watch.stream); std::exchange(lost, now) < now)
      std::fprintf(stderr, "posectl: %llu frames were left out\n", static_cast<unsigned long long>(now));
    if (const std::uint64_t now = session.client.reconnected(); std::exchange(reconnected, now) < now)
      std::fprintf(stderr, "posectl: the connection was lost, and is there again\n");
  }
  return kDone;
}

}  // namespace posed::cli
