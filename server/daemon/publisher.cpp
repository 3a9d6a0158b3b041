#include "server/daemon/publisher.h"

#include <algorithm>
#include <tuple>

#include "common/names.h"
#include "server/daemon/sensor_message.h"

namespace posed {
namespace {

const std::vector<std::string> kFigureFields = {"world_from_segment", "q", "goals"};
const std::vector<std::string> kPoseFields = {"world_from_segment", "q", "goals", "objects"};

Status check_among(const std::vector<std::string>& known, const std::vector<std::string>& fields) {
  for (std::size_t i = 0; i < fields.size(); ++i) {
    if (std::find(known.begin(), known.end(), fields[i]) == known.end()) {
      return Error{"invalid_params", "a pose has no field " + fields[i].substr(0, 64), "/fields/" + std::to_string(i),
                   did_you_mean(fields[i], known)};
    }
  }
  return Ok{};
}

net::SharedLine share(std::string line, proto::Stream stream, proto::Encoding encoding) {
  if (encoding == proto::Encoding::cbor) line = proto::encode_cbor(line, stream);
  return std::make_shared<const std::string>(std::move(line));
}

}  // namespace

bool Publisher::Channel::operator<(const Channel& o) const {
  return std::tie(stream, figures, fields, encoding) < std::tie(o.stream, o.figures, o.fields, o.encoding);
}

Status Publisher::check_fields(const std::vector<std::string>& fields) {
  return check_among(kFigureFields, fields);
}

proto::PoseFields Publisher::fields_of(const std::vector<std::string>& fields) {
  if (fields.empty()) return {};
  const auto wanted = [&](const char* name) { return std::find(fields.begin(), fields.end(), name) != fields.end(); };
  return {wanted("world_from_segment"), wanted("q"), wanted("goals"), wanted("objects")};
}

Status Publisher::check(const proto::StreamSubscribe& wish) const {
  std::vector<std::string> known;
  for (const auto& [id, figure] : scene_.figures()) known.push_back(id);
  for (std::size_t i = 0; i < wish.figures.size(); ++i) {
    if (std::find(known.begin(), known.end(), wish.figures[i]) == known.end()) {
      return Error{"unknown_figure", "no figure is called " + wish.figures[i].substr(0, 64),
                   "/figures/" + std::to_string(i), did_you_mean(wish.figures[i], known)};
    }
  }
  if (Status checked = check_among(kPoseFields, wish.fields); !checked) return checked;
  if (wish.stream != proto::Stream::pose && !(wish.figures.empty() && wish.fields.empty())) {
    return Error{"invalid_params", "only the pose stream has figures and fields to choose",
                 wish.figures.empty() ? "/fields" : "/figures", "leave it out"};
  }
  return Ok{};
}

Publisher::Channel Publisher::channel_of(const proto::StreamSubscribe& wish) {
  Channel channel{wish.stream, wish.figures, {}, wish.encoding};
  std::sort(channel.figures.begin(), channel.figures.end());
  channel.figures.erase(std::unique(channel.figures.begin(), channel.figures.end()), channel.figures.end());
  channel.fields = fields_of(wish.fields);
  return channel;
}

void Publisher::subscribe(net::ConnectionId connection, const proto::StreamSubscribe& wish) {
  unsubscribe(connection, wish.stream);
  const Channel channel = channel_of(wish);
  const bool first_of_scene = !followed(proto::Stream::scene);
  auto [it, made] = channels_.try_emplace(channel);
  State& state = it->second;
  if (made) state.key = next_key_++;
  state.seq = std::max<std::uint64_t>(state.seq, 1);  // the present state has a number that it had, or the first
  ++state.subscribers;
  followers_[connection][static_cast<std::size_t>(wish.stream)] = channel;

  if (wish.stream == proto::Stream::scene) {
    if (first_of_scene) {
      scene_text_ = scene_text();
      scene_revision_ = sent_revision_ = scene_.revision();
    }
    return subscribe_to_scene(connection, wish);
  }
  net::SharedLine present = state.last;
  if (wish.stream == proto::Stream::pose) present = encode_pose(channel, state.seq, pose_t_ns_);
  if (wish.stream == proto::Stream::camera) {
    publish_cameras(pose_t_ns_);  // so that all followers have seen the same
    present = share(proto::encode_camera_frame(state.seq, {pose_t_ns_, cameras_}), wish.stream, wish.encoding);
  }
  server_.subscribe(
      connection, {wish.stream, state.key, wish.max_rate_hz, wish.credit, true, wish.encoding == proto::Encoding::cbor},
      std::move(present), state.seq);
}

// From where the scene is now, when the disk has that: what is sent after it begins there.
void Publisher::subscribe_to_scene(net::ConnectionId connection, const proto::StreamSubscribe& wish) {
  journal_.when_stored([this, connection, wish, revision = scene_revision_, text = scene_text_](const Status& stored) {
    const auto follower = followers_.find(connection);
    if (follower == followers_.end()) return;
    const auto& channel = follower->second[static_cast<std::size_t>(proto::Stream::scene)];
    if (!channel) return;  // it has thought better of it
    State& state = channels_.find(*channel)->second;
    server_.subscribe(
        connection,
        {wish.stream, state.key, wish.max_rate_hz, wish.credit, false, channel->encoding == proto::Encoding::cbor},
        share(stored ? proto::encode_scene_snapshot(state.seq, revision, text)
                     : proto::encode_scene_snapshot(state.seq, scene_revision_, scene_text_),
              proto::Stream::scene, channel->encoding),
        state.seq);
  });
}

void Publisher::drop(Channels::iterator channel) {
  if (--channel->second.subscribers == 0) channels_.erase(channel);
}

void Publisher::unsubscribe(net::ConnectionId connection, proto::Stream stream) {
  const auto follower = followers_.find(connection);
  if (follower == followers_.end()) return;
  auto& channel = follower->second[static_cast<std::size_t>(stream)];
  if (!channel) return;
  drop(channels_.find(*channel));
  channel.reset();
  server_.unsubscribe(connection, stream);
}

void Publisher::forget(net::ConnectionId connection) {
  const auto follower = followers_.find(connection);
  if (follower == followers_.end()) return;
  for (const auto& channel : follower->second) {
    if (channel) drop(channels_.find(*channel));
  }
  followers_.erase(follower);
}

bool Publisher::follows(net::ConnectionId connection, proto::Stream stream) const {
  const auto follower = followers_.find(connection);
  return follower != followers_.end() && follower->second[static_cast<std::size_t>(stream)];
}

net::SharedLine Publisher::encode_pose(const Channel& channel, std::uint64_t seq, Nanoseconds t_ns) const {
  proto::PoseData data;
  data.t_ns = t_ns;
  data.revision = solving_.revision();
  for (const auto& [id, solved] : solving_.figures()) {
    if (channel.figures.empty() || std::binary_search(channel.figures.begin(), channel.figures.end(), id)) {
      data.figures.push_back(solving_.message(id));
    }
  }
  if (channel.fields.objects) {
    for (const auto& [id, object] : scene_.objects()) {
      if (object.live) data.objects.push_back({id, *object.live});
    }
  }
  return share(proto::encode_pose_frame(seq, data, channel.fields), channel.stream, channel.encoding);
}

void Publisher::publish(const Channel& channel, State& state, net::SharedLine line, Nanoseconds t_ns) {
  server_.publish(channel.stream, state.key, state.seq, std::move(line), channel.encoding == proto::Encoding::cbor,
                  t_ns);
}

void Publisher::publish_pose(Nanoseconds t_ns) {
  pose_t_ns_ = t_ns;
  for (auto& [channel, state] : channels_) {
    if (channel.stream != proto::Stream::pose) continue;
    ++state.seq;
    publish(channel, state, encode_pose(channel, state.seq, t_ns), t_ns);
  }
}

// A camera relative to a sensor that has not been heard is absent.
proto::CameraData Publisher::camera_data(Nanoseconds t_ns) const {
  proto::CameraData data;
  data.t_ns = t_ns;
  for (const auto& [id, camera] : scene_.cameras()) {
    const GoalBase& base = camera.camera.relative_to;
    Transform world_from_base;
    if (base.kind == GoalBase::Kind::segment) {
      const Transform* segment = solving_.world_from_segment(base.figure, camera.base_segment);
      if (!segment) continue;
      world_from_base = *segment;
    } else if (base.kind != GoalBase::Kind::world) {
      if (!camera.world_from_base) continue;
      world_from_base = *camera.world_from_base;
    }
    data.cameras.push_back(
        {id, camera.live ? *camera.live : world_from_base * camera.camera.base_from_camera, camera.camera.fov_y});
    Quat& rotation = data.cameras.back().world_from_camera.rotation;
    for (const proto::CameraFrame& sent : cameras_) {
      if (sent.camera == id) rotation = same_sign(sent.world_from_camera.rotation, rotation);
    }
  }
  return data;
}

void Publisher::publish_cameras(Nanoseconds t_ns) {
  if (!followed(proto::Stream::camera)) return;
  proto::CameraData data = camera_data(t_ns);
  if (data.cameras == cameras_) return;
  cameras_ = data.cameras;
  for (auto& [channel, state] : channels_) {
    if (channel.stream != proto::Stream::camera) continue;
    ++state.seq;
    publish(channel, state, share(proto::encode_camera_frame(state.seq, data), channel.stream, channel.encoding), t_ns);
  }
}

void Publisher::publish_frame(const Frame& frame) {
  for (auto& [channel, state] : channels_) {
    if (channel.stream != proto::Stream::tracker) continue;
    ++state.seq;
    state.last =
        share(proto::encode_tracker_frame(state.seq, tracker_message(frame)), channel.stream, channel.encoding);
    publish(channel, state, state.last, frame.t_ns);
  }
}

void Publisher::publish_stats(const proto::StatsData& stats) {
  for (auto& [channel, state] : channels_) {
    if (channel.stream != proto::Stream::stats) continue;
    ++state.seq;
    state.last = share(proto::encode_stats_frame(state.seq, stats), channel.stream, channel.encoding);
    publish(channel, state, state.last);
  }
}

bool Publisher::followed(proto::Stream stream) const {
  return std::any_of(channels_.begin(), channels_.end(),
                     [stream](const auto& entry) { return entry.first.stream == stream; });
}

std::string Publisher::scene_text() const {
  SceneDocument document = scene_.document();
  for (auto& [id, figure] : document.figures) figure.q.clear();  // the pose stream carries it
  return proto::encode_scene(document);
}

void Publisher::publish_scene(const std::string& by) {
  if (!followed(proto::Stream::scene)) return;
  std::string text = scene_text();
  journal_.when_stored([this, from = scene_revision_, revision = scene_.revision(), by,
                        patch = proto::diff(scene_text_, text)](const Status& stored) {
    if (stored) send_patch(from, revision, by, patch);
  });
  scene_text_ = std::move(text);
  scene_revision_ = scene_.revision();
}

void Publisher::send_patch(Revision from, Revision revision, const std::string& by, const std::string& patch) {
  for (auto& [channel, state] : channels_) {
    if (channel.stream != proto::Stream::scene) continue;
    ++state.seq;
    publish(channel, state,
            share(proto::encode_scene_patch(state.seq, from, revision, by, patch), channel.stream, channel.encoding));
  }
  sent_revision_ = revision;
}

void Publisher::scene_failed() {
  scene_text_ = scene_text();
  scene_revision_ = scene_.revision();
  // Followers have seen nothing of it; their revision goes on all the same.
  send_patch(sent_revision_, scene_revision_, "posed", "[]");
}

}  // namespace posed
