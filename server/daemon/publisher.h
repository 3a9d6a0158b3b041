// Who follows which stream, and the lines that they get: encoded once for each set of fields. Station loop only.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "common/frame.h"
#include "proto/codec.h"
#include "server/daemon/journal.h"
#include "server/daemon/solving.h"
#include "server/net/server.h"

namespace posed {

class Publisher {
 public:
  Publisher(net::Server& server, const Scene& scene, const Solving& solving, Journal& journal)
      : server_(server), scene_(scene), solving_(solving), journal_(journal) {}

  // Of a figure's pose; none means all. Errors: "invalid_params" for a field that is none, path "/fields/0".
  static Status check_fields(const std::vector<std::string>& fields);
  static proto::PoseFields fields_of(const std::vector<std::string>& fields);
  // Errors: "unknown_figure", "invalid_params" for a field that is none.
  Status check(const proto::StreamSubscribe& wish) const;
  // Replaces the connection's subscription of this stream. The present state goes out at once. `wish` is checked.
  void subscribe(net::ConnectionId connection, const proto::StreamSubscribe& wish);
  void unsubscribe(net::ConnectionId connection, proto::Stream stream);
  void forget(net::ConnectionId connection);
  bool follows(net::ConnectionId connection, proto::Stream stream) const;

  void publish_pose(Nanoseconds t_ns);
  void publish_cameras(Nanoseconds t_ns);  // where they stand has changed, or may have
  void publish_frame(const Frame& frame);
  void publish_scene(const std::string& by);  // after each edit; sent when the disk has it
  void scene_failed();                        // edits that the disk did not take are undone
  void publish_stats(const proto::StatsData& stats);

 private:
  // What distinguishes lines of one stream.
  struct Channel {
    proto::Stream stream;
    std::vector<std::string> figures;
    proto::PoseFields fields;
    proto::Encoding encoding = proto::Encoding::json;
    bool operator<(const Channel& o) const;
  };
  struct State {
    std::uint32_t key = 0;
    std::uint64_t seq = 0;
    int subscribers = 0;
    net::SharedLine last;  // tracker and stats: the present state
  };
  using Channels = std::map<Channel, State>;

  static Channel channel_of(const proto::StreamSubscribe& wish);
  void publish(const Channel& channel, State& state, net::SharedLine line, Nanoseconds t_ns = 0);
  net::SharedLine encode_pose(const Channel& channel, std::uint64_t seq, Nanoseconds t_ns) const;
  bool followed(proto::Stream stream) const;
  proto::CameraData camera_data(Nanoseconds t_ns) const;
  std::string scene_text() const;
  void send_patch(Revision from, Revision revision, const std::string& by, const std::string& patch);
  void subscribe_to_scene(net::ConnectionId connection, const proto::StreamSubscribe& wish);
  void drop(Channels::iterator channel);

  net::Server& server_;
  const Scene& scene_;
  const Solving& solving_;
  Journal& journal_;
  Channels channels_;
  std::uint32_t next_key_ = 1;
  std::map<net::ConnectionId, std::array<std::optional<Channel>, proto::kStreams>> followers_;
  Nanoseconds pose_t_ns_ = 0;
  std::vector<proto::CameraFrame> cameras_;  // as last sent
  // Of the scene stream: what its followers have, or will when the disk has what waits for it.
  std::string scene_text_;
  Revision scene_revision_ = 0;
  Revision sent_revision_ = 0;
};

}  // namespace posed
