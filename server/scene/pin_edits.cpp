#include "server/scene/errors.h"
#include "server/scene/goal_resolve.h"
#include "server/scene/scene.h"
#include "server/solver/kinematics.h"

namespace posed {
namespace {

// Where the segment stands, as a pin holds it.
void hold_here(const SceneFigure& figure, int segment, Pin& pin) {
  std::vector<Transform> world(static_cast<std::size_t>(figure.tree->size()));
  forward_kinematics(*figure.tree, figure.q, world);
  const Transform& t = world[static_cast<std::size_t>(segment)];
  if (!pin.position) pin.position = t * figure.tree->segment(segment).touch_point;
  if (!pin.rotation) pin.rotation = t.rotation;
}

}  // namespace

Status Scene::complete_pins(SceneFigure& figure) {
  std::map<std::string, Pin> pins;
  for (auto& [name, pin] : figure.entry.pins) {
    const std::string path = "/pins/" + token(name);
    const Result<AttachedPoint> place = figure.tree->attach({name, {}, ""});
    if (!place) return below(path, place.error());
    for (int i = 0; pin.position && i < 3; ++i) {
      if (!(std::abs((*pin.position)[i]) <= kMaxCoordinate))
        return Error{"out_of_range", "the position is too far away", path + "/position/" + std::to_string(i),
                     "within 1000 km of the origin"};
    }
    if (pin.rotation && !(std::abs(glm::length(*pin.rotation) - 1.0) <= kUnitQuatTolerance))
      return Error{"invalid_params", "the quaternion is not of unit length", path + "/quat_xyzw",
                   "x y z w, with x²+y²+z²+w² = 1"};
    hold_here(figure, place->segment, pin);
    const std::string& segment = figure.tree->segment(place->segment).name;
    if (!pins.emplace(segment, pin).second)
      return Error{"invalid_params", "segment " + segment + " is pinned twice", path, "leave one of the two out"};
  }
  figure.entry.pins = std::move(pins);
  return Ok{};
}

Result<Edited> Scene::set_pins(const std::string& id, std::map<std::string, Pin> pins, IfRevision if_revision) {
  const Result<const SceneFigure*> found = find_figure(id);
  if (!found) return found.error();
  SceneFigure& figure = figures_.at((*found)->entry.id);
  if (const auto error = stale(figures_, figure.entry.id, if_revision)) return *error;
  SceneFigure pinned = figure;
  pinned.entry.pins = std::move(pins);
  if (const Status complete = complete_pins(pinned); !complete) return complete.error();
  keep_figure(figure.entry.id);
  figure = std::move(pinned);
  figure.revision = next_figure_revision(figure.entry.id);
  return Edited{figure.entry.id, count(), figure.revision};
}

Result<Edited> Scene::pin(const std::string& id, const std::string& segment, std::optional<Pin::Hold> hold,
                          IfRevision if_revision) {
  const Result<const SceneFigure*> found = find_figure(id);
  if (!found) return found.error();
  SceneFigure& figure = figures_.at((*found)->entry.id);
  const Result<AttachedPoint> place = figure.tree->attach({segment, {}, ""});
  if (!place) return below("/segment", place.error());
  if (const auto error = stale(figures_, figure.entry.id, if_revision)) return *error;
  const std::string& name = figure.tree->segment(place->segment).name;
  keep_figure(figure.entry.id);
  figure.entry.pins.erase(name);
  if (hold) {
    Pin pin{*hold, {}, {}};
    hold_here(figure, place->segment, pin);
    figure.entry.pins.emplace(name, pin);
  }
  figure.revision = next_figure_revision(figure.entry.id);
  return Edited{figure.entry.id, count(), figure.revision};
}

}  // namespace posed
