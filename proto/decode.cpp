// Requests: what peers send to the daemon.
#include "proto/codec.h"
#include "proto/methods.h"
#include "proto/read.h"

namespace posed::proto {
namespace {

using Entry = std::variant<Request, BadRequest>;

BadRequest bad(std::string id, Error error) {
  return {std::move(id), std::move(error)};
}

// Ids are echoed, so they are held short.
bool id_allowed(const Json& id) {
  return id.is_null() || id.is_number() || (id.is_string() && id.get_ref<const std::string&>().size() <= 256);
}

Entry decode_request(Json& json) {
  if (!json.is_object())
    return bad("null", {"invalid_request", "a request is an object", "", R"({"jsonrpc":"2.0","id":1,"method":…})"});
  const auto id = json.find("id");
  if (id != json.end() && !id_allowed(*id))
    return bad("null", {"invalid_request", "the id is not a short string or a number", "/id", "\"id\":1"});
  const std::string id_text = id == json.end() ? "" : id->dump();
  const std::string answer_to = id_text.empty() ? "null" : id_text;
  const auto version = json.find("jsonrpc");
  if (version == json.end() || *version != "2.0") {
    return bad(answer_to, {"invalid_request", "the request does not say that it is JSON-RPC 2.0", "/jsonrpc",
                           R"("jsonrpc":"2.0")"});
  }
  const auto method_name = json.find("method");
  if (method_name == json.end() || !method_name->is_string()) {
    return bad(answer_to,
               {"invalid_request", "the request names no method", "/method", R"("method":"session.status")"});
  }
  const auto& name = method_name->get_ref<const std::string&>();
  const Method* method = find_method(name);
  if (!method) {
    if (reserved_method(name))
      return bad(answer_to, {"not_available", name + " is reserved: this daemon does not do it yet", "/method", ""});
    return bad(answer_to,
               {"unknown_method", "no method is called " + name.substr(0, 64), "/method", nearest_method(name)});
  }
  for (const auto& [key, value] : json.items()) {
    if (key != "jsonrpc" && key != "id" && key != "method" && key != "params") {
      ReadContext context;
      const At at(context, key.substr(0, 64));
      context.fail("unknown_field", "there is no field \"" + key.substr(0, 64) + "\" in a request",
                   "put it into params");
      return bad(answer_to, *context.error);
    }
  }

  Json params = Json::object();
  if (const auto found = json.find("params"); found != json.end()) params = std::move(*found);
  ReadContext context;
  context.path = "/params";
  Request request;
  request.id = id_text;
  read_request(context, std::move(params), *method, request);
  if (context.error) return bad(answer_to, *context.error);
  return request;
}

}  // namespace

Line decode_line(std::string_view text) {
  Line line;
  Result<Json> json = parse(text);
  if (!json) {
    line.entries.push_back(bad("null", json.error()));
  } else if (json->is_array()) {
    if (json->empty()) line.entries.push_back(bad("null", {"invalid_request", "the batch is empty", "", ""}));
    if (json->size() > kMaxBatch) {
      line.entries.push_back(bad(
          "null",
          {"too_large", "a batch holds at most " + std::to_string(kMaxBatch) + " requests", "", "send it in parts"}));
      return line;
    }
    line.batch = !json->empty();
    for (Json& item : *json) line.entries.push_back(decode_request(item));
  } else {
    line.entries.push_back(decode_request(*json));
  }
  return line;
}

}  // namespace posed::proto
