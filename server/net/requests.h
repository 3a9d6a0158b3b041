// Credit: acks that come in among the requests.
#pragma once

#include "proto/messages.h"
#include "server/net/outbox.h"

namespace posed::net {

// Books the acks of a line. Those that want no reply are taken out; the station answers the others.
void take_acks(proto::Line& line, Outbox& outbox, Nanoseconds now);

}  // namespace posed::net
