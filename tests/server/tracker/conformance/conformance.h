// What every tracker driver must get over, whatever the family and whatever its line. The tests are in
// conformance_test.cpp, written once; each line's program says which trackers it runs them on.
#pragma once

#include <gtest/gtest.h>

#include <functional>
#include <memory>
#include <ostream>
#include <string>

#include "common/frame.h"
#include "tests/support/tracker_testbed.h"

namespace posed::tracker {

struct ConformanceCase {
  std::string name;
  std::string kind;  // as the registry has it
  std::function<std::unique_ptr<test::TrackerTestbed>()> make;
  std::function<std::unique_ptr<test::TrackerEmulator>()> emulator;
  double tolerance = 1e-5;  // m, and of a quaternion's parts
  char told_letter = 0;     // what an error letter comes out as; 0: as it is
};

inline void PrintTo(const ConformanceCase& which, std::ostream* out) {
  *out << which.name;
}

inline std::string name_of(const testing::TestParamInfo<ConformanceCase>& which) {
  return which.param.name;
}

class Conformance : public testing::TestWithParam<ConformanceCase> {
 protected:
  void SetUp() override {
    bed = GetParam().make();
    ASSERT_TRUE(bed);
  }
  std::string spec() const { return GetParam().kind + ":" + bed->place(); }
  void expect_pose(const Frame& frame, std::size_t index, const test::SourcePose& pose) const;

  std::unique_ptr<test::TrackerTestbed> bed;
};

}  // namespace posed::tracker
