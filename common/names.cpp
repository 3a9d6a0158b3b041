#include "common/names.h"

#include <algorithm>
#include <numeric>

namespace posed {
namespace {

bool letter_or_digit(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_';
}

// Levenshtein; names are short, but `a` comes from outside, so callers bound it.
std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 0; i < a.size(); ++i) {
    std::size_t diagonal = row[0]++;
    for (std::size_t j = 0; j < b.size(); ++j) {
      const std::size_t substituted = diagonal + (a[i] == b[j] ? 0 : 1);
      diagonal = row[j + 1];
      row[j + 1] = std::min({substituted, row[j] + 1, diagonal + 1});
    }
  }
  return row[b.size()];
}

}  // namespace

bool valid_id(std::string_view id) {
  if (id.empty() || id.size() > 64 || !letter_or_digit(id[0])) return false;
  return std::all_of(id.begin(), id.end(), [](char c) { return letter_or_digit(c) || c == '.' || c == '-'; });
}

std::string did_you_mean(std::string_view name, std::span<const std::string> candidates) {
  name = name.substr(0, 64);
  std::size_t best = name.size() / 2 + 2;
  const std::string* nearest = nullptr;
  for (const std::string& c : candidates) {
    const std::size_t d = edit_distance(name, c);
    if (d < best) best = d, nearest = &c;
  }
  if (nearest && !name.empty()) return "did you mean " + *nearest + "?";
  if (candidates.empty() || candidates.size() > 24) return {};
  std::string all = "one of:";
  for (const std::string& c : candidates) all += " " + c;
  return all;
}

}  // namespace posed
