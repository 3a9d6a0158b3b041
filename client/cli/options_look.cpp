#include <cstdio>
#include <map>

#include "client/cli/completion.h"
#include "client/cli/options_parts.h"

namespace posed::cli {

void add_status(CLI::App& app, Run& run) {
  example(app.add_subcommand("status", "how the daemon is"), "posectl status")->callback([&run] { run = run_status; });
  auto* session = app.add_subcommand("session", "who is connected");
  session->require_subcommand(1);
  example(session->add_subcommand("list", "all connections"), "posectl session list")->callback([&run] {
    run = list_sessions;
  });
}

void add_watch(CLI::App& app, Run& run) {
  static const std::map<std::string, proto::Stream> kNames{{"pose", proto::Stream::pose},
                                                           {"tracker", proto::Stream::tracker},
                                                           {"stats", proto::Stream::stats},
                                                           {"scene", proto::Stream::scene},
                                                           {"camera", proto::Stream::camera}};
  auto watch = std::make_shared<Watch>();
  auto* command = app.add_subcommand("watch", "follow a stream");
  example(command, "posectl watch pose --rate 10 --count 3");
  command->add_option("stream", watch->stream, "what to follow; default: pose")
      ->transform(CLI::CheckedTransformer(kNames, CLI::ignore_case).description(""))
      ->type_name("pose|tracker|stats|scene|camera");
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

namespace {

view::Size size_from(const std::string& text) {
  view::Size size;
  char more = 0;
  if (std::sscanf(text.c_str(), "%dx%d%c", &size.columns, &size.rows, &more) != 2 || size.columns < 1 ||
      size.rows < 1 || size.columns > 1000 || size.rows > 1000)
    throw CLI::ValidationError("--size", "is COLUMNSxROWS, as in 80x24");
  return size;
}

}  // namespace

void add_view(CLI::App& app, Run& run) {
  static const std::map<std::string, view::Glyphs> kGlyphs{
      {"braille", view::Glyphs::braille}, {"blocks", view::Glyphs::blocks}, {"ascii", view::Glyphs::ascii}};
  struct View {
    view::Options options;
    view::Glyphs glyphs = view::Glyphs::braille;
    std::string size;
    bool once = false;
  };
  auto args = std::make_shared<View>();
  auto* command = app.add_subcommand("view", "look at the figures in this terminal, and pull at them");
  example(command, "posectl view --once --size 80x24");
  command->add_option("--figure", args->options.figure, "this one only")->type_name("ID");
  command->add_option("--rate", args->options.max_rate_hz, "poses a second at most; default: 60")
      ->check(CLI::PositiveNumber)
      ->type_name("HZ");
  auto* glyphs = command->add_option("--glyphs", args->glyphs, "of the drawing; default: what the terminal shows")
                     ->transform(CLI::CheckedTransformer(kGlyphs, CLI::ignore_case).description(""))
                     ->type_name("braille|blocks|ascii");
  auto* once = command->add_flag("--once", args->once, "print one picture as text, for scripts");
  auto* size =
      command->add_option("--size", args->size, "of that picture; default: 80x24")->needs(once)->type_name("CxR");
  command->callback([&run, args, glyphs, size] {
    if (*glyphs) args->options.glyphs = args->glyphs;
    if (*size) args->options.size = size_from(args->size);
    run = [args](const Session& s) { return run_view(s, args->options, args->once); };
  });
}

void add_doctor(CLI::App& app, Options& options) {
  auto root = std::make_shared<std::string>("/");
  auto* doctor = app.add_subcommand("doctor", "what is wrong with trackers, permissions, ports and versions");
  example(doctor, "posectl doctor");
  doctor->add_option("--root", *root, "")->group("");
  doctor->callback([&options, root] {
    options.run_alone = [host = options.host, identity = options.identity, root] {
      return run_doctor(host, identity, *root);
    };
  });
}

void add_solve(CLI::App& app, Run& run) {
  struct Solve {
    std::string file;
    bool batch = false;
  };
  auto solve = std::make_shared<Solve>();
  auto* command = app.add_subcommand("solve", "solve a problem that touches no scene");
  example(command, R"(echo '{"goals":[{"at":"left_hand","position":[0.4,0.3,1.3]}]}' | posectl solve -)");
  command->add_option("file", solve->file, "its JSON object, as in PROTOCOL.md; - reads standard input")->required();
  command->add_flag("--batch", solve->batch, "the file holds many: {\"problems\":[...]}");
  command->callback(
      [&run, solve] { run = [solve](const Session& s) { return run_solve(s, solve->file, solve->batch); }; });
}

void add_call(CLI::App& app, Run& run) {
  struct Call {
    std::string method, params = "{}";
  };
  auto call = std::make_shared<Call>();
  auto* command = app.add_subcommand("call", "call any method of the protocol");
  example(command, R"(posectl call pose.get '{"figure":"body"}')");
  command->add_option("method", call->method, "as in session.status")->required();
  command->add_option("params", call->params, "a JSON object; - reads it from standard input");
  command->callback(
      [&run, call] { run = [call](const Session& s) { return run_call(s, call->method, call->params); }; });
}

void add_token(CLI::App& app, std::function<int()>& run) {
  struct Token {
    std::string role, name;
  };
  auto token = std::make_shared<Token>();
  auto* make = app.add_subcommand("token", "make a token, and its line for posed --auth.tokens");
  example(make, "posectl token editor ana >> tokens");
  make->add_option("role", token->role, "what it lets one do")
      ->required()
      ->type_name("viewer|editor|operator")
      ->check(CLI::IsMember({"viewer", "editor", "operator"}).description(""));
  make->add_option("name", token->name, "whose it is")->required()->check([](const std::string& name) {
    return name.find_first_of(" \t#") == std::string::npos ? "" : "a name is one word";
  });
  make->callback([&run, token] { run = [token] { return make_token(token->role, token->name); }; });
}

void add_completion(CLI::App& app, std::function<int()>& run) {
  auto shell = std::make_shared<std::string>("bash");
  auto* completion = app.add_subcommand("completion", "what your shell reads to complete these words");
  completion->add_option("shell", *shell, "default: bash")
      ->type_name("bash|zsh")
      ->check(CLI::IsMember({"bash", "zsh"}).description(""));
  example(completion, "source <(posectl completion bash)");
  completion->callback([&run, &app, shell] {
    run = [script = completion_script(app, *shell)] { return std::fputs(script.c_str(), stdout), kDone; };
  });
}

}  // namespace posed::cli
