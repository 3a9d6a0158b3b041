#include "client/cli/view/screen.h"

#include <gtest/gtest.h>

namespace posed::view {
namespace {

bool has(const std::string& text, std::string_view part) {
  return text.find(part) != std::string::npos;
}

TEST(Screen, TheFirstPageIsWholeAndTheSamePageIsNothing) {
  Screen screen(Colors::all, true);
  Grid page({10, 3});
  page.text(2, 1, "hello");
  EXPECT_EQ(screen.update(page), "\x1b[?2026h\x1b[0m\x1b[2J\x1b[H\x1b[2;3Hhello\x1b[?2026l");
  EXPECT_EQ(screen.update(page), "");
  screen.forget();
  EXPECT_TRUE(has(screen.update(page), "\x1b[2J"));
}

TEST(Screen, OnlyWhatHasChangedIsSent) {
  Screen screen(Colors::all, true);
  Grid page({80, 24});
  page.text(0, 0, "one two three");
  screen.update(page);
  page.text(4, 0, "TWO");
  EXPECT_EQ(screen.update(page), "\x1b[?2026h\x1b[1;5HTWO\x1b[?2026l");
  // A short gap is written again, a long one jumped over.
  page.text(4, 0, "t");
  page.text(6, 0, "o");
  page.text(20, 0, "x");
  EXPECT_EQ(screen.update(page), "\x1b[?2026h\x1b[1;5HtWo\x1b[13Cx\x1b[?2026l");
}

TEST(Screen, StylesAreSaidWhereTheyChange) {
  Screen screen(Colors::all, true);
  Grid page({80, 2});
  page.text(0, 0, "ab", {203, -1, true});
  page.text(2, 0, "cd", {203, 17, false, true});
  page.text(4, 0, "ef");
  EXPECT_TRUE(has(screen.update(page), "\x1b[0;1;38;5;203mab\x1b[0;7;38;5;203;48;5;17mcd\x1b[0mef"));
}

TEST(Screen, WithoutColoursThereAreNone) {
  Screen screen(Colors::none, true);
  Grid page({80, 2});
  page.text(0, 0, "ab", {203});
  page.text(2, 0, "cd", {110, -1, true});
  const std::string bytes = screen.update(page);
  EXPECT_TRUE(has(bytes, "ab\x1b[0;1mcd")) << bytes;
}

TEST(Screen, SixteenColoursAreTheNearest) {
  Screen screen(Colors::sixteen, true);
  Grid page({80, 2});
  page.text(0, 0, "a", {196});
  page.text(1, 0, "b", {255});
  page.text(2, 0, "c", {34});
  const std::string bytes = screen.update(page);
  EXPECT_TRUE(has(bytes, "\x1b[0;97mb") && has(bytes, "\x1b[0;32mc")) << bytes;
  EXPECT_FALSE(has(bytes, "38;5"));
}

TEST(Screen, WhereThereIsNoUtf8ThereIsAsciiOnly) {
  Screen screen(Colors::all, false);
  Grid page({80, 2});
  page.text(0, 0, "Zoë ⣿");
  for (const char byte : screen.update(page)) EXPECT_LT(static_cast<unsigned char>(byte), 0x80);
}

TEST(Screen, ThePlaceBehindTheLastColumnIsNotReliedOn) {
  Screen screen(Colors::all, true);
  Grid page({4, 2});
  screen.update(page);
  page.text(0, 0, "abcd");
  page.text(0, 1, "e");
  EXPECT_TRUE(has(screen.update(page), "abcd\x1b[2;1He"));
}

TEST(Screen, AnotherSizeIsDrawnAnew) {
  Screen screen(Colors::all, true);
  screen.update(Grid({80, 24}));
  EXPECT_TRUE(has(screen.update(Grid({100, 30})), "\x1b[2J"));
}

TEST(Screen, ColoursAreAsTheEnvironmentSays) {
  EXPECT_EQ(colors_of(nullptr, nullptr, "xterm-256color"), Colors::all);
  EXPECT_EQ(colors_of(nullptr, "truecolor", "xterm"), Colors::all);
  EXPECT_EQ(colors_of(nullptr, nullptr, "linux"), Colors::sixteen);
  EXPECT_EQ(colors_of("1", "truecolor", "xterm-256color"), Colors::none);
  EXPECT_EQ(colors_of("", nullptr, "xterm-256color"), Colors::all);
  EXPECT_EQ(colors_of(nullptr, nullptr, "vt100"), Colors::none);
  EXPECT_EQ(colors_of(nullptr, nullptr, "dumb"), Colors::none);
  EXPECT_EQ(colors_of(nullptr, nullptr, nullptr), Colors::none);
}

}  // namespace
}  // namespace posed::view
