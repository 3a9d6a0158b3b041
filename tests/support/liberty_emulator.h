// A LIBERTY or PATRIOT in software, as the LIBERTY's manual describes it; the PATRIOT takes the same commands.
// Source: LIBERTY User Manual URM03PH156 Rev H, tables 2-19 and 2-46.
#pragma once

#include <array>
#include <map>
#include <string>

#include "tests/support/emulator_pack.h"
#include "tests/support/tracker_emulator.h"
#include "tests/support/tracker_frames.h"

namespace posed::test {

using LibertyPose = SourcePose;

struct LibertyKind {
  std::string tag = "LY", banner = "LIBERTY Ready!";
  int stations = 16;
  int rate_hz = 240;
};

inline const LibertyKind kPatriotKind{"PA", "Patriot Ready!", 2, 60};

class LibertyEmulator final : public TrackerEmulator {
 public:
  explicit LibertyEmulator(int stations = 2, LibertyKind kind = {});  // that are plugged in, from 1 on

  using TrackerEmulator::write;
  void write(std::span<const std::uint8_t> bytes) override;  // to its OUT endpoint, or its serial line
  int rate_hz() const override { return kind_.rate_hz; }
  void tick() override;
  // With USB buffering off only the newest cycle waits, with it on at most 2300 bytes do.
  std::deque<Output> drain() override;
  std::deque<std::vector<std::uint8_t>> take();  // the same, as bytes
  bool has_output() const { return !output_.empty(); }
  void power_cycle() override;
  void left_streaming() override;
  void set_on_serial(bool on) { on_serial_ = on; }  // it says its banner there, and not on USB

  void plug_sensor(int station) override { sensors_[station].detected = sensors_[station].active = true; }
  void unplug_sensor(int station) override { sensors_[station].detected = false; }
  void set_pose(int station, SourcePose pose) override { sensors_[station].pose = pose; }
  void set_motion(Motion motion) override { motion_ = std::move(motion); }
  void set_error_letter(int station, char letter) override { sensors_[station].letter = letter; }
  // Of a stylus. In the mode that L 1 asks for it starts and stops the stream as well.
  void press_button(int station, bool down);
  void set_distortion(int station, int level) { sensors_[station].distortion = level; }
  void set_count(std::uint32_t count) { count_ = count; }
  void stop_streaming() override { continuous_ = false; }

  bool streaming() const override { return continuous_; }
  bool binary() const { return binary_; }
  bool centimetres() const { return centimetres_; }
  bool buffering() const { return buffering_; }
  int rate_code() const { return rate_; }
  // Of positions (X) or attitudes (Y): how sharp, low, high, most; as it was told last.
  std::array<double, 4> filter(char command) const { return filters_.contains(command) ? filters_.at(command) : kOff; }
  std::array<double, 3> hemisphere(int station) const { return sensors_.at(station).hemisphere; }
  bool active(int station) const { return sensors_.at(station).active; }
  std::uint32_t count() const { return count_; }
  const std::vector<std::string>& commands() const { return commands_; }  // all that were understood, in order

 private:
  struct SensorState {
    bool detected = false, active = false;
    LibertyPose pose;
    char letter = 0;
    int distortion = 0;
    bool button = false, button_starts = false;
    SensorFrames frames;
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
  void set_frames(char command, const Arguments& arguments, const std::string& line);
  SourcePose raw(int station);  // inches, as no command has changed it but the hemisphere's
  SourcePose measured(int station);
  Bytes framed(int station, char command, int error, const Bytes& body) const;

  LibertyKind kind_;
  std::map<int, SensorState> sensors_;
  Motion motion_;
  std::string line_;
  std::vector<std::string> commands_;
  std::deque<Output> output_;
  std::uint32_t count_ = 0, ticks_ = 0;
  bool continuous_ = false, binary_ = false, centimetres_ = false, buffering_ = true, echo_ = false;
  bool on_serial_ = false;
  int rate_ = 4;
  static constexpr std::array<double, 4> kOff{0, 1, 0, 0};
  std::map<char, std::array<double, 4>> filters_;
};

// The 8 bytes in front of everything that it says in binary mode.
Bytes liberty_frame(int station, std::uint8_t command, std::uint8_t error, const Bytes& body,
                    const std::string& tag = "LY");

}  // namespace posed::test
