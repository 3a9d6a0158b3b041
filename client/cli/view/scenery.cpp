#include "client/cli/view/scenery.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

#include "client/cli/view/palette.h"
#include "client/cli/view/shapes.h"

namespace posed::view {
namespace {

constexpr double kGridReach = 2.0;       // m
constexpr double kLeastGridDots = 24.0;  // between two lines of the floor
constexpr double kApart = 0.03, kApartDots = 2.2;
constexpr double kStick = 0.02;  // m, radius of a segment that has no shape
constexpr double kTriad = 0.07;  // m, the axes of a sensor
constexpr double kCone = 0.18;   // m, how far a camera's edges reach

// One pane, with what all its parts need.
struct Drawing {
  Canvas& canvas;
  const Camera& camera;
  View view;
  const Station& station;
  int part = 0;

  // A straight line in the world that nothing hides.
  void line(Vec3 a, Vec3 b, Layer layer, int color, int period) const {
    if (camera.perspective) {
      const double near = 1.01 * Camera::kNear;
      const double da = glm::dot(camera.eye - a, camera.back), db = glm::dot(camera.eye - b, camera.back);
      if (da < near && db < near) return;
      const Vec3 cut = a + (b - a) * ((near - da) / (db - da));
      if (da < near) a = cut;
      if (db < near) b = cut;
    }
    const auto from = camera.project(a), to = camera.project(b);
    if (from && to) canvas.line(from->x, from->y, to->x, to->y, layer, color, period);
  }

  // Metres a dot, about the middle of what is seen.
  double dot() const { return camera.metres_a_dot(camera.perspective ? glm::length(camera.eye) : 1.0); }

  void floor() const {
    if (view == View::front || view == View::side) {
      const auto at = camera.project(kZero);
      canvas.line(0, at->y, canvas.width() - 1, at->y, Layer::floor, kFloorLine, 2);
    } else {
      const double step = 0.5 < kLeastGridDots * dot() ? 1.0 : 0.5;
      for (double at = -kGridReach; at <= kGridReach + 1e-9; at += step) {
        line(Vec3(at, -kGridReach, 0), Vec3(at, kGridReach, 0), Layer::floor, kFloor, 4);
        line(Vec3(-kGridReach, at, 0), Vec3(kGridReach, at, 0), Layer::floor, kFloor, 4);
      }
    }
    for (std::size_t i = 0; i < 3; ++i) {
      // An axis that points at us is no line.
      const Vec3 axis = i == 0 ? kX : i == 1 ? kY : kZ;
      if (std::abs(glm::dot(axis, camera.back)) < 0.99 && (i < 2 || camera.perspective))
        line(kZero, 0.25 * axis, Layer::floor, kAxes[i], 1);
    }
  }

  void shapes(const std::vector<Shape>& all, const Transform& place, Layer layer, Tone tone, double least) {
    ++part;
    for (const Shape& shape : all)
      draw_shape(canvas, camera, shape, place, layer, part,
                 [&](double light) { return shaded(tone, least + (1.0 - least) * light); });
  }

  // A sensor by its axes.
  void triad(const Transform& place) const {
    for (std::size_t i = 0; i < 3; ++i) {
      const Vec3 axis = i == 0 ? kX : i == 1 ? kY : kZ;
      line(place.position, place * (kTriad * axis), Layer::mark, kAxes[i], 1);
    }
  }

  // A camera by the edges of what it sees, four to three, along its X with Z up.
  void cone(const proto::CameraFrame& frame) const {
    const double up = kCone * std::tan(frame.fov_y / 2.0), side = up * 4.0 / 3.0;
    const std::array corners{Vec3(kCone, side, up), Vec3(kCone, -side, up), Vec3(kCone, -side, -up),
                             Vec3(kCone, side, -up)};
    for (std::size_t i = 0; i < 4; ++i) {
      const Vec3 corner = frame.world_from_camera * corners[i];
      line(frame.world_from_camera.position, corner, Layer::mark, kCamera, 1);
      line(corner, frame.world_from_camera * corners[(i + 1) % 4], Layer::mark, kCamera, 1);
    }
  }

  void objects() {
    for (const Object& object : station.entities->objects)
      shapes(object.shapes, station.world_from_object(object), Layer::object, Tone::object, 0.2);
  }

  void figure(const proto::FigurePose& pose) {
    const auto found = station.entities->figures.find(pose.figure);
    // A figure may change before we have heard of its new segments.
    if (found == station.entities->figures.end()) return;
    const FigureDocument& document = found->second.document;
    if (document.segments.size() != pose.world_from_segment.size()) return;
    std::set<std::string> left, right;
    for (const auto& [one, other] : document.mirror) left.insert(one), right.insert(other);
    for (std::size_t i = 0; i < document.segments.size(); ++i) {
      const Segment& segment = document.segments[i];
      const Tone tone = left.contains(segment.name)    ? Tone::left
                        : right.contains(segment.name) ? Tone::right
                                                       : Tone::middle;
      const Shape stick{Shape::Kind::capsule, kZero, segment.touch_point, kStick};
      shapes(segment.shapes.empty() ? std::vector{stick} : segment.shapes, pose.world_from_segment[i], Layer::figure,
             tone, 0.15);
    }
  }
};

struct Mark {
  Camera::Point at;
  char32_t glyph;
  Style style;
};

char32_t mark_glyph(bool chosen, bool touch, Glyphs glyphs) {
  if (glyphs == Glyphs::ascii) return touch ? U'o' : chosen ? U'X' : U'+';
  if (touch) return U'•';
  return glyphs == Glyphs::blocks ? (chosen ? U'■' : U'□') : (chosen ? U'◆' : U'◇');
}

// Where the segments that are pinned are held: at their touch points.
void mark_pins(const Camera& camera, const Station& station, const proto::FigurePose& pose, Glyphs glyphs,
               std::vector<Mark>& marks) {
  const auto found = station.entities->figures.find(pose.figure);
  if (found == station.entities->figures.end()) return;
  const std::vector<Segment>& segments = found->second.document.segments;
  if (segments.size() != pose.world_from_segment.size()) return;
  for (std::size_t i = 0; i < segments.size(); ++i) {
    if (!found->second.entry.pins.contains(segments[i].name)) continue;
    const auto at = camera.project(pose.world_from_segment[i] * segments[i].touch_point);
    if (at) marks.push_back({*at, glyphs == Glyphs::ascii ? U'#' : U'▪', Style{kPin}});
  }
}

}  // namespace

const Transform& Station::world_from_object(const Object& object) const {
  if (pose) {
    for (const proto::ObjectFrame& led : pose->objects)
      if (led.object == object.id) return led.world_from_object;
  }
  return object.world_from_object;
}

const proto::GoalResult* Entities::goal(const std::string& id) const {
  const auto found = std::find_if(goals.begin(), goals.end(), [&](const auto& g) { return g.goal.id == id; });
  return found == goals.end() ? nullptr : &*found;
}

const Binding* Entities::bound_to(const std::string& goal) const {
  const auto found = std::find_if(bindings.begin(), bindings.end(), [&](const auto& b) { return b.to.goal == goal; });
  return found == bindings.end() ? nullptr : &*found;
}

void draw_scenery(Grid& grid, const Pane& pane, const Station& station, const std::string& chosen,
                  const std::map<std::string, Vec3>& moved, Glyphs glyphs) {
  Canvas canvas(pane.size.columns, pane.size.rows);
  Drawing drawing{canvas, pane.camera, pane.view, station};
  canvas.set_apart(std::max(kApart, kApartDots * drawing.dot()));
  drawing.floor();
  drawing.objects();
  std::vector<Mark> marks;
  for (const proto::FigurePose& figure : station.pose ? station.pose->figures : std::vector<proto::FigurePose>{}) {
    drawing.figure(figure);
    mark_pins(pane.camera, station, figure, glyphs, marks);
    for (const proto::GoalFrame& goal : figure.goals) {
      const proto::GoalResult* entity = station.entities->goal(goal.id);
      if (entity != nullptr && !takes_hold(kind_of(entity->goal.payload))) continue;
      const bool is_chosen = goal.id == chosen;
      const Style style{color_of(goal.state), -1, is_chosen};
      const auto on_its_way = moved.find(goal.id);
      const Vec3 target = on_its_way == moved.end() ? goal.target : on_its_way->second;
      drawing.line(goal.touch, target, Layer::mark, style.fg, is_chosen ? 1 : 2);
      for (const bool touch : {true, false}) {
        const auto at = pane.camera.project(touch ? goal.touch : target);
        if (at) marks.push_back({*at, mark_glyph(is_chosen, touch, glyphs), style});
      }
    }
  }
  for (const auto& [sensor, place] : station.sensors) {
    drawing.triad(place);
    if (const auto at = pane.camera.project(place.position))
      marks.push_back({*at, glyphs == Glyphs::ascii ? U'*' : U'✶', Style{kSensor}});
  }
  for (const proto::CameraFrame& camera : station.cameras) {
    drawing.cone(camera);
    if (const auto at = pane.camera.project(camera.world_from_camera.position))
      marks.push_back({*at, glyphs == Glyphs::ascii ? U'>' : U'▸', Style{kCamera}});
  }
  canvas.draw(grid, pane.column, pane.row, glyphs);
  // The chosen goal's above the others', and cubes above touch points.
  std::stable_sort(marks.begin(), marks.end(),
                   [&](const Mark& a, const Mark& b) { return a.style.bold < b.style.bold; });
  for (const Mark& mark : marks) {
    const int x = static_cast<int>(std::floor(std::clamp(mark.at.x, -1e4, 1e4) / 2.0 + 0.25));
    const int y = static_cast<int>(std::floor(std::clamp(mark.at.y, -1e4, 1e4) / 4.0 + 0.125));
    if (x >= 0 && y >= 0 && x < pane.size.columns && y < pane.size.rows)
      grid.put(pane.column + x, pane.row + y, {mark.glyph, mark.style});
  }
}

Box bounds(const Station& station) {
  Box box;
  for (const proto::FigurePose& figure : station.pose ? station.pose->figures : std::vector<proto::FigurePose>{}) {
    const auto found = station.entities->figures.find(figure.figure);
    for (std::size_t i = 0; i < figure.world_from_segment.size(); ++i) {
      box.add(figure.world_from_segment[i].position);
      if (found == station.entities->figures.end() || i >= found->second.document.segments.size()) continue;
      for (const Shape& shape : found->second.document.segments[i].shapes) {
        const Ball ball = around(shape);
        box.add(figure.world_from_segment[i] * ball.center,
                shape.kind == Shape::Kind::capsule ? shape.radius : ball.radius);
      }
    }
    for (const proto::GoalFrame& goal : figure.goals) box.add(goal.target, 0.03);
  }
  for (const Object& object : station.entities->objects) {
    for (const Shape& shape : object.shapes) {
      const Ball ball = around(shape);
      box.add(station.world_from_object(object) * ball.center, ball.radius);
    }
  }
  if (box.empty()) box.add(Vec3(0, 0, 0.5), 0.5);
  return box;
}

}  // namespace posed::view
