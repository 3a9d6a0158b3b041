// JSON lines over real sockets: requests, half-close, limits, stopping.
#include <gtest/gtest.h>
#include <sys/resource.h>

#include "fake_station.h"

namespace posed::net {
namespace {

using namespace test;  // NOLINT: the vocabulary of these tests

TEST(Lines, ARequestGetsItsReply) {
  FakeStation station;
  RawPeer peer(station.server.port());
  ASSERT_TRUE(peer.connected());
  for (int i = 1; i <= 3; ++i) {
    const auto reply = peer.call(proto::SessionPing{}, i);
    EXPECT_EQ(reply.id, i);
    const auto result = proto::decode_message<proto::PingResult>(reply.result);
    ASSERT_TRUE(result);
    EXPECT_GT(result->receive_t_ns, 0);
  }
  const auto peers = station.open_peers();
  ASSERT_EQ(peers.size(), 1u);
  EXPECT_FALSE(peers.begin()->second.websocket);
  EXPECT_TRUE(peers.begin()->second.address.starts_with("127.0.0.1:"));
}

TEST(Lines, BytesMayComeOneByOne) {
  FakeStation station;
  RawPeer peer(station.server.port());
  for (const char c : "\r\n" + ping(1) + "\n\n" + ping(2)) {
    peer.send(std::string(1, c));
    std::this_thread::yield();
  }
  EXPECT_EQ(peer.incoming().id, 1);
  EXPECT_EQ(peer.incoming().id, 2);
}

TEST(Lines, APeerWhoSaysNothingIsNoPeerYet) {
  FakeStation station;
  RawPeer silent(station.server.port());
  RawPeer peer(station.server.port());
  peer.call(proto::SessionPing{});
  EXPECT_EQ(station.open_peers().size(), 1u);
  EXPECT_EQ(station.server.counters().connections, 2u);
  silent.end();
  EXPECT_EQ(silent.rest(), "");
}

TEST(Lines, HalfClosedStillGetsItsReplies) {
  FakeStation station;
  station.hold();
  RawPeer peer(station.server.port());
  peer.send(ping(1) + ping(2) + "this is not JSON\n");
  peer.end();
  ASSERT_TRUE(eventually([&] { return station.waiting_lines() == 3; }));
  station.release();
  EXPECT_EQ(peer.incoming().id, 1);
  EXPECT_EQ(peer.incoming().id, 2);
  const auto bad = peer.incoming();
  ASSERT_TRUE(bad.error);
  EXPECT_EQ(bad.error->code, "parse_error");
  EXPECT_TRUE(peer.at_end());
  EXPECT_TRUE(eventually([&] { return station.open_peers().empty(); }));
}

TEST(Lines, ALastLineWithoutItsEndCounts) {
  FakeStation station;
  RawPeer peer(station.server.port());
  std::string text = ping(1) + ping(2);
  text.pop_back();
  peer.send(text);
  peer.end();
  EXPECT_EQ(peer.incoming().id, 1);
  EXPECT_EQ(peer.incoming().id, 2);
  EXPECT_TRUE(peer.at_end());
}

TEST(Lines, AShortTextThatCouldHaveBecomeHttpIsALine) {
  FakeStation station;
  RawPeer peer(station.server.port());
  peer.send("GE");
  peer.end();
  EXPECT_EQ(peer.incoming().error->code, "parse_error");
  EXPECT_TRUE(peer.at_end());
}

TEST(Lines, NotificationsGetNoReply) {
  FakeStation station;
  RawPeer peer(station.server.port());
  peer.send(proto::encode_notification(proto::SessionPing{}) + "\n" + ping(7));
  peer.end();
  EXPECT_EQ(peer.incoming().id, 7);
  EXPECT_TRUE(peer.at_end());
}

TEST(Lines, ABatchPasses) {
  FakeStation station;
  RawPeer peer(station.server.port());
  const auto one = [](int id) { return proto::encode_request(id, proto::SessionPing{}); };
  peer.send("[" + one(1) + "," + proto::encode_notification(proto::SessionPing{}) + ",5," + one(2) + "]\n");
  const auto text = peer.line();
  ASSERT_TRUE(text);
  EXPECT_TRUE(text->starts_with("[") && text->ends_with("]"));
  EXPECT_NE(text->find("\"id\":1"), std::string::npos);
  EXPECT_NE(text->find("invalid_request"), std::string::npos);
  EXPECT_NE(text->find("\"id\":2"), std::string::npos);
}

TEST(Lines, AcksThatWantAReplyGoOnToTheStation) {
  FakeStation station;
  RawPeer peer(station.server.port());
  peer.send(proto::encode_notification(proto::StreamAck{proto::Stream::pose, 1}) + "\n");
  peer.follow({proto::Stream::pose, {}, {}, 0.0, 1});
  const auto reply = peer.call(proto::StreamAck{proto::Stream::pose, 1}, 3);
  EXPECT_EQ(reply.id, 3);
  EXPECT_FALSE(reply.error);
  const std::lock_guard lock(station.mutex);
  EXPECT_EQ(station.lines, 2) << "the notification stays below";
}

TEST(Lines, TooLongALineIsToldAfterWhatIsOwed) {
  Options options = options_on_a_free_port();
  options.limits.line_bytes = 1000;
  FakeStation station(std::move(options));
  station.hold();
  RawPeer peer(station.server.port());
  peer.send(ping(1));
  ASSERT_TRUE(eventually([&] { return station.waiting_lines() == 1; }));
  peer.send(std::string(5000, '{'));
  station.release();
  EXPECT_EQ(peer.incoming().id, 1);
  const auto told = peer.incoming();
  ASSERT_TRUE(told.error);
  EXPECT_EQ(told.error->code, "too_large");
  EXPECT_FALSE(told.id);
  EXPECT_TRUE(peer.at_end());
}

TEST(Lines, ALineOfAMebibytePasses) {
  FakeStation station;
  RawPeer peer(station.server.port());
  std::string text = ping(1);
  text.insert(text.size() - 1, std::string(proto::kMaxLineBytes - text.size() + 1, ' '));
  ASSERT_EQ(text.size(), proto::kMaxLineBytes + 1);
  peer.send(text);
  EXPECT_EQ(peer.incoming().id, 1);
  text.insert(text.size() - 1, " ");
  peer.send(text);
  EXPECT_EQ(peer.incoming().error->code, "too_large");
  EXPECT_TRUE(peer.at_end());
}

TEST(Lines, AnswersMayComeInAnyOrderAndNumber) {
  FakeStation station;
  RawPeer peer(station.server.port());
  constexpr int kLines = 20'000;
  std::jthread writer([&] {
    std::string text;
    for (int i = 1; i <= kLines; ++i) text += ping(i);
    peer.send(text);
    peer.end();
  });
  for (int i = 1; i <= kLines; ++i) ASSERT_EQ(peer.incoming().id, i);
  EXPECT_TRUE(peer.at_end());
}

TEST(Lines, WithTooManyUnansweredNothingMoreIsRead) {
  Options options = options_on_a_free_port();
  options.limits.unanswered = 10;
  FakeStation station(std::move(options));
  station.hold();
  RawPeer peer(station.server.port());
  std::string text;
  for (int i = 1; i <= 50; ++i) text += ping(i);
  peer.send(text);
  ASSERT_TRUE(eventually([&] { return station.waiting_lines() == 10; }));
  RawPeer other(station.server.port());
  other.send(ping(1));
  ASSERT_TRUE(eventually([&] { return station.waiting_lines() >= 11; })) << "others go on";
  EXPECT_EQ(station.waiting_lines(), 11u);
  station.release();
  for (int i = 1; i <= 50; ++i) ASSERT_EQ(peer.incoming().id, i);
}

TEST(Lines, WhoDoesNotReadIsNotReadFrom) {
  Options options = options_on_a_free_port();
  options.limits.unread_bytes = 10'000;
  FakeStation station(std::move(options));
  station.padding = 100'000;
  RawPeer peer(station.server.port(), 4096);
  std::string text;
  for (int i = 1; i <= 400; ++i) text += proto::encode_request(i, proto::SessionStatus{}) + "\n";
  std::jthread writer([&] { peer.send(text); });
  // 40 MB are on offer; what is taken up is what the kernel's buffers hold.
  RawPeer other(station.server.port());
  for (int i = 1; i <= 100; ++i) EXPECT_EQ(other.call(proto::SessionPing{}, i).id, i);
  for (int i = 1; i <= 400; ++i) ASSERT_EQ(peer.incoming().id, i);
}

TEST(Lines, TooManyRepliesCloseThePeerAndSayWhy) {
  Options options = options_on_a_free_port();
  options.limits.reply_bytes = 3'000'000;
  FakeStation station(std::move(options));
  station.padding = 500'000;
  station.hold();
  RawPeer peer(station.server.port(), 4096);
  for (int i = 1; i <= 20; ++i) peer.send(proto::encode_request(i, proto::SessionStatus{}) + "\n");
  ASSERT_TRUE(eventually([&] { return station.waiting_lines() == 20; }));
  RawPeer other(station.server.port());
  station.release();
  EXPECT_EQ(other.call(proto::SessionPing{}).id, 1);
  std::int64_t replies = 0;
  for (;;) {
    const auto incoming = peer.incoming();
    if (incoming.error) {
      EXPECT_EQ(incoming.error->code, "too_large");
      break;
    }
    ASSERT_EQ(incoming.id, ++replies);
  }
  EXPECT_LT(replies, 20);
  EXPECT_TRUE(peer.at_end());
}

TEST(Lines, APortInUseIsAClearSentence) {
  FakeStation station;
  Options options;
  options.port = station.server.port();
  try {
    const FakeStation second(std::move(options));
    FAIL() << "it listens twice";
  } catch (const std::runtime_error& error) {
    EXPECT_EQ(error.what(), "port " + std::to_string(station.server.port()) +
                                " on 127.0.0.1 is in use; is posed already running? choose another with --listen");
  }
}

TEST(Lines, WrongAddressesAreClearSentences) {
  for (const auto& [host, words] : {std::pair{"192.0.2.1", "no address of this machine"},
                                    std::pair{"no such host", "no address and no host name"}}) {
    Options options = options_on_a_free_port();
    options.host = host;
    try {
      const FakeStation station(std::move(options));
      FAIL() << host;
    } catch (const std::runtime_error& error) {
      EXPECT_NE(std::string(error.what()).find(words), std::string::npos) << error.what();
    }
  }
}

TEST(Lines, StopSendsWhatIsQueuedAndCloses) {
  FakeStation station;
  RawPeer peer(station.server.port()), silent(station.server.port()), follower(station.server.port());
  follower.follow({proto::Stream::pose, {}, {}, 0.0, 0});
  station.hold();
  peer.send(ping(1) + ping(2));
  ASSERT_TRUE(eventually([&] { return station.waiting_lines() == 2; }));
  station.release();
  station.server.stop();
  EXPECT_EQ(peer.incoming().id, 1);
  EXPECT_EQ(peer.incoming().id, 2);
  EXPECT_TRUE(peer.at_end());
  EXPECT_TRUE(silent.at_end());
  EXPECT_TRUE(follower.at_end());
  EXPECT_TRUE(station.open_peers().empty());
  EXPECT_EQ(station.server.counters().connections, 0u);
  EXPECT_FALSE(RawPeer(station.server.port()).connected());
  station.server.stop();
  station.server.publish(proto::Stream::pose, 0, 1, share("late"));
}

TEST(Lines, StopDoesNotWaitForWhoDoesNotRead) {
  Options options = options_on_a_free_port();
  options.limits.stop = 100'000'000;
  options.limits.reply_bytes = 1 << 30;
  FakeStation station(std::move(options));
  station.padding = 20'000'000;
  RawPeer peer(station.server.port(), 4096);
  peer.send(proto::encode_request(1, proto::SessionStatus{}) + "\n");
  ASSERT_TRUE(eventually([&] { return station.server.counters().replies == 1; }));
  station.server.stop();
  EXPECT_TRUE(station.open_peers().empty());
}

TEST(Lines, ThereIsALimitOfConnections) {
  Options options = options_on_a_free_port();
  options.limits.connections = 3;
  FakeStation station(std::move(options));
  std::vector<RawPeer> peers;
  for (int i = 0; i < 3; ++i) {
    peers.emplace_back(station.server.port());
    EXPECT_EQ(peers.back().call(proto::SessionPing{}).id, 1);
  }
  RawPeer refused(station.server.port());
  EXPECT_TRUE(refused.at_end());
  EXPECT_EQ(station.server.counters().refused, 1u);
  peers.pop_back();
  ASSERT_TRUE(eventually([&] { return station.server.counters().connections == 2; }));
  EXPECT_EQ(RawPeer(station.server.port()).call(proto::SessionPing{}).id, 1);
}

TEST(Lines, OneAddressHasSoManyConnectionsAndGetsThemBack) {
  Options options = options_on_a_free_port();
  options.limits.connections_per_address = 2;
  FakeStation station(std::move(options));
  for (int round = 0; round < 3; ++round) {
    RawPeer first(station.server.port()), second(station.server.port());
    EXPECT_EQ(first.call(proto::SessionPing{}).id, 1);
    EXPECT_EQ(second.call(proto::SessionPing{}).id, 1);
    RawPeer third(station.server.port());
    EXPECT_TRUE(third.at_end());
    first.close();
    second.close();
    ASSERT_TRUE(eventually([&] { return station.server.counters().connections == 0; }));
  }
  EXPECT_EQ(station.server.counters().refused, 3u);
}

// Browsers can be made to say lines of somebody's choice in the midst of a TLS handshake: in a session's ticket.
TEST(Lines, NoneAreTakenOutOfATlsHandshake) {
  FakeStation station;
  RawPeer peer(station.server.port());
  peer.send(std::string("\x16\x03\x01\x02\x00\x01\x00", 7) + "\n" + ping(1) + ping(2));
  const proto::Incoming answer = peer.incoming();
  ASSERT_TRUE(answer.error);
  EXPECT_EQ(answer.error->code, "invalid_request");
  EXPECT_TRUE(peer.at_end());
  EXPECT_EQ(station.lines, 0);
}

TEST(Lines, WhoDoesNotShowWhoItIsIsClosed) {
  Options options = options_on_a_free_port();
  options.limits.admission = 500'000'000;
  FakeStation station(std::move(options));
  RawPeer known(station.server.port());
  EXPECT_EQ(known.call(proto::SessionPing{}).id, 1);
  station.server.admit(station.open_peers().begin()->first);
  RawPeer silent(station.server.port()), stranger(station.server.port());
  EXPECT_EQ(stranger.call(proto::SessionPing{}).id, 1);
  EXPECT_TRUE(silent.at_end());
  EXPECT_TRUE(stranger.at_end());
  EXPECT_EQ(known.call(proto::SessionPing{}, 2).id, 2);
}

TEST(Lines, WhoSendsTooFastIsReadMoreSlowlyAndLosesNothing) {
  Options options = options_on_a_free_port();
  options.limits.lines_per_second = 200.0;
  FakeStation station(std::move(options));
  RawPeer peer(station.server.port());
  std::string text;
  for (int i = 1; i <= 300; ++i) text += ping(i);
  const auto begin = std::chrono::steady_clock::now();
  peer.send(text);
  for (int i = 1; i <= 300; ++i) ASSERT_EQ(peer.incoming().id, i);
  // A second's worth at once, and the rest at its rate.
  EXPECT_GE(std::chrono::steady_clock::now() - begin, std::chrono::milliseconds(450));
}

TEST(Lines, WithoutDescriptorsAPeerWaitsInTheQueue) {
  FakeStation station;
  RawPeer first(station.server.port());
  EXPECT_EQ(first.call(proto::SessionPing{}).id, 1);
  rlimit before{};
  ASSERT_EQ(::getrlimit(RLIMIT_NOFILE, &before), 0);
  const int next = ::dup(STDERR_FILENO);
  ::close(next);
  rlimit tight = before;
  tight.rlim_cur = static_cast<rlim_t>(next) + 1;
  ASSERT_EQ(::setrlimit(RLIMIT_NOFILE, &tight), 0);
  RawPeer second(station.server.port());  // takes the last descriptor
  EXPECT_TRUE(second.connected());
  second.send(ping(1));
  for (int i = 1; i <= 100; ++i) EXPECT_EQ(first.call(proto::SessionPing{}, i).id, i) << "others go on";
  EXPECT_EQ(station.server.counters().accepted, 1u);
  ASSERT_EQ(::setrlimit(RLIMIT_NOFILE, &before), 0);
  EXPECT_EQ(second.incoming().id, 1);
}

TEST(Lines, ManyComeAndGo) {
  FakeStation station;
  constexpr int kThreads = 4, kEach = 125;
  std::vector<std::thread> threads;
  for (int t = 0; t < kThreads; ++t) {
    threads.emplace_back([&, t] {
      for (int i = 0; i < kEach; ++i) {
        RawPeer peer(station.server.port());
        ASSERT_TRUE(peer.connected());
        if (i % 5 == 0)
          peer.send(proto::encode_request(1, proto::StreamSubscribe{proto::Stream::stats, {}, {}, 0.0, 0}) + "\n");
        if (i % 3 != 0) peer.send(ping(i));
        if (i % 3 == 1) {
          EXPECT_TRUE(peer.reply().id);
        }
        if (i % 7 == 0) peer.end();
        if ((i + t) % 4 == 0) peer.reset();
      }
    });
  }
  for (std::uint64_t seq = 1; seq <= 500; ++seq) station.publish(seq, 500);
  for (auto& thread : threads) thread.join();
  // A follower who is gone looks like one who has half-closed, until the next frame.
  std::uint64_t seq = 500;
  EXPECT_TRUE(eventually([&] {
    station.publish(++seq);
    return station.server.counters().connections == 0;
  }));
  const std::lock_guard lock(station.mutex);
  EXPECT_EQ(station.opened, station.closed);
  EXPECT_TRUE(station.peers.empty());
}

}  // namespace
}  // namespace posed::net
