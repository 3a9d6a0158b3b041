#include "client/cli/options_parts.h"

namespace posed::cli {

void add_entity(CLI::App* family, Run& run, const std::string& noun, const std::string& id, int (*list)(const Session&),
                int (*get)(const Session&, const std::string&), int (*remove)(const Session&, const std::string&)) {
  example(family->add_subcommand("list", "all " + noun + "s"), "posectl " + noun + " list")->callback([&run, list] {
    run = list;
  });
  const auto add = [&](const std::string& verb, const std::string& help, auto act) {
    auto which = std::make_shared<std::string>();
    auto* command = example(family->add_subcommand(verb, help), "posectl " + noun + ' ' + verb + ' ' + id);
    command->add_option("id", *which, "which " + noun)->required();
    command->callback([&run, which, act] { run = [which, act](const Session& s) { return act(s, *which); }; });
  };
  add("get", "one " + noun, get);
  add("remove", "remove one " + noun, remove);
}

void add_figure(CLI::App& app, Run& run) {
  auto* figure = app.add_subcommand("figure", "the figures of the scene, and what pins them");
  figure->require_subcommand(1);
  add_entity(figure, run, "figure", "body", list_figures, get_figure, remove_figure);
  struct Set {
    std::string id, template_name, file, label;
    double stature = 0.0;
  };
  auto args = std::make_shared<Set>();
  auto* set = example(figure->add_subcommand("set", "bring a figure in, or change it"),
                      "posectl figure set body --template tempus --stature 1.62");
  set->add_option("id", args->id, "its name, or the whole figure as a JSON object")->required();
  auto* kind = set->add_option("--template", args->template_name, "a built-in one, as tempus")->type_name("NAME");
  auto* stature = set->add_option("--stature", args->stature, "of the template, metres")->type_name("M");
  set->add_option("--document", args->file, "a figure of your own; - reads standard input")
      ->type_name("FILE")
      ->excludes(kind)
      ->excludes(stature);
  auto* label = set->add_option("--label", args->label, "kept with it")->type_name("TEXT");
  set->callback([&run, args, stature, label] {
    if (args->id.starts_with('{')) {
      run = [args](const Session& s) { return set_entity(s, "figure.set", args->id); };
      return;
    }
    proto::FigureSet edit;
    edit.id = args->id;
    if (!args->template_name.empty()) edit.template_name = args->template_name;
    if (*stature) edit.stature = args->stature;
    if (*label) edit.label = args->label;
    run = [edit, args](const Session& s) { return set_figure(s, edit, args->file); };
  });

  struct Pinned {
    std::string segment, hold = "pose", figure;
  };
  auto pinned = std::make_shared<Pinned>();
  auto* pin = example(figure->add_subcommand("pin", "hold a segment where it is, before all goals; or let it go"),
                      "posectl figure pin left_foot pose");
  pin->add_option("segment", pinned->segment, "as in left_foot")->required();
  pin->add_option("hold", pinned->hold, "default: pose; none lets go")
      ->type_name("position|orientation|pose|none")
      ->check(CLI::IsMember({"position", "orientation", "pose", "none"}).description(""));
  pin->add_option("--figure", pinned->figure, "needed where there are several")->type_name("ID");
  pin->callback([&run, pinned] {
    run = [pinned](const Session& s) { return pin_segment(s, pinned->figure, pinned->segment, pinned->hold); };
  });
}

void add_joint(CLI::App& app, Run& run) {
  auto* joint = app.add_subcommand("joint", "one joint of a figure");
  joint->require_subcommand(1);
  struct Set {
    proto::JointSet edit;
    double halfplane = 0.0, deviation = 0.0, twist = 0.0;
    bool degrees = false;
  };
  auto args = std::make_shared<Set>();
  auto* get = example(joint->add_subcommand("get", "how it is turned"), "posectl joint get left_elbow");
  auto* set = example(joint->add_subcommand("set", "turn it; goals that hold its limb pull back at once"),
                      "posectl joint set left_elbow --deviation 70 --degrees");
  for (CLI::App* command : {get, set}) {
    command->add_option("joint", args->edit.joint, "as in left_elbow")->required();
    command->add_option("--figure", args->edit.figure, "needed where there are several")->type_name("ID");
    command->add_flag("--degrees", args->degrees, "angles in degrees; default: radians");
  }
  get->callback([&run, args] {
    run = [args](const Session& s) { return get_joint(s, args->edit.figure, args->edit.joint, args->degrees); };
  });
  auto* value =
      set->add_option("value", args->edit.value, "its share of q: an angle, a length, or a quaternion x y z w")
          ->expected(1, 7);
  std::vector<std::pair<CLI::Option*, std::optional<double> proto::JointSet::*>> parts;
  const auto angle = [&](const char* name, double Set::*to, std::optional<double> proto::JointSet::*field,
                         const char* help) {
    parts.emplace_back(set->add_option(name, (*args).*to, help)->type_name("ANGLE")->excludes(value), field);
  };
  angle("--halfplane", &Set::halfplane, &proto::JointSet::halfplane, "to which side the limb leaves its place at rest");
  angle("--deviation", &Set::deviation, &proto::JointSet::deviation, "how far from its place at rest");
  angle("--twist", &Set::twist, &proto::JointSet::twist, "about the limb itself");
  set->callback([&run, args, parts] {
    const double unit = args->degrees ? 3.14159265358979323846 / 180.0 : 1.0;
    const double values[] = {args->halfplane, args->deviation, args->twist};
    for (std::size_t i = 0; i < parts.size(); ++i)
      if (*parts[i].first) args->edit.*parts[i].second = unit * values[i];
    if (args->edit.value.size() == 1) args->edit.value[0] *= unit;
    if (args->edit.value.empty() && !args->edit.halfplane && !args->edit.deviation && !args->edit.twist)
      throw CLI::RequiredError("a value, or --halfplane, --deviation or --twist");
    run = [args](const Session& s) { return set_joint(s, args->edit); };
  });
}

void add_pose(CLI::App& app, Run& run) {
  auto* pose = app.add_subcommand("pose", "read and change the pose");
  pose->require_subcommand(1);
  auto figure = std::make_shared<std::string>();
  auto to = std::make_shared<std::string>("rest");

  auto* get = pose->add_subcommand("get", "the newest pose, with its goals");
  example(get, "posectl pose get");
  get->callback([&run, figure] { run = [figure](const Session& s) { return get_pose(s, *figure); }; });
  auto* reset = pose->add_subcommand("reset", "back to the rest pose, or to the start pose");
  example(reset, "posectl pose reset start");
  reset->add_option("to", *to, "default: rest")
      ->type_name("rest|start")
      ->check(CLI::IsMember({"rest", "start"}).description(""));
  reset->callback([&run, figure, to] { run = [figure, to](const Session& s) { return reset_pose(s, *figure, *to); }; });
  auto* mirror = pose->add_subcommand("mirror", "exchange left and right");
  example(mirror, "posectl pose mirror");
  mirror->callback([&run, figure] { run = [figure](const Session& s) { return mirror_pose(s, *figure); }; });
  for (CLI::App* command : {get, reset, mirror}) {
    command->add_option("--figure", *figure, "needed where there are several")->type_name("ID");
  }
}

}  // namespace posed::cli
