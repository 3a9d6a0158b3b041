#include "server/tracker/frame_assembler.h"

#include <gtest/gtest.h>

namespace posed::tracker {
namespace {

class Cycles {
 public:
  explicit Cycles(bool counted) : assembler(counted ? FrameAssembler("d", true) : FrameAssembler("d", false)) {}

  // What came out, as "12@100 1@200": the stations of each Frame and its time.
  std::string cycle(std::uint32_t count, const std::vector<int>& stations) {
    std::string said;
    for (const int station : stations) {
      std::vector<Frame> out;
      Sample sample;
      sample.station = station;
      sample.device_count = count;
      assembler.add(sample, now += 100, out);
      for (const Frame& frame : out) {
        if (!said.empty()) said += ' ';
        for (const Sample& s : frame.samples) said += std::to_string(s.station);
        said += '@' + std::to_string(frame.t_ns);
      }
    }
    return said;
  }

  FrameAssembler assembler;
  Nanoseconds now = 0;
};

class EitherWay : public testing::TestWithParam<bool> {};
INSTANTIATE_TEST_SUITE_P(FrameAssembler, EitherWay, testing::Values(false, true));

TEST_P(EitherWay, ClosesAtTheLastStationWithoutWaiting) {
  Cycles c(GetParam());
  c.assembler.expect_up_to(2);
  EXPECT_EQ(c.cycle(1, {1, 2}), "12@200");
  EXPECT_EQ(c.cycle(2, {1, 2}), "12@400");
}

TEST_P(EitherWay, AVanishedFirstStationIsAbsentAtOnce) {
  Cycles c(GetParam());
  c.assembler.expect_up_to(2);
  c.cycle(1, {1, 2});
  EXPECT_EQ(c.cycle(2, {2}), "2@300");
  EXPECT_EQ(c.cycle(3, {2}), "2@400");
}

TEST_P(EitherWay, AVanishedLastStationDelaysOneFrameOnly) {
  Cycles c(GetParam());
  c.assembler.expect_up_to(2);
  c.cycle(1, {1, 2});
  EXPECT_EQ(c.cycle(2, {1}), "");
  EXPECT_EQ(c.cycle(3, {1}), "1@300 1@400");  // each with the time of its own bytes
  EXPECT_EQ(c.cycle(4, {1}), "1@500");
}

TEST_P(EitherWay, AStationThatJoinsIsHeardFromItsSecondCycleOn) {
  Cycles c(GetParam());
  c.assembler.expect_up_to(1);
  EXPECT_EQ(c.cycle(1, {1}), "1@100");
  EXPECT_EQ(c.cycle(2, {1, 2}), "1@200");
  EXPECT_EQ(c.cycle(3, {1, 2}), "12@500");
}

TEST_P(EitherWay, KnowingNothingItLearns) {
  Cycles c(GetParam());
  EXPECT_EQ(c.cycle(1, {1, 3, 7}), "1@100");
  EXPECT_EQ(c.cycle(2, {1, 3, 7}), "137@600");
}

TEST_P(EitherWay, ALastStationThatComesAndGoes) {
  Cycles c(GetParam());
  c.assembler.expect_up_to(2);
  c.cycle(1, {1, 2});
  c.cycle(2, {1});
  c.cycle(3, {1});
  EXPECT_EQ(c.cycle(4, {1, 2}), "1@500");
  EXPECT_EQ(c.cycle(5, {1, 2}), "12@800");
}

TEST_P(EitherWay, AllStationsSwapped) {
  Cycles c(GetParam());
  c.assembler.expect_up_to(1);
  c.cycle(1, {1});
  c.cycle(2, {2});  // without a count this looks like a latecomer
  EXPECT_EQ(c.cycle(3, {2}), "2@300");
}

TEST(FrameAssembler, AnotherCountIsAnotherInstant) {
  Cycles c(true);
  c.assembler.expect_up_to(3);
  c.cycle(1, {1, 2, 3});
  EXPECT_EQ(c.cycle(2, {1}), "");
  EXPECT_EQ(c.cycle(3, {2, 3}), "1@400 2@500");  // 2 of the second cycle and 1 of the third are lost on the way
  EXPECT_EQ(c.cycle(4, {1, 2, 3}), "123@900");
}

}  // namespace
}  // namespace posed::tracker
