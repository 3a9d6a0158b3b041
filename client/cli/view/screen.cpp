#include "client/cli/view/screen.h"

#include <algorithm>
#include <array>
#include <string_view>

namespace posed::view {
namespace {

constexpr int kBridge = 4;  // so many unchanged cells are written again rather than jumped over

// The nearest of the sixteen that every terminal has to one of the 256.
int sixteen(int color) {
  if (color < 16) return color;
  std::array<int, 3> rgb{};
  if (color >= 232) {
    rgb.fill(8 + 10 * (color - 232));
  } else {
    const int cube = color - 16;
    const std::array<int, 3> parts{cube / 36, cube / 6 % 6, cube % 6};
    for (std::size_t i = 0; i < 3; ++i) rgb[i] = parts[i] == 0 ? 0 : 55 + 40 * parts[i];
  }
  static constexpr std::array<std::array<int, 3>, 16> kColors{{{0, 0, 0},
                                                               {170, 0, 0},
                                                               {0, 170, 0},
                                                               {170, 85, 0},
                                                               {0, 0, 170},
                                                               {170, 0, 170},
                                                               {0, 170, 170},
                                                               {170, 170, 170},
                                                               {85, 85, 85},
                                                               {255, 85, 85},
                                                               {85, 255, 85},
                                                               {255, 255, 85},
                                                               {85, 85, 255},
                                                               {255, 85, 255},
                                                               {85, 255, 255},
                                                               {255, 255, 255}}};
  int best = 7, least = 1 << 30;
  for (int i = 1; i < 16; ++i) {  // never black, which may be the ground
    int distance = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      const int d = rgb[k] - kColors[static_cast<std::size_t>(i)][k];
      distance += d * d;
    }
    if (distance < least) least = distance, best = i;
  }
  return best;
}

}  // namespace

void Screen::move(std::string& out, int column, int row) {
  if (column == column_ && row == row_) return;
  if (row == row_ && column > column_ && column_ >= 0)
    out += "\x1b[" + (column - column_ == 1 ? "" : std::to_string(column - column_)) + 'C';
  else
    out += "\x1b[" + std::to_string(row + 1) + ';' + std::to_string(column + 1) + 'H';
  column_ = column;
  row_ = row;
}

void Screen::color(std::string& out, int color, bool back) const {
  if (color < 0 || colors_ == Colors::none) return;
  if (colors_ == Colors::all) {
    out += (back ? ";48;5;" : ";38;5;") + std::to_string(color);
    return;
  }
  const int near = sixteen(color);
  out += ';' + std::to_string((near < 8 ? 30 + near : 82 + near) + (back ? 10 : 0));
}

void Screen::style(std::string& out, const Style& wanted) {
  Style style = wanted;
  if (colors_ == Colors::none) style.fg = style.bg = -1;
  if (style == style_) return;
  out += "\x1b[0";
  if (style.bold) out += ";1";
  if (style.reverse) out += ";7";
  color(out, style.fg, false);
  color(out, style.bg, true);
  out += 'm';
  style_ = style;
}

std::string Screen::update(const Grid& page) {
  std::string out;
  const Size size = page.size();
  if (!shown_ || shown_->size() != size) {
    out = "\x1b[0m\x1b[2J\x1b[H";
    shown_.emplace(size);
    column_ = row_ = 0;
    style_ = {};
  }
  const std::size_t head = out.size();
  for (int row = 0; row < size.rows; ++row) {
    const auto changed = [&](int column) { return page.at(column, row) != shown_->at(column, row); };
    for (int column = 0; column < size.columns; ++column) {
      if (!changed(column)) continue;
      // A short gap in the same style is cheaper written than jumped over.
      if (row_ == row && column_ >= 0 && column > column_ && column - column_ <= kBridge) {
        bool alike = true;
        for (int between = column_; between < column; ++between) alike = alike && page.at(between, row).style == style_;
        if (alike) column = column_;
      }
      const Cell& cell = page.at(column, row);
      move(out, column, row);
      style(out, cell.style);
      append_utf8(out, utf8_ || cell.glyph < 0x7f ? cell.glyph : U'?');
      shown_->put(column, row, cell);
      // Behind the last column terminals differ on where the cursor is.
      column_ = column + 1 < size.columns ? column + 1 : -1;
    }
  }
  if (out.size() == head) return out;
  // Terminals that know of synchronized output show the page at once; others pass over these.
  return "\x1b[?2026h" + out + "\x1b[?2026l";
}

Colors colors_of(const char* no_color, const char* colorterm, const char* term) {
  const std::string_view kind = term == nullptr ? "" : term;
  if ((no_color != nullptr && *no_color != '\0') || kind.empty() || kind == "dumb" || kind.starts_with("vt"))
    return Colors::none;
  if (colorterm != nullptr && *colorterm != '\0') return Colors::all;
  for (const char* rich : {"256color", "direct", "kitty", "alacritty", "foot", "wezterm", "ghostty"})
    if (kind.find(rich) != std::string_view::npos) return Colors::all;
  return Colors::sixteen;
}

}  // namespace posed::view
