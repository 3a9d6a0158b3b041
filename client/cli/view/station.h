// What is seen of the station at a moment, as one value: what the network's thread fills in and the page shows.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "proto/messages.h"

namespace posed::view {

// What changes by edits only.
struct Entities {
  std::map<std::string, proto::FigureResult> figures;
  std::vector<proto::GoalResult> goals;  // by id
  std::vector<Object> objects;
  std::vector<Binding> bindings;

  const proto::GoalResult* goal(const std::string& id) const;
  const Binding* bound_to(const std::string& goal) const;  // what leads it, or null
};

struct Note {
  std::string text;
  bool bad = false;
};

struct Station {
  std::shared_ptr<const proto::PoseData> pose;  // null: none has come yet
  std::shared_ptr<const Entities> entities = std::make_shared<Entities>();
  std::map<std::string, Transform> sensors;  // in the world, as they were heard last
  std::vector<proto::CameraFrame> cameras;   // all that stand somewhere
  std::string lost_why;                      // empty: connected
  double rate_hz = 0.0;                      // frames that came in the last second
  std::optional<double> age_ms;  // of the newest frame when it came, from the sample's or the edit's arrival
  std::uint64_t lost = 0;        // frames left out because we were slow
  std::uint64_t edits_done = 0;  // how many of our edits have their answer, and are in `entities`
  std::uint64_t notes = 0;       // how many there have been
  Note note;                     // the last one

  // Where a sensor has it, or else where the document says.
  const Transform& world_from_object(const Object& object) const;
};

}  // namespace posed::view
