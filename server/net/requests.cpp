#include "server/net/requests.h"

#include <variant>

namespace posed::net {

void take_acks(proto::Line& line, Outbox& outbox, Nanoseconds now) {
  auto& entries = line.entries;
  auto kept = entries.begin();
  for (auto& entry : entries) {
    const auto* request = std::get_if<proto::Request>(&entry);
    const auto* ack = request ? std::get_if<proto::StreamAck>(&request->params) : nullptr;
    if (ack) {
      outbox.ack(ack->stream, ack->seq, now);
      if (request->id.empty()) continue;
    }
    if (&*kept != &entry) *kept = std::move(entry);
    ++kept;
  }
  entries.erase(kept, entries.end());
}

}  // namespace posed::net
