// Replies, errors and batches out, and what a client makes of them.
#include <random>

#include "tests/proto/proto_fixture.h"

namespace posed::proto {
namespace {

TEST(Replies, AResultComesBackWithItsId) {
  const std::string line = encode_reply("42", EditResult{"g1", 7, 1});
  EXPECT_EQ(line, R"({"jsonrpc":"2.0","id":42,"result":{"id":"g1","revision":7,"entity_revision":1}})");
  const Result<Incoming> in = decode_incoming(line);
  ASSERT_TRUE(in);
  EXPECT_EQ(in->id, 42);
  EXPECT_FALSE(in->error);
  EXPECT_EQ(decode_message<EditResult>(in->result)->entity_revision, 1u);
}

TEST(Replies, FullDoublesSurvive) {
  std::mt19937 random{10};
  std::uniform_int_distribution<std::uint64_t> bits;
  PoseResult sent;
  sent.pose.figure = "body";
  while (sent.pose.q.size() < 500) {
    const double value = std::bit_cast<double>(bits(random));
    if (std::isfinite(value)) sent.pose.q.push_back(value);
  }
  sent.balance_error = 1e-17;
  sent.pose.cost = 1.0 / 3.0;
  const Result<Incoming> in = decode_incoming(encode_reply("1", sent));
  const Result<PoseResult> back = decode_message<PoseResult>(in->result);
  ASSERT_TRUE(back) << back.error().message;
  EXPECT_EQ(back->pose.q, sent.pose.q);
  EXPECT_EQ(back->balance_error, 1e-17);
  EXPECT_EQ(back->pose.cost, 1.0 / 3.0);
}

TEST(Replies, EveryErrorCodeHasItsNumber) {
  const std::pair<const char*, int> table[] = {
      {"parse_error", -32700},     {"invalid_request", -32600},   {"unknown_method", -32601},
      {"invalid_params", -32602},  {"unknown_field", -32602},     {"missing_field", -32602},
      {"wrong_type", -32602},      {"out_of_range", -32602},      {"not_finite", -32602},
      {"bad_id", -32602},          {"internal", -32603},          {"unknown_figure", -32000},
      {"unknown_segment", -32000}, {"unknown_site", -32000},      {"unknown_joint", -32000},
      {"unknown_goal", -32000},    {"unknown_binding", -32000},   {"unknown_sensor", -32000},
      {"unknown_scene", -32000},   {"unknown_stream", -32000},    {"bad_figure", -32000},
      {"bad_scene", -32000},       {"not_available", -32000},     {"ambiguous_figure", -32000},
      {"too_large", -32000},       {"revision_mismatch", -32000}, {"store_failed", -32000}};
  for (const auto& [code, number] : table) {
    const json reply = json::parse(encode_error("1", {code, "m", "", ""}));
    EXPECT_EQ(reply["error"]["code"], number) << code;
    EXPECT_EQ(reply["error"]["data"], (json{{"code", code}}));
  }
}

TEST(Replies, AnErrorSaysWhereAndWhatWouldBeRight) {
  const Error sent{"unknown_segment", "no segment is called right_hnd", "/params/at", "did you mean right_hand?"};
  const std::string line = encode_error("\"a\"", sent);
  EXPECT_EQ(json::parse(line)["id"], "a");
  const Result<Incoming> in = decode_incoming(line);
  ASSERT_TRUE(in && in->error);
  EXPECT_EQ(in->error->code, sent.code);
  EXPECT_EQ(in->error->message, sent.message);
  EXPECT_EQ(in->error->path, sent.path);
  EXPECT_EQ(in->error->hint, sent.hint);
  EXPECT_EQ(json::parse(encode_error("", sent))["id"], nullptr);
}

TEST(Replies, TextCutInTheMiddleOfALetterIsStillJson) {
  const std::string cut = "\xe2\x82";
  EXPECT_TRUE(json::accept(encode_error("1", {"unknown_field", cut, "/" + cut, cut})));
  EXPECT_TRUE(json::accept(encode_reply("1", EditResult{cut, 1, 1})));
}

TEST(Replies, ABatchIsAnsweredByOneLine) {
  EXPECT_EQ(join_batch({"{\"a\":1}", "", "{\"b\":2}"}), "[{\"a\":1},{\"b\":2}]");
  EXPECT_EQ(join_batch({"", ""}), "");
  EXPECT_EQ(join_batch({}), "");
}

TEST(Replies, ClientsIgnoreWhatTheyDoNotKnow) {
  const Result<EditResult> result =
      decode_message<EditResult>(R"({"id":"g1","new":{"x":[1]},"revision":7,"entity_revision":1,"other":null})");
  ASSERT_TRUE(result) << result.error().message;
  EXPECT_EQ(result->revision, 7u);
  const Result<PoseData> pose = decode_message<PoseData>(
      R"({"t_ns":1,"revision":2,"later":1,"figures":[{"figure":"b","cost":0,"status":"converged","branch_changed":false,"x":1}]})");
  ASSERT_TRUE(pose) << pose.error().message;
  EXPECT_TRUE(pose->figures[0].world_from_segment.empty());
}

TEST(Replies, AMessageThatLacksAFieldIsAnError) {
  const Result<EditResult> result = decode_message<EditResult>(R"({"id":"g1","revision":7})");
  ASSERT_FALSE(result);
  EXPECT_EQ(result.error().code, "missing_field");
  EXPECT_FALSE(decode_message<EditResult>("x"));
  EXPECT_FALSE(decode_message<EditResult>("[]"));
}

TEST(Replies, LinesThatNoDaemonSendsAreErrors) {
  for (const char* line : {"", "x", "[]", "1", R"({"method":"stream.frame","params":{"stream":7}})",
                           R"({"method":"stream.frame","params":{"stream":"pose","seq":-1}})"}) {
    const Result<Incoming> in = decode_incoming(line);
    ASSERT_FALSE(in) << line;
    EXPECT_EQ(in.error().code, "bad_reply");
  }
  const Result<Incoming> odd = decode_incoming(R"({"id":"text","error":{"message":7},"params":[]})");
  ASSERT_TRUE(odd);
  EXPECT_FALSE(odd->id);
  EXPECT_TRUE(odd->error);
}

TEST(Replies, PrettyIsTheSameJson) {
  const std::string text = R"({"b":[1,2.5],"a":"x"})";
  EXPECT_EQ(json::parse(pretty(text)), json::parse(text));
  EXPECT_NE(pretty(text).find('\n'), std::string::npos);
  EXPECT_LT(pretty(text).find("\"b\""), pretty(text).find("\"a\""));
  EXPECT_EQ(pretty("no json"), "no json");
}

}  // namespace
}  // namespace posed::proto
