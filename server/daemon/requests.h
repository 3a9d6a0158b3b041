// Answers the requests of one line: one function a method, in requests_*.cpp by family. A handler checks, changes the
// scene through its edits, tells the pipeline, and answers through the Responder.
#pragma once

#include "proto/messages.h"
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

  void on(const proto::FigureSet&, Responder);
  void on(const proto::FigureGet&, Responder);
  void on(const proto::FigureList&, Responder);
  void on(const proto::FigureRemove&, Responder);
  void on(const proto::FigurePin&, Responder);
  void on(const proto::GoalSet&, Responder);
  void on(const proto::GoalGet&, Responder);
  void on(const proto::GoalList&, Responder);
  void on(const proto::GoalRemove&, Responder);
  void on(const proto::GoalClear&, Responder);
  void on(const proto::ObjectSet&, Responder);
  void on(const proto::ObjectGet&, Responder);
  void on(const proto::ObjectList&, Responder);
  void on(const proto::ObjectRemove&, Responder);
  void on(const proto::BindingSet&, Responder);
  void on(const proto::BindingGet&, Responder);
  void on(const proto::BindingList&, Responder);
  void on(const proto::BindingRemove&, Responder);

  void on(const proto::JointSet&, Responder);
  void on(const proto::JointGet&, Responder);
  void on(const proto::PoseGet&, Responder);
  void on(const proto::PoseSet&, Responder);
  void on(const proto::PoseReset&, Responder);
  void on(const proto::PoseMirror&, Responder);
  void on(const proto::SolverGet&, Responder);
  void on(const proto::SolverSet&, Responder);

  void on(proto::Solve&, Responder);
  void on(proto::SolveBatch&, Responder);

  void on(const proto::SceneGet&, Responder);
  void on(const proto::SceneNew&, Responder);
  void on(const proto::SceneList&, Responder);
  void on(const proto::SceneSave&, Responder);
  void on(const proto::SceneOpen&, Responder);

  void on(const proto::StreamSubscribe&, Responder);
  void on(const proto::StreamUnsubscribe&, Responder);
  void on(const proto::StreamAck&, Responder);

  void answer(const Result<Edited>& edited, Responder& responder);
  void start_solving(proto::SolveBatch batch, bool alone, Responder responder);
  void answer_loaded(const Status& loaded, Responder& responder);

  Pipeline& p_;
  net::ConnectionId connection_;
  Nanoseconds receive_t_ns_;
  std::optional<Revision> if_revision_;  // of the request at hand
};

const char* tracker_state_name(tracker::State state);

}  // namespace posed
