#include "proto/methods.h"

#include <algorithm>
#include <array>
#include <cctype>

#include "common/names.h"
#include "proto/codec.h"
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
constexpr Method method(const char* name, Edits edits = Edits::nothing) {
  return {name, edits, &read_params<T>, index_of<T>()};
}

constexpr Edits kEdits = Edits::entity;
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
    method<GoalClear>("goal.clear", Edits::whole),
    method<GoalGrab>("goal.grab"),
    method<GoalRelease>("goal.release"),
    method<ObjectSet>("object.set", kEdits),
    method<ObjectGet>("object.get"),
    method<ObjectList>("object.list"),
    method<ObjectRemove>("object.remove", kEdits),
    method<BindingSet>("binding.set", kEdits),
    method<BindingGet>("binding.get"),
    method<BindingList>("binding.list"),
    method<BindingRemove>("binding.remove", kEdits),
    method<CameraSet>("camera.set", kEdits),
    method<CameraGet>("camera.get"),
    method<CameraList>("camera.list"),
    method<CameraRemove>("camera.remove", kEdits),
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
    method<SceneNew>("scene.new", Edits::whole),
    method<SceneList>("scene.list"),
    method<SceneSave>("scene.save"),
    method<SceneOpen>("scene.open", Edits::whole),
    method<SceneRemove>("scene.remove"),
    method<TrackerList>("tracker.list"),
    method<TrackerGrab>("tracker.grab"),
    method<TrackerRelease>("tracker.release"),
    method<TrackerConfigure>("tracker.configure"),
    method<TrackerReset>("tracker.reset"),
    method<TrackerTouch>("tracker.touch"),
    method<TrackerAlign>("tracker.align"),
    method<TrackerTip>("tracker.tip"),
    method<TrackerBoresight>("tracker.boresight"),
    method<TrackerForget>("tracker.forget"),
    method<StreamSubscribe>("stream.subscribe"),
    method<StreamUnsubscribe>("stream.unsubscribe"),
    method<StreamAck>("stream.ack"),
    method<EditApply>("edit.apply", Edits::whole),
    method<EditUndo>("edit.undo", Edits::step),
    method<EditRedo>("edit.redo", Edits::step),
    method<EditHistory>("edit.history"),
};
static_assert(kMethods.size() == std::variant_size_v<Params>);

bool ends_with_any(std::string_view name, std::initializer_list<std::string_view> endings) {
  return std::any_of(endings.begin(), endings.end(), [&](std::string_view ending) { return name.ends_with(ending); });
}

// 8-4-4-4-12 hexadecimal digits.
bool is_uuid(const std::string& text) {
  if (text.size() != 36) return false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const bool dash = i == 8 || i == 13 || i == 18 || i == 23;
    if (dash ? text[i] != '-' : !std::isxdigit(static_cast<unsigned char>(text[i]))) return false;
  }
  return true;
}

}  // namespace

Role role_for(const Params& params) {
  const std::string_view name = method_of(params).name;
  // An ack is booked where it comes in, and says nothing.
  if (name == "session.hello" || name == "session.ping" || name == "stream.ack") return Role::none;
  if (name.starts_with("session.") || name.starts_with("stream.") || ends_with_any(name, {".get", ".list", ".history"}))
    return Role::viewer;
  return name.starts_with("tracker.") ? Role::operator_ : Role::editor;
}

std::optional<Role> find_role(std::string_view name) {
  const auto& names = EnumNames<Role>::names;
  const auto found = std::find(names.begin(), names.end(), name);
  if (found == names.end()) return std::nullopt;
  return static_cast<Role>(found - names.begin());
}

std::string_view name_of(Role role) {
  return word(role);
}

void read_request(ReadContext& context, Json params, const Method& method, Request& out) {
  if (expect_object(context, params)) {
    Reader common(context, params);
    common.reserved("scene", "\"main\"");
    if (method.edits == Edits::entity) common.optional("if_revision", out.if_revision);
    if (method.edits == Edits::entity || method.edits == Edits::whole) common.optional("gesture", out.gesture);
    if (method.edits != Edits::nothing) {
      if (common.optional("once", out.once) && !is_uuid(out.once)) {
        common.fail_at("once", "invalid_params", "once is no UUID",
                       "\"0b6f2f4e-7c1d-4a53-9a56-3f1e2d4c5b6a\", another for each edit");
      }
      common.optional("force", out.force);
    }
    for (const std::string& key : common.known()) params.erase(key);
  }
  if (!context.error) out.params = method.read(context, params);
}

void read(ReadContext& c, const Json& j, Edit& out) {
  if (!expect_object(c, j)) return;
  Reader reader(c, j);
  std::string name;
  reader.required("method", name);
  RawJson params{Json::object()};
  reader.optional("params", params);
  reader.finish();
  if (c.error) return;
  const Method* method = find_method(name);
  if (!method) {
    return reader.fail_at("method", "unknown_method", "no method is called " + name.substr(0, 64),
                          nearest_method(name));
  }
  if (method->edits != Edits::entity && name != "goal.clear") {
    return reader.fail_at("method", "invalid_params", name + " can not be one edit among several",
                          "edits of one entity can, and goal.clear");
  }
  const At at(c, "params");
  if (params.json.is_object()) {
    Reader own(c, params.json);
    for (const char* key : {"gesture", "once", "force"}) {
      if (own.has(key))
        own.fail_at(key, "unknown_field", std::string(key) + " is said of all edits together", "say it beside edits");
    }
  }
  Request request;
  if (!c.error) read_request(c, std::move(params.json), *method, request);
  out = std::move(request);
}

Json write(const Edit& edit) {
  Json params = std::visit([](const auto& message) { return write(message); }, edit.params);
  if (edit.if_revision) params["if_revision"] = *edit.if_revision;
  return Json{{"method", method_of(edit.params).name}, {"params", std::move(params)}};
}

const Method* find_method(std::string_view name) {
  const auto found = std::find_if(kMethods.begin(), kMethods.end(), [&](const Method& m) { return name == m.name; });
  return found == kMethods.end() ? nullptr : &*found;
}

const Method& method_of(const Params& params) {
  return *std::find_if(kMethods.begin(), kMethods.end(), [&](const Method& m) { return m.index == params.index(); });
}

std::string_view method_name(const Params& params) {
  return method_of(params).name;
}

std::string nearest_method(std::string_view name) {
  std::vector<std::string> names;
  names.reserve(kMethods.size());
  for (const Method& m : kMethods) names.emplace_back(m.name);
  return did_you_mean(name, names);
}

bool reserved_method(std::string_view name) {
  return name.starts_with("key.") || name.starts_with("play.") || name.starts_with("take.");
}

}  // namespace posed::proto
