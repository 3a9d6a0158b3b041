// Is a figure document a body tree? (paper, "Body representation" and Figure 12)
#pragma once

#include <optional>

#include "common/figure.h"
#include "common/result.h"

namespace posed {

inline constexpr int kMaxSegments = 500;
inline constexpr int kMaxShapes = 64;           // of one segment
inline constexpr std::size_t kMaxCorners = 64;  // of a swing polygon
inline constexpr int kMaxNames = 2000;          // sites, and aliases
inline constexpr double kMaxLength = 1e4;       // m, any coordinate
inline constexpr double kUnitTolerance = 1e-6;

// The first thing wrong with the document: code "bad_figure", the path as a JSON pointer into the document
// ("/segments/3/joint/limits/0"), a message that names the thing and a hint with the cure. Nothing: it can be built.
std::optional<Error> check_figure(const FigureDocument& document);

}  // namespace posed
