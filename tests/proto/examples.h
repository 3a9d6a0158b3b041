// The files of proto/examples: {"request","reply"} of a method, or {"notice"} of what comes unasked.
#pragma once

#include <filesystem>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <string>

namespace posed::proto {

using OrderedJson = nlohmann::ordered_json;

// By the file's name without its ending.
inline const std::map<std::string, OrderedJson>& examples() {
  static const std::map<std::string, OrderedJson> all = [] {
    std::map<std::string, OrderedJson> found;
    for (const auto& entry : std::filesystem::directory_iterator(POSED_SOURCE_DIR "/proto/examples")) {
      std::ifstream file(entry.path());
      if (entry.path().extension() == ".json") found[entry.path().stem().string()] = OrderedJson::parse(file);
    }
    return found;
  }();
  return all;
}

}  // namespace posed::proto
