// Figures for monitoring, in Prometheus' text format 0.0.4.
#pragma once

#include <string>

#include "proto/messages.h"
#include "server/net/server.h"

namespace posed {

std::string metrics_page(const proto::StatsData& stats, const net::Counters& counters, std::uint64_t revision);

}  // namespace posed
