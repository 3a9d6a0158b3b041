// What a peer may send: bytes cut into lines, lines into requests; and what a daemon may send to a client. Whatever
// comes, every line is answered, and what was understood means the same when it is said again.
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <string_view>
#include <vector>

#include "proto/codec.h"
#include "proto/framing.h"

namespace {

using namespace posed;
using namespace posed::proto;

void require(bool holds, const char* what, std::string_view text) {
  if (holds) return;
  std::fprintf(stderr, "%s: %.*s\n", what, static_cast<int>(text.size()), text.data());
  std::abort();
}

struct Cut {
  std::vector<std::string> lines;
  std::string rest;
  bool good = true;
};

// `step` decides the size of each piece; 0: all at once.
Cut cut_up(std::string_view text, std::size_t step, std::size_t limit) {
  LineSplitter splitter(limit);
  Cut cut;
  std::size_t size = step;
  while (!text.empty() && cut.good) {
    size = step == 0 ? text.size() : size * 7 % 13 % step + 1;
    const std::string_view piece = text.substr(0, size);
    text.remove_prefix(piece.size());
    cut.good = splitter.push(piece);
    while (const auto line = splitter.next()) cut.lines.emplace_back(*line);
  }
  if (cut.good) cut.rest = splitter.rest();
  return cut;
}

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

void check_documents(std::string_view text) {
  if (const Result<SceneDocument> scene = decode_scene(text)) {
    const std::string said = encode_scene(*scene);
    const Result<SceneDocument> again = decode_scene(said);
    require(again && encode_scene(*again) == said, "not the same scene again", said);
  }
  if (const Result<FigureDocument> figure = decode_figure(text)) {
    const std::string said = encode_figure(*figure);
    const Result<FigureDocument> again = decode_figure(said);
    require(again && encode_figure(*again) == said, "not the same figure again", said);
  }
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
  const std::size_t limit = 4096;
  const Cut whole = cut_up(text, 0, limit);
  for (const std::size_t step : {1u, 3u, 12u}) {
    const Cut pieces = cut_up(text, step, limit);
    require(pieces.lines == whole.lines && pieces.rest == whole.rest && pieces.good == whole.good, "cut otherwise",
            text);
  }
  for (const auto& entry : decode_line(text).entries) check_entry(entry, text);
  check_documents(text);
  check_client(text);
  return 0;
}
