// Result and Patched.
#include <gtest/gtest.h>

#include <memory>

#include "common/patched.h"
#include "common/result.h"

namespace posed {
namespace {

Result<int> half_of(int v) {
  if (v % 2 != 0) return Error{"invalid_params", "it is odd", "/v", "give an even number"};
  return v / 2;
}

TEST(Result, HoldsAValueOrTheReason) {
  const Result<int> good = half_of(8);
  ASSERT_TRUE(good);
  EXPECT_EQ(*good, 4);
  EXPECT_EQ(good.value(), 4);
  const Result<int> bad = half_of(7);
  ASSERT_FALSE(bad);
  EXPECT_EQ(bad.error().code, "invalid_params");
  EXPECT_EQ(bad.error().path, "/v");
}

TEST(Result, GivesUpWhatItHolds) {
  Result<std::unique_ptr<int>> owner(std::make_unique<int>(3));
  const std::unique_ptr<int> taken = std::move(*owner);
  EXPECT_EQ(*taken, 3);
}

TEST(Result, OfAnErrorAsAValueIsStillTold) {
  const Status fine = Ok{}, wrong = Error{"internal", "", "", ""};
  EXPECT_TRUE(fine);
  EXPECT_FALSE(wrong);
}

TEST(Patched, LeftOutKeeps) {
  double target = 3.0;
  const Patched<double> left_out;
  left_out.apply(target, 10.0);
  EXPECT_EQ(target, 3.0);
  EXPECT_FALSE(left_out.named());
  EXPECT_FALSE(left_out.is_reset());
  EXPECT_EQ(left_out.value(), nullptr);
}

TEST(Patched, NullRestoresTheDefault) {
  double target = 3.0;
  const auto null = Patched<double>::reset();
  null.apply(target, 10.0);
  EXPECT_EQ(target, 10.0);
  EXPECT_TRUE(null.named());
  EXPECT_TRUE(null.is_reset());
  EXPECT_EQ(null.value(), nullptr);
  null.apply(target);
  EXPECT_EQ(target, 0.0);
}

TEST(Patched, AValueReplaces) {
  double target = 3.0;
  const Patched<double> zero(0.0);
  zero.apply(target, 10.0);
  EXPECT_EQ(target, 0.0);
  EXPECT_TRUE(zero.named());
  EXPECT_FALSE(zero.is_reset());
  ASSERT_NE(zero.value(), nullptr);
}

}  // namespace
}  // namespace posed
