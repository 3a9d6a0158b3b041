#include "server/net/requests.h"

#include <algorithm>

#include "proto/codec.h"

namespace posed::net {

void take_acks(proto::Line& line, Outbox& outbox, Nanoseconds now) {
  auto& entries = line.entries;
  auto kept = entries.begin();
  for (auto& entry : entries) {
    const auto* request = std::get_if<proto::Request>(&entry);
    const auto* ack = request ? std::get_if<proto::StreamAck>(&request->params) : nullptr;
    if (ack) {
      const bool known = outbox.ack(ack->stream, ack->seq, now);
      if (request->id.empty()) continue;
      if (!known) {
        const std::string name(proto::stream_name(ack->stream));
        entry = proto::BadRequest{request->id,
                                  {"unknown_stream", "this connection is not subscribed to " + name, "/params/stream",
                                   "call stream.subscribe first"}};
      }
    }
    if (&*kept != &entry) *kept = std::move(entry);
    ++kept;
  }
  entries.erase(kept, entries.end());
}

}  // namespace posed::net
