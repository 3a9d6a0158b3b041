#include "client/cli/manual.h"

#include <CLI/CLI.hpp>

#include "common/names.h"

namespace posed::cli {
namespace {

// As troff wants it: no line begins with a dot or a quote, and what looks like a hyphen is a minus.
std::string roff(const std::string& text) {
  std::string out;
  bool at_start = true;
  for (const char c : text) {
    if (at_start && (c == '.' || c == '\'')) out += "\\&";
    if (c == '\\')
      out += "\\e";
    else if (c == '-')
      out += "\\-";
    else
      out += c;
    at_start = c == '\n';
  }
  return out;
}

void add_options(const CLI::App& command, std::string& out) {
  for (const CLI::Option* option : command.get_options()) {
    if (option->get_single_name() == "help") continue;
    const bool named = !option->get_lnames().empty();
    const std::string takes = option->get_items_expected_max() > 0 ? option->get_type_name() : "";
    out += ".TP\n.B " + roff((named ? "--" : "") + option->get_single_name());
    if (!takes.empty()) out += " \\fI" + roff(takes) + "\\fR";
    out += '\n' + roff(option->get_description()) + '\n';
  }
}

void add_commands(const CLI::App& app, const std::string& path, std::string& out) {
  for (const CLI::App* command : app.get_subcommands({})) {
    const std::string here = path + ' ' + command->get_name();
    if (command->get_subcommands({}).empty() || !command->get_footer().empty()) {
      out += ".SS " + roff(here) + '\n' + roff(command->get_description()) + ".\n";
      add_options(*command, out);
      const std::string footer = command->get_footer();
      if (const std::size_t line = footer.find('\n'); line != std::string::npos)
        out += ".PP\n.nf\n" + roff(footer.substr(line + 1)) + "\n.fi\n";
    }
    add_commands(*command, here, out);
  }
}

}  // namespace

Result<std::string> help_of(const CLI::App& app, const std::vector<std::string>& words) {
  const CLI::App* command = &app;
  std::string path;
  for (const std::string& word : words) {
    std::vector<std::string> known;
    const CLI::App* next = nullptr;
    for (const CLI::App* sub : command->get_subcommands({})) {
      known.push_back(sub->get_name());
      if (sub->get_name() == word) next = sub;
    }
    path += (path.empty() ? "" : " ") + command->get_name();
    if (next == nullptr) return Error{"bad_usage", path + " has no command " + word, "", did_you_mean(word, known)};
    command = next;
  }
  // App::help() would go on to the command that was given, which is help itself.
  if (command == &app) return app.get_formatter()->make_help(&app, app.get_name(), CLI::AppFormatMode::Normal);
  return command->help(path);
}

Result<std::string> man_page(const CLI::App& app) {
  std::string out =
      ".TH POSECTL 1\n.SH NAME\nposectl \\- the tool of posed, for people and scripts\n.SH SYNOPSIS\n.B posectl\n"
      "[\\fIOPTIONS\\fR] \\fICOMMAND\\fR\n.SH DESCRIPTION\n" +
      roff(app.get_description()) +
      " Its words and the protocol's are the same: what posectl goal set does is goal.set.\n" + ".SH OPTIONS\n";
  add_options(app, out);
  out += ".SH COMMANDS\n";
  add_commands(app, app.get_name(), out);
  out += ".SH EXIT STATUS\n" + roff(app.get_footer()) + '\n';
  return out;
}

}  // namespace posed::cli
