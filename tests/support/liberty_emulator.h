// A LIBERTY in software, as its manual describes it: bytes written to it are commands, tick() is one measurement cycle,
// take() is what waits to be read. Written from the manual and not from posed's decoder, so that the two can disagree.
// Source: LIBERTY User Manual URM03PH156 Rev H. Pure; one thread (lock around it otherwise).
#pragma once

#include <array>
#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace posed::test {

// Source frame (X forward, Y right, Z down); inches and degrees, which is what the device itself thinks in.
struct LibertyPose {
  double x = 10.0, y = -2.5, z = 3.25;
  double azimuth = 45.0, elevation = -30.0, roll = 15.0;
};

class LibertyEmulator {
 public:
  explicit LibertyEmulator(int stations = 2);  // that are plugged in, from 1 on

  void write(std::span<const std::uint8_t> bytes);  // to its OUT endpoint
  void write(std::string_view text);
  void tick();  // one measurement cycle: the count goes on, and a frame comes out where the device streams
  // What a read gets: each element is one answer or one cycle's frames. With USB buffering off only the newest cycle
  // waits, with it on at most 2300 bytes do.
  std::deque<std::vector<std::uint8_t>> take();
  bool has_output() const { return !output_.empty(); }

  // The hand on the plugs, and on what the device measures.
  void plug_sensor(int station) { sensors_[station].detected = sensors_[station].active = true; }
  void unplug_sensor(int station) { sensors_[station].detected = false; }
  void set_pose(int station, LibertyPose pose) { sensors_[station].pose = pose; }
  void set_motion(std::function<LibertyPose(int station, std::uint32_t count)> motion) { motion_ = std::move(motion); }
  void set_error_letter(int station, char letter) { sensors_[station].letter = letter; }
  void set_distortion(int station, int level) { sensors_[station].distortion = level; }
  void set_count(std::uint32_t count) { count_ = count; }
  void set_frozen(bool frozen) { frozen_ = frozen; }  // measures nothing, as with the source unplugged
  void set_deaf(bool deaf) { deaf_ = deaf; }          // takes commands and does nothing

  bool streaming() const { return continuous_; }
  bool binary() const { return binary_; }
  bool centimetres() const { return centimetres_; }
  bool buffering() const { return buffering_; }
  std::uint32_t count() const { return count_; }
  const std::vector<std::string>& commands() const { return commands_; }  // all that were understood, in order

 private:
  struct SensorState {
    bool detected = false, active = false;
    LibertyPose pose;
    char letter = 0;
    int distortion = 0;
    std::array<double, 3> hemisphere{1, 0, 0};
    std::vector<int> list{2, 4, 1};
  };
  using Arguments = std::vector<std::string>;

  void execute(const std::string& line);
  void set(char command, const Arguments& arguments, const std::string& line);
  void query(char command, int station);
  void set_list(const Arguments& arguments, const std::string& line);
  void set_stations(const Arguments& arguments, const std::string& line);
  void complain(char command, int error, const std::string& line);
  void answer(char command, int station, const std::vector<std::uint8_t>& body, const std::string& text);
  std::vector<std::uint8_t> cycle(char command);
  std::vector<std::uint8_t> record(int station, char command);
  LibertyPose measured(int station);

  std::map<int, SensorState> sensors_;
  std::function<LibertyPose(int, std::uint32_t)> motion_;
  std::string line_;
  std::vector<std::string> commands_;
  struct Output {
    std::vector<std::uint8_t> bytes;
    bool cycle = false;
  };
  std::deque<Output> output_;
  std::uint32_t count_ = 0;
  bool continuous_ = false, binary_ = false, centimetres_ = false, buffering_ = true, echo_ = false;
  bool frozen_ = false, deaf_ = false;
  int rate_ = 4;
};

}  // namespace posed::test
