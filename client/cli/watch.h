// How frames are shown: a line each, rows of CSV, or a table that stands still.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "client/cli/commands.h"

namespace posed::cli {

// One line.
Result<std::string> show_line(const proto::Incoming& frame);

class Csv {
 public:
  explicit Csv(client::Client& client) : client_(client) {}

  // Rows with their ends; before the first ones the names of the columns.
  Result<std::string> rows(const proto::Incoming& frame);

 private:
  Result<std::string> pose(const std::string& data);
  // The names of a figure's segments, asked for once.
  Result<std::vector<std::string>> segments(const std::string& figure, std::size_t count);

  client::Client& client_;
  bool named_ = false;
  std::map<std::string, std::vector<std::string>> segments_;
};

class Table {
 public:
  explicit Table(client::Client& client);

  // All of the screen, as text for a terminal.
  Result<std::string> screen(const proto::Incoming& frame, std::uint64_t lost);

 private:
  std::string age(Nanoseconds t_ns);

  std::optional<Nanoseconds> clock_offset_;  // of the daemon's clock from ours
  std::vector<double> ages_ms_;              // the last ones
  std::uint64_t last_seq_ = 0;
  Nanoseconds last_seen_ = 0;
  double rate_hz_ = 0.0;
};

}  // namespace posed::cli
