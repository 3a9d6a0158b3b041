// CBOR says what JSON says.
#include <cmath>

#include "tests/proto/examples.h"
#include "tests/proto/proto_fixture.h"

namespace posed::proto {
namespace {

// Alike but for numbers that are not whole: those agree to the last bit of a float32, or wholly if `exact`.
void expect_same(const json& text, const json& cbor, bool exact, const std::string& path = "") {
  SCOPED_TRACE(path);
  if (text.is_number_float()) {
    ASSERT_TRUE(cbor.is_number_float());
    if (exact) {
      EXPECT_EQ(text, cbor);
    } else {
      EXPECT_EQ(static_cast<float>(text.get<double>()), static_cast<float>(cbor.get<double>()));
    }
    return;
  }
  ASSERT_EQ(text.type(), cbor.type());
  if (!text.is_structured()) {
    EXPECT_EQ(text, cbor);
    return;
  }
  ASSERT_EQ(text.size(), cbor.size());
  if (text.is_array()) {
    for (std::size_t i = 0; i < text.size(); ++i) expect_same(text[i], cbor[i], exact, path + "/" + std::to_string(i));
    return;
  }
  for (const auto& [key, value] : text.items()) {
    ASSERT_TRUE(cbor.contains(key)) << key;
    expect_same(value, cbor[key], exact, path + "/" + key);
  }
}

TEST(StreamCbor, EveryExampleOfAFrameSaysTheSame) {
  int frames = 0;
  for (const auto& [name, example] : examples()) {
    if (!name.starts_with("stream.frame.")) continue;
    const std::string text = example.at("notice").dump();
    const bool scene = name.starts_with("stream.frame.scene");
    expect_same(json::parse(text), json::from_cbor(encode_cbor(text, scene ? Stream::scene : Stream::pose)), scene,
                name);
    ++frames;
  }
  EXPECT_GE(frames, 5);
}

TEST(StreamCbor, NumbersOfEverySize) {
  const std::string text =
      R"({"whole":[0,1,23,24,255,256,65535,65536,4294967295,4294967296,18446744073709551615,-1,-24,-25,-256,-257,-65537,)"
      R"(-9007199254740991],"parts":[0.5,-0.25,1.234567,-0.0000001,1e300,0.1],"words":["",")" +
      std::string(300, 'x') + R"(","\u00e4"],"rest":[true,false,null,[],{}]})";
  // No float32 holds 1e300: a stream of poses never says it.
  const std::string bounded = std::string(text).replace(text.find("1e300"), 5, "1e30");
  expect_same(json::parse(text), json::from_cbor(encode_cbor(text, Stream::scene)), true);
  expect_same(json::parse(bounded), json::from_cbor(encode_cbor(bounded, Stream::pose)), false);
}

TEST(StreamCbor, AFrameOfFortySegmentsIsHalfAsLong) {
  PoseData data;
  FigurePose& pose = data.figures.emplace_back();
  pose.figure = "body";
  for (int i = 0; i < 40; ++i)
    pose.world_from_segment.push_back(
        {{std::sin(i), std::cos(i), 0.1234567 * i}, quat_about({0.6, 0.8, 0.0}, i + 0.1)});
  const std::string text = encode_pose_frame(812, data, {true, false, false});
  const std::string cbor = encode_cbor(text, Stream::pose);
  EXPECT_LT(cbor.size(), 0.6 * static_cast<double>(text.size()));
  expect_same(json::parse(text), json::from_cbor(cbor), false);
}

}  // namespace
}  // namespace posed::proto
