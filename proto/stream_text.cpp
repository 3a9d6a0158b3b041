// Stream frames are written by hand: they are sent hundreds of times a second, and a fixed number of decimals costs a
// tenth of what a general JSON library takes.
#include <array>
#include <charconv>
#include <cmath>

#include "proto/codec.h"
#include "proto/enums.h"

namespace posed::proto {
namespace {

constexpr int kMetreDecimals = 6;
constexpr int kQuatDecimals = 7;

void append_integer(std::string& out, auto value) {
  std::array<char, 24> buffer;
  const auto end = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value).ptr;
  out.append(buffer.data(), end);
}

// The shortest text that reads back as the same number.
void append_number(std::string& out, double value) {
  std::array<char, 32> buffer;
  const auto end = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value).ptr;
  out.append(buffer.data(), end);
}

// Fixed decimals without trailing zeros, never "-0".
void append_fixed(std::string& out, double value, int decimals) {
  double scale = 1.0;
  for (int i = 0; i < decimals; ++i) scale *= 10.0;
  const double scaled = value * scale;
  if (!(std::abs(scaled) < 9e15)) return append_number(out, value);
  auto digits = static_cast<std::int64_t>(std::llround(scaled));
  if (digits < 0) {
    out += '-';
    digits = -digits;
  }
  const auto unit = static_cast<std::int64_t>(scale);
  append_integer(out, digits / unit);
  auto fraction = digits % unit;
  if (fraction == 0) return;
  out += '.';
  for (auto place = unit / 10; fraction != 0; place /= 10) {
    out += static_cast<char>('0' + fraction / place);
    fraction %= place;
  }
}

void append_vec3(std::string& out, const Vec3& v) {
  out += '[';
  append_fixed(out, v.x, kMetreDecimals);
  out += ',';
  append_fixed(out, v.y, kMetreDecimals);
  out += ',';
  append_fixed(out, v.z, kMetreDecimals);
  out += ']';
}

void append_quat(std::string& out, const Quat& q) {
  const auto v = xyzw(q);
  for (std::size_t i = 0; i < 4; ++i) {
    if (i > 0) out += ',';
    append_fixed(out, v[i], kQuatDecimals);
  }
}

// Ids, device names and causes: the ids' alphabet needs no escape, other text is not sent here.
void append_id(std::string& out, std::string_view id) {
  out.append("\"").append(id).append("\"");
}

// A flag quotes a byte of the device, which may be any: what is no plain character becomes "?".
void append_flag(std::string& out, std::string_view flag) {
  out += '"';
  for (const char c : flag) out += c < ' ' || c > '~' || c == '"' || c == '\\' ? '?' : c;
  out += '"';
}

void append_goal(std::string& out, const GoalFrame& goal) {
  out += "{\"id\":";
  append_id(out, goal.id);
  out += ",\"touch\":";
  append_vec3(out, goal.touch);
  out += ",\"target\":";
  append_vec3(out, goal.target);
  out += ",\"error\":";
  append_fixed(out, goal.error, kMetreDecimals);
  out += ",\"force\":";
  append_vec3(out, goal.force);
  out += ",\"state\":";
  append_id(out, word(goal.state));
  out += ",\"causes\":[";
  for (std::size_t i = 0; i < goal.causes.size(); ++i) {
    if (i > 0) out += ',';
    const GoalFrame::Because& cause = goal.causes[i];
    if (!cause.goal.empty()) {
      out += "{\"goal\":";
      append_id(out, cause.goal);
    } else if (!cause.limit.empty()) {
      out += "{\"limit\":";
      append_id(out, cause.limit);
      out += ",\"side\":";
      append_id(out, word(cause.side));
    } else if (!cause.binding.empty()) {
      out += "{\"binding\":";
      append_id(out, cause.binding);
    } else if (!cause.pin.empty()) {
      out += "{\"pin\":";
      append_id(out, cause.pin);
    } else {
      out += "{\"beyond_m\":";
      append_fixed(out, cause.beyond_m, kMetreDecimals);
    }
    if (!cause.figure.empty()) {
      out += ",\"figure\":";
      append_id(out, cause.figure);
    }
    out += '}';
  }
  out += "]}";
}

void append_transform(std::string& out, const Transform& t) {
  out += '[';
  for (int k = 0; k < 3; ++k) {
    append_fixed(out, t.position[k], kMetreDecimals);
    out += ',';
  }
  append_quat(out, t.rotation);
  out += ']';
}

void append_figure(std::string& out, const FigurePose& pose, const PoseFields& fields) {
  out += "{\"figure\":";
  append_id(out, pose.figure);
  if (fields.world_from_segment) {
    out += ",\"world_from_segment\":[";
    for (std::size_t i = 0; i < pose.world_from_segment.size(); ++i) {
      if (i > 0) out += ',';
      append_transform(out, pose.world_from_segment[i]);
    }
    out += ']';
  }
  if (fields.q) {
    out += ",\"q\":[";
    for (std::size_t i = 0; i < pose.q.size(); ++i) {
      if (i > 0) out += ',';
      append_fixed(out, pose.q[i], kQuatDecimals);
    }
    out += ']';
  }
  if (fields.goals) {
    out += ",\"goals\":[";
    for (std::size_t i = 0; i < pose.goals.size(); ++i) {
      if (i > 0) out += ',';
      append_goal(out, pose.goals[i]);
    }
    out += ']';
  }
  out += ",\"cost\":";
  append_number(out, pose.cost);
  out += ",\"status\":";
  append_id(out, word(pose.status));
  out += pose.branch_changed ? ",\"branch_changed\":true}" : ",\"branch_changed\":false}";
}

std::string open_frame(Stream stream, std::uint64_t seq) {
  std::string out;
  out.reserve(4096);
  out += "{\"jsonrpc\":\"2.0\",\"method\":\"stream.frame\",\"params\":{\"stream\":";
  append_id(out, word(stream));
  out += ",\"seq\":";
  append_integer(out, seq);
  out += ",\"data\":";
  return out;
}

void append_field(std::string& out, const char* name, auto value) {
  out.append(out.back() == '{' ? "\"" : ",\"").append(name).append("\":");
  if constexpr (std::is_floating_point_v<decltype(value)>)
    append_number(out, value);
  else
    append_integer(out, value);
}

}  // namespace

std::string encode_pose_frame(std::uint64_t seq, const PoseData& data, const PoseFields& fields) {
  std::string out = open_frame(Stream::pose, seq);
  out += '{';
  append_field(out, "t_ns", data.t_ns);
  append_field(out, "revision", data.revision);
  out += ",\"figures\":[";
  for (std::size_t i = 0; i < data.figures.size(); ++i) {
    if (i > 0) out += ',';
    append_figure(out, data.figures[i], fields);
  }
  out += ']';
  if (fields.objects && !data.objects.empty()) {
    out += ",\"objects\":[";
    for (std::size_t i = 0; i < data.objects.size(); ++i) {
      out += i > 0 ? ",{\"object\":" : "{\"object\":";
      append_id(out, data.objects[i].object);
      out += ",\"world_from_object\":";
      append_transform(out, data.objects[i].world_from_object);
      out += '}';
    }
    out += ']';
  }
  return out += "}}}";
}

std::string encode_tracker_frame(std::uint64_t seq, const TrackerData& data) {
  std::string out = open_frame(Stream::tracker, seq);
  out += '{';
  append_field(out, "t_ns", data.t_ns);
  if (data.sample_t_ns != 0) append_field(out, "sample_t_ns", data.sample_t_ns);
  out += ",\"device\":";
  append_id(out, data.device);
  out += ",\"sensors\":[";
  for (std::size_t i = 0; i < data.sensors.size(); ++i) {
    const SensorData& s = data.sensors[i];
    out += i > 0 ? ",{\"sensor\":" : "{\"sensor\":";
    append_id(out, s.sensor);
    out += ",\"position\":";
    append_vec3(out, s.position);
    out += ",\"quat_xyzw\":[";
    append_quat(out, s.rotation);
    out += ']';
    append_field(out, "buttons", s.buttons);
    out += ",\"flags\":[";
    for (std::size_t k = 0; k < s.flags.size(); ++k) {
      if (k > 0) out += ',';
      append_flag(out, s.flags[k]);
    }
    out += ']';
    append_field(out, "device_count", s.device_count);
    append_field(out, "device_t_ns", s.device_t_ns);
    out += '}';
  }
  return out += "]}}}";
}

std::string encode_camera_frame(std::uint64_t seq, const CameraData& data) {
  std::string out = open_frame(Stream::camera, seq);
  out += '{';
  append_field(out, "t_ns", data.t_ns);
  out += ",\"cameras\":[";
  for (std::size_t i = 0; i < data.cameras.size(); ++i) {
    const CameraFrame& camera = data.cameras[i];
    out += i > 0 ? ",{\"camera\":" : "{\"camera\":";
    append_id(out, camera.camera);
    out += ",\"position\":";
    append_vec3(out, camera.world_from_camera.position);
    out += ",\"quat_xyzw\":[";
    append_quat(out, camera.world_from_camera.rotation);
    out += "],\"fov_y\":";
    append_fixed(out, camera.fov_y, kQuatDecimals);
    out += '}';
  }
  return out += "]}}}";
}

std::string encode_stats_frame(std::uint64_t seq, const StatsData& data) {
  std::string out = open_frame(Stream::stats, seq);
  out += '{';
  append_field(out, "t_ns", data.t_ns);
  append_field(out, "frames", data.frames);
  append_field(out, "solves", data.solves);
  append_field(out, "solve_us", data.solve_us);
  append_field(out, "sample_to_send_us", data.sample_to_send_us);
  append_field(out, "connections", data.connections);
  append_field(out, "dropped", data.dropped);
  append_field(out, "frame_age_us", data.frame_age_us);
  append_field(out, "frame_age_p99_us", data.frame_age_p99_us);
  append_field(out, "acked_age_us", data.acked_age_us);
  append_field(out, "acked_age_p99_us", data.acked_age_p99_us);
  if (!data.trackers.empty()) {
    out += ",\"trackers\":[";
    for (std::size_t i = 0; i < data.trackers.size(); ++i) {
      const TrackerStats& tracker = data.trackers[i];
      out += i > 0 ? ",{\"tracker\":" : "{\"tracker\":";
      append_id(out, tracker.tracker);
      append_field(out, "rate_hz", tracker.rate_hz);
      append_field(out, "jitter_us", tracker.jitter_us);
      append_field(out, "lag_us", tracker.lag_us);
      out += '}';
    }
    out += ']';
  }
  return out += "}}}";
}

std::string encode_scene_snapshot(std::uint64_t seq, std::uint64_t revision, std::string_view document) {
  std::string out = open_frame(Stream::scene, seq);
  out += '{';
  append_field(out, "revision", revision);
  return out.append(",\"document\":").append(document).append("}}}");
}

std::string encode_scene_patch(std::uint64_t seq, std::uint64_t from_revision, std::uint64_t revision,
                               std::string_view by, std::string_view patch) {
  std::string out = open_frame(Stream::scene, seq);
  out += '{';
  append_field(out, "from_revision", from_revision);
  append_field(out, "revision", revision);
  out += ",\"by\":";
  append_id(out, by);
  return out.append(",\"patch\":").append(patch).append("}}}");
}

std::string encode_lost(Stream stream, std::uint64_t dropped) {
  std::string out = "{\"jsonrpc\":\"2.0\",\"method\":\"stream.lost\",\"params\":{\"stream\":";
  append_id(out, word(stream));
  append_field(out, "dropped", dropped);
  return out += "}}";
}

}  // namespace posed::proto
