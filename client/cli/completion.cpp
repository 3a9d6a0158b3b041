// Completion for bash, and for zsh through its bashcompinit: the words that may follow the commands typed so far. Where
// an option's type is a choice ("rest|start"), its words.
#include "client/cli/completion.h"

#include <CLI/CLI.hpp>
#include <algorithm>

namespace posed::cli {
namespace {

std::string choices(const CLI::Option& option) {
  std::string words = option.get_type_name();
  if (words.find('|') == std::string::npos) return "";
  std::replace(words.begin(), words.end(), '|', ' ');
  return words;
}

struct Cases {
  std::string paths;   // the commands with the words that lead to them, each between bars
  std::string words;   // what may follow a path
  std::string values;  // what may follow an option of a path
};

void add_cases(const CLI::App& app, const std::string& path, Cases& cases) {
  std::string words;
  for (const CLI::App* command : app.get_subcommands({})) words += ' ' + command->get_name();
  for (const CLI::Option* option : app.get_options()) {
    for (const std::string& name : option->get_lnames()) {
      words += " --" + name;
      if (const std::string values = choices(*option); !values.empty())
        cases.values += "    \"" + path + " --" + name + "\") only=\"" + values + "\" ;;\n";
    }
    if (option->get_lnames().empty()) words += ' ' + choices(*option);
  }
  cases.paths += path + "|";
  cases.words += "    \"" + path + "\") words=\"" + words.substr(words.empty() ? 0 : 1) + "\" ;;\n";
  for (const CLI::App* command : app.get_subcommands({}))
    add_cases(*command, path + (path.empty() ? "" : " ") + command->get_name(), cases);
}

}  // namespace

std::string completion_script(const CLI::App& app, const std::string& shell) {
  Cases cases;
  add_cases(app, "", cases);
  const std::string head = shell == "zsh" ? "autoload -U +X bashcompinit && bashcompinit\n" : "";
  return head +
         "_posectl() {\n"
         "  local path=\"\" word words=\"\" only=\"\" i\n"
         "  for ((i = 1; i < COMP_CWORD; i++)); do\n"
         "    word=\"${path:+$path }${COMP_WORDS[i]}\"\n"
         "    [[ \"|" +
         cases.paths +
         "\" != *\"|$word|\"* ]] || path=$word\n"
         "  done\n"
         "  case $path in\n" +
         cases.words +
         "  esac\n"
         "  case \"$path ${COMP_WORDS[COMP_CWORD-1]}\" in\n" +
         cases.values +
         "  esac\n"
         "  COMPREPLY=($(compgen -W \"${only:-$words --help --json --host}\" -- \"${COMP_WORDS[COMP_CWORD]}\"))\n"
         "}\n"
         "complete -F _posectl posectl\n";
}

}  // namespace posed::cli
