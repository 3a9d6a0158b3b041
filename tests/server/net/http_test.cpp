// HTTP and WebSocket over real sockets. Boost.Beast is the other side of the WebSocket.
#include <gtest/gtest.h>

#include <boost/asio/connect.hpp>
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/beast/core/buffers_to_string.hpp>
#include <boost/beast/core/flat_buffer.hpp>
#include <boost/beast/websocket/stream.hpp>
#include <filesystem>
#include <fstream>

#include "fake_station.h"

namespace posed::net {
namespace {

using namespace test;  // NOLINT: the vocabulary of these tests
namespace asio = boost::asio;
namespace beast = boost::beast;
namespace fs = std::filesystem;

class Http : public ::testing::Test {
 protected:
  Http() {
    std::string name = (fs::temp_directory_path() / "posed-http-XXXXXX").string();
    folder = mkdtemp(name.data());
    std::ofstream(folder / "index.html") << "<p>viewer";
    std::ofstream(folder / "big.js") << std::string(3'000'000, 'x');
    Options options = options_on_a_free_port();
    options.viewer = folder;
    station.emplace(std::move(options));
  }
  ~Http() override { fs::remove_all(folder); }

  std::uint16_t port() const { return station->server.port(); }
  // The whole answer to one request.
  std::string fetch(const std::string& method, const std::string& target, const std::string& more = "",
                    const std::string& host = "localhost") {
    RawPeer peer(port());
    peer.send(method + " " + target + " HTTP/1.1\r\nHost: " + host + "\r\nConnection: close\r\n" + more + "\r\n");
    return peer.rest();
  }

  fs::path folder;
  std::optional<FakeStation> station;
};

std::string body_of(const std::string& answer) {
  const std::size_t end = answer.find("\r\n\r\n");
  return end == std::string::npos ? "no header" : answer.substr(end + 4);
}
bool has(const std::string& text, std::string_view part) {
  return text.find(part) != std::string::npos;
}

TEST_F(Http, ServesTheViewer) {
  const std::string answer = fetch("GET", "/");
  EXPECT_TRUE(answer.starts_with("HTTP/1.1 200 OK\r\n")) << answer;
  EXPECT_TRUE(has(answer, "Content-Type: text/html; charset=utf-8\r\n"));
  EXPECT_TRUE(has(answer, "Content-Length: 9\r\n"));
  EXPECT_TRUE(has(answer, "Content-Security-Policy: default-src 'self';"));
  EXPECT_TRUE(has(answer, "X-Content-Type-Options: nosniff\r\n"));
  EXPECT_EQ(body_of(answer), "<p>viewer");
  EXPECT_EQ(body_of(fetch("GET", "/big.js")), std::string(3'000'000, 'x'));
  EXPECT_TRUE(station->open_peers().empty()) << "visitors are no peers";
}

TEST_F(Http, RefusesWhatIsNotThereAndWhatIsOutside) {
  for (const char* target : {"/none", "/../http_test", "/%2e%2e/etc/passwd", "/.hidden", "//etc/passwd"}) {
    EXPECT_TRUE(fetch("GET", target).starts_with("HTTP/1.1 404 ")) << target;
  }
}

TEST_F(Http, PackedFilesGoToWhoTakesThem) {
  std::ofstream(folder / "big.js.gz") << "packed";
  for (const char* takes : {"Accept-Encoding: gzip, br\r\n", "Accept-Encoding: br\r\nAccept-Encoding: gzip\r\n"}) {
    const std::string answer = fetch("GET", "/big.js", takes);
    EXPECT_TRUE(has(answer, "Content-Encoding: gzip\r\n")) << takes;
    EXPECT_TRUE(has(answer, "Content-Type: text/javascript; charset=utf-8\r\n"));
    EXPECT_TRUE(has(answer, "Content-Length: 6\r\n"));
    EXPECT_EQ(body_of(answer), "packed");
  }
  for (const char* refuses : {"", "Accept-Encoding: gzip;q=0\r\n", "Accept-Encoding: identity\r\n"}) {
    const std::string answer = fetch("GET", "/big.js", refuses);
    EXPECT_FALSE(has(answer, "Content-Encoding")) << refuses;
    EXPECT_EQ(body_of(answer).size(), 3'000'000u) << refuses;
  }
}

TEST_F(Http, HeadIsGetWithoutTheBody) {
  const std::string answer = fetch("HEAD", "/big.js");
  EXPECT_TRUE(answer.starts_with("HTTP/1.1 200 OK\r\n"));
  EXPECT_TRUE(has(answer, "Content-Length: 3000000\r\n"));
  EXPECT_EQ(body_of(answer), "");
}

TEST_F(Http, OtherMethodsAreRefusedEvenWithABody) {
  for (const char* method : {"POST", "PUT", "DELETE", "OPTIONS", "PATCH"}) {
    const std::string answer = fetch(method, "/", "Content-Length: 100000\r\n");
    EXPECT_TRUE(answer.starts_with("HTTP/1.1 405 ")) << method << answer;
    EXPECT_TRUE(has(answer, "Allow: GET, HEAD\r\n"));
  }
  const std::lock_guard lock(station->mutex);
  EXPECT_EQ(station->lines, 0) << "a page's POST is no request to the daemon";
}

TEST_F(Http, KeepsAliveAndAnswersInOrder) {
  RawPeer peer(port());
  const std::string get = "GET /healthz HTTP/1.1\r\nHost: localhost\r\n\r\n";
  const std::string big = "GET /big.js HTTP/1.1\r\nHost: localhost\r\n\r\n";
  peer.send(get + big + get + big + get);
  for (int i = 0; i < 5; ++i) {
    const std::string header = peer.until("\r\n\r\n");
    EXPECT_TRUE(header.starts_with("HTTP/1.1 200 OK\r\n"));
    EXPECT_TRUE(has(header, "Connection: keep-alive\r\n"));
    const std::size_t size = i % 2 == 0 ? 3 : 3'000'000;
    EXPECT_EQ(peer.bytes(size), i % 2 == 0 ? "ok\n" : std::string(size, 'x'));
  }
}

TEST_F(Http, OneByteAtATime) {
  RawPeer peer(port());
  for (const char c : std::string("GET /healthz HTTP/1.0\r\nHost: localhost\r\n\r\n")) {
    peer.send(std::string(1, c));
    std::this_thread::yield();
  }
  const std::string answer = peer.rest();
  EXPECT_TRUE(answer.starts_with("HTTP/1.1 200 OK\r\n")) << answer;
  EXPECT_EQ(body_of(answer), "ok\n");
}

TEST_F(Http, PagesAreWhatTheDaemonSetsThemTo) {
  EXPECT_TRUE(fetch("GET", "/metrics").starts_with("HTTP/1.1 404 "));
  for (const char* body : {"a 1\n", "a 2\n"}) {
    station->server.set_page("/metrics", "text/plain; version=0.0.4", share(body));
    const std::string answer = fetch("GET", "/metrics?x=1");
    EXPECT_TRUE(has(answer, "Content-Type: text/plain; version=0.0.4\r\n"));
    EXPECT_EQ(body_of(answer), body);
  }
}

TEST_F(Http, SaysHowToBuildTheViewer) {
  FakeStation bare;
  RawPeer peer(bare.server.port());
  peer.send("GET / HTTP/1.1\r\nHost: localhost\r\nConnection: close\r\n\r\n");
  const std::string answer = peer.rest();
  EXPECT_TRUE(answer.starts_with("HTTP/1.1 200 OK\r\n"));
  EXPECT_TRUE(has(answer, "./deploy/build"));
}

TEST_F(Http, ForeignHostsAreRefused) {
  EXPECT_TRUE(fetch("GET", "/", "", "evil.example:80").starts_with("HTTP/1.1 421 "));
  EXPECT_TRUE(fetch("GET", "/", "", "").starts_with("HTTP/1.1 400 "));
}

// A name of somebody else's that was made to point here gives its page our origin: it must not get through, on whatever
// address we listen. Where tokens are asked for it has none to show.
TEST(Rebinding, APageThatWasLedHereGetsNothing) {
  const std::string upgrade =
      "Upgrade: websocket\r\nConnection: Upgrade\r\nSec-WebSocket-Version: 13\r\n"
      "Sec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\n";
  const auto asked = [&](std::uint16_t port, const std::string& path, const std::string& host) {
    RawPeer peer(port);
    peer.send("GET " + path + " HTTP/1.1\r\nHost: " + host + ":80\r\nOrigin: http://" + host + ":80\r\n" + upgrade +
              "\r\n");
    return peer.until("\r\n");
  };
  for (const char* address : {"127.0.0.1", "0.0.0.0"}) {
    Options options = options_on_a_free_port();
    options.host = address;
    options.hosts = {"posed.lab.example"};
    FakeStation open(std::move(options));
    const std::uint16_t port = open.server.port();
    for (const char* path : {"/ws", "/", "/metrics"})
      EXPECT_EQ(asked(port, path, "rebound.example"), "HTTP/1.1 421 Misdirected Request\r\n") << address << path;
    for (const char* host : {"127.0.0.1", "localhost", "posed.lab.example"})
      EXPECT_EQ(asked(port, "/ws", host), "HTTP/1.1 101 Switching Protocols\r\n") << address << host;
    EXPECT_EQ(open.lines, 0);
  }
  Options options = options_on_a_free_port();
  options.host = "0.0.0.0";
  options.tokens =
      std::make_shared<const Tokens>(Tokens::parse("viewer ana sha256:" + std::string(64, 'a') + "\n", "the test"));
  FakeStation closed(std::move(options));
  EXPECT_EQ(asked(closed.server.port(), "/ws", "station.lab.example"), "HTTP/1.1 101 Switching Protocols\r\n");
}

TEST_F(Http, OneAddressGetsSoManyPagesASecond) {
  Options options = options_on_a_free_port();
  options.limits.http_requests_per_second = 2.0;
  FakeStation strict(std::move(options));
  int refused = 0;
  for (int i = 0; i < 20; ++i) {
    RawPeer peer(strict.server.port());
    peer.send("GET /healthz HTTP/1.1\r\nHost: localhost\r\nConnection: close\r\n\r\n");
    const std::string answer = peer.rest();
    if (answer.starts_with("HTTP/1.1 200 ")) continue;
    ++refused;
    EXPECT_TRUE(answer.starts_with("HTTP/1.1 429 Too Many Requests\r\n")) << answer;
    EXPECT_TRUE(has(answer, "Retry-After: 1\r\n"));
  }
  EXPECT_GT(refused, 0);
  EXPECT_EQ(RawPeer(strict.server.port()).call(proto::SessionPing{}).id, 1) << "lines are no pages";
}

TEST_F(Http, NonsenseIsRefused) {
  RawPeer peer(port());
  peer.send("GET / HTTP/9.9\r\nnonsense\r\n\r\n");
  EXPECT_TRUE(peer.rest().starts_with("HTTP/1.1 400 "));
  RawPeer endless(port());
  endless.send("GET / HTTP/1.1\r\nX: " + std::string(100'000, 'x'));
  EXPECT_TRUE(endless.rest().starts_with("HTTP/1.1 431 "));
}

TEST_F(Http, WhoDawdlesOverARequestIsClosed) {
  Options options = options_on_a_free_port();
  options.limits.http_request = 100'000'000;
  FakeStation hasty(std::move(options));
  const std::uint16_t at = hasty.server.port();
  RawPeer one(at), two(at), line(at);
  one.send("G");
  two.send("GET / HTTP/1.1\r\n");
  line.send("{");
  EXPECT_EQ(one.rest(), "");
  EXPECT_EQ(two.rest(), "");
  EXPECT_EQ(hasty.open_peers().size(), 1u) << "a line may take its time";
}

class Websocket : public Http {
 protected:
  using Stream = beast::websocket::stream<asio::ip::tcp::socket>;

  beast::error_code connect(Stream& stream, const std::string& origin = "") {
    stream.next_layer().connect({asio::ip::address_v4::loopback(), port()});
    stream.set_option(beast::websocket::stream_base::decorator([origin](beast::websocket::request_type& request) {
      if (!origin.empty()) request.set(beast::http::field::origin, origin);
    }));
    beast::error_code error;
    stream.handshake("localhost:" + std::to_string(port()), "/ws", error);
    return error;
  }
  static std::string read(Stream& stream) {
    beast::flat_buffer buffer;
    beast::error_code error;
    stream.read(buffer, error);
    return error ? "error: " + error.message() : beast::buffers_to_string(buffer.data());
  }
  static proto::Incoming incoming(Stream& stream) {
    const std::string text = read(stream);
    const auto incoming = proto::decode_incoming(text);
    EXPECT_TRUE(incoming) << text;
    return incoming ? *incoming : proto::Incoming{};
  }
  static void write(Stream& stream, const std::string& text) { stream.write(asio::buffer(text)); }

  asio::io_context io;
};

TEST_F(Websocket, RequestsAndFrames) {
  Stream stream(io);
  ASSERT_FALSE(connect(stream));
  write(stream, proto::encode_request(1, proto::SessionPing{}));
  EXPECT_EQ(incoming(stream).id, 1);
  ASSERT_EQ(station->open_peers().size(), 1u);
  EXPECT_TRUE(station->open_peers().begin()->second.websocket);
  write(stream, proto::encode_request(2, proto::StreamSubscribe{proto::Stream::stats, {}, {}, 0.0, 0}));
  EXPECT_EQ(incoming(stream).id, 2);
  EXPECT_EQ(incoming(stream).seq, 0u);
  // Each length of header, and a text of several reads.
  std::uint64_t seq = 0;
  for (const std::size_t size : {std::size_t{0}, std::size_t{1000}, std::size_t{60'000}, std::size_t{300'000}}) {
    station->publish(++seq, size);
    EXPECT_EQ(read(stream), *FakeStation::frame(seq, size));
  }
  write(stream, "[" + proto::encode_request(3, proto::SessionPing{}) + "]");
  EXPECT_TRUE(read(stream).starts_with("[{"));
  write(stream, "not JSON");
  EXPECT_EQ(incoming(stream).error->code, "parse_error");
  beast::error_code error;
  stream.close(beast::websocket::close_code::normal, error);
  EXPECT_FALSE(error) << error.message();
  EXPECT_TRUE(eventually([&] { return station->open_peers().empty(); }));
}

TEST_F(Websocket, FramesInCborAreBinaryAndAllElseIsText) {
  Stream stream(io);
  ASSERT_FALSE(connect(stream));
  proto::StreamSubscribe wish{proto::Stream::stats, {}, {}, 0.0, 0};
  wish.encoding = proto::Encoding::cbor;
  write(stream, proto::encode_request(1, wish));
  EXPECT_EQ(incoming(stream).id, 1);
  EXPECT_TRUE(stream.got_text());
  read(stream);
  EXPECT_TRUE(stream.got_binary()) << "the present, too";
  const std::string bytes = std::string("\xbf\x00\xff\n", 4) + std::string(200, '\xf6');
  station->server.publish(proto::Stream::stats, 1, 1, share(bytes), true);
  EXPECT_EQ(read(stream), bytes);
  EXPECT_TRUE(stream.got_binary());
  write(stream, proto::encode_request(2, proto::SessionPing{}));
  EXPECT_EQ(incoming(stream).id, 2);
  EXPECT_TRUE(stream.got_text());
}

// A viewer that is silent is asked whether it is there, whatever its streams do.
TEST(WebsocketHeartbeat, WhoAnswersStaysAndWhoDoesNotIsClosed) {
  Options options = options_on_a_free_port();
  options.limits.heartbeat = 300'000'000;
  FakeStation station(std::move(options));
  const std::string handshake =
      "GET /ws HTTP/1.1\r\nHost: localhost\r\nUpgrade: websocket\r\nConnection: Upgrade\r\n"
      "Sec-WebSocket-Version: 13\r\nSec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\n\r\n";
  RawPeer dead(station.server.port()), alive(station.server.port()), lines(station.server.port());
  for (RawPeer* peer : {&dead, &alive}) {
    peer->send(handshake);
    EXPECT_TRUE(peer->until("\r\n\r\n").starts_with("HTTP/1.1 101"));
  }
  lines.call(proto::SessionPing{});
  const std::string asked("\x89\x00", 2), answer("\x8a\x80\0\0\0\0", 6);
  for (int i = 0; i < 6; ++i) {
    ASSERT_EQ(alive.bytes(2), asked);
    alive.send(answer);
  }
  EXPECT_TRUE(eventually([&] { return station.open_peers().size() == 2; }))
      << "alive, and JSON lines that have no such thing";
  EXPECT_EQ(dead.bytes(2), asked);
  dead.rest();
  ASSERT_EQ(alive.bytes(2), asked);
  EXPECT_EQ(lines.call(proto::SessionPing{}, 2).id, 2);
}

TEST_F(Websocket, FragmentsAndPings) {
  Stream stream(io);
  ASSERT_FALSE(connect(stream));
  int pongs = 0;
  stream.control_callback([&](beast::websocket::frame_type type, beast::string_view payload) {
    if (type == beast::websocket::frame_type::pong && payload == "still there?") ++pongs;
  });
  const std::string request = proto::encode_request(1, proto::SessionPing{});
  stream.write_some(false, asio::buffer(request.substr(0, 10)));
  stream.ping("still there?");
  stream.write_some(true, asio::buffer(request.substr(10)));
  EXPECT_EQ(incoming(stream).id, 1);
  EXPECT_EQ(pongs, 1);
}

TEST_F(Websocket, ManyRequestsAtOnce) {
  Stream stream(io);
  ASSERT_FALSE(connect(stream));
  constexpr int kRequests = 2000;
  std::thread writer([&] {
    for (int i = 1; i <= kRequests; ++i) write(stream, proto::encode_request(i, proto::SessionPing{}));
  });
  writer.join();
  for (int i = 1; i <= kRequests; ++i) ASSERT_EQ(incoming(stream).id, i);
}

TEST_F(Websocket, ForeignOriginsAreRefused) {
  Stream ours(io), foreign(io);
  EXPECT_FALSE(connect(ours, "http://localhost:" + std::to_string(port())));
  EXPECT_EQ(connect(foreign, "http://evil.example"), beast::websocket::error::upgrade_declined);
  const std::string answer = fetch("GET", "/ws",
                                   "Upgrade: websocket\r\nConnection: Upgrade\r\nSec-WebSocket-Version: 13\r\n"
                                   "Sec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\nOrigin: http://evil.example\r\n");
  EXPECT_TRUE(answer.starts_with("HTTP/1.1 403 ")) << answer;
}

TEST_F(Websocket, APlainGetOfItIsToldWhatItIs) {
  EXPECT_TRUE(fetch("GET", "/ws").starts_with("HTTP/1.1 426 "));
}

TEST_F(Websocket, TooLongAMessageIsToldAndClosed) {
  Stream stream(io);
  ASSERT_FALSE(connect(stream));
  stream.auto_fragment(false);
  beast::error_code error;
  stream.write(asio::buffer(std::string(proto::kMaxLineBytes + 1, ' ')), error);
  EXPECT_EQ(incoming(stream).error->code, "too_large");
  EXPECT_TRUE(read(stream).starts_with("error: "));
  EXPECT_EQ(stream.reason().code, beast::websocket::close_code::too_big);
}

TEST_F(Websocket, BinaryFramesAreRefused) {
  Stream stream(io);
  ASSERT_FALSE(connect(stream));
  stream.binary(true);
  write(stream, "x");
  EXPECT_TRUE(read(stream).starts_with("error: "));
  EXPECT_EQ(stream.reason().code, beast::websocket::close_code::unknown_data);
}

TEST_F(Websocket, StopSaysGoodbye) {
  Stream stream(io);
  ASSERT_FALSE(connect(stream));
  write(stream, proto::encode_request(1, proto::SessionPing{}));
  EXPECT_EQ(incoming(stream).id, 1);
  station->server.stop();
  EXPECT_TRUE(read(stream).starts_with("error: "));
  EXPECT_EQ(stream.reason().code, beast::websocket::close_code::going_away);
}

}  // namespace
}  // namespace posed::net
