#include "client/cli/view/keys.h"

#include <gtest/gtest.h>

#include <set>

namespace posed::view {
namespace {

using Keys = std::vector<Key>;

Keys read(std::initializer_list<std::string_view> pieces) {
  KeyReader reader;
  Keys keys;
  for (const std::string_view piece : pieces) {
    for (const Key key : reader.push(piece)) keys.push_back(key);
  }
  return keys;
}

TEST(Keys, SequencesMayBeSplitAnywhere) {
  const std::string_view all = "a\x1b[A\x1b[1;2Bq\x1bOC\x1b[6~\x1b[0n";
  const Keys expected{U'a',          Special::up, Key(Special::down, true), U'q', Special::right, Special::page_down,
                      Special::alive};
  for (std::size_t first = 0; first <= all.size(); ++first) {
    for (std::size_t second = first; second <= all.size(); ++second) {
      EXPECT_EQ(read({all.substr(0, first), all.substr(first, second - first), all.substr(second)}), expected)
          << first << ' ' << second;
    }
  }
}

TEST(Keys, AnEscapeAloneIsAKeyAfterAPause) {
  KeyReader reader;
  EXPECT_TRUE(reader.push("\x1b").empty());
  EXPECT_TRUE(reader.waits());
  EXPECT_EQ(reader.pause(), Keys{Special::escape});
  EXPECT_FALSE(reader.waits());
  EXPECT_EQ(read({"\x1bq"}), (Keys{Special::escape, U'q'}));
  EXPECT_EQ(read({"\x1b\x1b[A"}), (Keys{Special::escape, Special::up}));
}

TEST(Keys, WhatMeansNothingIsPassedOverWhole) {
  EXPECT_EQ(read({"\x1b[?62;1;4cx"}), Keys{U'x'});           // what a terminal says of itself
  EXPECT_EQ(read({"\x1b[15~\x1b[<0;10;20Mx"}), Keys{U'x'});  // F5, a mouse
  EXPECT_EQ(read({"é漢x"}), Keys{U'x'});
  EXPECT_EQ(read({"\x1b[12\x1b[A"}), Keys{Special::up});  // a sequence that was broken off
  KeyReader reader;
  for (int i = 0; i < 10'000; ++i) reader.push("\x1b[1;1;1;1");  // noise does not heap up
  EXPECT_EQ(reader.push("\x1b[Ax").back(), Key(U'x'));
}

TEST(Keys, EachHasOneMeaning) {
  std::set<char32_t> seen;
  for (const Help& help : help_sheet()) {
    EXPECT_FALSE(help.bound.empty()) << help.keys;
    for (const Bound& bound : help.bound) {
      EXPECT_TRUE(seen.insert(bound.key.code).second) << help.keys;
      EXPECT_EQ(command_of(bound.key), bound.command);
    }
  }
  EXPECT_EQ(command_of(Key(Special::up, true)), Command::nudge_up);
  EXPECT_FALSE(command_of(U'%'));
  EXPECT_FALSE(command_of(Special::alive));
}

}  // namespace
}  // namespace posed::view
