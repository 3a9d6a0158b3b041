// What a peer may send in a line, and what a daemon may send to a client. Whatever comes, every line is answered, and
// what was understood means the same when it is said again.
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "proto/codec.h"
#include "tests/fuzz/require.h"

namespace {

using namespace posed;
using namespace posed::proto;
using posed::fuzz::require;

void check_entry(const std::variant<Request, BadRequest>& entry, std::string_view text) {
  if (const auto* bad = std::get_if<BadRequest>(&entry)) {
    require(!bad->id.empty() && !bad->error.code.empty() && !bad->error.message.empty(), "no reason", text);
    const std::string reply = encode_error(bad->id, bad->error);
    const Result<Incoming> in = decode_incoming(reply);
    require(in && in->error && in->error->code == bad->error.code, "the error is not understood", reply);
    return;
  }
  const auto& request = std::get<Request>(entry);
  const std::string said = encode_request(1, request.params);
  const Line again = decode_line(said);
  require(again.entries.size() == 1 && std::holds_alternative<Request>(again.entries[0]), "not understood again", said);
  require(encode_request(1, std::get<Request>(again.entries[0]).params) == said, "not the same again", said);
}

void check_client(std::string_view text) {
  const Result<Incoming> in = decode_incoming(text);
  if (!in) return;
  (void)decode_message<PoseData>(in->data);
  (void)decode_message<TrackerData>(in->data);
  (void)decode_message<StatsData>(in->data);
  if (const auto figure = decode_message<FigureResult>(in->result)) {
    require(bool(decode_incoming(encode_reply("1", *figure))), "the reply is not understood", text);
  }
  if (const auto pose = decode_message<PoseResult>(in->result)) {
    require(bool(decode_incoming(encode_reply("1", *pose))), "the reply is not understood", text);
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  for (const auto& entry : decode_line(text).entries) check_entry(entry, text);
  check_client(text);
  return 0;
}
