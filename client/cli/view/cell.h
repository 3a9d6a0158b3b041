// A page of characters with colours: what is drawn into before anything goes to a terminal. Plain values.
#pragma once

#include <string_view>
#include <vector>

namespace posed::view {

// Colours are those of the palette of 256; -1: the terminal's own.
struct Style {
  int fg = -1, bg = -1;
  bool bold = false, reverse = false;
  bool operator==(const Style&) const = default;
};

struct Cell {
  char32_t glyph = U' ';
  Style style;
  bool operator==(const Cell&) const = default;
};

struct Size {
  int columns = 80, rows = 24;
  bool operator==(const Size&) const = default;
};

// Column 0, row 0 is at the top left. What lies outside is not drawn.
class Grid {
 public:
  explicit Grid(Size size) : size_(size), cells_(static_cast<std::size_t>(size.columns * size.rows)) {}

  Size size() const { return size_; }
  const Cell& at(int column, int row) const { return cells_[index(column, row)]; }
  void put(int column, int row, Cell cell) {
    if (column >= 0 && row >= 0 && column < size_.columns && row < size_.rows) cells_[index(column, row)] = cell;
  }
  // UTF-8, at most `most` columns of it, the last an ellipsis where there is more. What would move the cursor, or is
  // not one column wide, is shown as a question mark. Returns the column behind it.
  int text(int column, int row, std::string_view utf8, Style style = {}, int most = 10'000);

 private:
  std::size_t index(int column, int row) const { return static_cast<std::size_t>(row * size_.columns + column); }
  Size size_;
  std::vector<Cell> cells_;
};

// How many columns Grid::text takes for it.
int width_of(std::string_view utf8);
void append_utf8(std::string& text, char32_t glyph);

}  // namespace posed::view
