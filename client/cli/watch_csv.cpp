#include "client/cli/output.h"
#include "client/cli/watch.h"

namespace posed::cli {
namespace {

using proto::Stream;

std::string vector(const Vec3& v) {
  return format("%.6f,%.6f,%.6f", v.x, v.y, v.z);
}

std::string place(const Vec3& position, const Quat& rotation) {
  const std::array<double, 4> q = xyzw(rotation);
  return vector(position) + format(",%.7f,%.7f,%.7f,%.7f", q[0], q[1], q[2], q[3]);
}

std::string integer(auto value) {
  return std::to_string(value);
}

std::string rows_of(const proto::TrackerData& data) {
  std::string rows;
  for (const proto::SensorData& sensor : data.sensors) {
    std::string flags;
    for (const std::string& flag : sensor.flags) flags += (flags.empty() ? "" : " ") + flag;
    rows += integer(data.t_ns) + ',' + sensor.sensor + ',' + place(sensor.position, sensor.rotation) + ',' +
            integer(sensor.buttons) + ',' + flags + '\n';
  }
  return rows;
}

std::string rows_of(const proto::StatsData& s) {
  return integer(s.t_ns) + ',' + integer(s.frames) + ',' + integer(s.solves) +
         format(",%.1f,%.1f,%d,", s.solve_us, s.sample_to_send_us, s.connections) + integer(s.dropped) +
         format(",%.0f,%.0f,%.0f,%.0f\n", s.frame_age_us, s.frame_age_p99_us, s.acked_age_us, s.acked_age_p99_us);
}

const char* columns(Stream stream) {
  switch (stream) {
    case Stream::pose:
      return "t_ns,revision,figure,segment,x,y,z,qx,qy,qz,qw\n";
    case Stream::tracker:
      return "t_ns,sensor,x,y,z,qx,qy,qz,qw,buttons,flags\n";
    case Stream::stats:
      return "t_ns,frames,solves,solve_us,sample_to_send_us,connections,dropped,frame_age_us,frame_age_p99_us,acked_"
             "age_us,"
             "acked_age_p99_us\n";
    case Stream::scene:
    case Stream::camera:
      break;
  }
  return "";
}

template <class Data>
Result<std::string> read_rows(const std::string& text) {
  const auto data = proto::decode_message<Data>(text);
  if (!data) return data.error();
  return rows_of(*data);
}

}  // namespace

Result<std::vector<std::string>> Csv::segments(const std::string& figure, std::size_t count) {
  auto& names = segments_[figure];
  if (names.size() == count) return names;  // another figure may have come under this id
  const auto found = client_.call<proto::FigureResult>(proto::FigureGet{figure});
  if (!found) return found.error();
  names.clear();
  for (const Segment& segment : found->document.segments) names.push_back(segment.name);
  names.resize(count);
  return names;
}

Result<std::string> Csv::pose(const std::string& text) {
  const auto data = proto::decode_message<proto::PoseData>(text);
  if (!data) return data.error();
  std::string rows;
  for (const proto::FigurePose& figure : data->figures) {
    const auto names = segments(figure.figure, figure.world_from_segment.size());
    if (!names) return names.error();
    for (std::size_t i = 0; i < names->size(); ++i) {
      const Transform& t = figure.world_from_segment[i];
      rows += integer(data->t_ns) + ',' + integer(data->revision) + ',' + figure.figure + ',' + (*names)[i] + ',' +
              place(t.position, t.rotation) + '\n';
    }
  }
  return rows;
}

Result<std::string> Csv::rows(const proto::Incoming& frame) {
  const Stream stream = *frame.stream;
  auto rows = stream == Stream::pose      ? pose(frame.data)
              : stream == Stream::tracker ? read_rows<proto::TrackerData>(frame.data)
                                          : read_rows<proto::StatsData>(frame.data);
  if (rows && !std::exchange(named_, true)) rows->insert(0, columns(stream));
  return rows;
}

}  // namespace posed::cli
