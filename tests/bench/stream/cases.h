// What bench_stream measures. Each case prints its lines of the table and writes its rows.
#pragma once

#include "tests/bench/bench_output.h"
#include "tests/bench/verdict.h"

namespace posed::test {

// `viewers` of a stream of `rate_hz`, by everyone in turn, again and again.
void fan_out(BenchOutput& out, Verdict& verdict, int viewers, double rate_hz);
// The daemon with its solver: from a sample's arrival to its pose at the last viewer.
void whole_daemon(BenchOutput& out, int viewers);
void memory(BenchOutput& out, Verdict& verdict);
void many_connections(BenchOutput& out, Verdict& verdict);
void pings(BenchOutput& out, Verdict& verdict);
// Edits that wait for the disk, with many viewers looking on, and alone.
void editors_and_viewers(BenchOutput& out, Verdict& verdict);
void durable_edits(BenchOutput& out);
// One viewer of many stops reading for ten seconds.
void stalled_viewer(BenchOutput& out, Verdict& verdict);

}  // namespace posed::test
