// The client library: calls, streams, and what goes wrong.
#include "client/lib/client.h"

#include <gtest/gtest.h>

#include "client/lib/address.h"
#include "client/lib/clock.h"
#include "played_daemon.h"

namespace posed::client {
namespace {

using namespace test;  // NOLINT: the vocabulary of these tests
using Lines = std::vector<std::string>;
using std::chrono::milliseconds;
using std::chrono::seconds;

TEST(Address, IsReadAsPeopleWriteIt) {
  const std::pair<const char*, const char*> good[] = {
      {"tcp://127.0.0.1:1", "127.0.0.1:1"},
      {"localhost", "localhost:19870"},
      {"tcp://lab/", "lab:19870"},
      {"lab:65535", "lab:65535"},
      {"tcp://[::1]:7", "[::1]:7"},
      {"[::1]", "[::1]:19870"},
      {"tls://lab:1", "lab:1"},
  };
  for (const auto& [text, expected] : good) {
    const auto address = parse_address(text);
    ASSERT_TRUE(address) << text;
    EXPECT_EQ(address->text(), expected);
  }
  EXPECT_TRUE(parse_address("tls://lab")->tls);
  EXPECT_FALSE(parse_address("tcp://lab")->tls);
  for (const char* text :
       {"", "tcp://", "ws://lab", ":1", "lab:", "lab:0", "lab:65536", "lab:1x", "::1", "[::1", "[::1]x"}) {
    const auto address = parse_address(text);
    ASSERT_FALSE(address) << text;
    EXPECT_EQ(address.error().code, "bad_address");
  }
}

TEST(Client, NobodyListens) {
  const auto client = Client::connect(nobody());
  ASSERT_FALSE(client);
  EXPECT_EQ(client.error().code, "cannot_connect");
  EXPECT_TRUE(client.error().message.starts_with("nothing listens at 127.0.0.1:"));
  EXPECT_EQ(client.error().hint, "start the daemon with ./deploy/run");
}

TEST(Client, CallsAreAnswered) {
  PlayedDaemon daemon([](const proto::Request& request) { return reply(request, proto::PingResult{5, 7}); });
  auto client = Client::connect(daemon.address());
  ASSERT_TRUE(client);
  const auto typed = client->call<proto::PingResult>(proto::SessionPing{});
  ASSERT_TRUE(typed);
  EXPECT_EQ(typed->send_t_ns, 7);
  const auto text = client->call("session.ping");
  ASSERT_TRUE(text);
  EXPECT_NE(text->find("\"receive_t_ns\":5"), std::string::npos);
}

TEST(Client, RefusalsKeepTheirPathAndHint) {
  PlayedDaemon daemon([](const proto::Request& request) {
    return Lines{proto::encode_error(request.id, {"unknown_goal", "no such goal", "/params/id", "did you mean g1?"}) +
                 "\n"};
  });
  auto client = Client::connect(daemon.address());
  ASSERT_TRUE(client);
  const auto result = client->request(proto::GoalGet{"g2"});
  ASSERT_FALSE(result);
  EXPECT_EQ(result.error().code, "unknown_goal");
  EXPECT_EQ(result.error().path, "/params/id");
  EXPECT_EQ(result.error().hint, "did you mean g1?");
}

TEST(Client, WrongParametersAreNotSent) {
  PlayedDaemon daemon([](const proto::Request& request) { return reply(request, proto::EmptyResult{}); });
  auto client = Client::connect(daemon.address());
  ASSERT_TRUE(client);
  EXPECT_EQ(client->call("session.ping", "{").error().code, "parse_error");
  EXPECT_EQ(client->call("session.ping", "[]").error().code, "wrong_type");
  EXPECT_TRUE(client->call("session.ping"));
  EXPECT_EQ(daemon.lines().size(), 1u);
}

TEST(Client, FramesAndRepliesInterleave) {
  PlayedDaemon daemon([](const proto::Request& request) {
    Lines lines{stats_frame(1)};
    lines.push_back(proto::encode_lost(proto::Stream::stats, 3) + "\n");
    lines.push_back(stats_frame(2));
    lines.push_back(proto::encode_reply(request.id, proto::PingResult{1, 2}) + "\n");
    lines.push_back(stats_frame(3));
    return lines;
  });
  auto client = Client::connect(daemon.address());
  ASSERT_TRUE(client);
  ASSERT_TRUE(client->call<proto::PingResult>(proto::SessionPing{}));
  for (std::uint64_t seq = 1; seq <= 3; ++seq) {
    const auto frame = client->next(seconds(60));
    ASSERT_TRUE(frame);
    EXPECT_EQ(frame->seq, seq);
    EXPECT_EQ(proto::decode_message<proto::StatsData>(frame->data)->frames, seq);
  }
  EXPECT_EQ(client->lost(proto::Stream::stats), 3u);
  EXPECT_EQ(client->next(milliseconds(1)).error().code, "timeout");
  EXPECT_TRUE(client->call<proto::PingResult>(proto::SessionPing{})) << "a time-out of next() spoils nothing";
}

TEST(Client, AcknowledgesWhereThereIsCredit) {
  PlayedDaemon daemon([](const proto::Request& request) {
    if (std::get_if<proto::StreamAck>(&request.params)) return Lines{};
    Lines lines = reply(request, proto::SubscribeResult{proto::Stream::stats});
    lines.push_back(stats_frame(1));
    lines.push_back(stats_frame(2));
    return lines;
  });
  auto client = Client::connect(daemon.address());
  ASSERT_TRUE(client);
  ASSERT_TRUE(client->subscribe({proto::Stream::stats, {}, {}, 0.0, 2}));
  ASSERT_TRUE(client->next(seconds(60)));
  ASSERT_TRUE(client->next(seconds(60)));
  ASSERT_TRUE(client->unsubscribe(proto::Stream::stats));
  const Lines lines = daemon.lines();
  ASSERT_EQ(lines.size(), 4u);
  EXPECT_EQ(lines[1], proto::encode_notification(proto::StreamAck{proto::Stream::stats, 1}));
  EXPECT_EQ(lines[2], proto::encode_notification(proto::StreamAck{proto::Stream::stats, 2}));
}

// They began where the new subscription's first frame is not yet: of the scene a change was missing.
TEST(Client, FramesOfTheOldSubscriptionAreNotTheNewOnes) {
  std::uint64_t seq = 0;
  const PlayedDaemon daemon([&seq](const proto::Request& request) {
    auto lines = reply(request, proto::SubscribeResult{proto::Stream::stats});
    lines.insert(lines.begin(), stats_frame(++seq));  // sent before the request was read
    lines.push_back(stats_frame(++seq));
    return lines;
  });
  auto client = Client::connect(daemon.address());
  ASSERT_TRUE(client);
  for (const std::uint64_t first : {2u, 4u}) {
    ASSERT_TRUE(client->subscribe({proto::Stream::stats, {}, {}, 0.0, 0}));
    EXPECT_EQ(client->next(std::chrono::seconds(60))->seq, first);
  }
}

TEST(Client, ALostConnectionStaysLost) {
  PlayedDaemon daemon([](const proto::Request&) { return Lines{"close"}; });
  auto client = Client::connect(daemon.address());
  ASSERT_TRUE(client);
  for (int i = 0; i < 2; ++i) {
    const auto result = client->call("session.ping");
    ASSERT_FALSE(result);
    EXPECT_EQ(result.error().code, "connection_lost");
  }
  EXPECT_EQ(client->next(seconds(1)).error().code, "connection_lost");
}

// The daemon closes after each second frame: the follower notices nothing but a pause.
TEST(Client, AKeptConnectionComesBackWithItsSubscriptions) {
  std::uint64_t seq = 0;
  PlayedDaemon daemon([&](const proto::Request& request) -> Lines {
    if (std::get_if<proto::StreamAck>(&request.params)) return {};
    if (std::get_if<proto::SessionHello>(&request.params)) return reply(request, proto::HelloResult{});
    if (!std::get_if<proto::StreamSubscribe>(&request.params)) return reply(request, proto::PingResult{1, 2});
    Lines lines = reply(request, proto::SubscribeResult{proto::Stream::stats});
    for (int i = 0; i < 2; ++i) lines.push_back(proto::encode_stats_frame(++seq, {}) + "\n");
    lines.emplace_back("close");
    return lines;
  });
  auto client = Client::connect(daemon.address(), seconds(60), {"secret", "ana", ""});
  ASSERT_TRUE(client);
  client->keep_connected(seconds(60));
  ASSERT_TRUE(client->subscribe({proto::Stream::stats, {}, {}, 5.0, 3}));
  for (std::uint64_t expected = 1; expected <= 6; ++expected) {
    const auto frame = client->next(seconds(60));
    ASSERT_TRUE(frame) << frame.error().message;
    EXPECT_EQ(frame->seq, expected);
  }
  EXPECT_EQ(client->reconnected(), 2u);
  int hellos = 0, subscriptions = 0;
  for (const std::string& line : daemon.lines()) {
    hellos += line.find("\"token\":\"secret\"") != std::string::npos;
    subscriptions += line.find("\"max_rate_hz\":5") != std::string::npos;
  }
  EXPECT_EQ(hellos, 3);
  EXPECT_EQ(subscriptions, 3);
}

TEST(Client, ACallWhoseReplyWasLostIsNotSentAgainAndTheNextOneIsHeard) {
  int calls = 0;
  PlayedDaemon daemon([&](const proto::Request& request) {
    return ++calls == 1 ? Lines{"close"} : reply(request, proto::PingResult{1, 2});
  });
  auto client = Client::connect(daemon.address(), seconds(60));
  ASSERT_TRUE(client);
  client->keep_connected(seconds(60));
  const auto lost = client->call("session.ping");
  ASSERT_FALSE(lost) << "it may have been done";
  EXPECT_EQ(lost.error().code, "connection_lost");
  EXPECT_TRUE(client->call("session.ping"));
  EXPECT_EQ(calls, 2);
}

TEST(Client, ALateReplyIsNotTakenForAnother) {
  int calls = 0;
  std::string first;
  PlayedDaemon daemon([&](const proto::Request& request) {
    if (++calls == 1) {
      first = proto::encode_reply(request.id, proto::PingResult{1, 1}) + "\n";
      return Lines{};
    }
    return Lines{first, proto::encode_reply(request.id, proto::PingResult{2, 2}) + "\n"};
  });
  auto client = Client::connect(daemon.address());
  ASSERT_TRUE(client);
  client->set_timeout(milliseconds(20));
  EXPECT_EQ(client->call("session.ping").error().code, "timeout");
  client->set_timeout(seconds(60));
  const auto second = client->call<proto::PingResult>(proto::SessionPing{});
  ASSERT_TRUE(second);
  EXPECT_EQ(second->send_t_ns, 2);
}

TEST(Client, WhatIsNotOurProtocolIsSaid) {
  PlayedDaemon daemon([](const proto::Request&) { return Lines{"220 mail.example ESMTP\n"}; });
  auto client = Client::connect(daemon.address());
  ASSERT_TRUE(client);
  EXPECT_EQ(client->call("session.ping").error().code, "bad_reply");
  EXPECT_EQ(client->call("session.ping").error().code, "connection_lost");
}

TEST(Client, LastWordsOfTheDaemonAreHeard) {
  PlayedDaemon daemon([](const proto::Request&) {
    return Lines{proto::encode_error("null", {"too_large", "a line holds at most 1048576 bytes", "", ""}) + "\n",
                 "close"};
  });
  auto client = Client::connect(daemon.address());
  ASSERT_TRUE(client);
  EXPECT_EQ(client->call("session.ping").error().code, "too_large");
}

TEST(Client, IsWokenFromAnotherThread) {
  PlayedDaemon daemon([](const proto::Request& request) { return reply(request, proto::PingResult{1, 2}); });
  auto connected = Client::connect(daemon.address());
  ASSERT_TRUE(connected);
  Client& client = *connected;
  std::thread other([&] { client.wake(); });
  const auto woken = client.next(std::chrono::minutes(10));
  other.join();
  ASSERT_FALSE(woken);
  EXPECT_EQ(woken.error().code, "woken");
  // Before it is waited, too; and calls are not disturbed.
  client.wake();
  EXPECT_TRUE(client.call("session.ping"));
  EXPECT_EQ(client.next(std::chrono::minutes(10)).error().code, "woken");
  EXPECT_EQ(client.next(std::chrono::milliseconds(1)).error().code, "timeout");
}

TEST(Client, IsTheSameEditorAfterAReconnect) {
  int hellos = 0;
  std::string resumed;
  PlayedDaemon daemon([&](const proto::Request& request) -> std::vector<std::string> {
    if (const auto* hello = std::get_if<proto::SessionHello>(&request.params)) {
      resumed = hello->resume;
      proto::HelloResult result;
      result.resume = "key";
      auto lines = reply(request, result);
      return lines;
    }
    if (++hellos == 1) return {"close"};
    return reply(request, proto::PingResult{1, 2});
  });
  Identity ana;
  ana.user = "ana";
  auto connected = Client::connect(daemon.address(), std::chrono::seconds(5), ana);
  ASSERT_TRUE(connected);
  Client& client = *connected;
  client.keep_connected(std::chrono::seconds(60));
  EXPECT_FALSE(client.call("session.ping"));
  EXPECT_TRUE(client.call("session.ping"));
  EXPECT_EQ(resumed, "key");
}

TEST(Client, KnowsTheDaemonsClock) {
  PlayedDaemon daemon([](const proto::Request& request) {
    const Nanoseconds ahead = steady_now() + 1'000'000'000'000;
    return reply(request, proto::PingResult{ahead, ahead});
  });
  auto connected = Client::connect(daemon.address());
  ASSERT_TRUE(connected);
  Client& client = *connected;
  const auto offset = clock_offset(client);
  ASSERT_TRUE(offset);
  EXPECT_NEAR(static_cast<double>(*offset), 1e12, 5e9);
}

}  // namespace
}  // namespace posed::client
