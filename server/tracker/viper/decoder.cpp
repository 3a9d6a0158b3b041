#include "server/tracker/viper/decoder.h"

#include <algorithm>
#include <numbers>
#include <utility>

#include "server/tracker/axes.h"
#include "server/tracker/little_endian.h"
#include "server/tracker/viper/frame.h"

namespace posed::tracker {
namespace {

constexpr std::size_t kCrc = 4;
constexpr std::size_t kSensorsAt = 24;
constexpr double kMetresPerUnit[] = {0.0254, 0.3048, 0.01, 1.0};  // as the frame's own bits number them
constexpr double kDegreesPerRadian = 180.0 / std::numbers::pi;
constexpr double kQ15 = 32768.0;
constexpr char kSelfTestLetter = 'I';  // as a LIBERTY has it

Reply reply_of(std::span<const std::uint8_t> frame) {
  Reply reply;
  reply.command = u32_at(frame, 12);
  const auto action = static_cast<ViperAction>(u32_at(frame, 16));
  reply.error = action == ViperAction::ack || action == ViperAction::ack_with_warning ? 0 : 1;
  const auto body = frame.subspan(28, frame.size() - 28 - kCrc);
  reply.body.assign(body.begin(), body.end());
  return reply;
}

bool take_rotation(std::span<const std::uint8_t> sensor, std::uint32_t units, bool packed, Sample& sample) {
  if (packed) {
    const auto part = [&](std::size_t i) { return i16_at(sensor, 16 + 2 * i) / kQ15; };
    return take_quaternion(Quat(part(0), part(1), part(2), part(3)), sample);
  }
  if (units == 0) return take_angles(vec3_at(sensor, 16), sample);
  if (units == 1) return take_angles(vec3_at(sensor, 16) * kDegreesPerRadian, sample);
  return units == 2 && take_quaternion(quat_at(sensor, 16), sample);
}

}  // namespace

ViperDecoder::ViperDecoder(ViperFormat format) : format_(std::move(format)), clock_(format_.rate_hz) {}

Heard ViperDecoder::feed(std::span<const std::uint8_t> bytes, Nanoseconds now) {
  Heard out;
  buffer_.feed(bytes, [&](std::span<const std::uint8_t> rest, bool) -> std::size_t {
    const ViperFrame frame = examine_viper_frame(rest);
    if (frame.size > 0 && !frame.whole) return RecordBuffer::kPartial;
    if (!frame.whole) return 0;
    if (frame.pose) return take_pose(rest.first(frame.size), now, out) ? frame.size : 0;
    out.replies.push_back(reply_of(rest.first(frame.size)));
    return frame.size;
  });
  return out;
}

bool ViperDecoder::take_pose(std::span<const std::uint8_t> bytes, Nanoseconds now, Heard& out) {
  const std::uint32_t count = u32_at(bytes, 12), info = u32_at(bytes, 16), sensors = u32_at(bytes, 20);
  const std::uint32_t mode = info & 0xf, self_test = info >> 4 & 0xf;
  if (mode > 1 || kViperPoseSize + std::size_t{sensors} * kViperSensorSize != bytes.size()) return false;
  Frame frame;
  frame.t_ns = now;
  frame.device = format_.device;
  for (std::uint32_t i = 0; i < sensors; ++i) {
    const auto sensor = bytes.subspan(kSensorsAt + i * kViperSensorSize, kViperSensorSize);
    const std::uint32_t bits = u32_at(sensor, 0);
    if (bits >> 7 & 1) continue;  // virtual
    Sample sample;
    sample.station = static_cast<int>(bits & 0x7f) + 1;
    if (sample.station > static_cast<int>(kViperMostSensors)) return false;
    if (!take_position(vec3_at(sensor, 4) * kMetresPerUnit[bits >> 8 & 3], sample)) return false;
    if (!take_rotation(sensor, bits >> 10 & 3, mode == 1, sample)) return false;
    sample.buttons = bits >> 12 & 3;
    if (self_test != 0) {
      sample.flags |= kFlagError;
      sample.error_letter = kSelfTestLetter;
    }
    sample.device_count = count;
    frame.samples.push_back(sample);
  }
  const auto before = [](const Sample& a, const Sample& b) { return a.station < b.station; };
  std::sort(frame.samples.begin(), frame.samples.end(), before);
  const auto same = [](const Sample& a, const Sample& b) { return a.station == b.station; };
  if (std::adjacent_find(frame.samples.begin(), frame.samples.end(), same) != frame.samples.end()) return false;
  if (frame.samples.empty()) return true;  // no sensor is plugged in

  const Nanoseconds device_t_ns = clock_.at(count);
  for (Sample& sample : frame.samples) {
    sample.device_t_ns = device_t_ns;
    const auto [last, first_time] = last_rotation_.try_emplace(sample.station, sample.rotation);
    if (!first_time) last->second = sample.rotation = same_sign(last->second, sample.rotation);
  }
  out.frames.push_back(std::move(frame));
  return true;
}

std::string ViperDecoder::description() const {
  return "viper " + format_.device + " " + std::to_string(format_.rate_hz);
}

}  // namespace posed::tracker
