// The outbox: what is sent next, and what is left out.
#include "server/net/outbox.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace posed::net {
namespace {

using proto::Stream;
constexpr Nanoseconds kSecond = 1'000'000'000;

SharedLine line(std::string text) {
  return std::make_shared<const std::string>(std::move(text));
}

// Without a framing set, a frame goes out as its text alone.
StreamFrame frame(const std::string& text) {
  return StreamFrame(text);
}

class OutboxTest : public ::testing::Test {
 protected:
  OutboxTest() { outbox.set_framing(Framing::raw); }
  // Everything that may go at `now`, joined by spaces.
  std::string drain(Nanoseconds now = 0) {
    std::string all;
    while (auto out = outbox.next(now)) all += (all.empty() ? "" : " ") + std::string(out->bytes);
    return all;
  }
  void put(std::uint64_t seq, Nanoseconds now = 0, Stream stream = Stream::pose) {
    EXPECT_TRUE(outbox.put(stream, seq, frame("f" + std::to_string(seq)), now));
  }
  void follow(double rate = 0.0, int credit = 0, Stream stream = Stream::pose) {
    outbox.subscribe({stream, 0, rate, credit, true}, {}, 0, 0);
  }
  static std::string lost(int n, const char* stream = "pose") {
    return std::string(R"({"jsonrpc":"2.0","method":"stream.lost","params":{"stream":")") + stream + R"(","dropped":)" +
           std::to_string(n) + "}}";
  }

  Tally tally;
  Outbox outbox{100, 1000, tally};
};

TEST_F(OutboxTest, IsEmptyAtFirst) {
  EXPECT_FALSE(outbox.next(0));
  EXPECT_FALSE(outbox.due());
  EXPECT_FALSE(outbox.subscribed());
}

TEST_F(OutboxTest, RepliesKeepTheirOrder) {
  std::string expected;
  for (int round = 0; round < 10; ++round) {
    for (int i = 0; i < 90; ++i) ASSERT_TRUE(outbox.reply(line(std::to_string(i))));
    for (int i = 0; i < 90; ++i) ASSERT_EQ(outbox.next(0)->bytes, std::to_string(i));
  }
  EXPECT_EQ(outbox.replies(), 0u);
  EXPECT_EQ(outbox.reply_bytes(), 0u);
}

TEST_F(OutboxTest, CapsTheNumberOfReplies) {
  for (int i = 0; i < 100; ++i) ASSERT_TRUE(outbox.reply(line("x")));
  EXPECT_FALSE(outbox.reply(line("x")));
  outbox.next(0);
  EXPECT_TRUE(outbox.reply(line("x")));
}

TEST_F(OutboxTest, CapsTheirBytes) {
  EXPECT_TRUE(outbox.reply(line(std::string(600, 'x'))));
  EXPECT_FALSE(outbox.reply(line(std::string(401, 'x'))));
  EXPECT_TRUE(outbox.reply(line(std::string(400, 'x'))));
}

TEST_F(OutboxTest, FramesWithoutASubscriptionAreNothing) {
  put(1);
  EXPECT_EQ(drain(), "");
}

TEST_F(OutboxTest, ThePresentComesFirst) {
  outbox.subscribe({Stream::pose, 0, 0.0, 0, true}, frame("present"), 7, 0);
  EXPECT_EQ(drain(), "present");
  put(8);
  EXPECT_EQ(drain(), "f8");
}

TEST_F(OutboxTest, RepliesGoBeforeFrames) {
  follow();
  put(1);
  ASSERT_TRUE(outbox.reply(line("r")));
  EXPECT_EQ(drain(), "r f1");
}

TEST_F(OutboxTest, TheNewestWinsAndTheLossIsToldOnce) {
  follow();
  for (int i = 1; i <= 5; ++i) put(i);
  EXPECT_EQ(drain(), lost(4) + " f5");
  EXPECT_EQ(tally.dropped.load(), 4u);
  put(6);
  EXPECT_EQ(drain(), "f6");
  put(7);
  put(8);
  EXPECT_EQ(drain(), lost(1) + " f8");
}

TEST_F(OutboxTest, ALossBetweenTheNoticeAndItsFrameIsToldToo) {
  follow();
  put(1);
  put(2);
  EXPECT_EQ(outbox.next(0)->bytes, lost(1));
  put(3);
  EXPECT_EQ(drain(), lost(1) + " f3");
}

TEST_F(OutboxTest, CreditLimitsWhatIsUnderWay) {
  follow(0.0, 3);
  std::string got;
  for (int i = 1; i <= 10; ++i) {
    put(i);
    got += drain();
  }
  EXPECT_EQ(got, "f1f2f3");
  EXPECT_FALSE(outbox.due()) << "time alone brings no credit";
  EXPECT_TRUE(outbox.ack(Stream::pose, 1, 0));
  EXPECT_EQ(drain(), lost(6) + " f10");
  put(11);
  EXPECT_EQ(drain(), "");
  EXPECT_TRUE(outbox.ack(Stream::pose, 10, 0));
  EXPECT_EQ(drain(), "f11");
  put(12);
  EXPECT_EQ(drain(), "f12");
  put(13);
  EXPECT_EQ(drain(), "f13");
  put(14);
  EXPECT_EQ(drain(), "") << "11, 12 and 13 are under way";
}

TEST_F(OutboxTest, AnAckCoversAllBeforeIt) {
  follow(0.0, 3);
  for (int i = 1; i <= 3; ++i) put(i), drain();
  EXPECT_TRUE(outbox.ack(Stream::pose, 3, 0));
  for (int i = 4; i <= 6; ++i) {
    put(i);
    EXPECT_EQ(drain(), "f" + std::to_string(i));
  }
}

TEST_F(OutboxTest, OldAndForeignAcksDoNoHarm) {
  EXPECT_FALSE(outbox.ack(Stream::pose, 1, 0));
  follow(0.0, 1);
  put(5);
  EXPECT_EQ(drain(), "f5");
  EXPECT_TRUE(outbox.ack(Stream::pose, 4, 0));
  put(6);
  EXPECT_EQ(drain(), "");
  EXPECT_TRUE(outbox.ack(Stream::pose, 1'000'000, 0));
  EXPECT_EQ(drain(), "f6");
}

TEST_F(OutboxTest, CreditThatNobodyCanRenewIsWaived) {
  follow(0.0, 1);
  put(1);
  EXPECT_EQ(drain(), "f1");
  put(2);
  EXPECT_EQ(drain(), "");
  outbox.waive_credit();
  EXPECT_EQ(drain(), "f2");
  put(3);
  EXPECT_EQ(drain(), "f3");
}

TEST_F(OutboxTest, TheRateIsACapAndTheNewestIsSentWhenDue) {
  follow(10.0);
  put(1, 0);
  EXPECT_EQ(drain(0), "f1");
  put(2, kSecond / 100);
  put(3, kSecond / 50);
  EXPECT_EQ(drain(kSecond / 50), "");
  ASSERT_TRUE(outbox.due());
  EXPECT_EQ(*outbox.due(), kSecond / 10);
  EXPECT_EQ(drain(kSecond / 10 - 1), "");
  EXPECT_EQ(drain(kSecond / 10), "f3") << "what the rate leaves out is no loss";
  EXPECT_EQ(tally.dropped.load(), 0u);
  EXPECT_EQ(tally.thinned.load(), 1u);
}

TEST_F(OutboxTest, TheRateHoldsOverTimeEvenWithLateTimers) {
  follow(60.0);
  int sent = 0;
  const Nanoseconds step = kSecond / 240;
  for (int i = 0; i < 240 * 10; ++i) {
    const Nanoseconds now = i * step + (i % 7) * 100'000;
    put(i + 1, now);
    while (auto out = outbox.next(now)) sent += out->frame;
  }
  EXPECT_LE(sent, 601);
  EXPECT_GE(sent, 595);
}

TEST_F(OutboxTest, ASilenceEarnsNoBurst) {
  follow(10.0);
  put(1, 0);
  EXPECT_EQ(drain(0), "f1");
  const Nanoseconds later = 60 * kSecond;
  put(2, later);
  EXPECT_EQ(drain(later), "f2");
  put(3, later + 1);
  EXPECT_EQ(drain(later + 1), "");
  EXPECT_EQ(*outbox.due(), later + kSecond / 10);
}

TEST_F(OutboxTest, ASlowPeerWithARateLosesOnlyWhatItsRateWouldHaveBroughtIt) {
  follow(10.0);
  put(1, 0);
  EXPECT_EQ(drain(0), "f1");
  // One second in which the socket takes nothing, at 100 Hz: ten were due.
  for (int i = 1; i <= 100; ++i) put(1 + i, i * kSecond / 100);
  EXPECT_EQ(tally.dropped.load() + tally.thinned.load(), 99u);
  EXPECT_NEAR(static_cast<double>(tally.dropped.load()), 9.0, 1.0);
  const std::string got = drain(2 * kSecond);
  EXPECT_TRUE(got.ends_with(" f101")) << got;
}

TEST_F(OutboxTest, ANewSubscriptionForgetsTheOldOne) {
  follow(0.0, 1);
  put(1);
  EXPECT_EQ(drain(), "f1");
  put(2);
  put(3);
  outbox.subscribe({Stream::pose, 4, 0.0, 1, true}, frame("present"), 3, 0);
  EXPECT_EQ(outbox.subscription(Stream::pose)->key, 4u);
  EXPECT_EQ(drain(), "present");
}

TEST_F(OutboxTest, AfterUnsubscribingNothingComes) {
  follow();
  put(1);
  outbox.unsubscribe(Stream::pose);
  put(2);
  EXPECT_EQ(drain(), "");
  EXPECT_FALSE(outbox.subscribed());
  EXPECT_EQ(outbox.subscription(Stream::pose), nullptr);
}

TEST_F(OutboxTest, StreamsTakeTurns) {
  for (Stream stream : {Stream::pose, Stream::tracker, Stream::stats}) follow(0.0, 0, stream);
  std::vector<int> sent(3, 0);
  for (int round = 0; round < 30; ++round) {
    // All have something, only one can go.
    for (Stream stream : {Stream::pose, Stream::tracker, Stream::stats}) {
      EXPECT_TRUE(outbox.put(stream, static_cast<std::uint64_t>(round + 1),
                             frame(std::string(1, "pt?s"[static_cast<int>(stream)])), 0));
    }
    auto out = outbox.next(0);
    while (!out->frame) out = outbox.next(0);
    ++sent[std::string("pts").find(out->bytes)];
  }
  EXPECT_EQ(sent, std::vector<int>(3, 10));
}

TEST_F(OutboxTest, AStreamWithoutCreditDoesNotHoldUpAnother) {
  follow(0.0, 1, Stream::pose);
  follow(0.0, 0, Stream::tracker);
  put(1);
  EXPECT_EQ(drain(), "f1");
  put(2);
  put(3, 0, Stream::tracker);
  EXPECT_EQ(drain(), "f3");
}

TEST_F(OutboxTest, TheSceneIsNeverThinned) {
  outbox.subscribe({Stream::scene, 0, 1.0, 1, false}, frame("snapshot"), 1, 0);
  ASSERT_TRUE(outbox.reply(line("r")));
  for (int i = 2; i <= 5; ++i) put(i, 0, Stream::scene);
  EXPECT_EQ(drain(), "snapshot r f2 f3 f4 f5");
  EXPECT_EQ(tally.dropped.load(), 0u);
}

TEST_F(OutboxTest, TheSceneIsUnderTheCapOfReplies) {
  outbox.subscribe({Stream::scene, 0, 0.0, 0, false}, {}, 0, 0);
  EXPECT_TRUE(outbox.put(Stream::scene, 1, frame(std::string(999, 'x')), 0));
  EXPECT_FALSE(outbox.put(Stream::scene, 2, frame("xx"), 0));
}

TEST_F(OutboxTest, BytesOfTheirOwnAreOutsideTheCap) {
  outbox.set_framing(Framing::text);
  outbox.send(line(std::string(5000, 'x')), Framing::raw);
  const auto out = outbox.next(0);
  ASSERT_TRUE(out);
  EXPECT_EQ(out->framing, Framing::raw);
  ASSERT_TRUE(outbox.reply(line("r")));
  EXPECT_EQ(outbox.next(0)->framing, Framing::text);
}

TEST_F(OutboxTest, ANewFramePassesOnlyWhatHoldsNothingBack) {
  EXPECT_FALSE(outbox.pass(Stream::pose, 1, 0, 0)) << "nobody has subscribed";
  follow(10.0, 2);
  EXPECT_TRUE(outbox.pass(Stream::pose, 1, 0, 0));
  EXPECT_FALSE(outbox.pass(Stream::pose, 2, 0, 1)) << "the rate";
  EXPECT_TRUE(outbox.pass(Stream::pose, 3, 0, kSecond / 10));
  EXPECT_FALSE(outbox.pass(Stream::pose, 4, 0, kSecond)) << "1 and 3 are under way";
  EXPECT_TRUE(outbox.ack(Stream::pose, 3, 0));
  ASSERT_TRUE(outbox.reply(line("r")));
  EXPECT_FALSE(outbox.pass(Stream::pose, 5, 0, kSecond)) << "a reply goes first";
  EXPECT_EQ(drain(kSecond), "r");
  put(6, kSecond);
  EXPECT_FALSE(outbox.pass(Stream::pose, 7, 0, kSecond)) << "an older one waits, and its loss is to be told";
  outbox.subscribe({Stream::scene, 0, 0.0, 0, false}, {}, 0, 0);
  EXPECT_FALSE(outbox.pass(Stream::scene, 1, 0, kSecond)) << "queued in order, always";
}

TEST_F(OutboxTest, WhoAsksForTheSameRateIsDueAtTheSameTime) {
  Outbox other(100, 1000, tally);
  for (Outbox* box : {&outbox, &other}) {
    const Nanoseconds begin = box == &other ? kSecond / 30 : 0;
    box->subscribe({Stream::pose, 0, 10.0, 0, true}, frame("present"), 0, begin);
    while (box->next(begin)) {
    }
    EXPECT_TRUE(box->put(Stream::pose, 1, frame("f1"), kSecond / 20));
  }
  EXPECT_EQ(outbox.due(), kSecond / 10);
  EXPECT_EQ(other.due(), kSecond / 10);
}

TEST_F(OutboxTest, EveryFaceSendsItsPartOfOneFrame) {
  const StreamFrame shared(std::string(300, 'x'));
  EXPECT_EQ(shared.as(Framing::line), std::string(300, 'x') + "\n");
  EXPECT_EQ(shared.as(Framing::text), std::string("\x81\x7e\x01\x2c", 4) + std::string(300, 'x'));
  EXPECT_EQ(shared.as(Framing::raw), std::string(300, 'x'));
  for (const Framing framing : {Framing::line, Framing::text}) {
    outbox.set_framing(framing);
    follow();
    ASSERT_TRUE(outbox.put(Stream::pose, 1, shared, 0));
    const auto out = outbox.next(0);
    ASSERT_TRUE(out);
    EXPECT_EQ(out->bytes, shared.as(framing));
    EXPECT_EQ(out->owner, shared.wire()) << "no copy";
    EXPECT_EQ(out->framing, Framing::raw);
  }
}

TEST_F(OutboxTest, TheAgeOfWhatIsAcknowledgedIsCounted) {
  follow(0.0, 3);
  for (int i = 1; i <= 3; ++i) {
    EXPECT_TRUE(outbox.put(Stream::pose, static_cast<std::uint64_t>(i), StreamFrame("f", false, i * kSecond), 0));
    drain();
  }
  EXPECT_TRUE(outbox.ack(Stream::pose, 2, 5 * kSecond));
  const AgeCounts ages = tally.acked_age.read();
  EXPECT_EQ(ages.total(), 1u) << "of the newest that the ack covers";
  EXPECT_NEAR(ages.quantile_us(0.5), 3e6, 0.1 * 3e6);
  put(4);  // without a time
  drain();
  EXPECT_TRUE(outbox.ack(Stream::pose, 4, 9 * kSecond));
  EXPECT_EQ(tally.acked_age.read().total(), 1u);
}

TEST(Ages, QuantilesAreRightToATenth) {
  AgeMeter meter;
  EXPECT_EQ(meter.read().quantile_us(0.5), 0.0);
  for (int i = 1; i <= 1000; ++i) meter.add(i * 1000);
  const AgeCounts before = meter.read();
  EXPECT_EQ(before.total(), 1000u);
  for (const double p : {0.01, 0.5, 0.9, 0.99}) EXPECT_NEAR(before.quantile_us(p), 1000.0 * p, 100.0 * p + 1.0);
  for (const Nanoseconds age : {Nanoseconds{-5}, Nanoseconds{0}, Nanoseconds{7}, INT64_MAX}) meter.add(age);
  EXPECT_EQ(meter.read().since(before).total(), 4u) << "whatever the clock says";
  for (Nanoseconds age = 8; age < Nanoseconds{1} << 40; age += 1 + age / 7) {
    AgeMeter one;
    one.add(age);
    EXPECT_NEAR(one.read().quantile_us(0.5), 1e-3 * static_cast<double>(age), 0.07e-3 * static_cast<double>(age));
  }
}

TEST_F(OutboxTest, HugeCreditIsBounded) {
  follow(0.0, 2'000'000'000);
  int sent = 0;
  for (int i = 1; i <= 5000; ++i) {
    put(i);
    while (auto out = outbox.next(0)) sent += out->frame;
  }
  EXPECT_EQ(sent, 1024);
}

}  // namespace
}  // namespace posed::net
