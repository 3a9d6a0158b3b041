#include <map>

#include "client/cli/options_parts.h"

namespace posed::cli {
namespace {

// What `goal set` was given.
struct Set {
  std::string at, id, figure, relative_to, label, distance_to, posture, tolerance;
  std::vector<double> position, orientation, aim, along, axis{1.0, 0.0, 0.0}, plane, normal, line, direction;
  std::vector<std::string> balance;
  double weight = 0.0, length = 0.0, margin = 0.0;
  int priority = 0;
  bool above = false, off = false, on = false;
  DistanceTarget::Compare compare = DistanceTarget::Compare::equal;
};

// "world", "object:chair", "segment:head", "segment:FIGURE/head" or "sensor:liberty:1".
GoalBase base_from(const std::string& text) {
  if (text == "world") return {};
  const std::size_t colon = text.find(':');
  const std::string kind = text.substr(0, colon), name = colon == std::string::npos ? "" : text.substr(colon + 1);
  if (kind == "object" && !name.empty()) return {GoalBase::Kind::object, "", "", "", name};
  if (kind == "sensor" && !name.empty()) return {GoalBase::Kind::sensor, "", "", name};
  if (kind == "segment" && !name.empty()) {
    const std::size_t slash = name.find('/');
    if (slash == std::string::npos) return {GoalBase::Kind::segment, "", name, ""};
    return {GoalBase::Kind::segment, name.substr(0, slash), name.substr(slash + 1), ""};
  }
  throw CLI::ValidationError("--relative-to", "is world, object:ID, segment:NAME, segment:FIGURE/NAME or sensor:ID");
}

// "0.01" or "0.01,0.01,0.2".
GoalTolerance tolerance_from(const std::string& text) {
  std::vector<double> sides;
  for (const std::string& word : CLI::detail::split(text, ',')) {
    if (!CLI::detail::lexical_cast(word, sides.emplace_back()) || sides.size() > 3)
      throw CLI::ValidationError("--tolerance", "is a radius in metres, 0.01, or a box, 0.01,0.01,0.2");
  }
  if (sides.size() == 2) throw CLI::ValidationError("--tolerance", "is one number, or three");
  return sides.size() == 1 ? GoalTolerance(sides[0]) : GoalTolerance(vector_from(sides));
}

void set_payload(const Set& set, GoalEdit& edit) {
  if (!set.position.empty()) edit.position = vector_from(set.position);
  if (!set.orientation.empty()) edit.orientation = OrientationTarget{quat_from_xyzw(set.orientation)};
  if (!set.aim.empty()) edit.aim = AimTarget{vector_from(set.axis), vector_from(set.aim), {}};
  if (!set.along.empty()) edit.aim = AimTarget{vector_from(set.axis), {}, vector_from(set.along)};
  if (!set.plane.empty())
    edit.plane = PlaneTarget{vector_from(set.plane), set.normal.empty() ? kZ : vector_from(set.normal),
                             set.above ? PlaneTarget::Side::above : PlaneTarget::Side::on};
  if (!set.line.empty()) edit.line = LineTarget{vector_from(set.line), vector_from(set.direction)};
  if (!set.distance_to.empty())
    edit.distance = DistanceTarget{attachment_from(set.distance_to), set.length, set.compare};
  if (!set.balance.empty()) {
    edit.balance = BalanceTarget{{}, set.margin};
    for (const std::string& word : set.balance) edit.balance->support.push_back(attachment_from(word));
  }
  if (!set.posture.empty()) edit.posture = PostureTarget{set.posture, {}};
}

void add_set(CLI::App* goal, Run& run) {
  static const std::map<std::string, DistanceTarget::Compare> kCompare{{"equal", DistanceTarget::Compare::equal},
                                                                       {"at_least", DistanceTarget::Compare::at_least},
                                                                       {"at_most", DistanceTarget::Compare::at_most}};
  auto args = std::make_shared<Set>();
  auto* set = goal->add_subcommand("set", "make a goal of any kind, or change what is named of one that is there");
  example(set,
          "posectl goal set right_hand 0.5 -0.3 1.2 --weight 40\n"
          "  posectl goal set head/eyes --aim 2 0.5 1.2 --priority 1\n"
          "  posectl goal set --balance left_foot right_foot --margin 0.02\n"
          "  posectl goal set --id body.right_hand.position --weight 10");
  set->add_option("at", args->at, "right_hand, right_hand/fingertip, or the whole goal as a JSON object");
  set->add_option("position", args->position, "metres, Z up")->expected(3)->type_name("X Y Z");
  const auto three = [&](const char* name, std::vector<double>& to, const char* help) {
    return set->add_option(name, to, help)->expected(3)->type_name("X Y Z");
  };
  set->add_option("--orientation", args->orientation, "turned so; with a position a pose")
      ->expected(4)
      ->type_name("X Y Z W");
  auto* aim = three("--aim", args->aim, "an axis of it points at this place");
  three("--along", args->along, "an axis of it points in this direction")->excludes(aim);
  three("--axis", args->axis, "that axis, in the segment's frame; default: 1 0 0");
  auto* plane = three("--plane", args->plane, "on the plane through this place");
  three("--normal", args->normal, "of the plane; default: 0 0 1")->needs(plane);
  set->add_flag("--above", args->above, "not on the plane, but where its normal points to")->needs(plane);
  auto* direction = three("--direction", args->direction, "of the line");
  three("--line", args->line, "on the line through this place")->needs(direction);
  auto* length = set->add_option("--length", args->length, "of the distance, metres")->type_name("M");
  auto* distance = set->add_option("--distance-to", args->distance_to, "so far from this place on the same figure")
                       ->needs(length)
                       ->type_name("AT");
  length->needs(distance);
  set->add_option("--compare", args->compare, "of the distance; default: equal")
      ->transform(CLI::CheckedTransformer(kCompare).description(""))
      ->needs(distance)
      ->type_name("equal|at_least|at_most");
  auto* balance = set->add_option("--balance", args->balance, "the centre of mass above what these places span")
                      ->expected(1, 32)
                      ->type_name("AT...");
  set->add_option("--margin", args->margin, "so far inside it, metres")->needs(balance)->type_name("M");
  set->add_option("--posture", args->posture, "all joints as in this pose")
      ->type_name("rest|start")
      ->check(CLI::IsMember({"rest", "start"}).description(""));

  set->add_option("--id", args->id, "default: FIGURE.SEGMENT.KIND")->type_name("ID");
  set->add_option("--figure", args->figure, "needed where there are several")->type_name("ID");
  auto* weight = set->add_option("--weight", args->weight, "default: 10; 0 is off")->type_name("W");
  auto* priority =
      set->add_option("--priority", args->priority, "lower ones are met first; default: 0")->type_name("N");
  auto* tolerance = set->add_option("--tolerance", args->tolerance, "met so near, metres; a position's may be a box")
                        ->type_name("M|X,Y,Z");
  set->add_option("--relative-to", args->relative_to, "world, object:ID, segment:NAME, sensor:ID; default: world")
      ->type_name("FRAME");
  auto* label = set->add_option("--label", args->label, "kept with it")->type_name("TEXT");
  auto* off = set->add_flag("--off", args->off, "it pulls no more");
  auto* on = set->add_flag("--on", args->on, "it pulls again")->excludes(off);
  set->callback([&run, set, args, weight, priority, tolerance, label, off, on] {
    if (args->at.starts_with('{')) {
      // --help and the like are the program's own, and never come here.
      if (set->count_all() > 1 + set->count("at")) throw CLI::ValidationError("a goal as JSON says all by itself", 1);
      run = [args](const Session& s) { return set_entity(s, "goal.set", args->at); };
      return;
    }
    proto::GoalSet request;
    GoalEdit& edit = request.edit;
    if (args->at.empty() && args->id.empty() && args->balance.empty() && args->posture.empty())
      throw CLI::RequiredError("a place to take hold of, or the --id of a goal that is there");
    edit.id = args->id;
    edit.figure = args->figure;
    if (!args->at.empty()) edit.at = attachment_from(args->at);
    set_payload(*args, edit);
    const bool empty = !edit.position && !edit.orientation && !edit.aim && !edit.plane && !edit.line &&
                       !edit.distance && !edit.balance && !edit.posture;
    if (empty && args->id.empty()) throw CLI::RequiredError("position, or another kind's options");
    if (!args->relative_to.empty()) edit.relative_to = base_from(args->relative_to);
    if (*weight) edit.weight = args->weight;
    if (*priority) edit.priority = args->priority;
    if (*tolerance) edit.tolerance = tolerance_from(args->tolerance);
    if (*label) edit.label = args->label;
    if (*off || *on) edit.enabled = args->on;
    run = [request](const Session& s) { return set_entity(s, request); };
  });
}

}  // namespace

Attachment attachment_from(const std::string& word) {
  Attachment at;
  const std::size_t slash = word.find('/');
  at.segment = word.substr(0, slash);
  if (slash != std::string::npos) at.site = word.substr(slash + 1);
  return at;
}

void add_goal(CLI::App& app, Run& run) {
  auto* goal = app.add_subcommand("goal", "what pulls at the figures");
  goal->require_subcommand(1);
  add_set(goal, run);
  add_entity(goal, run, "goal", "body.right_hand.position", list_goals, get_goal, remove_goal);
  auto figure = std::make_shared<std::string>();
  auto* clear = example(goal->add_subcommand("clear", "remove all goals"), "posectl goal clear --figure body");
  clear->add_option("--figure", *figure, "of this figure only")->type_name("ID");
  clear->callback([&run, figure] { run = [figure](const Session& s) { return clear_goals(s, *figure); }; });
}

}  // namespace posed::cli
