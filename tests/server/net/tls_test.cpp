// TLS on the same port, over real sockets, with another implementation at the other end: Asio's.
#include <gtest/gtest.h>

#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/read_until.hpp>
#include <boost/asio/ssl.hpp>
#include <boost/asio/write.hpp>

#include "certificate.h"
#include "fake_station.h"

namespace posed::net {
namespace {

using namespace test;  // NOLINT: the vocabulary of these tests
namespace asio = boost::asio;

class Tls : public ::testing::Test {
 protected:
  Tls() {
    std::string name = (std::filesystem::temp_directory_path() / "posed-tls-XXXXXX").string();
    folder = mkdtemp(name.data());
    const Certificate made(folder);
    options.tls = std::make_shared<const TlsContext>(made.certificate, made.key);
    context.load_verify_file(made.certificate.string());
    context.set_verify_mode(asio::ssl::verify_peer);
  }
  ~Tls() override { std::filesystem::remove_all(folder); }

  std::filesystem::path folder;
  Options options = options_on_a_free_port();
  asio::ssl::context context{asio::ssl::context::tls_client};
};

struct TlsPeer {
  TlsPeer(asio::ssl::context& context, std::uint16_t port) : stream(io, context) {
    stream.next_layer().connect({asio::ip::address_v4::loopback(), port});
    stream.handshake(asio::ssl::stream_base::client);
  }
  void send(const std::string& text) { asio::write(stream, asio::buffer(text)); }
  std::string until(const std::string& mark) {
    const std::size_t size = asio::read_until(stream, asio::dynamic_buffer(buffer), mark);
    std::string text = buffer.substr(0, size);
    buffer.erase(0, size);
    return text;
  }
  proto::Incoming incoming() {
    const std::string line = until("\n");
    const auto incoming = proto::decode_incoming(std::string_view(line).substr(0, line.size() - 1));
    EXPECT_TRUE(incoming) << line;
    return incoming ? *incoming : proto::Incoming{};
  }

  asio::io_context io;
  asio::ssl::stream<asio::ip::tcp::socket> stream;
  std::string buffer;
};

TEST_F(Tls, RequestsAndStreams) {
  FakeStation station(std::move(options));
  TlsPeer peer(context, station.server.port());
  peer.send(ping(1));
  EXPECT_EQ(peer.incoming().id, 1);
  peer.send(proto::encode_request(2, proto::StreamSubscribe{proto::Stream::stats, {}, {}, 0.0, 0}) + "\n");
  EXPECT_EQ(peer.incoming().id, 2);
  EXPECT_EQ(peer.incoming().seq, 0u);
  std::uint64_t seq = 0;
  for (const std::size_t size : {0, 1000, 16'000, 60'000, 300'000}) {
    station.publish(++seq, size);
    EXPECT_EQ(peer.until("\n"), *FakeStation::frame(seq, size) + "\n");
  }
}

// A read gives a record at a time: what is left of them no socket shows.
TEST_F(Tls, ManyRequestsAtOnceAndLongReplies) {
  FakeStation station(std::move(options));
  station.padding = 50'000;
  TlsPeer peer(context, station.server.port());
  std::string text;
  for (int i = 1; i <= 1000; ++i) text += i % 10 ? ping(i) : proto::encode_request(i, proto::SessionStatus{}) + "\n";
  std::jthread writer([&] { peer.send(text.substr(0, text.size() / 2)); });
  writer.join();
  peer.send(text.substr(text.size() / 2));
  for (int i = 1; i <= 1000; ++i) ASSERT_EQ(peer.incoming().id, i);
}

TEST_F(Tls, AllFacesAreBehindIt) {
  FakeStation station(std::move(options));
  TlsPeer page(context, station.server.port());
  page.send("GET /healthz HTTP/1.1\r\nHost: localhost\r\n\r\n");
  EXPECT_TRUE(page.until("ok\n").starts_with("HTTP/1.1 200"));
  TlsPeer socket(context, station.server.port());
  socket.send(
      "GET /ws HTTP/1.1\r\nHost: localhost\r\nOrigin: https://localhost\r\nUpgrade: websocket\r\nConnection: "
      "Upgrade\r\n"
      "Sec-WebSocket-Version: 13\r\nSec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\n\r\n");
  EXPECT_TRUE(socket.until("\r\n\r\n").starts_with("HTTP/1.1 101"));
  EXPECT_TRUE(eventually([&] { return station.open_peers().size() == 1; }));
}

TEST_F(Tls, OnThisMachineOneMayGoWithout) {
  FakeStation station(std::move(options));
  RawPeer plain(station.server.port());
  EXPECT_EQ(plain.call(proto::SessionPing{}).id, 1);
  TlsPeer peer(context, station.server.port());
  peer.send(ping(1));
  EXPECT_EQ(peer.incoming().id, 1);
}

TEST_F(Tls, OthersAreToldThatItIsNeeded) {
  options.plain_on_loopback = false;
  FakeStation station(std::move(options));
  RawPeer lines(station.server.port());
  lines.send(ping(1));
  EXPECT_EQ(lines.incoming().error->code, "tls_required");
  EXPECT_TRUE(lines.at_end());
  RawPeer page(station.server.port());
  page.send("GET / HTTP/1.1\r\nHost: localhost\r\n\r\n");
  const std::string answer = page.rest();
  EXPECT_TRUE(answer.starts_with("HTTP/1.1 426")) << answer;
  EXPECT_NE(answer.find("https://"), std::string::npos);
  EXPECT_EQ(station.lines, 0) << "nothing was taken";
}

TEST_F(Tls, NonsenseAfterTheFirstByteEndsTheConnection) {
  FakeStation station(std::move(options));
  RawPeer peer(station.server.port());
  peer.send(std::string("\x16\x03\x01\x00\x05hello", 10));
  peer.rest();
  TlsPeer other(context, station.server.port());
  other.send(ping(1));
  EXPECT_EQ(other.incoming().id, 1);
}

TEST_F(Tls, OneAddressMayShakeHandsSoOften) {
  options.limits.handshakes_per_second = 2.0;
  FakeStation station(std::move(options));
  int refused = 0;
  for (int i = 0; i < 20; ++i) {
    RawPeer peer(station.server.port());
    peer.send(std::string("\x16\x03\x01\x00\x05hello", 10));
    refused += peer.rest().empty();  // else OpenSSL's alert
  }
  EXPECT_GT(refused, 0);
  EXPECT_GE(station.server.counters().refused, static_cast<std::uint64_t>(refused));
  EXPECT_EQ(RawPeer(station.server.port()).call(proto::SessionPing{}).id, 1) << "lines in the clear are no handshake";
}

TEST_F(Tls, WhoDawdlesOverTheHandshakeIsClosed) {
  options.limits.http_request = 100'000'000;
  FakeStation station(std::move(options));
  RawPeer peer(station.server.port());
  peer.send("\x16");
  EXPECT_TRUE(peer.at_end());
}

TEST_F(Tls, StopSaysThatNoMoreWillCome) {
  auto station = std::make_unique<FakeStation>(std::move(options));
  TlsPeer peer(context, station->server.port());
  peer.send(ping(1));
  EXPECT_EQ(peer.incoming().id, 1);
  station.reset();
  char byte;
  boost::system::error_code error;
  peer.stream.read_some(asio::buffer(&byte, 1), error);
  EXPECT_EQ(error, asio::error::eof) << "not cut off: " << error.message();
}

TEST_F(Tls, BadFilesAreClearSentences) {
  const Certificate good(folder);
  std::filesystem::create_directory(folder / "other");
  const Certificate other(folder / "other");
  const auto said = [](const std::filesystem::path& certificate, const std::filesystem::path& key) -> std::string {
    try {
      const TlsContext made(certificate, key);
    } catch (const std::runtime_error& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_NE(said("/nowhere", good.key).find("--tls.certificate"), std::string::npos);
  EXPECT_NE(said(good.key, good.key).find("--tls.certificate"), std::string::npos);
  EXPECT_NE(said(good.certificate, good.certificate).find("--tls.key"), std::string::npos);
  EXPECT_NE(said(good.certificate, other.key).find("is not the key of"), std::string::npos);
}

}  // namespace
}  // namespace posed::net
