#include "client/cli/view/canvas.h"

#include <gtest/gtest.h>

namespace posed::view {
namespace {

Grid drawn(const Canvas& canvas, Glyphs glyphs = Glyphs::braille) {
  Grid grid({canvas.width() / 2, canvas.height() / 4});
  canvas.draw(grid, 0, 0, glyphs);
  return grid;
}

TEST(Canvas, EveryDotHasItsPlaceInBraille) {
  const char32_t expected[] = {U'⠁', U'⠈', U'⠂', U'⠐', U'⠄', U'⠠', U'⡀', U'⢀'};
  for (unsigned i = 0; i < 8; ++i) {
    EXPECT_EQ(glyph_of(1U << i, Glyphs::braille), expected[i]) << i;
    Canvas canvas(1, 1);
    canvas.dot(static_cast<int>(i % 2), static_cast<int>(i / 2), Layer::figure, 5);
    EXPECT_EQ(drawn(canvas).at(0, 0).glyph, expected[i]) << i;
    EXPECT_EQ(drawn(canvas).at(0, 0).style.fg, 5);
  }
  EXPECT_EQ(glyph_of(0xff, Glyphs::braille), U'⣿');
  EXPECT_EQ(glyph_of(0, Glyphs::braille), U' ');
}

TEST(Canvas, BlocksAndAsciiSayWhichHalfIsFull) {
  EXPECT_EQ(glyph_of(0x0f, Glyphs::blocks), U'▀');
  EXPECT_EQ(glyph_of(0xf0, Glyphs::blocks), U'▄');
  EXPECT_EQ(glyph_of(0xff, Glyphs::blocks), U'█');
  EXPECT_EQ(glyph_of(0x0f, Glyphs::ascii), U'"');
  EXPECT_EQ(glyph_of(0xf0, Glyphs::ascii), U'_');
  EXPECT_EQ(glyph_of(0xff, Glyphs::ascii), U'#');
  for (unsigned dots = 0; dots < 256; ++dots) EXPECT_LT(glyph_of(dots, Glyphs::ascii), 0x7fU);
}

TEST(Canvas, TheNearerBodyIsSeen) {
  Canvas canvas(1, 1);
  for (int y = 0; y < 4; ++y)
    for (int x = 0; x < 2; ++x) canvas.body(x, y, 2.0F, Layer::figure, 10, 1);
  for (int y = 0; y < 4; ++y)
    for (int x = 0; x < 2; ++x)
      canvas.body(x, y, 1.0F, Layer::figure, 20, 1), canvas.body(x, y, 3.0F, Layer::figure, 30, 1);
  EXPECT_EQ(drawn(canvas).at(0, 0), (Cell{U'⣿', {20}}));
}

TEST(Canvas, ALimbInFrontOfABodyStandsApart) {
  Canvas canvas(4, 1);
  for (int y = 0; y < 4; ++y)
    for (int x = 0; x < 8; ++x) canvas.body(x, y, 1.0F, Layer::figure, 10, 1);
  for (int y = 0; y < 4; ++y)
    for (int x = 3; x < 5; ++x) canvas.body(x, y, 0.8F, Layer::figure, 20, 2);
  // The body's dots beside the limb are dark; the limb's own are not.
  const Grid grid = drawn(canvas);
  EXPECT_EQ(grid.at(0, 0).glyph, U'⣿');
  EXPECT_EQ(grid.at(1, 0).glyph, U'⢸');
  EXPECT_EQ(grid.at(2, 0).glyph, U'⡇');
  EXPECT_EQ(grid.at(3, 0).glyph, U'⣿');
}

TEST(Canvas, ABodyThatTouchesItsNeighbourDoesNot) {
  Canvas canvas(2, 1);
  for (int y = 0; y < 4; ++y)
    for (int x = 0; x < 4; ++x) canvas.body(x, y, 1.0F, Layer::figure, 10, x < 2 ? 1 : 2);
  EXPECT_EQ(drawn(canvas).at(0, 0).glyph, U'⣿');
  EXPECT_EQ(drawn(canvas).at(1, 0).glyph, U'⣿');
}

TEST(Canvas, AMarkHasItsCharacterForItself) {
  Canvas canvas(1, 1);
  for (int y = 0; y < 4; ++y) canvas.body(0, y, 1.0F, Layer::figure, 10, 1);
  canvas.dot(1, 0, Layer::mark, 30);
  canvas.body(1, 0, 0.1F, Layer::figure, 10, 1);
  EXPECT_EQ(drawn(canvas).at(0, 0), (Cell{U'⠈', {30}}));
}

TEST(Canvas, LinesFromAnywhereEndAtTheEdge) {
  Canvas canvas(4, 2);
  canvas.line(-1e9, 3.0, 1e9, 3.0, Layer::floor, 1);
  for (int x = 0; x < 4; ++x) EXPECT_EQ(drawn(canvas).at(x, 0).glyph, U'⣀');
  canvas.line(-5.0, -5.0, -1.0, 40.0, Layer::floor, 1);  // beside it
  canvas.line(2.0, 6.0, 2.0, 6.0, Layer::floor, 1);      // a point
  EXPECT_EQ(drawn(canvas).at(1, 1).glyph, U'⠄');
  EXPECT_EQ(drawn(canvas).at(0, 1).glyph, U' ');
}

TEST(Canvas, WhatIsOutsideIsNotDrawn) {
  Canvas canvas(1, 1);
  for (const int at : {-1, 2, 1000})
    canvas.dot(at, 0, Layer::mark, 1), canvas.body(0, at < 0 ? at : at + 4, 0, Layer::figure, 1, 1);
  EXPECT_EQ(drawn(canvas).at(0, 0).glyph, U' ');
  Canvas none(-3, 0);
  none.line(0, 0, 5, 5, Layer::mark, 1);
  EXPECT_EQ(none.width(), 0);
}

TEST(Grid, TextThatWouldMoveTheCursorIsShownAsQuestionMarks) {
  Grid grid({12, 1});
  EXPECT_EQ(grid.text(0, 0, "a\x1b[2Jé漢\xff"), 8);
  std::u32string shown;
  for (int i = 0; i < 8; ++i) shown += grid.at(i, 0).glyph;
  EXPECT_EQ(shown, U"a?[2Jé??");
}

TEST(Grid, TextIsCutWithAnEllipsis) {
  Grid grid({12, 1});
  EXPECT_EQ(grid.text(0, 0, "abcdef", {}, 4), 4);
  EXPECT_EQ(grid.at(2, 0).glyph, U'c');
  EXPECT_EQ(grid.at(3, 0).glyph, U'…');
  EXPECT_EQ(grid.text(10, 0, "abcdef"), 16);  // what lies outside is not drawn
  EXPECT_EQ(grid.at(11, 0).glyph, U'b');
}

}  // namespace
}  // namespace posed::view
