// Replies and documents: what the daemon sends, streams apart.
#include <unordered_map>

#include "proto/codec.h"
#include "proto/describe_results.h"

namespace posed::proto {
namespace {

// The one translation from errors to JSON-RPC's numbers.
int number_of(const std::string& code) {
  static const std::unordered_map<std::string, int> numbers = {
      {"parse_error", -32700},   {"invalid_request", -32600}, {"unknown_method", -32601}, {"invalid_params", -32602},
      {"unknown_field", -32602}, {"missing_field", -32602},   {"wrong_type", -32602},     {"out_of_range", -32602},
      {"not_finite", -32602},    {"bad_id", -32602},          {"internal", -32603},
  };
  const auto found = numbers.find(code);
  return found == numbers.end() ? -32000 : found->second;
}

// Text that a peer sent may be quoted in messages, cut anywhere: never let it throw.
std::string dump(const Json& json, int indent = -1) {
  return json.dump(indent, ' ', false, Json::error_handler_t::replace);
}

template <class Document>
Result<Document> decode_document(std::string_view text, const char* code) {
  Result<Json> json = parse(text);
  if (!json) return json.error();
  ReadContext context;
  Document document;
  read(context, *json, document);
  if (!context.error) return document;
  if (context.error->code != "not_available") context.error->code = code;
  return *context.error;
}

}  // namespace

template <class ResultMessage>
std::string encode_reply(const std::string& id, const ResultMessage& result) {
  return encode_reply_text(id, encode_result(result));
}

template <class ResultMessage>
std::string encode_result(const ResultMessage& result) {
  return dump(write(result));
}

std::string encode_reply_text(const std::string& id, std::string_view result) {
  std::string text = "{\"jsonrpc\":\"2.0\",\"id\":";
  text.reserve(text.size() + id.size() + result.size() + 16);
  return text.append(id).append(",\"result\":").append(result).append("}");
}

std::string encode_solved(const Solved& solved) {
  return dump(write(solved));
}

std::string join_solved(const std::vector<std::string>& texts) {
  std::size_t size = 16;
  for (const std::string& text : texts) size += text.size() + 1;
  std::string all = "{\"results\":[";
  all.reserve(size);
  for (std::size_t i = 0; i < texts.size(); ++i) all.append(i > 0 ? "," : "").append(texts[i]);
  return all.append("]}");
}

std::string encode_progress(const std::string& id, std::size_t done, std::size_t of) {
  return "{\"jsonrpc\":\"2.0\",\"method\":\"solve.progress\",\"params\":{\"id\":" + id +
         ",\"done\":" + std::to_string(done) + ",\"of\":" + std::to_string(of) + "}}";
}

std::string encode_error(const std::string& id, const Error& error) {
  Json data{{"code", error.code}};
  if (!error.path.empty()) data["path"] = error.path;
  if (!error.hint.empty()) data["hint"] = error.hint;
  const Json body{{"code", number_of(error.code)}, {"message", error.message}, {"data", std::move(data)}};
  return "{\"jsonrpc\":\"2.0\",\"id\":" + (id.empty() ? "null" : id) + ",\"error\":" + dump(body) + "}";
}

std::string join_batch(const std::vector<std::string>& replies) {
  std::string line;
  for (const std::string& reply : replies) {
    if (reply.empty()) continue;
    line += line.empty() ? '[' : ',';
    line += reply;
  }
  if (!line.empty()) line += ']';
  return line;
}

std::string encode_scene(const SceneDocument& scene, int indent) {
  return dump(write(scene), indent);
}
std::string encode_figure(const FigureDocument& figure, int indent) {
  return dump(write(figure), indent);
}

std::string encode_entity(const FigureEntry& figure) {
  Json json = write(figure);
  json.erase("q");
  return dump(json);
}
std::string encode_entity(const Goal& goal) {
  return dump(write(goal));
}
std::string encode_entity(const Object& object) {
  return dump(write(object));
}
std::string encode_entity(const Binding& binding) {
  return dump(write(binding));
}
std::string encode_entity(const Camera& camera) {
  return dump(write(camera));
}
std::string encode_calibration(const Calibration& calibration) {
  return dump(write(calibration));
}
Result<Calibration> decode_calibration(std::string_view text) {
  return decode_document<Calibration>(text, "bad_calibration");
}
std::string encode_q(const std::vector<double>& q) {
  return dump(write(q));
}

Result<SceneDocument> decode_scene(std::string_view text) {
  Result<SceneDocument> scene = decode_document<SceneDocument>(text, "bad_scene");
  if (!scene) return scene;
  for (auto& [id, figure] : scene->figures) figure.id = id;
  for (auto& [id, goal] : scene->goals) goal.id = id;
  for (auto& [id, object] : scene->objects) object.id = id;
  for (auto& [id, binding] : scene->bindings) binding.id = id;
  for (auto& [id, camera] : scene->cameras) camera.id = id;
  return scene;
}

Result<FigureDocument> decode_figure(std::string_view text) {
  return decode_document<FigureDocument>(text, "bad_figure");
}

std::string diff(std::string_view before, std::string_view after) {
  return dump(Json::diff(Json::parse(before, nullptr, false), Json::parse(after, nullptr, false)));
}

std::string pretty(std::string_view text) {
  const Json json = Json::parse(text, nullptr, false);
  return json.is_discarded() ? std::string(text) : dump(json, 2);
}

std::string_view stream_name(Stream stream) {
  return word(stream);
}
std::string_view name_of(GoalState state) {
  return word(state);
}
std::string_view name_of(SolveStatus status) {
  return word(status);
}

#define POSED_RESULT(Type)                                            \
  template std::string encode_reply(const std::string&, const Type&); \
  template std::string encode_result(const Type&);
POSED_RESULT(HelloResult)
POSED_RESULT(PingResult)
POSED_RESULT(StatusResult)
POSED_RESULT(SessionListResult)
POSED_RESULT(EditResult)
POSED_RESULT(ClearResult)
POSED_RESULT(ApplyResult)
POSED_RESULT(StepResult)
POSED_RESULT(HistoryResult)
POSED_RESULT(GrabResult)
POSED_RESULT(RevisionResult)
POSED_RESULT(EmptyResult)
POSED_RESULT(FigureResult)
POSED_RESULT(FigureListResult)
POSED_RESULT(GoalResult)
POSED_RESULT(GoalListResult)
POSED_RESULT(ObjectResult)
POSED_RESULT(ObjectListResult)
POSED_RESULT(BindingResult)
POSED_RESULT(BindingListResult)
POSED_RESULT(CameraResult)
POSED_RESULT(CameraListResult)
POSED_RESULT(JointResult)
POSED_RESULT(PoseResult)
POSED_RESULT(SolverResult)
POSED_RESULT(SolveResult)
POSED_RESULT(SolveBatchResult)
POSED_RESULT(SceneResult)
POSED_RESULT(SceneListResult)
POSED_RESULT(TrackerListResult)
POSED_RESULT(TrackerGrabResult)
POSED_RESULT(TouchResult)
POSED_RESULT(CalibrationResult)
POSED_RESULT(SubscribeResult)
#undef POSED_RESULT

}  // namespace posed::proto
