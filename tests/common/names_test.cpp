#include "common/names.h"

#include <gtest/gtest.h>

namespace posed {
namespace {

TEST(ValidId, TakesTheProtocolsAlphabet) {
  for (const char* id : {"a", "Z", "0", "_", "right_hand", "body.right_hand.position", "a-b", "simulated.1", "9.-_"}) {
    EXPECT_TRUE(valid_id(id)) << id;
  }
  EXPECT_TRUE(valid_id(std::string(64, 'x')));
}

TEST(ValidId, RefusesTheRest) {
  for (const char* id : {"", ".a", "-a", "a b", "a/b", "a:1", "a\n", "\xc3\xa9", "a~", "a\"", "[", "@", "`", "{"}) {
    EXPECT_FALSE(valid_id(id)) << id;
  }
  EXPECT_FALSE(valid_id(std::string(65, 'x')));
  EXPECT_FALSE(valid_id(std::string_view("a\0b", 3)));
}

TEST(DidYouMean, NamesTheNearest) {
  const std::vector<std::string> names{"left_hand", "right_hand", "head"};
  EXPECT_EQ(did_you_mean("right_hnd", names), "did you mean right_hand?");
  EXPECT_EQ(did_you_mean("lefthand", names), "did you mean left_hand?");
  EXPECT_EQ(did_you_mean("hed", names), "did you mean head?");
}

TEST(DidYouMean, ListsThemAllWhereNoneIsNearAndTheyAreFew) {
  const std::vector<std::string> names{"left_hand", "right_hand", "head"};
  EXPECT_EQ(did_you_mean("zzzzzzzzzzzz", names), "one of: left_hand right_hand head");
  EXPECT_EQ(did_you_mean("zz", std::vector<std::string>(25, "right_hand")), "");
  EXPECT_EQ(did_you_mean("zz", {}), "");
}

TEST(DidYouMean, GuessesNothingFromNothing) {
  EXPECT_EQ(did_you_mean("", std::vector<std::string>{"a", "b"}), "one of: a b");
}

TEST(DidYouMean, BoundsWhatCameFromOutside) {
  const std::string longest = "did you mean ";
  const std::vector<std::string> names{"head"};
  EXPECT_LT(did_you_mean(std::string(1'000'000, 'h'), names).size(), longest.size() + 64);
}

}  // namespace
}  // namespace posed
