// What stands around the parameters: JSON itself, JSON-RPC, ids, batches.
#include "tests/proto/proto_fixture.h"

namespace posed::proto {
namespace {

TEST(DecodeEnvelope, WhatIsNoJsonIsAParseError) {
  for (const char* text : {"", "x", "{", "{]", "[1,", "\"open", "{'a':1}", "nul", R"({"id":1,})", "{} {}", "\x01",
                           R"({"jsonrpc":"2.0","id":1,"method":"session.ping","params":{"x":NaN}})",
                           R"({"jsonrpc":"2.0","id":1,"method":"session.ping","params":{"x":-Infinity}})",
                           R"({"jsonrpc":"2.0","id":1,"method":"goal.set","params":{"position":[1e999,0,0]}})"}) {
    const BadRequest bad = refused(text);
    EXPECT_EQ(bad.error.code, "parse_error") << text;
    EXPECT_EQ(bad.error.path, "") << text;
    EXPECT_EQ(bad.id, "null") << text;
    EXPECT_FALSE(bad.error.hint.empty()) << text;
  }
}

TEST(DecodeEnvelope, BadUtf8IsAParseError) {
  for (const char* bytes : {"\xff", "\xc3", "\xc0\x80", "\xed\xa0\x80", "\xf5\x80\x80\x80", "\xe2\x82"}) {
    expect_error(call("scene.save", std::string("{\"name\":\"") + bytes + "\"}"), "parse_error", "");
    expect_error(call("scene.save", std::string("{\"") + bytes + "\":1}"), "parse_error", "");
  }
  EXPECT_EQ(params_of<SceneSave>("scene.save", "{\"name\":\"\xe2\x82\xac\"}").name, "\xe2\x82\xac");
}

TEST(DecodeEnvelope, NestsAtMost64Deep) {
  const auto nested = [](int depth) {
    return std::string(static_cast<std::size_t>(depth), '[') + std::string(static_cast<std::size_t>(depth), ']');
  };
  const BadRequest deep = refused(nested(65));
  EXPECT_EQ(deep.error.code, "parse_error");
  EXPECT_NE(deep.error.message.find("64"), std::string::npos);
  EXPECT_EQ(decode_line(nested(64)).entries.size(), 1u);
  expect_error(std::string(1'000'000, '['), "parse_error", "");
  expect_error(std::string(500'000, '{'), "parse_error", "");
  // Brackets inside strings nest nothing, quotes and backslashes there end nothing.
  EXPECT_EQ(params_of<SceneSave>("scene.save", R"({"name":"\"\\)" + std::string(200, '[') + "\"}").name,
            "\"\\" + std::string(200, '['));
}

TEST(DecodeEnvelope, AKeyStandsOnce) {
  const BadRequest twice =
      refused(R"({"jsonrpc":"2.0","id":1,"method":"goal.list","params":{},"method":"goal.clear"})");
  EXPECT_EQ(twice.error.code, "parse_error");
  EXPECT_NE(twice.error.message.find("method"), std::string::npos);
  std::string many = "{";
  for (int i = 0; i < 100; ++i) many += "\"k" + std::to_string(i) + "\":{},";
  expect_error(many + "\"k57\":1}", "parse_error", "");
  expect_error(call("goal.set", R"({"at":{"segment":"head","segment":"neck","point":[0,0,0]}})"), "parse_error", "");
  accepted(call("goal.set", R"({"at":{"segment":"head","point":[0,0,0]},"id":"segment"})"));
}

// Each key was compared with all before it: one line kept the daemon busy for minutes.
TEST(DecodeEnvelope, AMillionBytesOfKeysAreSoonRead) {
  std::string params = "{";
  for (int i = 0; params.size() < kMaxLineBytes - 100; ++i) params += "\"" + std::to_string(i) + "\":0,";
  expect_error(call("session.ping", params + "\"x\":0}"), "unknown_field", "/params/0");
  // A scene of that size comes back as it was.
  SceneDocument scene;
  for (int i = 0; i < 2000; ++i) scene.figures["f" + std::to_string(i)].template_name = "tempus";
  EXPECT_EQ(decode_scene(encode_scene(scene))->figures.size(), 2000u);
}

TEST(DecodeEnvelope, ANumberTooLargeIsQuoted) {
  const BadRequest bad = refused(call("goal.set", R"({"weight":1e999})"));
  EXPECT_NE(bad.error.message.find("1e999"), std::string::npos) << bad.error.message;
  EXPECT_LT(refused("[" + std::string(100'000, '9') + "]").error.message.size(), 200u);
}

TEST(DecodeEnvelope, ARequestIsAnObjectThatSaysJsonRpc) {
  for (const char* text : {"1", "null", "\"session.ping\"", "true"}) expect_error(text, "invalid_request", "");
  expect_error(R"({"id":1,"method":"session.ping"})", "invalid_request", "/jsonrpc");
  expect_error(R"({"jsonrpc":"1.0","id":1,"method":"session.ping"})", "invalid_request", "/jsonrpc");
  expect_error(R"({"jsonrpc":2.0,"id":1,"method":"session.ping"})", "invalid_request", "/jsonrpc");
  expect_error(R"({"jsonrpc":"2.0","id":1})", "invalid_request", "/method");
  expect_error(R"({"jsonrpc":"2.0","id":1,"method":7})", "invalid_request", "/method");
}

TEST(DecodeEnvelope, TheIdIsEchoedAsItWasWritten) {
  for (const char* id : {"1", "-7", "0", "9007199254740993", "18446744073709551615", "1.5", "\"\"", "\"a b\"",
                         R"("\"quoted\\")", "\"\xc3\xa9\"", "null"}) {
    const std::string head = std::string(R"({"jsonrpc":"2.0","id":)") + id;
    EXPECT_EQ(accepted(head + R"(,"method":"session.ping"})").id, id);
    EXPECT_EQ(refused(head + R"(,"method":"session.pin"})").id, id);
  }
}

TEST(DecodeEnvelope, AnIdIsShortAndPlain) {
  for (const std::string& id :
       {std::string("{}"), std::string("[1]"), std::string("true"), "\"" + std::string(257, 'x') + "\""}) {
    const BadRequest bad = refused(R"({"jsonrpc":"2.0","id":)" + id + R"(,"method":"session.ping"})");
    EXPECT_EQ(bad.error.code, "invalid_request");
    EXPECT_EQ(bad.error.path, "/id");
    EXPECT_EQ(bad.id, "null");
  }
  EXPECT_EQ(accepted(R"({"jsonrpc":"2.0","id":")" + std::string(256, 'x') + R"(","method":"session.ping"})").id.size(),
            258u);
}

TEST(DecodeEnvelope, WithoutAnIdItIsANotification) {
  const Request ack = accepted(R"({"jsonrpc":"2.0","method":"stream.ack","params":{"stream":"pose","seq":812}})");
  EXPECT_EQ(ack.id, "");
  EXPECT_EQ(std::get<StreamAck>(ack.params).seq, 812u);
  EXPECT_EQ(refused(R"({"jsonrpc":"2.0","method":"stream.ak"})").id, "null");
}

TEST(DecodeEnvelope, ParamsMayBeLeftOut) {
  EXPECT_TRUE(
      std::holds_alternative<SessionPing>(accepted(R"({"jsonrpc":"2.0","id":1,"method":"session.ping"})").params));
  for (const char* params : {"[]", "null", "1", "\"x\""})
    expect_error(call("session.ping", params), "wrong_type", "/params");
}

TEST(DecodeEnvelope, OtherFieldsOfARequestAreUnknown) {
  expect_error(R"({"jsonrpc":"2.0","id":1,"method":"goal.list","at":"head"})", "unknown_field", "/at");
  expect_error(R"({"jsonrpc":"2.0","id":1,"method":"goal.list","a/b~c":0})", "unknown_field", "/a~1b~0c");
}

TEST(DecodeEnvelope, TheMethodIsKnownReservedOrMistyped) {
  const BadRequest typo = refused(call("goal.sett", "{}"));
  EXPECT_EQ(typo.error.code, "unknown_method");
  EXPECT_EQ(typo.error.path, "/method");
  EXPECT_EQ(typo.error.hint, "did you mean goal.set?");
  for (const char* reserved : {"key.set", "take.record", "play.start"}) {
    expect_error(call(reserved, "{}"), "not_available", "/method");
  }
}

TEST(DecodeEnvelope, EntriesOfABatchStandEachForItself) {
  const Line line = decode_line(R"([{"jsonrpc":"2.0","id":1,"method":"session.ping"}, 7,
      {"jsonrpc":"2.0","method":"stream.ack","params":{"stream":"pose","seq":1}},
      {"jsonrpc":"2.0","id":"b","method":"goal.get","params":{}}])");
  ASSERT_TRUE(line.batch);
  ASSERT_EQ(line.entries.size(), 4u);
  EXPECT_EQ(std::get<Request>(line.entries[0]).id, "1");
  EXPECT_EQ(std::get<BadRequest>(line.entries[1]).error.code, "invalid_request");
  EXPECT_EQ(std::get<BadRequest>(line.entries[1]).id, "null");
  EXPECT_EQ(std::get<Request>(line.entries[2]).id, "");
  EXPECT_EQ(std::get<BadRequest>(line.entries[3]).id, "\"b\"");
  EXPECT_EQ(std::get<BadRequest>(line.entries[3]).error.path, "/params/id");
}

TEST(DecodeEnvelope, AnEmptyBatchIsAnInvalidRequest) {
  expect_error("[]", "invalid_request", "");
}

TEST(DecodeEnvelope, BatchesInBatchesAreRefusedOneByOne) {
  const Line line = decode_line("[[],{}]");
  EXPECT_TRUE(line.batch);
  for (const auto& entry : line.entries) EXPECT_EQ(std::get<BadRequest>(entry).error.code, "invalid_request");
}

// Each bad entry is answered with a hundred times its size.
TEST(DecodeEnvelope, ABatchHoldsSoManyRequests) {
  const auto batch = [](std::size_t size) {
    std::string text = "[";
    for (std::size_t i = 0; i < size; ++i) text += i > 0 ? ",1" : "1";
    return text + "]";
  };
  EXPECT_EQ(decode_line(batch(kMaxBatch)).entries.size(), kMaxBatch);
  expect_error(batch(kMaxBatch + 1), "too_large", "");
}

}  // namespace
}  // namespace posed::proto
