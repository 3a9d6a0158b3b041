#include "client/cli/options.h"

#include <CLI/CLI.hpp>
#include <map>
#include <memory>

#include "client/cli/completion.h"
#include "client/cli/options_parts.h"

namespace posed::cli {
namespace {

void add_watch(CLI::App& app, Run& run) {
  static const std::map<std::string, proto::Stream> kNames{{"pose", proto::Stream::pose},
                                                           {"tracker", proto::Stream::tracker},
                                                           {"stats", proto::Stream::stats},
                                                           {"scene", proto::Stream::scene},
                                                           {"camera", proto::Stream::camera}};
  auto watch = std::make_shared<Watch>();
  auto* command = app.add_subcommand("watch", "follow a stream");
  command->add_option("stream", watch->stream, "pose, tracker, stats, scene or camera")
      ->transform(CLI::CheckedTransformer(kNames, CLI::ignore_case).description(""))
      ->type_name("STREAM");
  command->add_option("--rate", watch->rate_hz, "frames a second at most")->check(CLI::PositiveNumber)->type_name("HZ");
  command->add_option("--count", watch->count, "stop after so many frames")->check(CLI::PositiveNumber)->type_name("N");
  command->add_option("--figure", watch->figure, "poses of this figure only")->type_name("ID");
  const auto form = [&](const char* flag, Watch::Form value, const char* help) {
    return command->add_flag_callback(
        flag, [watch, value] { watch->form = value; }, help);
  };
  auto* csv = form("--csv", Watch::Form::csv, "rows for a spreadsheet: segments, sensors or statistics");
  auto* table =
      form("--table", Watch::Form::table, "a table that stands still (the default on a terminal)")->excludes(csv);
  form("--lines", Watch::Form::lines, "a line a frame (the default elsewhere)")->excludes(csv)->excludes(table);
  command->callback([&run, watch] { run = [watch](const Session& s) { return run_watch(s, *watch); }; });
}

void add_goal(CLI::App& app, Run& run) {
  auto* goal = app.add_subcommand("goal", "list, set and remove goals");
  goal->require_subcommand(1);
  goal->add_subcommand("list", "all goals")->callback([&run] { run = list_goals; });

  struct Set {
    std::string at, id, figure;
    std::vector<double> position;
    double weight = 0.0;
  };
  auto args = std::make_shared<Set>();
  auto* set = goal->add_subcommand("set", "pull a segment's touch point, or a site, to a point; or any other goal");
  set->add_option("at", args->at, "right_hand, right_hand/fingertip, or the whole goal as a JSON object")->required();
  set->add_option("position", args->position, "metres, Z up")->expected(3)->type_name("X Y Z");
  set->add_option("--id", args->id, "default: FIGURE.SEGMENT.position");
  set->add_option("--figure", args->figure, "needed where there are several");
  auto* weight = set->add_option("--weight", args->weight, "default: 10")->type_name("W");
  set->callback([&run, args, weight] {
    if (args->at.starts_with('{')) {
      if (!args->position.empty() || !args->id.empty() || !args->figure.empty() || *weight)
        throw CLI::ValidationError("a goal as JSON says all by itself", 1);
      run = [args](const Session& s) { return set_goal(s, args->at); };
      return;
    }
    if (args->position.size() != 3) throw CLI::RequiredError("position");
    proto::GoalSet edit;
    edit.edit.id = args->id;
    edit.edit.figure = args->figure;
    Attachment at;
    const std::size_t slash = args->at.find('/');
    at.segment = args->at.substr(0, slash);
    if (slash != std::string::npos) at.site = args->at.substr(slash + 1);
    edit.edit.at = at;
    edit.edit.position = Vec3(args->position[0], args->position[1], args->position[2]);
    if (*weight) edit.edit.weight = args->weight;
    run = [edit](const Session& s) { return set_goal(s, edit); };
  });

  auto id = std::make_shared<std::string>();
  auto* remove = goal->add_subcommand("remove", "remove one goal");
  remove->add_option("id", *id)->required();
  remove->callback([&run, id] { run = [id](const Session& s) { return remove_goal(s, *id); }; });

  auto figure = std::make_shared<std::string>();
  auto* clear = goal->add_subcommand("clear", "remove all goals");
  clear->add_option("--figure", *figure, "of this figure only");
  clear->callback([&run, figure] { run = [figure](const Session& s) { return clear_goals(s, *figure); }; });
}

void add_pose(CLI::App& app, Run& run) {
  auto* pose = app.add_subcommand("pose", "read and change the pose");
  pose->require_subcommand(1);
  auto figure = std::make_shared<std::string>();
  auto to = std::make_shared<std::string>("rest");

  auto* get = pose->add_subcommand("get", "the newest pose, with its goals");
  get->callback([&run, figure] { run = [figure](const Session& s) { return get_pose(s, *figure); }; });
  auto* reset = pose->add_subcommand("reset", "back to the rest pose, or to the start pose");
  reset->add_option("to", *to, "rest or start")->check(CLI::IsMember({"rest", "start"}).description(""));
  reset->callback([&run, figure, to] { run = [figure, to](const Session& s) { return reset_pose(s, *figure, *to); }; });
  auto* mirror = pose->add_subcommand("mirror", "exchange left and right");
  mirror->callback([&run, figure] { run = [figure](const Session& s) { return mirror_pose(s, *figure); }; });
  for (CLI::App* command : {get, reset, mirror}) {
    command->add_option("--figure", *figure, "needed where there are several")->type_name("ID");
  }
}

void add_solve(CLI::App& app, Run& run) {
  struct Solve {
    std::string file;
    bool batch = false;
  };
  auto solve = std::make_shared<Solve>();
  auto* command = app.add_subcommand("solve", "solve a problem that touches no scene");
  command->add_option("file", solve->file, "its JSON object, as in PROTOCOL.md; - reads standard input")->required();
  command->add_flag("--batch", solve->batch, "the file holds many: {\"problems\":[...]}");
  command->callback(
      [&run, solve] { run = [solve](const Session& s) { return run_solve(s, solve->file, solve->batch); }; });
}

void add_scene(CLI::App& app, Run& run) {
  auto* scene = app.add_subcommand("scene", "list, begin, save and open scenes");
  scene->require_subcommand(1);
  scene->add_subcommand("list", "saved scenes and templates")->callback([&run] { run = list_scenes; });
  const auto add = [&](const char* name, const char* what, const char* help,
                       int (*act)(const Session&, const std::string&)) {
    auto value = std::make_shared<std::string>();
    auto* command = scene->add_subcommand(name, help);
    command->add_option(what, *value)->required();
    command->callback([&run, value, act] { run = [value, act](const Session& s) { return act(s, *value); }; });
  };
  add("new", "template", "begin anew from a template", new_scene);
  add("save", "name", "keep the scene under a name", save_scene);
  add("open", "name", "go on with a kept scene", open_scene);
}

void add_call(CLI::App& app, Run& run) {
  struct Call {
    std::string method, params = "{}";
  };
  auto call = std::make_shared<Call>();
  auto* command = app.add_subcommand("call", "call any method of the protocol");
  command->add_option("method", call->method, "as in session.status")->required();
  command->add_option("params", call->params, "a JSON object; - reads it from standard input");
  command->callback(
      [&run, call] { run = [call](const Session& s) { return run_call(s, call->method, call->params); }; });
}

void add_doctor(CLI::App& app, Options& options) {
  auto root = std::make_shared<std::string>("/");
  auto* doctor = app.add_subcommand("doctor", "what is wrong with trackers, permissions, ports and versions");
  doctor->add_option("--root", *root, "")->group("");
  doctor->callback([&options, root] {
    options.run_alone = [host = options.host, identity = options.identity, root] {
      return run_doctor(host, identity, *root);
    };
  });
}

void add_alone(CLI::App& app, std::function<int()>& run) {
  struct Token {
    std::string role, name;
  };
  auto token = std::make_shared<Token>();
  auto* make = app.add_subcommand("token", "make a token, and its line for posed --auth.tokens");
  make->add_option("role", token->role, "viewer, editor or operator")
      ->required()
      ->check(CLI::IsMember({"viewer", "editor", "operator"}).description(""));
  make->add_option("name", token->name, "whose it is")->required()->check([](const std::string& name) {
    return name.find_first_of(" \t#") == std::string::npos ? "" : "a name is one word";
  });
  make->callback([&run, token] { run = [token] { return make_token(token->role, token->name); }; });

  auto shell = std::make_shared<std::string>("bash");
  auto* completion = app.add_subcommand("completion", "what your shell reads to complete these words");
  completion->add_option("shell", *shell, "bash or zsh")->check(CLI::IsMember({"bash", "zsh"}).description(""));
  completion->footer("As in: source <(posectl completion bash)");
  completion->callback([&run, &app, shell] {
    run = [script = completion_script(app, *shell)] { return std::fputs(script.c_str(), stdout), kDone; };
  });
}

}  // namespace

std::variant<Options, int> parse_options(int argc, const char* const* argv) {
  Options options;
  options.host = "tcp://127.0.0.1:" + std::to_string(proto::kDefaultPort);
  CLI::App app("posectl talks to a running posed.", "posectl");
  app.require_subcommand(1);
  app.fallthrough();
  app.add_option("--host", options.host, "where posed listens")
      ->envname("POSED_HOST")
      ->type_name("tcp://HOST:PORT")
      ->capture_default_str();
  app.add_flag("--json", options.json, "results, and errors, as JSON, one a line");
  app.add_option("--token", options.identity.token, "where posed asks for one; better in the environment")
      ->envname("POSED_TOKEN")
      ->type_name("TOKEN");
  app.add_option("--authority", options.identity.authority, "for tls://: a file of the certificates to trust")
      ->envname("POSED_AUTHORITY")
      ->type_name("FILE");
  app.footer("Exit codes: 0 done, 1 the daemon refused, 2 wrong usage, 3 no daemon or the connection was lost.");
  app.add_subcommand("status", "how the daemon is")->callback([&options] { options.run = run_status; });
  add_watch(app, options.run);
  add_goal(app, options.run);
  add_pose(app, options.run);
  add_solve(app, options.run);
  add_tracker(app, options.run);
  add_camera(app, options.run);
  add_scene(app, options.run);
  add_call(app, options.run);
  add_doctor(app, options);
  add_alone(app, options.run_alone);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? kDone : kUsage;
  }
  return options;
}

}  // namespace posed::cli
