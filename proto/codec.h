// Between text and messages. The only place that knows JSON; no exception leaves it.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "proto/messages.h"

namespace posed::proto {

// ---- the daemon's side ----

// Never fails: what cannot be read becomes a BadRequest that says what to answer.
Line decode_line(std::string_view text);

// Replies, without the trailing newline. `id` is JSON text, as in Request.
template <class ResultMessage>
std::string encode_reply(const std::string& id, const ResultMessage& result);
// The result alone, as in encode_reply_text.
template <class ResultMessage>
std::string encode_result(const ResultMessage& result);
std::string encode_error(const std::string& id, const Error& error);
// The same in parts, for an answer that is made on several threads: the text of each result, of them all, and the
// reply.
std::string encode_solved(const Solved& solved);
std::string join_solved(const std::vector<std::string>& texts);
std::string encode_reply_text(const std::string& id, std::string_view result);
// The line that answers a batch; empty if there is nothing to answer.
std::string join_batch(const std::vector<std::string>& replies);

// Stream frames, without the trailing newline. Positions carry 6 decimals, quaternions 7; every other number its
// shortest form.
std::string encode_pose_frame(std::uint64_t seq, const PoseData& data, const PoseFields& fields);
std::string encode_tracker_frame(std::uint64_t seq, const TrackerData& data);
std::string encode_camera_frame(std::uint64_t seq, const CameraData& data);
std::string encode_stats_frame(std::uint64_t seq, const StatsData& data);
std::string encode_scene_snapshot(std::uint64_t seq, std::uint64_t revision, std::string_view document);
std::string encode_scene_patch(std::uint64_t seq, std::uint64_t from_revision, std::uint64_t revision,
                               std::string_view by, std::string_view patch);
std::string encode_lost(Stream stream, std::uint64_t dropped);
std::string encode_progress(const std::string& id, std::size_t done, std::size_t of);  // solve.progress

// The same frame for who asked for CBOR. Numbers that are not whole are float32 (of the scene: double where they need
// it).
std::string encode_cbor(std::string_view frame, Stream stream);

// ---- documents ----

std::string encode_scene(const SceneDocument& scene, int indent = -1);
Result<SceneDocument> decode_scene(std::string_view text);
std::string encode_figure(const FigureDocument& figure, int indent = -1);
// Entities as a scene's document has them; of a figure without its q.
std::string encode_entity(const FigureEntry& figure);
std::string encode_entity(const Goal& goal);
std::string encode_entity(const Object& object);
std::string encode_entity(const Binding& binding);
std::string encode_entity(const Camera& camera);
// A calibration as the store keeps it.
std::string encode_calibration(const Calibration& calibration);
Result<Calibration> decode_calibration(std::string_view text);
std::string encode_q(const std::vector<double>& q);
Result<FigureDocument> decode_figure(std::string_view text);
// The RFC 6902 patch that leads from one JSON text to another.
std::string diff(std::string_view before, std::string_view after);

// ---- the client's side ----

std::string encode_request(std::int64_t id, const Params& params);
// A call of any method by name. `params` is JSON text; an Error if it is not an object.
Result<std::string> encode_call(std::int64_t id, std::string_view method, std::string_view params);
std::string encode_notification(const Params& params);

// One line from the daemon.
struct Incoming {
  std::optional<std::int64_t> id;  // a reply to this request
  std::string result;              // JSON text of the result, if it is one
  std::optional<Error> error;
  std::string method;  // a notification: "stream.frame", "stream.lost"
  std::optional<Stream> stream;
  std::uint64_t seq = 0;
  std::string data;  // JSON text: of a frame's data
  std::uint64_t dropped = 0;
  std::uint64_t done = 0, of = 0;  // solve.progress
};
Result<Incoming> decode_incoming(std::string_view text);

// Of JSON text as in Incoming::result or Incoming::data. Unknown fields are ignored.
template <class Message>
Result<Message> decode_message(std::string_view text);

// JSON text set out for reading.
std::string pretty(std::string_view text);

std::string_view method_name(const Params& params);
// Who may call it. What only looks is for viewers; what belongs to the station is for its operators; the rest is
// editing.
Role role_for(const Params& params);
std::optional<Role> find_role(std::string_view name);

std::string_view stream_name(Stream stream);
std::string_view name_of(GoalState state);
std::string_view name_of(SolveStatus status);
std::string_view name_of(Role role);

}  // namespace posed::proto
