#include "client/cli/options.h"

#include "client/cli/editor.h"
#include "client/cli/manual.h"
#include "client/cli/options_parts.h"
#include "client/cli/output.h"
#include "common/names.h"

namespace posed::cli {
namespace {

// The command that was understood last, and the words that lead to it.
const CLI::App& understood(const CLI::App& app, std::string& path) {
  path += (path.empty() ? "" : " ") + app.get_name();
  const auto parsed = app.get_subcommands();
  return parsed.empty() ? app : understood(*parsed.back(), path);
}

// Where in the tree a command of this name is.
std::string found_elsewhere(const CLI::App& app, const std::string& path, const std::string& name) {
  for (const CLI::App* command : app.get_subcommands({})) {
    const std::string here = path + ' ' + command->get_name();
    if (command->get_name() == name) return here;
    if (std::string below = found_elsewhere(*command, here, name); !below.empty()) return below;
  }
  return "";
}

// What was meant, where a word is not known.
Error explain(const CLI::App& app, const CLI::ParseError& error) {
  std::string path;
  const CLI::App& command = understood(app, path);
  const std::string help = path + " --help shows what there is";
  const auto left = app.remaining(true);
  if (left.empty()) return {"bad_usage", error.what(), "", help};
  const std::string& word = left.front();
  std::vector<std::string> known;
  if (word.starts_with("-")) {
    for (const CLI::App* level = &command; level != nullptr; level = level->get_parent()) {
      for (const CLI::Option* option : level->get_options())
        for (const std::string& name : option->get_lnames()) known.push_back("--" + name);
    }
    const std::string hint = did_you_mean(word.substr(0, word.find('=')), known);
    return {"bad_usage", path + " has no option " + word, "", hint.starts_with("did") ? hint : help};
  }
  for (const CLI::App* sub : command.get_subcommands({})) known.push_back(sub->get_name());
  if (known.empty()) return {"bad_usage", path + " takes no further word: " + word, "", help};
  std::string hint = did_you_mean(word, known);
  if (!hint.starts_with("did")) {
    const std::string elsewhere = found_elsewhere(app, app.get_name(), word);
    hint = elsewhere.empty() ? help : "did you mean " + elsewhere + '?';
  }
  return {"bad_usage", path + " has no command " + word, "", hint};
}

void add_help(CLI::App& app, std::function<int()>& run) {
  struct Help {
    std::vector<std::string> words;
    bool man = false;
  };
  auto args = std::make_shared<Help>();
  auto* command = example(app.add_subcommand("help", "how a command is used"), "posectl help goal set");
  command->add_option("command", args->words, "its words; left out: all commands")->type_name("COMMAND...");
  command->add_flag("--man", args->man, "the whole manual as a man page: posectl help --man | man -l -");
  command->callback([&run, &app, args] {
    run = [text = args->man ? man_page(app) : help_of(app, args->words)] {
      if (!text) return fail(text.error());
      return std::fputs(text->c_str(), stdout), kDone;
    };
  });
}

}  // namespace

std::variant<Options, int> parse_options(int argc, const char* const* argv) {
  Options options;
  options.host = "tcp://127.0.0.1:" + std::to_string(proto::kDefaultPort);
  options.identity.program = "posectl 0.1.0";
  options.identity.user = user_name();
  CLI::App app("posectl talks to a running posed.", "posectl");
  app.require_subcommand(1);
  app.fallthrough();
  app.add_option("--host", options.host, "where posed listens")
      ->envname("POSED_HOST")
      ->type_name("tcp://HOST:PORT")
      ->capture_default_str();
  app.add_flag("--json", options.json, "results, and errors, as JSON, one a line");
  app.add_option("--user", options.identity.user, "who you are to the others; default: your login name")
      ->envname("POSED_USER")
      ->type_name("NAME");
  app.add_option("--token", options.identity.token, "where posed asks for one; better in the environment")
      ->envname("POSED_TOKEN")
      ->type_name("TOKEN");
  app.add_option("--authority", options.identity.authority, "for tls://: a file of the certificates to trust")
      ->envname("POSED_AUTHORITY")
      ->type_name("FILE");
  app.footer("Exit codes: 0 done, 1 the daemon refused, 2 wrong usage, 3 no daemon or the connection was lost.");
  add_status(app, options.run);
  add_watch(app, options.run);
  add_view(app, options.run);
  add_goal(app, options.run);
  add_pose(app, options.run);
  add_joint(app, options.run);
  add_figure(app, options.run);
  add_object(app, options.run);
  add_binding(app, options.run);
  add_edit(app, options.run);
  add_scene(app, options.run);
  add_solve(app, options.run);
  add_tracker(app, options.run);
  add_camera(app, options.run);
  add_call(app, options.run);
  add_doctor(app, options);
  add_token(app, options.run_alone);
  add_completion(app, options.run_alone);
  add_help(app, options.run_alone);
  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& asked) {  // --help
    return app.exit(asked), kDone;
  } catch (const CLI::ParseError& error) {
    for (int i = 1; i < argc; ++i)
      if (std::string_view(argv[i]) == "--json") say_errors_as_json();
    return fail(explain(app, error));
  }
  // With a token the daemon knows the name by itself.
  if (!options.identity.token.empty() && app.count("--user") == 0) options.identity.user.clear();
  if (!options.run_alone) options.identity.resume = editor_key();
  return options;
}

}  // namespace posed::cli
