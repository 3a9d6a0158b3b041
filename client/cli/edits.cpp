// Several edits as one, and what was done before.
#include "client/cli/output.h"

namespace posed::cli {
namespace {

std::string json_string(const std::string& text) {
  std::string json = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') json += '\\';
    if (static_cast<unsigned char>(c) < 0x20)
      json += format("\\u%04x", static_cast<unsigned>(c));
    else
      json += c;
  }
  return json + '"';
}

int show_step(const Session& session, const proto::Params& params, const char* done) {
  return request<proto::StepResult>(session, params, [done](const proto::StepResult& result) {
    std::string line = format("step %llu is %s (revision %llu)", static_cast<unsigned long long>(result.step), done,
                              static_cast<unsigned long long>(result.revision));
    for (const std::string& entity : result.entities) line += "  " + entity;
    print_line(line);
  });
}

}  // namespace

int apply_edits(const Session& session, const std::string& file, const std::string& label) {
  const auto text = read_file(file);
  if (!text) return fail(text.error());
  const std::size_t first = text->find_first_not_of(" \t\r\n");
  std::string params = *text;
  if (first != std::string::npos && params[first] == '[') params = "{\"edits\":" + params + '}';
  if (!label.empty() && first != std::string::npos) {
    // An object that has a label of its own has two then, and the daemon says so.
    params.insert(params.find('{') + 1, "\"label\":" + json_string(label) + ',');
  }
  return call<proto::ApplyResult>(session, "edit.apply", params, [](const proto::ApplyResult& result) {
    print_line(format("%zu edits are done (revision %llu)", result.results.size(),
                      static_cast<unsigned long long>(result.revision)));
  });
}

int undo_edit(const Session& session, std::uint64_t step) {
  return show_step(session, proto::EditUndo{step}, "undone");
}

int redo_edit(const Session& session) {
  return show_step(session, proto::EditRedo{}, "done again");
}

int show_history(const Session& session, int limit) {
  return request<proto::HistoryResult>(session, proto::EditHistory{limit}, [](const proto::HistoryResult& history) {
    if (history.steps.empty()) print_line("nothing was done yet");
    for (const proto::HistoryStep& step : history.steps) {
      std::string line = format("%5llu  %9.1f s  %-10s  %s", static_cast<unsigned long long>(step.step),
                                static_cast<double>(step.t_ns) * 1e-9, step.user.c_str(),
                                step.label.empty() ? step.method.c_str() : step.label.c_str());
      for (const std::string& entity : step.entities) line += "  " + entity;
      if (step.mine) line += "  (yours)";
      if (step.undone) line += "  (undone)";
      print_line(line);
    }
  });
}

}  // namespace posed::cli
