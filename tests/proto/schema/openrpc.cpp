// Prints proto/schema/openrpc.json: every method and notice of the protocol in OpenRPC, made of the same description by
// which the codec reads and writes (proto/describe.h), so that it says what the daemon does.
#include <iostream>

#include "proto/codec.h"
#include "proto/describe_results.h"
#include "proto/methods.h"
#include "tests/proto/schema/fields.h"

namespace posed::proto {
namespace {

template <class Message>
const Method& method_for() {
  return method_of(Params(Message{}));
}

// What every method and every edit accepts (methods.cpp: read_request).
void add_common(const Method& method, Json& params) {
  const auto add = [&params](const char* name, const char* description, Json schema) {
    params.push_back(
        {{"name", name}, {"description", description}, {"required", false}, {"schema", std::move(schema)}});
  };
  if (method.edits == Edits::entity)
    add("if_revision", "The entity's own revision that the edit is based on; 0: it must not exist yet.",
        {{"type", {"integer", "null"}}, {"minimum", 0}});
  if (method.edits == Edits::entity || method.edits == Edits::whole)
    add("gesture", "Edits of one editor with the same text are one step to undo.", {{"type", "string"}});
  if (method.edits != Edits::nothing) {
    add("once", "A UUID, a new one for each edit: sent again, the edit is not done again.",
        {{"type", "string"}, {"pattern", "^[0-9A-Fa-f]{8}-([0-9A-Fa-f]{4}-){3}[0-9A-Fa-f]{12}$"}});
    add("force", "Whoever holds the goal is no hindrance.", {{"type", "boolean"}});
  }
  add("scene", "Reserved.", {{"const", "main"}});
}

template <class Message, class Reply>
Json row(const char* summary) {
  const Method& method = method_for<Message>();
  const Json fields = object_schema<Message>(Direction::to_daemon);
  Json params = Json::array();
  for (const auto& [name, schema] : fields.at("properties").items()) {
    bool required = false;
    for (const Json& field : fields.value("required", Json::array())) required = required || field == name;
    params.push_back({{"name", name}, {"required", required}, {"schema", schema}});
  }
  add_common(method, params);
  return {{"name", method.name},
          {"summary", summary},
          {"paramStructure", "by-name"},
          {"params", std::move(params)},
          {"result", {{"name", "result"}, {"schema", object_schema<Reply>(Direction::from_daemon)}}},
          {"errors", {{{"$ref", "#/components/errors/error"}}}},
          {"x-role", name_of(role_for(Params(Message{})))}};
}

Json methods() {
  Json all = {
      row<SessionHello, HelloResult>("Says who one is, and shows a token where the daemon asks for one."),
      row<SessionPing, PingResult>("The daemon's clock, when it heard and when it answered."),
      row<SessionStatus, StatusResult>("What the daemon is doing."),
      row<SessionList, SessionListResult>("Who is connected."),
      row<FigureSet, EditResult>("Creates or changes a figure."),
      row<FigureGet, FigureResult>("A figure with its document and the order of its joint values."),
      row<FigureList, FigureListResult>("All figures."),
      row<FigureRemove, EditResult>("Removes a figure, and the goals of it or relative to it."),
      row<FigurePin, EditResult>("Holds a segment where it is, before all goals, or lets it go."),
      row<GoalSet, EditResult>("Creates or changes a goal."),
      row<GoalGet, GoalResult>("A goal."),
      row<GoalList, GoalListResult>("All goals."),
      row<GoalRemove, EditResult>("Removes a goal, and what is bound to it."),
      row<GoalClear, ClearResult>("Removes all goals of a figure, or of all."),
      row<GoalGrab, GrabResult>("Holds a goal: others' edits of it wait."),
      row<GoalRelease, EmptyResult>("Lets a goal go that one holds."),
      row<ObjectSet, EditResult>("Creates or changes an object."),
      row<ObjectGet, ObjectResult>("An object."),
      row<ObjectList, ObjectListResult>("All objects."),
      row<ObjectRemove, EditResult>("Removes an object to which no goal is relative, and what is bound to it."),
      row<BindingSet, EditResult>("Creates or changes a binding: a sensor that moves something."),
      row<BindingGet, BindingResult>("A binding."),
      row<BindingList, BindingListResult>("All bindings."),
      row<BindingRemove, EditResult>("Removes a binding; what it moved stays where it is."),
      row<CameraSet, EditResult>("Creates or changes a camera."),
      row<CameraGet, CameraResult>("A camera."),
      row<CameraList, CameraListResult>("All cameras."),
      row<CameraRemove, EditResult>("Removes a camera, and what is bound to it."),
      row<JointSet, EditResult>("Sets one joint, holds it or lets it go."),
      row<JointGet, JointResult>("One joint's value."),
      row<PoseGet, PoseResult>("The pose as it is solved, after an edit if one likes."),
      row<PoseSet, EditResult>("Sets all joint values of a figure."),
      row<PoseReset, EditResult>("Brings a figure back to its rest or its start."),
      row<PoseMirror, EditResult>("Swaps left and right."),
      row<SolverGet, SolverResult>("The scene's solver."),
      row<SolverSet, SolverResult>("Chooses the scene's solver and its limits."),
      row<Solve, SolveResult>("Solves one problem; the scene stays as it is."),
      row<SolveBatch, SolveBatchResult>("Solves many problems on all cores; the scene stays as it is."),
      row<SceneGet, SceneResult>("The scene's document."),
      row<SceneNew, RevisionResult>("Begins with a template."),
      row<SceneList, SceneListResult>("Saved scenes and templates."),
      row<SceneSave, RevisionResult>("Saves the scene under a name."),
      row<SceneOpen, RevisionResult>("Goes on with a saved scene."),
      row<SceneRemove, EmptyResult>("Removes a saved scene."),
      row<TrackerList, TrackerListResult>("All trackers and what they are doing."),
      row<TrackerGrab, TrackerGrabResult>("Keeps others from configuring and calibrating a tracker."),
      row<TrackerRelease, EmptyResult>("Lets a tracker go that one has grabbed."),
      row<TrackerConfigure, EmptyResult>("Settings of a device, and which calibration counts."),
      row<TrackerReset, EmptyResult>("A device's settings as they began, and no calibration."),
      row<TrackerTouch, TouchResult>("Where a sensor's tip is, measured for a while."),
      row<TrackerAlign, CalibrationResult>("Where the tracker's source is, by points that were touched."),
      row<TrackerTip, CalibrationResult>("Where a stylus' tip is in its sensor's frame."),
      row<TrackerBoresight, CalibrationResult>("How a sensor's present turn is to be read."),
      row<TrackerForget, EmptyResult>("Keeps a calibration no longer."),
      row<StreamSubscribe, SubscribeResult>("Asks for a stream; it comes as notices stream.frame."),
      row<StreamUnsubscribe, SubscribeResult>("Ends a stream."),
      row<StreamAck, EmptyResult>("Says which frame one has seen, where there is credit."),
      row<EditApply, ApplyResult>("Several edits, all or none."),
      row<EditUndo, StepResult>("Takes back one's own last edit, or the step that is named."),
      row<EditRedo, StepResult>("Does again what one has undone last."),
      row<EditHistory, HistoryResult>("Who has done what, the newest first."),
  };
  return all;
}

Json object_of(Json properties) {
  Json required = Json::array();
  for (const auto& [name, schema] : properties.items()) required.push_back(name);
  return {{"type", "object"}, {"required", std::move(required)}, {"properties", std::move(properties)}};
}

Json notice(const char* name, const char* summary, Json params) {
  return {{"name", name}, {"summary", summary}, {"params", std::move(params)}};
}

Json frame(const char* stream, Json data) {
  return object_of({{"stream", {{"const", stream}}}, {"seq", whole()}, {"data", std::move(data)}});
}

// What comes unasked to who has subscribed, or has asked for progress.
Json notices() {
  const Json patch = {{"type", "array"}, {"items", {{"type", "object"}, {"required", {"op", "path"}}}}};
  return {
      notice("stream.frame", "The present state of a stream.",
             {{"oneOf",
               {frame("pose", object_schema<PoseData>(Direction::from_daemon)),
                frame("tracker", object_schema<TrackerData>(Direction::from_daemon)),
                frame("scene", object_of({{"revision", whole()}, {"document", {{"$ref", "scene.schema.json"}}}})),
                frame("scene", object_of({{"from_revision", whole()},
                                          {"revision", whole()},
                                          {"by", {{"type", "string"}}},
                                          {"patch", patch}})),
                frame("camera", object_schema<CameraData>(Direction::from_daemon)),
                frame("stats", object_schema<StatsData>(Direction::from_daemon))}}}),
      notice("stream.lost", "How many frames were left out for a peer that reads too slowly.",
             object_of({{"stream", schema_of<Stream>(Direction::from_daemon)}, {"dropped", whole()}})),
      notice("solve.progress", "How far a solve.batch has come, by the id of its request.",
             object_of({{"id", Json::object()}, {"done", whole()}, {"of", whole()}})),
  };
}

Json document() {
  const Json numbers = {{"type", "number"}};
  const auto row_of = [&](const char* description, int size) -> Json {
    return {
        {"description", description}, {"type", "array"}, {"items", numbers}, {"minItems", size}, {"maxItems", size}};
  };
  const Json error = object_schema<Error>(Direction::from_daemon);
  return {
      {"openrpc", "1.2.6"},
      {"info",
       {{"title", "posed"},
        {"version", std::to_string(kProtocol)},
        {"description",
         "The protocol of proto/PROTOCOL.md: JSON-RPC 2.0, one object a line over TCP, or a text frame over a "
         "WebSocket at "
         "/ws. SI units; right-handed, Z up, X forward, Y left. Within a version fields, kinds and enumerators are "
         "only "
         "ever added: clients ignore what they do not know; the daemon refuses fields that it does not know. It checks "
         "besides what no schema can: that names are of something, and numbers within their bounds."}}},
      {"servers", {{{"name", "local"}, {"url", "tcp://127.0.0.1:" + std::to_string(kDefaultPort)}}}},
      {"methods", methods()},
      {"x-notices", notices()},
      {"components",
       {{"schemas",
         {{"vector", row_of("[x, y, z]", 3)},
          {"quaternion", row_of("[x, y, z, w], of unit length", 4)},
          {"transform", row_of("[x, y, z, qx, qy, qz, qw]: metres and a unit quaternion", 7)}}},
        {"errors",
         {{"error",
           {{"code", -32000},
            {"message", "A sentence; -32700 to -32600 as in JSON-RPC 2.0, -32000 for all of posed's own."},
            {"data",
             {{"type", "object"},
              {"required", {"code"}},
              {"properties",
               {{"code", error.at("properties").at("code")},
                {"path", error.at("properties").at("path")},
                {"hint", error.at("properties").at("hint")}}}}}}}}}}},
  };
}

}  // namespace
}  // namespace posed::proto

int main() {
  std::cout << posed::proto::document().dump(1) << '\n';
}
