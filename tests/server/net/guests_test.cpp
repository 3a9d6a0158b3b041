#include "server/net/guests.h"

#include <gtest/gtest.h>

namespace posed::net {
namespace {

constexpr Nanoseconds kSecond = 1'000'000'000;

class GuestsTest : public ::testing::Test {
 protected:
  GuestsTest() {
    limits.connections_per_address = 2;
    limits.handshakes_per_second = 3.0;
    limits.http_requests_per_second = 0.5;
  }
  static Guests::Address address(unsigned n) { return boost::asio::ip::address_v4(0x0a000000u + n); }

  Limits limits;
};

TEST_F(GuestsTest, ConnectionsAreCountedByAddress) {
  Guests guests(limits);
  EXPECT_TRUE(guests.enter(address(1), 0));
  EXPECT_TRUE(guests.enter(address(1), 0));
  EXPECT_FALSE(guests.enter(address(1), 0));
  EXPECT_TRUE(guests.enter(address(2), 0));
  guests.leave(address(1));
  EXPECT_TRUE(guests.enter(address(1), 0));
}

TEST_F(GuestsTest, ASecondsWorthAtOnceAndThenAsItComesIn) {
  Guests guests(limits);
  Nanoseconds now = 50 * kSecond;
  for (int i = 0; i < 3; ++i) EXPECT_TRUE(guests.may_encrypt(address(1), now)) << i;
  EXPECT_FALSE(guests.may_encrypt(address(1), now));
  EXPECT_TRUE(guests.may_encrypt(address(2), now)) << "others have their own";
  now += kSecond * 2 / 5;
  EXPECT_TRUE(guests.may_encrypt(address(1), now));
  EXPECT_FALSE(guests.may_encrypt(address(1), now));
  now += 100 * kSecond;
  for (int i = 0; i < 3; ++i) EXPECT_TRUE(guests.may_encrypt(address(1), now)) << i;
  EXPECT_FALSE(guests.may_encrypt(address(1), now)) << "it does not pile up";
}

TEST_F(GuestsTest, LessThanOneASecondIsStillOneInAWhile) {
  Guests guests(limits);
  EXPECT_TRUE(guests.may_ask(address(1), 0));
  EXPECT_FALSE(guests.may_ask(address(1), kSecond));
  EXPECT_TRUE(guests.may_ask(address(1), 3 * kSecond));
}

TEST_F(GuestsTest, WhoComesBackAtOnceHasNoNewShareAndWhoStaysAwayIsForgotten) {
  Guests guests(limits);
  Nanoseconds now = 10 * kSecond;
  ASSERT_TRUE(guests.enter(address(1), now));
  for (int i = 0; i < 3; ++i) ASSERT_TRUE(guests.may_encrypt(address(1), now));
  guests.leave(address(1));
  ASSERT_TRUE(guests.enter(address(1), now));
  EXPECT_FALSE(guests.may_encrypt(address(1), now));
  guests.leave(address(1));
  for (unsigned n = 2; n < 1000; ++n) {
    now += kSecond / 100;
    ASSERT_TRUE(guests.enter(address(n), now));
    guests.leave(address(n));
  }
  EXPECT_LT(guests.remembered(), 300u);
}

TEST_F(GuestsTest, WithoutLimitsThereIsNone) {
  const Limits none;
  Guests guests(none);
  for (int i = 0; i < 1000; ++i) {
    ASSERT_TRUE(guests.enter(address(1), 0));
    ASSERT_TRUE(guests.may_encrypt(address(1), 0));
    ASSERT_TRUE(guests.may_ask(address(1), 0));
  }
}

}  // namespace
}  // namespace posed::net
