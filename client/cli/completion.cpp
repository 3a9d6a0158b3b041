// Completion for bash, and for zsh through its bashcompinit: the words that may follow the commands typed so far.
#include <CLI/CLI.hpp>

#include "client/cli/completion.h"

namespace posed::cli {
namespace {

// `paths` are the commands with the words that lead to them, each between bars.
void add_cases(const CLI::App& app, const std::string& path, std::string& cases, std::string& paths) {
  std::string words;
  for (const CLI::App* command : app.get_subcommands({})) words += ' ' + command->get_name();
  for (const CLI::Option* option : app.get_options()) {
    for (const std::string& name : option->get_lnames()) words += " --" + name;
  }
  paths += path + "|";
  cases += "    \"" + path + "\") words=\"" + words.substr(words.empty() ? 0 : 1) + "\" ;;\n";
  for (const CLI::App* command : app.get_subcommands({}))
    add_cases(*command, path + (path.empty() ? "" : " ") + command->get_name(), cases, paths);
}

std::string streams_and_roles() {
  return "    watch) more=\"pose tracker stats scene\" ;;\n    token) more=\"viewer editor operator\" ;;\n";
}

}  // namespace

std::string completion_script(const CLI::App& app, const std::string& shell) {
  std::string cases, paths;
  add_cases(app, "", cases, paths);
  const std::string head = shell == "zsh" ? "autoload -U +X bashcompinit && bashcompinit\n" : "";
  return head +
         "_posectl() {\n"
         "  local path=\"\" word words=\"\" more=\"\" i\n"
         "  for ((i = 1; i < COMP_CWORD; i++)); do\n"
         "    word=\"${path:+$path }${COMP_WORDS[i]}\"\n"
         "    [[ \"|" +
         paths +
         "\" != *\"|$word|\"* ]] || path=$word\n"
         "  done\n"
         "  case $path in\n" +
         cases +
         "  esac\n"
         "  case $path in\n" +
         streams_and_roles() +
         "  esac\n"
         "  COMPREPLY=($(compgen -W \"$words $more --help --json --host\" -- \"${COMP_WORDS[COMP_CWORD]}\"))\n"
         "}\n"
         "complete -F _posectl posectl\n";
}

}  // namespace posed::cli
