#include <algorithm>
#include <map>

#include "client/cli/options_parts.h"

namespace posed::cli {

void add_scene(CLI::App& app, Run& run) {
  auto* scene = app.add_subcommand("scene", "list, begin, save and open scenes");
  scene->require_subcommand(1);
  example(scene->add_subcommand("list", "saved scenes and templates"), "posectl scene list")->callback([&run] {
    run = list_scenes;
  });
  example(scene->add_subcommand("get", "the whole document, as JSON"), "posectl scene get > monday.json")
      ->callback([&run] { run = get_scene; });
  const auto add = [&](const char* name, const char* what, const char* help, const char* line,
                       int (*act)(const Session&, const std::string&)) {
    auto value = std::make_shared<std::string>();
    auto* command = example(scene->add_subcommand(name, help), line);
    command->add_option(what, *value)->required();
    command->callback([&run, value, act] { run = [value, act](const Session& s) { return act(s, *value); }; });
  };
  add("new", "template", "begin anew from a template", "posectl scene new paper/sitting", new_scene);
  add("save", "name", "keep the scene under a name", "posectl scene save monday", save_scene);
  add("open", "name", "go on with a kept scene", "posectl scene open monday", open_scene);
}

void add_edit(CLI::App& app, Run& run) {
  auto* edit = app.add_subcommand("edit", "several edits as one");
  edit->require_subcommand(1);
  struct Apply {
    std::string file, label;
  };
  auto args = std::make_shared<Apply>();
  auto* apply = edit->add_subcommand("apply", "all of a file's edits or none: one revision, one step to undo");
  example(apply, R"(echo '[{"method":"pose.reset","params":{"to":"start"}}]' | posectl edit apply -)");
  apply->add_option("file", args->file, "the params of edit.apply, or its array of edits; - reads standard input")
      ->required();
  apply->add_option("--label", args->label, "what the history calls it")->type_name("TEXT");
  apply->callback([&run, args] { run = [args](const Session& s) { return apply_edits(s, args->file, args->label); }; });

  auto step = std::make_shared<std::uint64_t>(0);
  auto* undo = example(app.add_subcommand("undo", "take back what you have done last"), "posectl undo");
  undo->add_option("step", *step, "that step in its stead; history has the numbers")->check(CLI::PositiveNumber);
  undo->callback([&run, step] { run = [step](const Session& s) { return undo_edit(s, *step); }; });
  example(app.add_subcommand("redo", "do again what you have undone last"), "posectl redo")->callback([&run] {
    run = redo_edit;
  });
  auto limit = std::make_shared<int>(20);
  auto* history =
      example(app.add_subcommand("history", "who has done what, the newest first"), "posectl history --limit 5");
  history->add_option("--limit", *limit, "steps at most; default: 20")->check(CLI::Range(1, 1000))->type_name("N");
  history->callback([&run, limit] { run = [limit](const Session& s) { return show_history(s, *limit); }; });
}

void add_object(CLI::App& app, Run& run) {
  auto* object = app.add_subcommand("object", "things that goals can be relative to");
  object->require_subcommand(1);
  add_entity(object, run, "object", "chair", list_objects, get_object, remove_object);
  struct Set {
    std::string id;
    std::vector<double> position, quat, box;
    std::string label;
  };
  auto args = std::make_shared<Set>();
  auto* set = example(object->add_subcommand("set", "make an object, or move it"),
                      "posectl object set chair 0.6 0 0.45 --box 0.2 0.2 0.02");
  set->add_option("id", args->id, "its name, or the whole object as a JSON object")->required();
  set->add_option("position", args->position, "of its frame, metres, Z up")->expected(3)->type_name("X Y Z");
  set->add_option("--quat", args->quat, "how it is turned")->expected(4)->type_name("X Y Z W");
  set->add_option("--box", args->box, "drawn as a box: half its size")->expected(3)->type_name("X Y Z");
  auto* label = set->add_option("--label", args->label, "kept with it")->type_name("TEXT");
  set->callback([&run, args, label] {
    if (args->id.starts_with('{')) {
      run = [args](const Session& s) { return set_entity(s, "object.set", args->id); };
      return;
    }
    proto::ObjectSet request;
    request.edit.id = args->id;
    if (!args->position.empty()) request.edit.position = vector_from(args->position);
    if (!args->quat.empty()) request.edit.rotation = quat_from_xyzw(args->quat);
    if (!args->box.empty())
      request.edit.shapes = std::vector{Shape{Shape::Kind::box, kZero, vector_from(args->box), 0.0}};
    if (*label) request.edit.label = args->label;
    run = [request](const Session& s) { return set_entity(s, request); };
  });
}

void add_binding(CLI::App& app, Run& run) {
  static const std::map<std::string, Binding::Mode> kModes{{"absolute", Binding::Mode::absolute},
                                                           {"relative", Binding::Mode::relative}};
  auto* binding = app.add_subcommand("binding", "sensors that lead goals and objects");
  binding->require_subcommand(1);
  add_entity(binding, run, "binding", "hand", list_bindings, get_binding, remove_binding);
  struct Set {
    std::string sensor, goal, object, id;
    std::vector<std::string> axes;
    Binding::Mode mode = Binding::Mode::absolute;
    double scale = 1.0;
  };
  auto args = std::make_shared<Set>();
  auto* set = example(binding->add_subcommand("set", "let a sensor lead a goal or an object"),
                      "posectl binding set simulated:1 --goal body.right_hand.position --id hand");
  set->add_option("sensor", args->sensor, "as in simulated:1, or the whole binding as a JSON object")->required();
  auto* goal = set->add_option("--goal", args->goal, "what it leads")->type_name("ID");
  set->add_option("--object", args->object, "what it leads")->type_name("ID")->excludes(goal);
  set->add_option("--id", args->id, "default: of the sensor's name")->type_name("ID");
  set->add_option("--axes", args->axes, "those that follow, of x y z and rx ry rz; default: all the target has")
      ->check(CLI::IsMember({"x", "y", "z", "rx", "ry", "rz"}).description(""))
      ->expected(1, 6)
      ->type_name("AXIS...");
  auto* mode = set->add_option("--mode", args->mode, "where the sensor is, or as it moves; default: absolute")
                   ->transform(CLI::CheckedTransformer(kModes).description(""))
                   ->type_name("absolute|relative");
  auto* scale = set->add_option("--scale", args->scale, "of its way; default: 1")->type_name("FACTOR");
  set->callback([&run, args, mode, scale] {
    if (args->sensor.starts_with('{')) {
      run = [args](const Session& s) { return set_entity(s, "binding.set", args->sensor); };
      return;
    }
    const auto has = [&](const char* axis) {
      return std::find(args->axes.begin(), args->axes.end(), axis) != args->axes.end();
    };
    proto::BindingSet request;
    request.edit.id = args->id;
    request.edit.sensor = args->sensor;
    if (!args->goal.empty() || !args->object.empty())
      request.edit.to = BindingTarget{args->goal, args->object, "", "", ""};
    if (!args->axes.empty()) request.edit.axes = Axes{has("x"), has("y"), has("z"), has("rx"), has("ry"), has("rz")};
    if (*mode) request.edit.mode = args->mode;
    if (*scale) request.edit.scale = args->scale;
    run = [request](const Session& s) { return set_entity(s, request); };
  });
}

}  // namespace posed::cli
