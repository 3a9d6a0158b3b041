#include "server/daemon/calibrations.h"

#include "common/names.h"
#include "proto/codec.h"

namespace posed {
namespace {

const std::string kFolder = "/calibrations/";

Error unknown(const std::string& tracker, const Calibrations::OfTracker& of_tracker, const std::string& name,
              const char* path) {
  std::string hint = did_you_mean(name, keys(of_tracker.kept));
  return {"unknown_calibration", "no calibration of " + tracker + " is called " + name.substr(0, 64), path,
          hint.empty() ? "tracker.align makes one" : hint};
}

}  // namespace

const Calibrations::OfTracker& Calibrations::of(const std::string& tracker) const {
  static const OfTracker nothing;
  const auto found = trackers_.find(tracker);
  return found == trackers_.end() ? nothing : found->second;
}

const Calibration* Calibrations::chosen(const std::string& tracker) const {
  const OfTracker& of_tracker = of(tracker);
  const auto found = of_tracker.kept.find(of_tracker.chosen);
  return found == of_tracker.kept.end() ? nullptr : &found->second;
}

Calibration Calibrations::begin(const std::string& tracker, const std::string& name) const {
  const OfTracker& of_tracker = of(tracker);
  const Calibration* present = chosen(tracker);
  const std::string wanted = !name.empty() ? name : present ? present->name : "default";
  if (const auto found = of_tracker.kept.find(wanted); found != of_tracker.kept.end()) return found->second;
  Calibration calibration = present ? *present : Calibration{};
  calibration.tracker = tracker;
  calibration.name = wanted;
  return calibration;
}

void Calibrations::put(Calibration calibration) {
  OfTracker& of_tracker = trackers_[calibration.tracker];
  of_tracker.chosen = calibration.name;
  of_tracker.kept.insert_or_assign(of_tracker.chosen, std::move(calibration));
}

Status Calibrations::choose(const std::string& tracker, const std::string& name) {
  OfTracker& of_tracker = trackers_[tracker];
  if (!name.empty() && !of_tracker.kept.contains(name)) return unknown(tracker, of_tracker, name, "/calibration");
  of_tracker.chosen = name;
  return Ok{};
}

Status Calibrations::forget(const std::string& tracker, const std::string& name) {
  OfTracker& of_tracker = trackers_[tracker];
  if (!of_tracker.kept.contains(name)) return unknown(tracker, of_tracker, name, "/name");
  if (of_tracker.chosen == name) {
    return Error{"in_use", tracker + " goes by calibration " + name, "/name",
                 "choose another one or none first: tracker.configure with \"calibration\":null"};
  }
  of_tracker.kept.erase(name);
  return Ok{};
}

void Calibrations::restore(const std::string& tracker, OfTracker before) {
  trackers_.insert_or_assign(tracker, std::move(before));
}

std::string Calibrations::path(const std::string& tracker, const std::string& name) {
  return kFolder + tracker + "/" + name;
}

std::vector<std::string> Calibrations::paths(const std::string& tracker) const {
  std::vector<std::string> paths{kFolder + tracker};
  for (const auto& [name, calibration] : of(tracker).kept) paths.push_back(path(tracker, name));
  return paths;
}

std::vector<std::string> Calibrations::paths() const {
  std::vector<std::string> all;
  for (const auto& [tracker, of_tracker] : trackers_) {
    for (std::string& path : paths(tracker)) all.push_back(std::move(path));
  }
  return all;
}

std::optional<std::string> Calibrations::document(const std::string& path) const {
  const std::string rest = path.substr(kFolder.size());
  const std::size_t slash = rest.find('/');
  const OfTracker& of_tracker = of(rest.substr(0, slash));
  if (slash == std::string::npos) {
    if (of_tracker.chosen.empty()) return {};
    return '"' + of_tracker.chosen + '"';  // an id: nothing to escape
  }
  const auto found = of_tracker.kept.find(rest.substr(slash + 1));
  if (found == of_tracker.kept.end()) return {};
  return proto::encode_calibration(found->second);
}

Status Calibrations::load(const std::vector<StoredPart>& parts) {
  std::map<std::string, std::string> chosen;
  for (const StoredPart& part : parts) {
    if (!part.path.starts_with(kFolder)) continue;
    const std::string rest = part.path.substr(kFolder.size());
    if (rest.find('/') == std::string::npos) {
      if (part.document.size() > 2) chosen[rest] = part.document.substr(1, part.document.size() - 2);
      continue;
    }
    Result<Calibration> calibration = proto::decode_calibration(part.document);
    if (!calibration) {
      calibration.error().path = part.path + calibration.error().path;
      return calibration.error();
    }
    put(std::move(*calibration));
  }
  for (auto& [tracker, of_tracker] : trackers_) of_tracker.chosen = chosen.contains(tracker) ? chosen[tracker] : "";
  return Ok{};
}

}  // namespace posed
