// Answers the requests of one line: one function a method, in requests_*.cpp by family. What edits do stands in
// apply.cpp; they all go through one door, `edit`, and are answered when the disk has them.
#pragma once

#include "proto/messages.h"
#include "server/daemon/apply.h"
#include "server/daemon/pipeline.h"
#include "server/daemon/responder.h"

namespace posed {

class Requests {
 public:
  Requests(Pipeline& pipeline, net::ConnectionId connection, Nanoseconds receive_t_ns)
      : p_(pipeline), connection_(connection), receive_t_ns_(receive_t_ns) {}

  void handle(proto::Line line);

 private:
  void on(const proto::SessionHello&, Responder);
  void on(const proto::SessionPing&, Responder);
  void on(const proto::SessionStatus&, Responder);
  void on(const proto::SessionList&, Responder);
  void on(const proto::TrackerList&, Responder);
  void on(const proto::TrackerGrab&, Responder);
  void on(const proto::TrackerRelease&, Responder);
  void on(const proto::TrackerConfigure&, Responder);
  void on(const proto::TrackerReset&, Responder);
  void on(const proto::TrackerTouch&, Responder);
  void on(const proto::TrackerAlign&, Responder);
  void on(const proto::TrackerTip&, Responder);
  void on(const proto::TrackerBoresight&, Responder);
  void on(const proto::TrackerForget&, Responder);

  void on(const proto::FigureGet&, Responder);
  void on(const proto::FigureList&, Responder);
  void on(const proto::GoalGet&, Responder);
  void on(const proto::GoalList&, Responder);
  void on(const proto::ObjectGet&, Responder);
  void on(const proto::ObjectList&, Responder);
  void on(const proto::BindingGet&, Responder);
  void on(const proto::BindingList&, Responder);
  void on(const proto::CameraGet&, Responder);
  void on(const proto::CameraList&, Responder);

  void on(const proto::JointGet&, Responder);
  void on(const proto::PoseGet&, Responder);
  void on(const proto::SolverGet&, Responder);
  void on(const proto::SolverSet&, Responder);

  void on(proto::Solve&, Responder);
  void on(proto::SolveBatch&, Responder);

  void on(const proto::SceneGet&, Responder);
  void on(const proto::SceneNew&, Responder);
  void on(const proto::SceneList&, Responder);
  void on(const proto::SceneSave&, Responder);
  void on(const proto::SceneOpen&, Responder);
  void on(const proto::SceneRemove&, Responder);

  void on(const proto::StreamSubscribe&, Responder);
  void on(const proto::StreamUnsubscribe&, Responder);
  void on(const proto::StreamAck&, Responder);

  Status may_touch(const std::string& tracker, bool force, Nanoseconds busy_for = 0);
  Result<SensorName> find_sensor(const std::string& name, bool force, Nanoseconds busy_for);
  Status check_name(const std::string& name) const;
  Status read_settings(const proto::TrackerConfigure& m, tracker::Settings& settings) const;
  void put_calibration(Calibration calibration, Responder responder);
  void keep_calibrations(const std::string& tracker, Calibrations::OfTracker before, Responder responder,
                         const std::string& result);

  Status allowed(const proto::Params& params) const;
  void on(const proto::EditUndo&, Responder);
  void on(const proto::EditRedo&, Responder);
  void on(const proto::EditHistory&, Responder);
  void on(const proto::GoalGrab&, Responder);
  void on(const proto::GoalRelease&, Responder);

  // Edits: `apply` says what each does.
  template <Applied Message>
  void on(const Message& m, Responder responder) {
    if constexpr (std::is_same_v<Message, proto::EditApply>) label_ = m.label;
    edit(std::move(responder), [&](Scene& scene) { return apply(scene, m, if_revision_); });
  }
  template <class Edit>
  void edit(Responder responder, Edit change) {
    if (repeated(responder)) return;
    const auto result = p_.editing.edit(by(), change);
    if (!result) return responder.params_error(result.error());
    done(std::move(responder), proto::encode_result(result_of(*result)));
  }
  static proto::EditResult result_of(const Edited& e) { return {e.id, e.revision, e.entity_revision}; }
  template <class Message>
  static const Message& result_of(const Message& m) {
    return m;
  }
  EditBy by() const;
  bool repeated(Responder& responder);
  // The edit is done: the reply goes out when the disk has it. `back`: to what was before.
  void done(Responder responder, std::string result, bool back = false);
  void start_solving(proto::SolveBatch batch, bool alone, Responder responder);
  void load(std::string_view text, Responder responder);

  Pipeline& p_;
  net::ConnectionId connection_;
  Nanoseconds receive_t_ns_;
  // Of the request at hand.
  std::optional<Revision> if_revision_;
  std::string method_, label_, gesture_, once_;
  bool force_ = false;
};

std::string random_key();  // 128 bits, hexadecimal
const char* tracker_state_name(tracker::State state);

}  // namespace posed
