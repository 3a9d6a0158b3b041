// Ids, and the nearest name for a hint.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace posed {

// [A-Za-z0-9_][A-Za-z0-9_.-]{0,63}
bool valid_id(std::string_view id);

// "did you mean right_hand?" for the candidate nearest by edit distance, or a list of them all where none is near and
// they are few; empty where there are none.
std::string did_you_mean(std::string_view name, std::span<const std::string> candidates);

// The keys of a map, as such candidates.
template <class Map>
std::vector<std::string> keys(const Map& map) {
  std::vector<std::string> names;
  names.reserve(map.size());
  for (const auto& entry : map) names.push_back(entry.first);
  return names;
}

}  // namespace posed
