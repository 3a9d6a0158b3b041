// Private to the scene: errors that several edits share.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "common/names.h"
#include "common/result.h"

namespace posed {

inline Error unknown(const std::string& what, const std::string& name, const std::vector<std::string>& known,
                     const std::string& path) {
  std::string hint = did_you_mean(name, known);
  if (hint.empty()) hint = known.empty() ? what + ".set makes one" : what + ".list names them";
  return {"unknown_" + what, "no " + what + " is called " + name.substr(0, 64), path, std::move(hint)};
}

// A key of a document as a part of a JSON pointer, cut where no id is that long.
inline std::string token(const std::string& key) {
  std::string text;
  for (const char c : key.substr(0, 64)) text += c == '~' ? "~0" : c == '/' ? "~1" : std::string(1, c);
  return text;
}

// An error of a part, seen from the whole.
inline Error below(const std::string& path, Error error) {
  error.path = path + error.path;
  return error;
}

template <class Map>
std::optional<Error> stale(const Map& map, const std::string& id, const std::optional<std::uint64_t>& if_revision) {
  if (!if_revision) return std::nullopt;
  const auto found = map.find(id);
  const std::uint64_t revision = found == map.end() ? 0 : found->second.revision;
  if (revision == *if_revision) return std::nullopt;
  return Error{"revision_mismatch", id + " is at revision " + std::to_string(revision), "/if_revision",
               "get it anew, then decide"};
}

}  // namespace posed
