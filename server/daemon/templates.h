// The scenes that the daemon ships: JSON files in one folder, by fixed names. No name from a client becomes a path.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "common/result.h"

namespace posed {

class Templates {
 public:
  // Lists the folder once. An absent folder has no templates.
  explicit Templates(std::filesystem::path folder);

  const std::vector<std::string>& names() const { return names_; }  // "standing", "paper/sitting"
  // The file's text. Errors: "unknown_scene".
  Result<std::string> read(const std::string& name) const;

 private:
  std::filesystem::path folder_;
  std::vector<std::string> names_;
};

}  // namespace posed
