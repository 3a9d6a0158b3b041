// The client's half: requests out, replies and frames in.
#include "proto/codec.h"
#include "proto/describe_results.h"
#include "proto/methods.h"

namespace posed::proto {
namespace {

std::string request_text(std::string_view id, std::string_view method, std::string_view params) {
  std::string line = "{\"jsonrpc\":\"2.0\"";
  if (!id.empty()) line.append(",\"id\":").append(id);
  line.append(",\"method\":").append(Json(std::string(method)).dump(-1, ' ', false, Json::error_handler_t::replace));
  return line.append(",\"params\":").append(params).append("}");
}

std::string params_text(const Params& params) {
  return std::visit(
      [](const auto& message) { return write(message).dump(-1, ' ', false, Json::error_handler_t::replace); }, params);
}

std::string text_of(const Json& object, const char* key) {
  const auto found = object.find(key);
  return found != object.end() && found->is_string() ? found->get<std::string>() : "";
}

Error read_error(const Json& json) {
  Error error{"", text_of(json, "message"), "", ""};
  if (const auto data = json.find("data"); data != json.end() && data->is_object()) {
    error.code = text_of(*data, "code");
    error.path = text_of(*data, "path");
    error.hint = text_of(*data, "hint");
  }
  return error;
}

Error not_from_a_daemon(const char* what) {
  return {"bad_reply", std::string("the daemon's line is not understood: ") + what, "", ""};
}

}  // namespace

std::string encode_request(std::int64_t id, const Params& params) {
  return request_text(std::to_string(id), method_of(params).name, params_text(params));
}

std::string encode_notification(const Params& params) {
  return request_text("", method_of(params).name, params_text(params));
}

Result<std::string> encode_call(std::int64_t id, std::string_view method, std::string_view params) {
  const Result<Json> json = parse(params);
  if (!json) return Error{"parse_error", "the parameters are not JSON", "", "as in '{\"id\":\"g1\"}'"};
  if (!json->is_object()) return Error{"wrong_type", "the parameters are not an object", "", "as in '{\"id\":\"g1\"}'"};
  return request_text(std::to_string(id), method, json->dump());
}

Result<Incoming> decode_incoming(std::string_view text) {
  const Result<Json> json = parse(text);
  if (!json) return not_from_a_daemon("it is not JSON");
  if (!json->is_object()) return not_from_a_daemon("it is not an object");
  Incoming in;
  in.method = text_of(*json, "method");
  if (const auto id = json->find("id"); id != json->end() && id->is_number_integer()) in.id = id->get<std::int64_t>();
  if (const auto error = json->find("error"); error != json->end() && error->is_object()) in.error = read_error(*error);
  if (const auto result = json->find("result"); result != json->end()) in.result = result->dump();
  const auto params = json->find("params");
  if (params == json->end() || !params->is_object()) return in;
  ReadContext context;
  context.strict = false;
  Reader reader(context, *params);
  reader.optional("stream", in.stream);
  reader.optional("seq", in.seq);
  reader.optional("dropped", in.dropped);
  reader.optional("done", in.done);
  reader.optional("of", in.of);
  if (context.error) return not_from_a_daemon(context.error->message.c_str());
  if (const auto data = params->find("data"); data != params->end()) in.data = data->dump();
  return in;
}

template <class Message>
Result<Message> decode_message(std::string_view text) {
  const Result<Json> json = parse(text);
  if (!json) return json.error();
  ReadContext context;
  context.strict = false;
  Message message;
  read(context, *json, message);
  if (context.error) return *context.error;
  return message;
}

#define POSED_MESSAGE(Type) template Result<Type> decode_message(std::string_view);
POSED_MESSAGE(HelloResult)
POSED_MESSAGE(PingResult)
POSED_MESSAGE(StatusResult)
POSED_MESSAGE(SessionListResult)
POSED_MESSAGE(EditResult)
POSED_MESSAGE(ClearResult)
POSED_MESSAGE(ApplyResult)
POSED_MESSAGE(StepResult)
POSED_MESSAGE(HistoryResult)
POSED_MESSAGE(GrabResult)
POSED_MESSAGE(RevisionResult)
POSED_MESSAGE(FigureResult)
POSED_MESSAGE(FigureListResult)
POSED_MESSAGE(GoalResult)
POSED_MESSAGE(GoalListResult)
POSED_MESSAGE(ObjectResult)
POSED_MESSAGE(ObjectListResult)
POSED_MESSAGE(BindingResult)
POSED_MESSAGE(BindingListResult)
POSED_MESSAGE(CameraResult)
POSED_MESSAGE(CameraListResult)
POSED_MESSAGE(JointResult)
POSED_MESSAGE(PoseResult)
POSED_MESSAGE(SolverResult)
POSED_MESSAGE(SolveResult)
POSED_MESSAGE(SolveBatchResult)
POSED_MESSAGE(SceneResult)
POSED_MESSAGE(SceneListResult)
POSED_MESSAGE(TrackerListResult)
POSED_MESSAGE(TrackerGrabResult)
POSED_MESSAGE(TouchResult)
POSED_MESSAGE(CalibrationResult)
POSED_MESSAGE(SubscribeResult)
POSED_MESSAGE(PoseData)
POSED_MESSAGE(CameraData)
POSED_MESSAGE(TrackerData)
POSED_MESSAGE(StatsData)
#undef POSED_MESSAGE

}  // namespace posed::proto
