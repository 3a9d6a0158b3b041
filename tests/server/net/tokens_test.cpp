// The file of who may come in.
#include "server/net/tokens.h"

#include <gtest/gtest.h>

#include "server/net/http_site.h"

namespace posed::net {
namespace {

// Of "secret" and of "other", as sha256sum says.
constexpr const char* kFile =
    "# who may come in\n"
    "\n"
    "editor ana sha256:2bb80d537b1da3e38bd30361aa855686bde0eacd7162fef6a25fe97bf527a25b\n"
    "  viewer screen sha256:d9298a10d1b0735837dc4bd85dac641b0f3cef27a47e5d53a54f2f3f5b2fcffa\r\n";

TEST(Tokens, AreFoundByTheirDigest) {
  const Tokens tokens = Tokens::parse(kFile, "file");
  EXPECT_EQ(tokens.size(), 2u);
  const auto ana = tokens.find("secret");
  ASSERT_TRUE(ana);
  EXPECT_EQ(ana->name, "ana");
  EXPECT_EQ(ana->role, proto::Role::editor);
  ASSERT_TRUE(tokens.find("other"));
  EXPECT_EQ(tokens.find("other")->role, proto::Role::viewer);
  for (const char* wrong :
       {"", "Secret", "secret ", "2bb80d537b1da3e38bd30361aa855686bde0eacd7162fef6a25fe97bf527a25b"}) {
    EXPECT_FALSE(tokens.find(wrong)) << wrong;
  }
}

TEST(Tokens, BrokenFilesSayWhereAndWhatCuresThem) {
  const std::string digest = "sha256:2bb80d537b1da3e38bd30361aa855686bde0eacd7162fef6a25fe97bf527a25b";
  const std::string broken[] = {"king ana " + digest,
                                "none ana " + digest,
                                "editor " + digest,
                                "editor ana secret",
                                "editor ana " + digest + " more",
                                "editor ana " + digest.substr(0, 60),
                                "editor ana " + std::string(digest).replace(10, 1, "x")};
  for (const std::string& line : broken) {
    try {
      Tokens::parse("# one\n" + line, "the-file");
      ADD_FAILURE() << line;
    } catch (const std::runtime_error& error) {
      EXPECT_NE(std::string(error.what()).find("the-file, line 2"), std::string::npos) << error.what();
      EXPECT_NE(std::string(error.what()).find("posectl token"), std::string::npos) << error.what();
    }
  }
  EXPECT_THROW(Tokens::parse("# nobody\n", "the-file"), std::runtime_error) << "nobody could ever come in";
  EXPECT_THROW(Tokens::read("/nowhere/tokens"), std::runtime_error);
}

TEST(Tokens, PagesOfTheDaemonWantOne) {
  const auto tokens = std::make_shared<const Tokens>(Tokens::parse(kFile, "file"));
  for (const bool asked : {true, false}) {
    HttpSite site(HostPolicy(true, {}, {}), "", asked ? tokens : nullptr);
    site.set_page("/metrics", "text/plain", std::make_shared<const std::string>("1"));
    HttpRequest request;
    request.method = "GET";
    request.target = "/metrics";
    request.host = "localhost";
    EXPECT_EQ(site.answer(request).status, asked ? 401 : 200);
    for (const char* wrong : {"Bearer nobody", "Bearer", "Bearer ", "secret", "Basic secret"}) {
      request.authorization = wrong;
      EXPECT_EQ(site.answer(request).status, asked ? 401 : 200) << wrong;
    }
    request.authorization = "Bearer other";
    EXPECT_EQ(site.answer(request).status, 200);
    request.authorization.clear();
    request.target = "/healthz";
    EXPECT_EQ(site.answer(request).status, 200) << "whether it lives is everybody's";
  }
}

}  // namespace
}  // namespace posed::net
