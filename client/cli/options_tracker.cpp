#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <memory>
#include <tuple>

#include "client/cli/options_parts.h"

namespace posed::cli {
namespace {

CLI::Option* add_point(CLI::App* command, const char* name, std::vector<double>& out, const char* help) {
  return command->add_option(name, out, help)->expected(3)->type_name("X Y Z");
}

void add_leases(CLI::App* tracker, Run& run) {
  struct Lease {
    std::string tracker;
    bool force = false;
    double seconds = 0.0;
  };
  auto lease = std::make_shared<Lease>();
  const auto add = [&](const char* name, const char* help, const char* line) {
    auto* command = example(tracker->add_subcommand(name, help), line);
    command->add_option("tracker", lease->tracker, "as tracker list names it")->required();
    command->add_flag("--force", lease->force, "whoever holds it");
    return command;
  };
  auto* grab = add("grab", "keep others from configuring and calibrating it, until Ctrl-C",
                   "posectl tracker grab simulated --seconds 1");
  grab->add_option("--seconds", lease->seconds, "and no longer")->check(CLI::PositiveNumber)->type_name("S");
  grab->callback([&run, lease] {
    run = [lease](const Session& s) { return grab_tracker(s, {lease->tracker, lease->force}, lease->seconds); };
  });
  add("release", "end whoever's hold, with --force", "posectl tracker release simulated --force")
      ->callback([&run, lease] {
        run = [lease](const Session& s) { return release_tracker(s, {lease->tracker, lease->force}); };
      });
  add("reset", "its settings as they began, and no calibration", "posectl tracker reset simulated")
      ->callback([&run, lease] {
        run = [lease](const Session& s) { return reset_tracker(s, {lease->tracker, lease->force}); };
      });
}

void add_configure(CLI::App* tracker, Run& run) {
  struct Configure {
    proto::TrackerConfigure message;
    std::string calibration;
    double rate = 0.0;
    std::vector<std::string> sensors, hemisphere;
    std::vector<double> position_filter, attitude_filter;
  };
  auto args = std::make_shared<Configure>();
  auto* command = tracker->add_subcommand("configure", "settings of the device, and the calibration that counts");
  example(command, "posectl tracker configure simulated --calibration none");
  command->add_option("tracker", args->message.tracker)->required();
  command->add_flag("--force", args->message.force, "whoever holds it");
  auto* calibration = command->add_option("--calibration", args->calibration, "one that is kept, or none");
  auto* rate = command->add_option("--rate", args->rate, "frames a second")->type_name("HZ");
  auto* sensors = command->add_option("--sensors", args->sensors, "those that are active")->type_name("SENSOR...");
  auto* hemisphere = command->add_option("--hemisphere", args->hemisphere, "towards the half of the field it is in")
                         ->expected(4)
                         ->type_name("SENSOR X Y Z");
  constexpr const char* kNumbers = "SENSITIVITY LOW HIGH MAX";
  const auto filter = [&](const char* name, std::vector<double>& out, const char* help) {
    return command->add_option(name, out, help)->expected(4)->type_name(kNumbers);
  };
  auto* position = filter("--position-filter", args->position_filter, "the device's own; 0 0 0 0 is off");
  auto* attitude = filter("--attitude-filter", args->attitude_filter, "the device's own; 0 0 0 0 is off");
  command->callback([=, &run] {
    proto::TrackerConfigure m = args->message;
    if (*calibration)
      m.calibration = args->calibration == "none" ? Patched<std::string>::reset() : Patched(args->calibration);
    if (*rate) m.rate_hz = args->rate;
    if (*sensors) m.sensors = args->sensors;
    if (*hemisphere) {
      try {
        m.hemisphere[args->hemisphere[0]] = {std::stod(args->hemisphere[1]), std::stod(args->hemisphere[2]),
                                             std::stod(args->hemisphere[3])};
      } catch (const std::logic_error&) {
        throw CLI::ValidationError("--hemisphere wants a sensor and three numbers, as in liberty:1 0 0 1", 1);
      }
    }
    const auto numbers = [](const std::vector<double>& v) {
      return proto::DeviceFilter{v != std::vector<double>(4, 0.0), v[0], v[1], v[2], v[3]};
    };
    if (*position) m.position_filter = numbers(args->position_filter);
    if (*attitude) m.attitude_filter = numbers(args->attitude_filter);
    run = [m](const Session& s) { return configure_tracker(s, m); };
  });
}

void add_calibration(CLI::App* tracker, Run& run) {
  struct Measure {
    Align align;
    std::vector<std::tuple<double, double, double>> points;
    std::vector<double> point, quat;
    double seconds = 0.0;
  };
  auto args = std::make_shared<Measure>();
  const auto add = [&](const char* name, const char* help, const char* line) {
    auto* command = example(tracker->add_subcommand(name, help), line);
    command->add_option("sensor", args->align.sensor, "as in liberty:1")->required();
    command->add_option("--seconds", args->seconds, "how long to measure")->check(CLI::PositiveNumber)->type_name("S");
    command->add_flag("--force", args->align.force, "whoever holds the tracker");
    return command;
  };
  const auto for_ms = [](double seconds, int otherwise) {
    return seconds > 0.0 ? static_cast<int>(seconds * 1000.0) : otherwise;
  };
  const auto named = [&](CLI::App* command) {
    command->add_option("--name", args->align.name, "of the calibration; default: the chosen one");
  };

  auto* align = add("align", "where its source is: touch known points of the world, three or more",
                    "posectl tracker align fastrak:1 --point 0 0 0.8 --point 0.4 0 0.8 --point 0 0.3 0.8");
  named(align);
  align->add_option("--point", args->points, "where it is, in metres; once for each point")
      ->required()
      ->type_name("X Y Z");
  align->callback([=, &run] {
    Align wish = args->align;
    for (const auto& [x, y, z] : args->points) wish.points.push_back({x, y, z});
    wish.for_ms = for_ms(args->seconds, wish.for_ms);
    run = [wish](const Session& s) { return align_tracker(s, wish); };
  });

  auto* tip = add("tip", "where a stylus's tip is: hold it in one place and swing the other end",
                  "posectl tracker tip simulated:1 --offset 0.15 0 0");
  named(tip);
  auto* offset = add_point(tip, "--offset", args->point, "of the tip in the sensor's frame, where you know it");
  tip->callback([=, &run] {
    proto::TrackerTip m{args->align.sensor, args->align.name, args->align.force, for_ms(args->seconds, 5000), {}};
    if (*offset) m.offset = vector_from(args->point);
    run = [m](const Session& s) { return calibrate_tip(s, m); };
  });

  auto* check = add("check", "how far off it is at a known point (default: the first of the alignment's)",
                    "posectl tracker check simulated:1 0.4 0 0.8 --seconds 0.2");
  auto* where = add_point(check, "point", args->point, "of the world, in metres");
  check->callback([=, &run] {
    proto::TrackerTouch m{args->align.sensor, args->align.force, for_ms(args->seconds, 500), {}};
    if (*where) m.point = vector_from(args->point);
    run = [m](const Session& s) { return check_tracker(s, m); };
  });

  auto* boresight = add("boresight", "how the sensor turns now is straight ahead",
                        "posectl tracker boresight simulated:1 --seconds 0.2");
  named(boresight);
  auto* quat = boresight->add_option("--quat", args->quat, "or this, in the world")->expected(4)->type_name("X Y Z W");
  boresight->callback([=, &run] {
    proto::TrackerBoresight m{args->align.sensor, args->align.name, args->align.force, for_ms(args->seconds, 500), {}};
    m.rotation = *quat ? quat_from_xyzw(args->quat) : quat_identity();
    run = [m](const Session& s) { return boresight_tracker(s, m); };
  });

  auto forgotten = std::make_shared<proto::TrackerForget>();
  auto* forget = example(tracker->add_subcommand("forget", "keep a calibration no longer"),
                         "posectl tracker forget simulated monday");
  forget->add_option("tracker", forgotten->tracker, "as tracker list names it")->required();
  forget->add_option("calibration", forgotten->name, "its name")->required();
  forget->add_flag("--force", forgotten->force, "whoever holds the tracker");
  forget->callback([=, &run] { run = [m = *forgotten](const Session& s) { return forget_calibration(s, m); }; });
}

BindingTarget read_target(const std::string& text) {
  const std::size_t colon = text.find(':');
  const std::string kind = text.substr(0, colon), id = colon == std::string::npos ? "" : text.substr(colon + 1);
  BindingTarget to;
  if (kind == "goal") to.goal = id;
  if (kind == "object") to.object = id;
  if (kind == "camera") to.camera = id;
  if (kind == "joint") to.joint = id;
  if (const std::size_t slash = to.joint.find('/'); slash != std::string::npos) {
    to.figure = to.joint.substr(0, slash);
    to.joint = to.joint.substr(slash + 1);
  }
  if (to == BindingTarget{} || id.empty())
    throw CLI::ValidationError(
        text + " names no target: goal:ID, object:ID, camera:ID, joint:NAME or joint:FIGURE/NAME", 1);
  return to;
}

Axes read_axes(const std::vector<std::string>& words) {
  Axes axes;
  for (const std::string& word : words) {
    bool* const axis = word == "x"    ? &axes.x
                       : word == "y"  ? &axes.y
                       : word == "z"  ? &axes.z
                       : word == "rx" ? &axes.rx
                       : word == "ry" ? &axes.ry
                       : word == "rz" ? &axes.rz
                                      : nullptr;
    if (!axis) throw CLI::ValidationError(word + " is no axis: x y z rx ry rz", 1);
    *axis = true;
  }
  return axes;
}

// "1=recenter"
std::vector<ButtonAction> read_buttons(const std::vector<std::string>& words) {
  std::vector<ButtonAction> buttons;
  for (const std::string& word : words) {
    ButtonAction& action = buttons.emplace_back();
    int end = 0;
    const bool number = std::sscanf(word.c_str(), "%d=%n", &action.button, &end) == 1 && end > 0;
    const std::string act = number ? word.substr(static_cast<std::size_t>(end)) : "";
    const auto name = std::find(kButtonActionNames.begin(), kButtonActionNames.end(), act);
    if (name == kButtonActionNames.end())
      throw CLI::ValidationError(word + " names no button and what it does: 1=recenter, 1=toggle or 1=save", 1);
    action.act = static_cast<ButtonAction::Do>(name - kButtonActionNames.begin());
  }
  return buttons;
}

void add_bindings(CLI::App* tracker, Run& run) {
  struct Bind {
    std::string sensor, target, id;
    bool relative = false;
    int clutch = 0;
    double scale = 1.0, predict = 0.0;
    std::vector<std::string> axes, buttons;
    std::vector<double> offset, filter;
  };
  auto args = std::make_shared<Bind>();
  auto* bind = tracker->add_subcommand("bind", "let a sensor move something");
  example(bind, "posectl tracker bind simulated:2 object:chair");
  bind->add_option("sensor", args->sensor, "as in liberty:1")->required();
  bind->add_option("target", args->target, "goal:ID, object:ID, camera:ID or joint:NAME")->required();
  bind->add_option("--id", args->id, "of the binding; default: the sensor, as in liberty.1");
  bind->add_flag("--relative", args->relative, "moves from where it stands");
  auto* clutch = bind->add_option("--clutch", args->clutch, "only while this button is held; 0 is the first")
                     ->check(CLI::NonNegativeNumber)
                     ->type_name("BUTTON");
  auto* buttons = bind->add_option("--button", args->buttons, "what it does: recenter, toggle or save; 0 is the first")
                      ->type_name("BUTTON=DO");
  bind->add_option("--scale", args->scale, "of positions")->type_name("S");
  auto* axes = bind->add_option("--axes", args->axes, "as in x,y,rz; default: all it has")->delimiter(',');
  auto* offset = add_point(bind, "--offset", args->offset, "of the target, as the sensor sees it");
  auto* filter = bind->add_option("--filter", args->filter, "One-Euro; calmer with less, quicker with more")
                     ->expected(1, 2)
                     ->type_name("MIN_CUTOFF_HZ [BETA]");
  auto* predict = bind->add_option("--predict", args->predict, "looks ahead")->type_name("MS");
  bind->callback([=, &run] {
    proto::BindingSet m;
    m.edit.id = args->id;
    m.edit.sensor = args->sensor;
    m.edit.to = read_target(args->target);
    m.edit.mode = args->relative ? Binding::Mode::relative : Binding::Mode::absolute;
    if (*clutch) m.edit.clutch = Clutch{args->clutch};
    if (*buttons) m.edit.buttons = read_buttons(args->buttons);
    m.edit.scale = args->scale;
    if (*axes) m.edit.axes = read_axes(args->axes);
    if (*offset) m.edit.offset = SensorOffset{vector_from(args->offset), quat_identity()};
    if (*filter || *predict) {
      BindingFilter f;
      f.predict_ms = args->predict;
      if (*filter) f.one_euro = OneEuro{args->filter[0], args->filter.size() > 1 ? args->filter[1] : 0.0, 1.0};
      m.edit.filter = f;
    }
    run = [m](const Session& s) { return bind_sensor(s, m); };
  });

  auto* unbind = tracker->add_subcommand("unbind", "what the sensor moved stays where it is");
  example(unbind, "posectl tracker unbind hand");
  unbind->add_option("binding", args->id, "a binding's id, or a sensor")->required();
  unbind->callback([&run, args] { run = [args](const Session& s) { return unbind_sensor(s, args->id); }; });
  example(tracker->add_subcommand("bindings", "which sensor moves what"), "posectl tracker bindings")->callback([&run] {
    run = list_bindings;
  });
}

}  // namespace

void add_tracker(CLI::App& app, Run& run) {
  auto* tracker = app.add_subcommand("tracker", "the trackers: how they are, where they stand, and what they move");
  example(tracker, "posectl tracker");
  tracker->callback([tracker, &run] {
    if (tracker->get_subcommands().empty()) run = list_trackers;
  });
  example(tracker->add_subcommand("list", "all trackers (the default)"), "posectl tracker list")->callback([&run] {
    run = list_trackers;
  });
  add_bindings(tracker, run);
  add_calibration(tracker, run);
  add_leases(tracker, run);
  add_configure(tracker, run);
}

void add_camera(CLI::App& app, Run& run) {
  auto* camera = app.add_subcommand("camera", "list, set and remove cameras");
  camera->require_subcommand(1);
  example(camera->add_subcommand("list", "all cameras"), "posectl camera list")->callback([&run] {
    run = list_cameras;
  });
  struct Set {
    proto::CameraSet message;
    std::vector<double> position, at, quat;
    std::string segment, object, sensor;
    double fov_degrees = 0.0;
  };
  auto args = std::make_shared<Set>();
  auto* set = camera->add_subcommand("set", "put an eye somewhere: it looks along +X, +Z is up");
  example(set, "posectl camera set main 2 0 1.5 --look-at 0 0 1.2");
  set->add_option("id", args->message.edit.id)->required();
  set->add_option("position", args->position, "metres")->expected(3)->type_name("X Y Z");
  auto* at = add_point(set, "--look-at", args->at, "a point that it looks at");
  auto* quat = set->add_option("--quat", args->quat, "how it turns")->expected(4)->excludes(at)->type_name("X Y Z W");
  auto* fov = set->add_option("--fov", args->fov_degrees, "from the lowest to the highest ray")->type_name("DEGREES");
  auto* segment = set->add_option("--segment", args->segment, "that it rides on: head, or FIGURE/head");
  auto* object = set->add_option("--object", args->object, "that it rides on")->excludes(segment);
  auto* sensor = set->add_option("--sensor", args->sensor, "that it rides on")->excludes(segment)->excludes(object);
  set->callback([=, &run] {
    CameraEdit& edit = args->message.edit;
    if (!args->position.empty()) edit.position = vector_from(args->position);
    if (*at) {
      if (args->position.empty()) throw CLI::ValidationError("--look-at wants the position, too", 1);
      edit.rotation = looking(vector_from(args->position), vector_from(args->at));
    }
    if (*quat) edit.rotation = quat_from_xyzw(args->quat);
    if (*fov) edit.fov_y = args->fov_degrees * M_PI / 180.0;
    GoalBase base;
    if (*segment) {
      const std::size_t slash = args->segment.find('/');
      base.kind = GoalBase::Kind::segment;
      base.figure = slash == std::string::npos ? "" : args->segment.substr(0, slash);
      base.segment = args->segment.substr(slash == std::string::npos ? 0 : slash + 1);
    }
    if (*object) base = {GoalBase::Kind::object, "", "", "", args->object};
    if (*sensor) base = {GoalBase::Kind::sensor, "", "", args->sensor};
    if (*segment || *object || *sensor) edit.relative_to = base;
    run = [args](const Session& s) { return set_camera(s, args->message); };
  });
  auto id = std::make_shared<std::string>();
  auto* remove = example(camera->add_subcommand("remove", "remove one camera"), "posectl camera remove main");
  remove->add_option("id", *id)->required();
  remove->callback([&run, id] { run = [id](const Session& s) { return remove_camera(s, *id); }; });
}

}  // namespace posed::cli
