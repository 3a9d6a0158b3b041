// Streams over real sockets: newest wins, losses are told, credit and rate.
#include <gtest/gtest.h>

#include "fake_station.h"

namespace posed::net {
namespace {

using namespace test;  // NOLINT: the vocabulary of these tests
using proto::Stream;

proto::StreamSubscribe wish(int credit = 0, double rate = 0.0, Stream stream = Stream::stats) {
  return {stream, {}, {}, rate, credit};
}

std::string ack(std::uint64_t seq) {
  return proto::encode_notification(proto::StreamAck{Stream::stats, seq}) + "\n";
}

TEST(Streams, EveryoneGetsTheSameLine) {
  FakeStation station;
  std::vector<RawPeer> peers;
  for (int i = 0; i < 5; ++i) {
    peers.emplace_back(station.server.port());
    peers.back().follow(wish());
  }
  RawPeer stranger(station.server.port());
  stranger.call(proto::SessionPing{});
  for (std::uint64_t seq = 1; seq <= 20; ++seq) {
    station.publish(seq, 3000);
    for (RawPeer& peer : peers) EXPECT_EQ(peer.line(), *FakeStation::frame(seq, 3000));
  }
  EXPECT_TRUE(eventually([&] { return station.server.counters().frames == 5 + 100; }));
  stranger.end();
  EXPECT_EQ(stranger.rest(), "") << "nothing unsolicited";
}

TEST(Streams, TheAgeOfWhatIsSentIsCounted) {
  FakeStation station;
  RawPeer peer(station.server.port());
  peer.follow(wish(1));
  peer.send(ack(0));
  const Nanoseconds old = 3'600'000'000'000;
  station.server.publish(Stream::stats, 0, 1, FakeStation::frame(1), false, station.clock.now() - old);
  EXPECT_EQ(peer.incoming().seq, 1u);
  ASSERT_TRUE(eventually([&] { return station.server.counters().sent_age.total() == 1; })) << "a frame without a time";
  EXPECT_NEAR(station.server.counters().sent_age.quantile_us(0.5), 3.6e9, 0.1 * 3.6e9);
  peer.send(ack(1));
  ASSERT_TRUE(eventually([&] { return station.server.counters().acked_age.total() == 1; }));
  EXPECT_NEAR(station.server.counters().acked_age.quantile_us(0.5), 3.6e9, 0.1 * 3.6e9);
}

TEST(Streams, AViewerThatStopsReadingIsKeptUnlessItIsOwedAReply) {
  Options options = options_on_a_free_port();
  options.limits.unread_reply = 300'000'000;
  FakeStation station(std::move(options));
  RawPeer viewer(station.server.port(), 4096);
  viewer.follow(wish());
  std::uint64_t seq = 0;
  const auto stuff = [&] {
    const std::uint64_t dropped = station.server.counters().dropped;
    while (station.server.counters().dropped == dropped) station.publish(++seq, 50'000);
  };
  // Much longer than what a reply may wait.
  for (int i = 0; i < 10; ++i) {
    stuff();
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
  }
  EXPECT_EQ(station.open_peers().size(), 1u);
  viewer.send(ping(2));
  EXPECT_TRUE(eventually([&] { return station.open_peers().empty(); }));
}

TEST(Streams, OthersKeysAreOthersFrames) {
  FakeStation station;
  RawPeer peer(station.server.port());
  peer.follow(wish());
  station.server.publish(Stream::stats, 1, 1, share("not mine"));
  station.server.publish(Stream::pose, 0, 1, share("not mine"));
  station.publish(2);
  EXPECT_EQ(peer.incoming().seq, 2u);
}

TEST(Streams, UnsubscribeEndsThem) {
  FakeStation station;
  RawPeer peer(station.server.port());
  peer.follow(wish());
  EXPECT_FALSE(peer.call(proto::StreamUnsubscribe{Stream::stats}).error);
  station.publish(1);
  EXPECT_EQ(peer.call(proto::SessionPing{}, 9).id, 9);
  peer.end();
  EXPECT_EQ(peer.rest(), "");
}

TEST(Streams, AHalfClosedFollowerIsStillServed) {
  FakeStation station;
  RawPeer peer(station.server.port());
  peer.send(proto::encode_request(1, wish(2)) + "\n");
  peer.end();
  EXPECT_EQ(peer.incoming().id, 1);
  EXPECT_EQ(peer.incoming().method, "stream.frame");
  for (std::uint64_t seq = 1; seq <= 10; ++seq) {
    station.publish(seq);
    EXPECT_EQ(peer.incoming().seq, seq) << "no ack can come: credit is waived";
  }
  peer.close();
  EXPECT_TRUE(eventually([&] {
    station.publish(11);
    return station.open_peers().empty();
  }));
}

TEST(Streams, ASlowReaderDelaysNobodyAndIsToldWhatItLost) {
  FakeStation station;
  RawPeer slow(station.server.port(), 4096), fast(station.server.port());
  slow.follow(wish());
  fast.follow(wish());
  constexpr std::size_t kSize = 100'000;
  std::uint64_t seq = 0;
  // Until the slow one has filled its buffers and lost a hundred frames; the fast one has each before the next is made.
  while (station.server.counters().dropped < 100) {
    ASSERT_LT(seq, 5000u);
    station.publish(++seq, kSize);
    ASSERT_EQ(fast.incoming().seq, seq);
  }
  std::uint64_t got = 0, lost = 0, last = 0;
  while (last < seq) {
    const auto incoming = slow.incoming();
    if (incoming.method == "stream.lost") {
      lost += incoming.dropped;
      continue;
    }
    ASSERT_EQ(incoming.method, "stream.frame");
    ++got;
    EXPECT_EQ(incoming.seq, got + lost) << "each loss is told before the frame after it";
    last = incoming.seq;
  }
  EXPECT_EQ(got + lost, seq);
  EXPECT_EQ(lost, station.server.counters().dropped);
  EXPECT_LT(got * kSize, 2'000'000u) << "the kernel holds little of the past";
}

TEST(Streams, CreditLimitsWhatIsUnderWay) {
  FakeStation station;
  RawPeer peer(station.server.port());
  peer.follow(wish(3));
  peer.send(ack(0));
  EXPECT_EQ(peer.call(proto::SessionPing{}).id, 1) << "the ack is booked";
  for (std::uint64_t seq = 1; seq <= 10; ++seq) {
    station.publish(seq);
    EXPECT_EQ(peer.call(proto::SessionPing{}).id, 1) << "each on its own";
    if (seq == 1) peer.send(ack(0));
  }
  peer.send(ack(3));
  // By now 1, 2 and 3 have come, which reply() has skipped.
  auto incoming = peer.incoming();
  EXPECT_EQ(incoming.method, "stream.lost");
  EXPECT_EQ(incoming.dropped, 6u);
  EXPECT_EQ(peer.incoming().seq, 10u);
  EXPECT_TRUE(eventually([&] { return station.server.counters().frames == 1 + 3 + 1; }));
}

TEST(Streams, AStalledViewerWakesToAFreshFrame) {
  FakeStation station;
  RawPeer peer(station.server.port());
  peer.follow(wish(2));
  std::uint64_t seq = 0;
  while (station.server.counters().dropped < 1000) {
    station.publish(++seq, 1000);
    if (seq % 50 == 0) std::this_thread::yield();
    ASSERT_LT(seq, 1'000'000u);
  }
  ASSERT_TRUE(eventually([&] { return station.server.counters().dropped + 2 >= seq; }));
  // One frame more was let out before the first ack; what comes after is the newest.
  int stale = 0;
  for (;;) {
    const auto incoming = peer.incoming();
    if (incoming.method != "stream.frame") continue;
    peer.send(ack(incoming.seq));
    if (incoming.seq == seq) break;
    ++stale;
  }
  EXPECT_LE(stale, 2);
}

TEST(Streams, TheRateIsACapAndTheLastStateArrives) {
  FakeStation station;
  RawPeer peer(station.server.port());
  peer.follow(wish(0, 20.0));
  for (std::uint64_t seq = 1; seq <= 1000; ++seq) station.publish(seq);
  int frames = 0;
  const auto begin = std::chrono::steady_clock::now();
  for (std::uint64_t last = 0; last < 1000; ++frames) {
    const auto incoming = peer.incoming();
    ASSERT_EQ(incoming.method, "stream.frame") << "thinning is no loss";
    last = incoming.seq;
  }
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  EXPECT_LE(frames, 2.0 + seconds * 20.0);
  EXPECT_EQ(station.server.counters().dropped, 0u);
  // The last is counted once the kernel has taken it, which may be after it has come.
  EXPECT_TRUE(eventually([&] { return station.server.counters().thinned + station.server.counters().frames >= 1001; }));
  EXPECT_EQ(station.server.counters().thinned + station.server.counters().frames, 1001u);
}

TEST(Streams, TheSceneIsNeverThinned) {
  Options options = options_on_a_free_port();
  options.limits.reply_bytes = 64 << 20;
  FakeStation station(std::move(options));
  RawPeer peer(station.server.port(), 4096);
  peer.follow(wish(1, 1.0, Stream::scene));
  constexpr std::uint64_t kFrames = 300;
  for (std::uint64_t seq = 1; seq <= kFrames; ++seq) station.publish(seq, 20'000, Stream::scene);
  for (std::uint64_t seq = 1; seq <= kFrames; ++seq) ASSERT_EQ(peer.incoming().seq, seq);
}

TEST(Streams, ASceneFollowerWhoReadsNothingIsClosed) {
  Options options = options_on_a_free_port();
  options.limits.reply_bytes = 1 << 20;
  options.limits.farewell = 50'000'000;
  FakeStation station(std::move(options));
  RawPeer peer(station.server.port(), 4096);
  peer.follow(wish(0, 0.0, Stream::scene));
  for (std::uint64_t seq = 1; seq <= 200; ++seq) station.publish(seq, 100'000, Stream::scene);
  EXPECT_TRUE(eventually([&] { return station.open_peers().empty(); }));
}

TEST(Streams, SubscribingAnewReplacesTheOld) {
  FakeStation station;
  RawPeer peer(station.server.port());
  peer.follow(wish(1));
  station.publish(1);
  peer.follow(wish(0));
  for (std::uint64_t seq = 2; seq <= 10; ++seq) {
    station.publish(seq);
    EXPECT_EQ(peer.incoming().seq, seq) << "once each, and no old credit counts";
  }
}

TEST(Streams, ABacklogOfTheLoopIsSkippedNotReplayed) {
  FakeStation station(options_on_a_free_port(), false);
  // Frames that were published while nobody ran are found at once.
  for (std::uint64_t seq = 1; seq <= 100; ++seq) station.publish(seq);
  station.server.start();
  RawPeer peer(station.server.port());
  peer.follow(wish());
  station.publish(101);
  EXPECT_EQ(peer.incoming().seq, 101u);
}

}  // namespace
}  // namespace posed::net
