// The parts of the HTTP side that need no socket: detection, paths, hosts, files, WebSocket framing.
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "server/net/accept_encoding.h"
#include "server/net/detect.h"
#include "server/net/host_policy.h"
#include "server/net/http_site.h"
#include "server/net/sha1.h"
#include "server/net/websocket_frames.h"

namespace posed::net {
namespace {

namespace fs = std::filesystem;

TEST(Detect, TellsMethodsFromLines) {
  for (const char* text : {"GET / HTTP/1.1", "HEAD ", "POST /x", "OPTIONS *", "DELETE /"}) {
    EXPECT_EQ(detect(text), Detected::http) << text;
  }
  for (const char* text : {"", "G", "GE", "GET", "P", "PO", "PU", "OPTIONS"}) {
    EXPECT_EQ(detect(text), Detected::undecided) << text;
  }
  for (const char* text : {"{", "[", " ", "\n", "GOAL", "GET\n", "get / HTTP/1.1", "hello"}) {
    EXPECT_EQ(detect(text), Detected::lines) << text;
  }
  EXPECT_EQ(detect("\x16\x03\x01"), Detected::tls);
}

TEST(Sha1, KnownDigests) {
  const auto hex = [](const std::string& bytes) {
    std::string text;
    for (const char c : bytes) {
      text += "0123456789abcdef"[(c >> 4) & 15];
      text += "0123456789abcdef"[c & 15];
    }
    return text;
  };
  EXPECT_EQ(hex(sha1("")), "da39a3ee5e6b4b0d3255bfef95601890afd80709");
  EXPECT_EQ(hex(sha1("abc")), "a9993e364706816aba3e25717850c26c9cd0d89d");
  EXPECT_EQ(hex(sha1("abcdbcdecdefdefgefghfghighijhijkijkljklmklmnlmnomnopnopq")),
            "84983e441c3bd26ebaae4aa1f95129e5e54670f1");
  EXPECT_EQ(hex(sha1(std::string(1'000'000, 'a'))), "34aa973cd4c4daa4f61eeb2bdbad27316534016f");
  EXPECT_EQ(base64(""), "");
  EXPECT_EQ(base64("f"), "Zg==");
  EXPECT_EQ(base64("fo"), "Zm8=");
  EXPECT_EQ(base64("foo"), "Zm9v");
  EXPECT_EQ(base64("foobar"), "Zm9vYmFy");
}

TEST(WebsocketFrames, AcceptKeyOfTheRfc) {
  EXPECT_EQ(accept_key("dGhlIHNhbXBsZSBub25jZQ=="), "s3pPLMBiTxaQ9kYGzzhZRbK+xOo=");
}

std::string client_frame(int first, std::string_view payload, std::uint64_t declared = ~0ull) {
  const std::uint64_t size = declared == ~0ull ? payload.size() : declared;
  std::string frame{static_cast<char>(first)};
  if (size < 126) {
    frame += static_cast<char>(0x80 | size);
  } else {
    const int bytes = size < 65536 ? 2 : 8;
    frame += static_cast<char>(bytes == 2 ? 0xfe : 0xff);
    for (int i = bytes - 1; i >= 0; --i) frame += static_cast<char>(size >> (8 * i));
  }
  const char mask[4] = {1, 2, 3, 4};
  frame.append(mask, 4);
  for (std::size_t i = 0; i < payload.size(); ++i) frame += static_cast<char>(payload[i] ^ mask[i % 4]);
  return frame;
}

TEST(WebsocketFrames, ReadsFramesInAnyPortions) {
  const std::string big(70'000, 'b'), middle(300, 'm');
  const std::string bytes = client_frame(0x81, "hello") + client_frame(0x89, "ping") + client_frame(0x81, middle) +
                            client_frame(0x81, big) + client_frame(0x81, "");
  for (const std::size_t portion : {std::size_t{1}, std::size_t{7}, std::size_t{4096}, bytes.size()}) {
    FrameReader reader(100'000);
    std::vector<std::string> got;
    for (std::size_t at = 0; at < bytes.size(); at += portion) {
      reader.push(std::string_view(bytes).substr(at, portion));
      while (auto message = reader.next()) got.push_back(message->payload);
    }
    EXPECT_EQ(got, (std::vector<std::string>{"hello", "ping", middle, big, ""})) << portion;
    EXPECT_EQ(reader.error(), 0);
  }
}

TEST(WebsocketFrames, JoinsFragmentsWithControlFramesBetween) {
  FrameReader reader(100);
  reader.push(client_frame(0x01, "one ") + client_frame(0x00, "two ") + client_frame(0x89, "?") +
              client_frame(0x80, "three"));
  auto ping = reader.next();
  ASSERT_TRUE(ping);
  EXPECT_EQ(ping->opcode, Opcode::ping);
  auto message = reader.next();
  ASSERT_TRUE(message);
  EXPECT_EQ(message->opcode, Opcode::text);
  EXPECT_EQ(message->payload, "one two three");
}

TEST(WebsocketFrames, RefusesWhatBreaksTheRules) {
  const std::pair<std::string, int> wrong[] = {
      {client_frame(0xc1, "x"), 1002},                            // a reserved bit: nobody agreed on compression
      {std::string("\x81\x01x", 3), 1002},                        // not masked
      {client_frame(0x80, "x"), 1002},                            // goes on with nothing
      {client_frame(0x01, "x") + client_frame(0x81, "y"), 1002},  // begins anew in the middle
      {client_frame(0x83, "x"), 1002},                            // unknown
      {client_frame(0x8b, "x"), 1002},                            // unknown control frame
      {client_frame(0x09, "x"), 1002},                            // control frames are whole
      {client_frame(0x89, std::string(126, 'x')), 1002},          // and short
      {client_frame(0x81, "", 101), 1009},                        // refused by its header alone
      {client_frame(0x81, "", 1ull << 63), 1009},
      {client_frame(0x01, std::string(60, 'x')) + client_frame(0x80, std::string(41, 'y')), 1009},
  };
  for (const auto& [bytes, code] : wrong) {
    FrameReader reader(100);
    reader.push(bytes);
    EXPECT_FALSE(reader.next());
    EXPECT_EQ(reader.error(), code) << ::testing::PrintToString(bytes);
    reader.push(client_frame(0x81, "x"));
    EXPECT_FALSE(reader.next());
  }
}

TEST(WebsocketFrames, HeadersByLength) {
  const auto header = [](std::size_t size) {
    const FrameHeader h = frame_header(Opcode::text, size);
    return std::string(h.bytes.data(), h.size);
  };
  EXPECT_EQ(header(0), std::string("\x81\x00", 2));
  EXPECT_EQ(header(125), "\x81\x7d");
  EXPECT_EQ(header(126), std::string("\x81\x7e\x00\x7e", 4));
  EXPECT_EQ(header(65535), "\x81\x7e\xff\xff");
  EXPECT_EQ(header(65536), std::string("\x81\x7f\0\0\0\0\0\x01\0\0", 10));
}

TEST(HostPolicy, OnLoopbackOnlyNamesOfOurs) {
  const HostPolicy policy(true, {"posed.example.org"}, {"http://localhost:5173"});
  for (const char* host : {"127.0.0.1", "127.0.0.1:19870", "localhost", "LOCALHOST:1", "localhost.", "[::1]:19870",
                           "[::1]", "viewer.localhost:80", "192.168.1.7:19870", "posed.example.org:443"}) {
    EXPECT_TRUE(policy.host_allowed(host)) << host;
  }
  for (const char* host :
       {"evil.example", "localhost.evil.example", "127.0.0.1.evil.example", "", "[", "notlocalhost"}) {
    EXPECT_FALSE(policy.host_allowed(host)) << host;
  }
  EXPECT_TRUE(HostPolicy(false, {}, {}).host_allowed("lab.example:19870"));
}

TEST(HostPolicy, OriginsAreOurOwnPageOrNamed) {
  const HostPolicy policy(true, {}, {"http://localhost:5173"});
  EXPECT_TRUE(policy.origin_allowed("http://127.0.0.1:19870", "127.0.0.1:19870"));
  EXPECT_TRUE(policy.origin_allowed("HTTP://LocalHost:1", "localhost:1"));
  EXPECT_TRUE(policy.origin_allowed("http://localhost:5173", "127.0.0.1:19870"));
  for (const char* origin : {"null", "http://evil.example", "http://127.0.0.1:19871", "http://127.0.0.1",
                             "127.0.0.1:19870", "http://evil.example/127.0.0.1:19870"}) {
    EXPECT_FALSE(policy.origin_allowed(origin, "127.0.0.1:19870")) << origin;
  }
}

TEST(PlainPath, DecodesAndRefuses) {
  EXPECT_EQ(plain_path("/"), "index.html");
  EXPECT_EQ(plain_path("/?x=/../y"), "index.html");
  EXPECT_EQ(plain_path("/a/b.js?v=1#z"), "a/b.js");
  EXPECT_EQ(plain_path("/a%20b.js"), "a b.js");
  EXPECT_EQ(plain_path("/sub/"), "sub/index.html");
  for (const char* target :
       {"",        "a.js",         "/..",     "/../x",    "/a/../../x", "/%2e%2e/x", "/a/%2E%2e/x", "/.git/config",
        "/a/.env", "//etc/passwd", "/a//b",   "/%00",     "/a%0ab",     "/a%2",      "/a%zz",       "/a\\..\\b",
        "/%5c..",  "/./a",         "/..%2fx", "http://x/"}) {
    EXPECT_FALSE(plain_path(target)) << target;
  }
}

TEST(AcceptEncoding, GzipWhereItIsWelcomeAndNoLessThanPlainBytes) {
  for (const char* yes :
       {"gzip", "GZIP", "x-gzip", "gzip, deflate, br, zstd", "deflate,gzip", "br;q=1.0, gzip;q=0.8, *;q=0.1", "*",
        "gzip;q=0.001", "gzip ; q=0.5", "gzip;q=1, identity;q=1", "identity;q=0.5, gzip;q=1.0", "*;q=0.5",
        "gzip;q=1;level=9", ", gzip", "identity;q=0, *", "br;q=0, gzip"}) {
    EXPECT_TRUE(prefers_gzip(yes)) << yes;
  }
  for (const char* no : {"",
                         "identity",
                         "br",
                         "gzip;q=0",
                         "gzip;q=0.000",
                         "*;q=0",
                         "gzip;q=0, *",
                         "br;q=1, gzip;q=0, deflate",
                         "deflate, gzip;q=0",
                         "identity;q=1, gzip;q=0.5",
                         "identity, *;q=0.5",
                         "gzip;q=2",
                         "gzip;q=-1",
                         "gzip;q=x",
                         "gzip;q=nan",
                         "gzip;q=1x",

                         "gzipped",
                         "x gzip",
                         ";;;",
                         "\"gzip\""}) {
    EXPECT_FALSE(prefers_gzip(no)) << no;
  }
}

class HttpFilesTest : public ::testing::Test {
 protected:
  HttpFilesTest() {
    std::string name = (fs::temp_directory_path() / "posed-files-XXXXXX").string();
    top = mkdtemp(name.data());
    fs::create_directories(top / "viewer/assets");
    write("viewer/index.html", "<p>viewer");
    write("viewer/assets/app-1a2b.js", "run()");
    write("secret.txt", "secret");
    fs::create_symlink(top / "secret.txt", top / "viewer/leak.txt");
    fs::create_directory_symlink(top, top / "viewer/up");
    fs::create_symlink("index.html", top / "viewer/start.html");
  }
  ~HttpFilesTest() override { fs::remove_all(top); }
  void write(const std::string& name, const std::string& text) { std::ofstream(top / name) << text; }

  fs::path top;
};

TEST_F(HttpFilesTest, FindsPlainFilesOnly) {
  HttpFiles files(top / "viewer");
  EXPECT_TRUE(files.present());
  const auto page = files.find("/");
  ASSERT_TRUE(page);
  EXPECT_EQ(*page->body, "<p>viewer");
  EXPECT_EQ(page->content_type, "text/html; charset=utf-8");
  EXPECT_EQ(page->cache_control, "no-cache");
  const auto script = files.find("/assets/app-1a2b.js");
  ASSERT_TRUE(script);
  EXPECT_EQ(script->content_type, "text/javascript; charset=utf-8");
  EXPECT_NE(script->cache_control.find("immutable"), std::string::npos);
  EXPECT_TRUE(files.find("/start.html")) << "a link that stays inside";
  for (const char* target :
       {"/assets", "/assets/", "/none.js", "/leak.txt", "/up/secret.txt", "/../secret.txt", "/index.html/x"}) {
    EXPECT_FALSE(files.find(target)) << target;
  }
}

TEST_F(HttpFilesTest, ReadsAgainWhatHasChanged) {
  HttpFiles files(top / "viewer");
  const auto first = files.find("/");
  EXPECT_EQ(files.find("/")->body, first->body) << "kept";
  write("viewer/index.html", "<p>another one");
  const auto second = files.find("/");
  ASSERT_TRUE(second);
  EXPECT_EQ(*second->body, "<p>another one");
  EXPECT_NE(first->etag, second->etag);
}

TEST_F(HttpFilesTest, TheTwinThatIsPacked) {
  HttpFiles files(top / "viewer");
  EXPECT_FALSE(files.find("/")->gzip);
  write("viewer/index.html.gz", "packed");
  const auto page = files.find("/");
  ASSERT_TRUE(page && page->gzip) << "seen without a restart";
  EXPECT_EQ(*page->gzip, "packed");
  EXPECT_EQ(*page->body, "<p>viewer");
  EXPECT_EQ(files.find("/")->gzip, page->gzip) << "kept";
  write("viewer/index.html.gz", "packed anew");
  EXPECT_EQ(*files.find("/")->gzip, "packed anew");

  fs::last_write_time(top / "viewer/index.html.gz",
                      fs::last_write_time(top / "viewer/index.html") - std::chrono::hours(1));
  EXPECT_FALSE(files.find("/")->gzip) << "packed before the file was last written";
}

TEST_F(HttpFilesTest, ATwinIsAFileOfTheRootAsAnyOther) {
  fs::create_symlink(top / "secret.txt", top / "viewer/index.html.gz");
  fs::create_directory(top / "viewer/assets/app-1a2b.js.gz");
  write("viewer/alone.html.gz", "packed");
  HttpFiles files(top / "viewer");
  ASSERT_TRUE(files.find("/") && files.find("/assets/app-1a2b.js"));
  EXPECT_FALSE(files.find("/")->gzip);
  EXPECT_FALSE(files.find("/assets/app-1a2b.js")->gzip);
  EXPECT_FALSE(files.find("/alone.html")) << "packed bytes alone are no page";
}

TEST_F(HttpFilesTest, AViewerThatIsNotThere) {
  EXPECT_FALSE(HttpFiles("").present());
  EXPECT_FALSE(HttpFiles("").find("/"));
  EXPECT_FALSE(HttpFiles(top / "none").find("/"));
}

TEST_F(HttpFilesTest, TheSiteAnswersConditionally) {
  HttpSite site(HostPolicy(true, {}, {}), top / "viewer");
  HttpRequest request;
  request.method = "GET";
  request.target = "/";
  request.host = "localhost";
  const HttpReply first = site.answer(request);
  EXPECT_EQ(first.status, 200);
  request.if_none_match = first.headers.substr(6, first.headers.find('\r') - 6);
  const HttpReply second = site.answer(request);
  EXPECT_EQ(second.status, 304);
  EXPECT_EQ(second.body, nullptr);
}

TEST_F(HttpFilesTest, TheSiteSendsPackedBytesToWhoWantsThem) {
  write("viewer/index.html.gz", "packed");
  HttpSite site(HostPolicy(true, {}, {}), top / "viewer");
  HttpRequest request;
  request.method = "GET";
  request.target = "/";
  request.host = "localhost";
  const auto says = [](const HttpReply& reply, std::string_view header) {
    return reply.headers.find(header) != std::string::npos;
  };
  const auto etag = [](const HttpReply& reply) { return reply.headers.substr(6, reply.headers.find('\r') - 6); };

  const HttpReply plain = site.answer(request);
  EXPECT_EQ(*plain.body, "<p>viewer");
  EXPECT_FALSE(says(plain, "Content-Encoding"));
  EXPECT_TRUE(says(plain, "Vary: Accept-Encoding\r\n")) << "a cache between must know";
  request.accept_encoding = "gzip, deflate";
  const HttpReply packed = site.answer(request);
  EXPECT_EQ(*packed.body, "packed");
  EXPECT_EQ(packed.content_type, "text/html; charset=utf-8");
  EXPECT_TRUE(says(packed, "Content-Encoding: gzip\r\n"));
  EXPECT_TRUE(says(packed, "Vary: Accept-Encoding\r\n"));
  EXPECT_NE(etag(plain), etag(packed));

  request.if_none_match = etag(packed);
  const HttpReply again = site.answer(request);
  EXPECT_EQ(again.status, 304);
  EXPECT_TRUE(says(again, "Vary: Accept-Encoding\r\n"));
  request.accept_encoding = "gzip;q=0";
  EXPECT_EQ(site.answer(request).status, 200) << "what it has is not what it may get now";

  request.target = "/assets/app-1a2b.js";
  request.accept_encoding = "gzip";
  EXPECT_FALSE(says(site.answer(request), "Vary")) << "there is only one";
}

}  // namespace
}  // namespace posed::net
