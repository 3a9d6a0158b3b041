// A FASTRAK or an ISOTRAK II in software, as the FASTRAK's manual describes it; the ISOTRAK II as VRPN's driver expects
// it. Commands are case-sensitive, single letters act at once, stations take turns: one record a cycle. Source: FASTRAK
// manual OPM00PI002 Rev G; VRPN's drivers for the ISOTRAK II's packing.
#pragma once

#include <array>
#include <map>
#include <string>
#include <vector>

#include "tests/support/emulator_pack.h"
#include "tests/support/tracker_emulator.h"
#include "tests/support/tracker_frames.h"

namespace posed::test {

class FastrakEmulator final : public TrackerEmulator {
 public:
  enum class Kind { fastrak, isotrak };

  explicit FastrakEmulator(int stations = 2, Kind kind = Kind::fastrak);  // switched on and plugged in, from 1 on

  using TrackerEmulator::write;
  void write(std::span<const std::uint8_t> bytes) override;
  int rate_hz() const override { return kind_ == Kind::fastrak ? 120 : 60; }
  void tick() override;
  std::deque<Output> drain() override;
  Bytes take();  // the same, as bytes
  bool streaming() const override { return continuous_; }
  void power_cycle() override;
  void left_streaming() override;

  // A receiver that is unplugged is still switched on: its records carry the letter l.
  void plug_sensor(int station) override { sensors_[station].detected = true; }
  void unplug_sensor(int station) override { sensors_[station].detected = false; }
  void set_pose(int station, SourcePose pose) override { sensors_[station].pose = pose; }
  void set_motion(Motion motion) override { motion_ = std::move(motion); }
  void set_error_letter(int station, char letter) override { sensors_[station].letter = letter; }
  void set_slow_to_complain() { slow_ = true; }  // its complaint comes with its next answer
  void stop_streaming() override { continuous_ = false; }
  void press_button(bool down);  // of the stylus, on station 1

  bool binary() const { return binary_; }
  bool centimetres() const { return centimetres_; }
  bool active(int station) const { return sensors_.contains(station) && sensors_.at(station).active; }
  std::array<double, 3> hemisphere(int station) const { return sensors_.at(station).hemisphere; }
  // Of positions (x) or attitudes (v): sensitivity, low, high, most; as it was told last.
  std::array<double, 4> filter(char command) const { return command == 'x' ? filters_[0] : filters_[1]; }
  const std::vector<std::string>& commands() const { return commands_; }  // all that were understood, in order

 private:
  struct Sensor {
    bool detected = false, active = false;
    SourcePose pose;
    char letter = ' ';
    std::array<double, 3> hemisphere{1, 0, 0};
    std::vector<int> list{2, 4, 1};
    SensorFrames frames;
    SourcePose reference{0, 0, 0, 0, 0, 0};  // of a boresight
  };
  using Arguments = std::vector<std::string>;

  bool at_once(char letter);
  void execute(const std::string& line);
  bool set_frames(char letter, Sensor& sensor, const Arguments& arguments);
  void set_list(const std::string& line, const Arguments& arguments);
  void answer(int station, char letter, const std::string& text);
  void complain(const std::string& line, int code);
  int most() const { return kind_ == Kind::fastrak ? 4 : 2; }
  SourcePose raw(const Sensor& sensor, int station) const;
  Bytes record(int station);
  Bytes packed(int station, const SourcePose& pose, char letter) const;
  void put_item(Bytes& to, int item, const SourcePose& pose, bool button) const;
  void put_numbers(Bytes& to, bool extended, const char* pattern, std::span<const double> numbers) const;

  Kind kind_;
  std::map<int, Sensor> sensors_;
  Motion motion_;
  std::string line_;
  std::vector<std::string> commands_;
  std::deque<Output> output_;
  bool slow_ = false;
  std::deque<Output> complaints_;  // that it is slow with
  std::uint32_t count_ = 0;
  int turn_ = 0;  // the station that measured last
  bool continuous_ = false, binary_ = false, centimetres_ = false, suspended_ = false;
  bool button_ = false, button_starts_ = true;
  std::array<std::array<double, 4>, 2> filters_{{{0.2, 0.2, 0.8, 0.95}, {0.2, 0.2, 0.8, 0.95}}};  // x, v
};

}  // namespace posed::test
