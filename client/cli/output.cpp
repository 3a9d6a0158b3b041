#include "client/cli/output.h"

#include <fstream>
#include <iostream>
#include <iterator>

namespace posed::cli {
namespace {

bool errors_as_json = false;

std::string because(const proto::GoalFrame::Because& cause) {
  const std::string whose = cause.figure.empty() ? "" : " of " + cause.figure;
  if (!cause.goal.empty()) return "held by " + cause.goal;
  if (!cause.binding.empty()) return "held by the binding " + cause.binding + whose;
  if (!cause.pin.empty()) return "held by the pin of " + cause.pin + whose;
  if (!cause.limit.empty()) return "at a limit of " + cause.limit + whose;
  return format("%.1f mm beyond reach", cause.beyond_m * 1e3);
}

}  // namespace

void say_errors_as_json() {
  errors_as_json = true;
}

int fail(const Error& error) {
  std::string text = "posectl: " + error.message;
  if (!error.path.empty()) text += " (at " + error.path + ')';
  if (!error.hint.empty()) text += "\nposectl: " + error.hint;
  if (errors_as_json) text = proto::encode_error("null", error);
  std::fprintf(stderr, "%s\n", text.c_str());
  for (const char* ours : {"bad_address", "bad_usage", "bad_file", "no_terminal"})
    if (error.code == ours) return kUsage;
  const bool no_daemon = error.code == "cannot_connect" || error.code == "connection_lost" || error.code == "timeout" ||
                         error.code == "bad_reply";
  return no_daemon ? kNoDaemon : kRefused;
}

Result<std::string> read_file(const std::string& file) {
  if (file == "-") return std::string(std::istreambuf_iterator<char>(std::cin), {});
  std::ifstream in(file, std::ios::binary);
  std::string text(std::istreambuf_iterator<char>(in), {});
  if (!in) return Error{"bad_file", file + " can not be read", "", "name a file, or - for standard input"};
  return text;
}

void print_line(std::string_view text) {
  std::fwrite(text.data(), 1, text.size(), stdout);
  std::fputc('\n', stdout);
  std::fflush(stdout);
}

void print_goal(const proto::GoalFrame& goal) {
  std::string line = format("  %s  %s  error %.1f mm  touch [%.4f %.4f %.4f]", goal.id.c_str(),
                            std::string(proto::name_of(goal.state)).c_str(), goal.error * 1e3, goal.touch.x,
                            goal.touch.y, goal.touch.z);
  for (const auto& cause : goal.causes) line += "  " + because(cause);
  print_line(line);
}

int edit(const Session& session, const proto::Params& params, const std::string& done) {
  return request<proto::RevisionResult>(session, params, [&](const proto::RevisionResult& result) {
    print_line(format("%s (revision %llu)", done.c_str(), static_cast<unsigned long long>(result.revision)));
  });
}

void print_set(const proto::EditResult& result) {
  print_line(format("%s is set (revision %llu)", result.id.c_str(), static_cast<unsigned long long>(result.revision)));
}

std::string show_base(const GoalBase& base) {
  switch (base.kind) {
    case GoalBase::Kind::world:
      return "";
    case GoalBase::Kind::sensor:
      return " from " + base.sensor;
    case GoalBase::Kind::object:
      return " from " + base.object;
    case GoalBase::Kind::segment:
      return " from " + base.figure + ' ' + base.segment;
  }
  return "";
}

}  // namespace posed::cli
