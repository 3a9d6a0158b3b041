#include "proto/methods.h"

#include <algorithm>
#include <array>

#include "common/names.h"
#include "proto/describe.h"

namespace posed::proto {
namespace {

template <class T>
Params read_params(ReadContext& context, const Json& params) {
  T message;
  read(context, params, message);
  return message;
}

template <class T, std::size_t I = 0>
constexpr std::size_t index_of() {
  if constexpr (std::is_same_v<T, std::variant_alternative_t<I, Params>>)
    return I;
  else
    return index_of<T, I + 1>();
}

template <class T>
constexpr Method method(const char* name, bool edits = false) {
  return {name, edits, &read_params<T>, index_of<T>()};
}

constexpr bool kEdits = true;
constexpr std::array kMethods{
    method<SessionHello>("session.hello"),
    method<SessionPing>("session.ping"),
    method<SessionStatus>("session.status"),
    method<SessionList>("session.list"),
    method<FigureSet>("figure.set", kEdits),
    method<FigureGet>("figure.get"),
    method<FigureList>("figure.list"),
    method<FigureRemove>("figure.remove", kEdits),
    method<FigurePin>("figure.pin", kEdits),
    method<GoalSet>("goal.set", kEdits),
    method<GoalGet>("goal.get"),
    method<GoalList>("goal.list"),
    method<GoalRemove>("goal.remove", kEdits),
    method<GoalClear>("goal.clear"),
    method<ObjectSet>("object.set", kEdits),
    method<ObjectGet>("object.get"),
    method<ObjectList>("object.list"),
    method<ObjectRemove>("object.remove", kEdits),
    method<BindingSet>("binding.set", kEdits),
    method<BindingGet>("binding.get"),
    method<BindingList>("binding.list"),
    method<BindingRemove>("binding.remove", kEdits),
    method<JointSet>("joint.set", kEdits),
    method<JointGet>("joint.get"),
    method<PoseGet>("pose.get"),
    method<PoseSet>("pose.set", kEdits),
    method<PoseReset>("pose.reset", kEdits),
    method<PoseMirror>("pose.mirror", kEdits),
    method<SolverGet>("solver.get"),
    method<SolverSet>("solver.set"),
    method<Solve>("solve"),
    method<SolveBatch>("solve.batch"),
    method<SceneGet>("scene.get"),
    method<SceneNew>("scene.new"),
    method<SceneList>("scene.list"),
    method<SceneSave>("scene.save"),
    method<SceneOpen>("scene.open"),
    method<TrackerList>("tracker.list"),
    method<StreamSubscribe>("stream.subscribe"),
    method<StreamUnsubscribe>("stream.unsubscribe"),
    method<StreamAck>("stream.ack"),
};
static_assert(kMethods.size() == std::variant_size_v<Params>);

constexpr const char* kReserved[] = {
    "scene.remove",    "camera.set",        "camera.get",    "camera.list",   "camera.remove", "goal.grab",
    "goal.release",    "edit.apply",        "edit.undo",     "edit.redo",     "edit.history",  "tracker.grab",
    "tracker.release", "tracker.configure", "tracker.align", "tracker.reset",
};

}  // namespace

const Method* find_method(std::string_view name) {
  const auto found = std::find_if(kMethods.begin(), kMethods.end(), [&](const Method& m) { return name == m.name; });
  return found == kMethods.end() ? nullptr : &*found;
}

const Method& method_of(const Params& params) {
  return *std::find_if(kMethods.begin(), kMethods.end(), [&](const Method& m) { return m.index == params.index(); });
}

std::string nearest_method(std::string_view name) {
  std::vector<std::string> names;
  names.reserve(kMethods.size());
  for (const Method& m : kMethods) names.emplace_back(m.name);
  return did_you_mean(name, names);
}

bool reserved_method(std::string_view name) {
  return std::find(std::begin(kReserved), std::end(kReserved), name) != std::end(kReserved) ||
         name.starts_with("key.") || name.starts_with("play.") || name.starts_with("take.");
}

}  // namespace posed::proto
