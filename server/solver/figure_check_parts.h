// What the parts of figure_check share; no one else includes it.
#pragma once

#include <algorithm>
#include <map>
#include <optional>
#include <string>

#include "common/names.h"
#include "server/solver/figure_check.h"

namespace posed::figure_check {

using Maybe = std::optional<Error>;
using Index = std::map<std::string, std::size_t, std::less<>>;

inline Error bad(std::string path, std::string message, std::string hint) {
  return {"bad_figure", std::move(message), std::move(path), std::move(hint)};
}

inline std::string at(const std::string& path, std::size_t i) {
  return path + "/" + std::to_string(i);
}

inline bool sane(const Vec3& v) {
  return finite(v) && std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)}) <= kMaxLength;
}

inline Maybe check_point(const std::string& path, const std::string& whose, const Vec3& v) {
  if (sane(v)) return {};
  return bad(path, "a coordinate of " + whose + " is not finite or beyond 10000 m", "give metres");
}

inline Maybe check_name(const std::string& path, const std::string& what, const std::string& name) {
  if (valid_id(name)) return {};
  return bad(path, what + " has no valid name",
             "use 1 to 64 letters, digits, '_', '.' and '-', the first a letter, a digit or '_'");
}

inline bool unit(double length) {
  return std::abs(length - 1.0) <= kUnitTolerance;
}

// `path`: of the joint.
Maybe check_limits(const Joint& joint, const std::string& path);

// Sites, mirror pairs and aliases. `all`: the segments by name.
Maybe check_references(const FigureDocument& document, const Index& all);

}  // namespace posed::figure_check
