// The calibrations of all trackers, and which one of each is chosen. The store has them beside the scene, which does
// not know of them: no new scene and no undo changes where a tracker stands. Station loop only.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "common/calibration.h"
#include "common/result.h"
#include "server/store/store.h"

namespace posed {

class Calibrations {
 public:
  struct OfTracker {
    std::map<std::string, Calibration> kept;  // by name
    std::string chosen;                       // empty: none
  };

  const OfTracker& of(const std::string& tracker) const;
  const Calibration* chosen(const std::string& tracker) const;  // null: none
  // The one that is to be measured anew: by its name, else the chosen one, else "default". A new one begins as the
  // chosen one.
  Calibration begin(const std::string& tracker, const std::string& name) const;

  void put(Calibration calibration);  // and chooses it
  // Empty: none. Errors: "unknown_calibration", path "/calibration".
  Status choose(const std::string& tracker, const std::string& name);
  // Errors: "unknown_calibration"; "in_use" for the chosen one; path "/name".
  Status forget(const std::string& tracker, const std::string& name);
  void restore(const std::string& tracker, OfTracker before);

  // ---- as the store has them: "/calibrations/TRACKER/NAME", and in "/calibrations/TRACKER" the chosen one's name ----

  static std::string path(const std::string& tracker, const std::string& name);
  std::vector<std::string> paths(const std::string& tracker) const;
  std::vector<std::string> paths() const;
  // None where nothing is there.
  std::optional<std::string> document(const std::string& path) const;
  // Takes what is theirs. Errors: "bad_calibration", with the part's path.
  Status load(const std::vector<StoredPart>& parts);

 private:
  std::map<std::string, OfTracker> trackers_;
};

}  // namespace posed
