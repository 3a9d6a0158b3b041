#include "proto/framing.h"

#include <gtest/gtest.h>

#include <vector>

namespace posed::proto {
namespace {

struct Cut {
  std::vector<std::string> lines;
  std::string rest;
  bool good = true;
  bool operator==(const Cut&) const = default;
};

void PrintTo(const Cut& cut, std::ostream* out) {
  *out << (cut.good ? "good" : "too long");
  for (const std::string& line : cut.lines) *out << " [" << line << "]";
  *out << " rest [" << cut.rest << "]";
}

Cut cut_up(const std::vector<std::string_view>& pieces, std::size_t limit) {
  LineSplitter splitter(limit);
  Cut cut;
  for (const std::string_view piece : pieces) {
    cut.good = splitter.push(piece);
    while (const auto line = splitter.next()) cut.lines.emplace_back(*line);
    if (!cut.good) return cut;
  }
  cut.rest = splitter.rest();
  return cut;
}

void expect_same_for_every_split(std::string_view text, std::size_t limit, const Cut& expected) {
  EXPECT_EQ(cut_up({text}, limit), expected);
  std::vector<std::string_view> bytes;
  for (std::size_t i = 0; i < text.size(); ++i) bytes.push_back(text.substr(i, 1));
  EXPECT_EQ(cut_up(bytes, limit), expected);
  for (std::size_t i = 0; i <= text.size(); ++i) {
    for (std::size_t k = i; k <= text.size(); ++k) {
      const Cut cut = cut_up({text.substr(0, i), text.substr(i, k - i), text.substr(k)}, limit);
      ASSERT_EQ(cut, expected) << "split at " << i << " and " << k;
    }
  }
}

TEST(LineSplitter, EverySplitGivesTheSameLines) {
  expect_same_for_every_split("one\ntwo\r\n\n\r\nthree\r\rfour\n", 100, {{"one", "two", "three\r\rfour"}, ""});
  expect_same_for_every_split("a\nbc\nunfinished", 100, {{"a", "bc"}, "unfinished"});
  expect_same_for_every_split("", 100, {});
  expect_same_for_every_split("\n\n", 100, {});
  expect_same_for_every_split(std::string_view("a\0b\n\0", 5), 100, {{std::string("a\0b", 3)}, std::string("\0", 1)});
}

TEST(LineSplitter, ALineMayBeAsLongAsTheLimit) {
  expect_same_for_every_split("12345\n12345\n1234\n12345", 5, {{"12345", "12345", "1234"}, "12345"});
  EXPECT_TRUE(cut_up({std::string(5, 'x')}, 5).good);
  EXPECT_FALSE(cut_up({std::string(6, 'x')}, 5).good);
}

// The limit is the line's, not its ending's.
TEST(LineSplitter, ACarriageReturnDoesNotCount) {
  expect_same_for_every_split("12345\r\n12345\r\n", 5, {{"12345", "12345"}, ""});
  expect_same_for_every_split("12345\rx\n", 5, {{}, "", false});
  expect_same_for_every_split("123456\r\n", 5, {{}, "", false});
}

// Where a line is too long the lines before it still count, however the bytes came.
TEST(LineSplitter, ALineOverTheLimitEndsTheStreamWhereverItEnds) {
  expect_same_for_every_split("123456\n", 5, {{}, "", false});
  expect_same_for_every_split("one\ntwo\n123456\nmore\n", 5, {{"one", "two"}, "", false});
  expect_same_for_every_split("one\ntwo\n123456", 5, {{"one", "two"}, "", false});
  expect_same_for_every_split("one\r\n12345678", 5, {{"one"}, "", false});
}

TEST(LineSplitter, OnceTooLongItStaysSo) {
  LineSplitter splitter(5);
  EXPECT_TRUE(splitter.push("abc"));
  EXPECT_FALSE(splitter.push("defg"));
  EXPECT_FALSE(splitter.push("\n"));
  EXPECT_FALSE(splitter.push("fine\n"));
  EXPECT_FALSE(splitter.next());
}

TEST(LineSplitter, LinesMayWaitForLater) {
  LineSplitter splitter(100);
  EXPECT_TRUE(splitter.push("a\nb\nc"));
  EXPECT_EQ(splitter.next(), "a");
  EXPECT_TRUE(splitter.push("c\nd\n"));
  EXPECT_EQ(splitter.next(), "b");
  EXPECT_EQ(splitter.next(), "cc");
  EXPECT_EQ(splitter.next(), "d");
  EXPECT_EQ(splitter.next(), std::nullopt);
  EXPECT_EQ(splitter.rest(), "");
}

}  // namespace
}  // namespace posed::proto
