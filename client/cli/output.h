// What the commands share: errors with their exit codes, and results on standard output.
#pragma once

#include <cstdio>
#include <string>

#include "client/cli/commands.h"

namespace posed::cli {

// Says the error on standard error, with its path and hint; the exit code for it.
int fail(const Error& error);
// From now on as JSON-RPC's error object, on a line.
void say_errors_as_json();

// All of a file; "-" is standard input. Error: "bad_file".
Result<std::string> read_file(const std::string& file);

void print_line(std::string_view text);
void print_goal(const proto::GoalFrame& goal);  // with what holds it
void print_set(const proto::EditResult& result);
std::string show_base(const GoalBase& base);  // " from chair"; empty: the world

// At most `size` of printf's output as a string.
template <class... Args>
std::string format(const char* pattern, Args... args) {
  const int size = std::snprintf(nullptr, 0, pattern, args...);
  std::string text(static_cast<std::size_t>(size) + 1, '\0');
  std::snprintf(text.data(), text.size(), pattern, args...);
  text.pop_back();
  return text;
}

// Prints the result of a request: as it came with --json, else as `show` says.
template <class R, class Show>
int print_result(const Session& session, const Result<std::string>& text, const Show& show) {
  if (!text) return fail(text.error());
  if (session.json) {
    print_line(*text);
    return kDone;
  }
  const auto result = proto::decode_message<R>(*text);
  if (!result) return fail(result.error());
  show(*result);
  return kDone;
}

template <class R, class Show>
int request(const Session& session, const proto::Params& params, const Show& show) {
  return print_result<R>(session, session.client.request(params), show);
}

template <class R, class Show>
int call(const Session& session, const std::string& method, const std::string& params, const Show& show) {
  return print_result<R>(session, session.client.call(method, params), show);
}

// For edits: says `done` and the scene's new revision.
int edit(const Session& session, const proto::Params& params, const std::string& done);

}  // namespace posed::cli
