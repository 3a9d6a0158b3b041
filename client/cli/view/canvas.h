// A picture of dots, 2 x 4 to a character: drawn with depth, then turned into characters. Pure.
#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include "client/cli/view/cell.h"

namespace posed::view {

// How dots become characters: braille; half blocks, which every console's font has; or ASCII.
enum class Glyphs { braille, blocks, ascii };

// What lies on a higher layer has a character for itself, so that it stands out from what is below.
enum class Layer : std::uint8_t { none, floor, object, figure, mark };

// x to the right, y down, in dots; (0, 0) is the top left corner's.
class Canvas {
 public:
  Canvas(int columns, int rows);

  int width() const { return width_; }
  int height() const { return height_; }

  // A dot of a body: seen where nothing nearer is. Bodies with different `part`s are set apart by a dark line where one
  // stands clearly in front of the other.
  void body(int x, int y, float depth, Layer layer, int color, int part);
  // A dot that nothing hides.
  void dot(int x, int y, Layer layer, int color);
  // Every `period`-th dot of a line that nothing hides.
  void line(double x0, double y0, double x1, double y1, Layer layer, int color, int period = 1);

  // Into `grid`, its top left character at (column, row). A character without dots is left as it is.
  void draw(Grid& grid, int column, int row, Glyphs glyphs) const;

  // How far in front that is, m: where dots are coarse, a line for every fold would leave nothing of the limbs.
  void set_apart(double metres) { apart_ = static_cast<float>(metres); }

 private:
  struct Dot {
    float depth = std::numeric_limits<float>::infinity();
    Layer layer = Layer::none;
    std::int16_t color = -1;
    std::int16_t part = -1;
  };
  const Dot& at(int x, int y) const { return dots_[static_cast<std::size_t>(y * width_ + x)]; }
  bool inside(int x, int y) const { return x >= 0 && y >= 0 && x < width_ && y < height_; }
  bool lit(int x, int y) const;
  Cell cell(int column, int row, Glyphs glyphs) const;

  int width_, height_;
  float apart_ = 0.03F;
  std::vector<Dot> dots_;
};

// The character for dots, of which bit `2 * y + x` is that at (x, y) of 2 x 4.
char32_t glyph_of(unsigned dots, Glyphs glyphs);

}  // namespace posed::view
