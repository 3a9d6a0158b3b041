#include "client/cli/view/canvas.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

namespace posed::view {
namespace {

// By the dots in the upper and in the lower half: none, some (1 or 2), many.
char32_t ascii_of(unsigned dots) {
  static constexpr std::array<std::array<char, 3>, 3> kTable{{{' ', '.', '_'}, {'\'', ':', '+'}, {'"', '*', '#'}}};
  const auto amount = [](unsigned four) { return (static_cast<std::size_t>(std::popcount(four)) + 1) / 2; };
  return static_cast<char32_t>(kTable[amount(dots & 0xf)][amount(dots >> 4)]);
}

char32_t block_of(unsigned dots) {
  const bool upper = std::popcount(dots & 0xf) >= 2, lower = std::popcount(dots >> 4) >= 2;
  if (upper && lower) return U'█';
  if (upper) return U'▀';
  if (lower) return U'▄';
  return dots == 0 ? U' ' : U'·';
}

}  // namespace

char32_t glyph_of(unsigned dots, Glyphs glyphs) {
  if (glyphs == Glyphs::ascii) return ascii_of(dots);
  if (glyphs == Glyphs::blocks) return block_of(dots);
  // Braille numbers the dots of the upper three rows down each column, then those of the fourth.
  static constexpr std::array<unsigned, 8> kBits{0x01, 0x08, 0x02, 0x10, 0x04, 0x20, 0x40, 0x80};
  unsigned bits = 0;
  for (std::size_t i = 0; i < kBits.size(); ++i) bits |= (dots >> i & 1) * kBits[i];
  return bits == 0 ? U' ' : U'\u2800' + bits;
}

Canvas::Canvas(int columns, int rows)
    : width_(std::max(columns, 0) * 2),
      height_(std::max(rows, 0) * 4),
      dots_(static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_)) {}

void Canvas::body(int x, int y, float depth, Layer layer, int color, int part) {
  if (!inside(x, y)) return;
  Dot& dot = dots_[static_cast<std::size_t>(y * width_ + x)];
  if (dot.layer == Layer::mark || depth >= dot.depth) return;
  dot = {depth, layer, static_cast<std::int16_t>(color), static_cast<std::int16_t>(part)};
}

void Canvas::dot(int x, int y, Layer layer, int color) {
  if (!inside(x, y)) return;
  Dot& dot = dots_[static_cast<std::size_t>(y * width_ + x)];
  if (layer < dot.layer) return;
  dot = {layer == Layer::mark ? 0.0F : std::numeric_limits<float>::infinity(), layer, static_cast<std::int16_t>(color),
         -1};
}

void Canvas::line(double x0, double y0, double x1, double y1, Layer layer, int color, int period) {
  // Cut to the picture (Liang and Barsky), so that a line from far away costs no more than one that is seen.
  double from = 0.0, to = 1.0;
  const auto cut = [&](double delta, double start, double low, double high) {
    if (delta == 0.0) return start >= low && start <= high;
    const double a = (low - start) / delta, b = (high - start) / delta;
    from = std::max(from, std::min(a, b));
    to = std::min(to, std::max(a, b));
    return from <= to;
  };
  if (!cut(x1 - x0, x0, 0.0, width_ - 1.0) || !cut(y1 - y0, y0, 0.0, height_ - 1.0)) return;
  const double length = std::max(std::abs(x1 - x0), std::abs(y1 - y0));
  // Counted from the line's own start: its dots do not crawl when the view moves along it.
  const double first = std::ceil(from * length / period) * period;
  for (double step = first; step <= to * length + 1e-3; step += period) {
    const double t = length > 0.0 ? step / length : 0.0;
    dot(static_cast<int>(std::lround(x0 + t * (x1 - x0))), static_cast<int>(std::lround(y0 + t * (y1 - y0))), layer,
        color);
  }
}

bool Canvas::lit(int x, int y) const {
  const Dot& here = at(x, y);
  if (here.layer == Layer::none) return false;
  if (here.part < 0) return true;
  // Objects are half-toned: without colours, too, they are not taken for a body.
  if (here.layer == Layer::object && (x + y) % 2 != 0) return false;
  for (const auto& [dx, dy] : {std::pair{1, 0}, {-1, 0}, {0, 1}, {0, -1}}) {
    if (!inside(x + dx, y + dy)) continue;
    const Dot& beside = at(x + dx, y + dy);
    if (beside.part >= 0 && beside.part != here.part && beside.depth < here.depth - apart_) return false;
  }
  return true;
}

Cell Canvas::cell(int column, int row, Glyphs glyphs) const {
  Layer layer = Layer::none;
  for (int y = 4 * row; y < 4 * row + 4; ++y)
    for (int x = 2 * column; x < 2 * column + 2; ++x) layer = std::max(layer, at(x, y).layer);
  unsigned dots = 0;
  std::array<int, 8> colors{};
  std::size_t count = 0;
  for (int y = 0; y < 4; ++y) {
    for (int x = 0; x < 2; ++x) {
      const int dx = 2 * column + x, dy = 4 * row + y;
      if (at(dx, dy).layer != layer || !lit(dx, dy)) continue;
      dots |= 1U << (2 * y + x);
      colors[count++] = at(dx, dy).color;
    }
  }
  if (count == 0) return {};
  // One colour a character: that which most of its dots have.
  int most = 0, color = -1;
  for (std::size_t i = 0; i < count; ++i) {
    const auto same = static_cast<int>(std::count(colors.begin(), colors.begin() + count, colors[i]));
    if (same > most) most = same, color = colors[i];
  }
  return {glyph_of(dots, glyphs), {color}};
}

void Canvas::draw(Grid& grid, int column, int row, Glyphs glyphs) const {
  for (int r = 0; r < height_ / 4; ++r) {
    for (int c = 0; c < width_ / 2; ++c) {
      const Cell made = cell(c, r, glyphs);
      if (made.glyph != U' ') grid.put(column + c, row + r, made);
    }
  }
}

}  // namespace posed::view
