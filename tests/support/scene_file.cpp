#include "tests/support/scene_file.h"

#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <stdexcept>

#include "server/solver/kinematics.h"
#include "server/solver/tempus.h"

namespace posed::test {
namespace {

using nlohmann::json;

template <class T>
T expect(Result<T> result) {
  if (!result) throw std::runtime_error(result.error().message + " (" + result.error().hint + ")");
  return std::move(*result);
}

Vec3 vec3(const json& j) {
  return {j.at(0).get<double>(), j.at(1).get<double>(), j.at(2).get<double>()};
}

Attachment attachment(const json& j) {
  if (j.is_object()) return {j.at("segment").get<std::string>(), vec3(j.at("point")), ""};
  const auto text = j.get<std::string>();
  const auto slash = text.find('/');
  if (slash == std::string::npos) return {text, {}, ""};
  return {text.substr(0, slash), {}, text.substr(slash + 1)};
}

}  // namespace

int SceneFile::index(const std::string& id) const {
  const auto found = std::find(ids.begin(), ids.end(), id);
  if (found == ids.end()) throw std::runtime_error("no goal is called " + id);
  return static_cast<int>(found - ids.begin());
}

ReachGoal& SceneFile::goal(const std::string& id) {
  return goals[static_cast<std::size_t>(index(id))];
}

SceneFile read_scene(const std::string& text) {
  const json document = json::parse(text);
  if (document.at("format") != "posed.scene/1") throw std::runtime_error("not a posed.scene/1");
  const json& figure = document.at("figures").at("body");
  if (figure.at("template") != "tempus") throw std::runtime_error("not the built-in figure");

  SceneFile scene;
  scene.tree = std::make_shared<const BodyTree>(expect(BodyTree::build(expect(tempus(figure.at("stature"))))));
  scene.start = figure.contains("q") ? figure.at("q").get<std::vector<double>>() : start_pose(*scene.tree);
  expect(check_q(*scene.tree, scene.start));
  for (const auto& [id, goal] : document.at("goals").items()) {
    const AttachedPoint held = expect(scene.tree->attach(attachment(goal.at("at"))));
    scene.ids.push_back(id);
    scene.goals.push_back({held.segment, held.point, vec3(goal.at("position")), goal.value("weight", 10.0),
                           goal.value("tolerance", 0.0), goal.value("enabled", true)});
  }
  return scene;
}

SceneFile read_scene_file(const std::string& path) {
  std::ifstream file(path);
  if (!file) throw std::runtime_error("can not read " + path);
  std::ostringstream text;
  text << file.rdbuf();
  return read_scene(text.str());
}

SceneFile read_template(const std::string& source_dir, const std::string& name) {
  return read_scene_file(source_dir + "/server/scene/templates/" + name + ".json");
}

}  // namespace posed::test
