// Reports of a SpaceMouse -> Frames. It tells how far its cap is pushed, not where it is: this turns that into a pose,
// which wanders with the push and stays where it is left. It starts before the figure's right hand; the first two
// buttons together take it back there. One sensor, station 1. Source: report layouts, range and axes (X right, Y
// towards the user, Z down) as spacenavd, PySpaceMouse and published USB captures have them. Each feed is one report,
// as hidraw reads them: how long one is tells its kind. Pure: the time that a push lasts is that between the reports'
// arrivals.
#pragma once

#include <cstdint>
#include <string>

#include "server/tracker/decoder.h"

namespace posed::tracker {

struct SpacemouseFormat {
  std::string device = "spacemouse";  // Frame::device
};

class SpacemouseDecoder final : public Decoder {
 public:
  explicit SpacemouseDecoder(SpacemouseFormat format) : format_(std::move(format)) {}

  Heard feed(std::span<const std::uint8_t> report, Nanoseconds now) override;
  void expect_up_to(int) override {}
  void lost_bytes() override {}  // the next report says it all
  std::uint64_t bad_bytes() const override { return bad_bytes_; }
  std::string description() const override;

 private:
  void push(const Vec3& cap, Nanoseconds now);
  void turn(const Vec3& cap, Nanoseconds now);
  void home();

  SpacemouseFormat format_;
  Sample sample_ = at_home();
  Nanoseconds pushed_ns_ = 0, turned_ns_ = 0;
  std::uint64_t bad_bytes_ = 0;

  static Sample at_home();
};

}  // namespace posed::tracker
