// A VIPER in software, as the SDK's protocol headers describe it: binary frames with a CRC, an answer to each command,
// one pose frame a cycle with all sensors.
#pragma once

#include <array>
#include <map>
#include <string>

#include "tests/support/emulator_pack.h"
#include "tests/support/tracker_emulator.h"

namespace posed::test {

// Bit by bit, as the definition of CRC-16/ARC has it.
std::uint16_t slow_crc16(std::span<const std::uint8_t> bytes);

class ViperEmulator final : public TrackerEmulator {
 public:
  explicit ViperEmulator(int stations = 2);  // that are plugged in, from 1 on

  using TrackerEmulator::write;
  void write(std::span<const std::uint8_t> bytes) override;
  int rate_hz() const override { return 240; }  // of tick(); what it was told comes out of that
  void tick() override;
  std::deque<Output> drain() override;
  Bytes take();  // the same, as bytes
  bool streaming() const override { return continuous_; }
  void power_cycle() override;
  void left_streaming() override;

  void plug_sensor(int station) override { sensors_[station].detected = true; }
  void unplug_sensor(int station) override { sensors_[station].detected = false; }
  void set_pose(int station, SourcePose pose) override { sensors_[station].pose = pose; }
  void set_motion(Motion motion) override { motion_ = std::move(motion); }
  // It has no letters: any but a blank is an error of its self test.
  void set_error_letter(int, char letter) override { self_test_ = letter == ' ' ? 0 : 2; }
  void stop_streaming() override { continuous_ = false; }
  void set_refusing(int command) { refusing_ = command; }  // -1: none
  void set_mode(int mode) { mode_ = mode; }
  void set_units(std::uint32_t position, std::uint32_t orientation) { units_ = {position, orientation}; }
  void start() { continuous_ = true; }
  void press_buttons(int station, std::uint32_t held) { sensors_[station].buttons = held; }
  void set_old_hemispheres(bool old) { old_hemispheres_ = old; }  // with two words before the direction
  struct Filter {
    std::uint32_t level = 2;
    std::array<float, 4> numbers{};
  };
  Filter filter(int target) const { return filters_.contains(target) ? filters_.at(target) : Filter{}; }  // 1: attitude
  std::array<double, 3> hemisphere(int station) const { return sensors_.at(station).hemisphere; }  // 0 0 0: it follows

 private:
  struct Sensor {
    bool detected = false;
    SourcePose pose;
    std::uint32_t buttons = 0;
    std::array<double, 3> hemisphere{1, 0, 0};
  };

  void execute(std::span<const std::uint8_t> frame);
  bool set_hemisphere(std::uint32_t sensor, std::span<const std::uint8_t> payload);
  bool set_filter(std::uint32_t target, std::span<const std::uint8_t> payload);
  void answer(std::uint32_t command, std::uint32_t action, std::uint32_t argument, const Bytes& payload);
  Bytes pose_frame();
  void put_sensor(Bytes& to, int station, const SourcePose& pose) const;

  std::map<int, Sensor> sensors_;
  Motion motion_;
  Bytes heard_;
  std::deque<Output> output_;
  std::uint32_t count_ = 0;
  std::array<std::uint32_t, 2> units_{0, 0};
  std::uint32_t self_test_ = 0;
  static constexpr int kRates[] = {30, 60, 120, 240, 480, 960};
  std::map<int, Filter> filters_;
  std::uint32_t rate_ = 3, ticks_ = 0;
  int mode_ = 0, refusing_ = -1;
  bool continuous_ = false, old_hemispheres_ = false;
};

}  // namespace posed::test
