#include "tests/support/fastrak_emulator.h"

#include <cstdlib>
#include <utility>

namespace posed::test {
namespace {

constexpr std::string_view kAtOnce = "PCcFfUuSWDd\x19\x0b\x13\x11";
constexpr std::string_view kLines = "ARBbGrHIlNOoeQVXxvyTtY";

enum Code { kMissing = -1, kNotNumeric = -2, kOutOfRange = -3, kUndefined = -99 };

std::vector<std::string> split(const std::string& text) {
  std::vector<std::string> fields(1);
  for (const char c : text) {
    if (c == ',') {
      fields.emplace_back();
    } else {
      fields.back() += c;
    }
  }
  return fields;
}

}  // namespace

FastrakEmulator::FastrakEmulator(int stations, Kind kind) : kind_(kind) {
  for (int station = 1; station <= stations; ++station) sensors_[station].detected = sensors_[station].active = true;
}

void FastrakEmulator::write(std::span<const std::uint8_t> bytes) {
  for (const std::uint8_t byte : bytes) {
    if (deaf_ || byte == '\n') continue;
    const char c = static_cast<char>(byte);
    if (line_.empty() && at_once(c)) continue;
    if (c != '\r') {
      line_ += c;
      continue;
    }
    execute(std::exchange(line_, {}));
  }
}

bool FastrakEmulator::at_once(char letter) {
  if (kAtOnce.find(letter) == std::string_view::npos) return false;
  commands_.emplace_back(1, letter);
  if (letter == 'C' || letter == 'c') continuous_ = letter == 'C';
  if (letter == 'F' || letter == 'f') binary_ = letter == 'f';
  if (letter == 'U' || letter == 'u') centimetres_ = letter == 'u';
  if (letter == '\x13' || letter == '\x11') suspended_ = letter == '\x13';
  if (letter == 'W' || letter == '\x19') power_cycle();
  if (letter == 'P' && !frozen_) {
    for (const auto& [station, sensor] : sensors_) {
      if (sensor.active) output_.push_back({record(station), true});
    }
  }
  if (letter == 'S') {
    const unsigned flags = 0x3E0u | (binary_ ? 1u : 0u) | (centimetres_ ? 2u : 0u) | (continuous_ ? 8u : 0u);
    char text[80];
    if (kind_ == Kind::fastrak) {
      std::snprintf(text, sizeof text, "%03X  0 F3 %-2s     3.18  %-23s", flags, "1", "");
    } else {
      std::snprintf(text, sizeof text, "%03X  0   1.10  ", flags);
    }
    answer(1, 'S', text);
  }
  return true;
}

void FastrakEmulator::execute(const std::string& line) {
  if (line.empty() || kLines.find(line[0]) == std::string_view::npos) return complain(line, kUndefined);
  const char letter = line[0];
  const Arguments arguments = split(line.substr(1));
  if (letter == 'O') return set_list(line, arguments);
  const bool of_station = std::string_view("ARBbGrHIlNeQV").find(letter) != std::string_view::npos;
  const int station = std::atoi(arguments[0].c_str());
  if (of_station && arguments[0].empty()) return complain(line, kMissing);
  if (of_station && (station < 1 || station > most())) return complain(line, kOutOfRange);
  if (letter == 'l' && arguments.size() == 1) {
    std::string text;
    for (int n = 1; n <= most(); ++n) text += sensors_[n].active ? '1' : '0';
    return answer(station, 'l', text);
  }
  if (letter == 'l') sensors_[station].active = arguments[1] == "1";
  if (letter == 'e' && arguments.size() == 2) button_starts_ = arguments[1] == "1";
  if (letter == 'H') {
    if (arguments.size() != 4) return complain(line, kMissing);
    for (std::size_t i = 0; i < 3; ++i) sensors_[station].hemisphere[i] = std::atof(arguments[i + 1].c_str());
  }
  if (std::string_view("ARBbGN").find(letter) != std::string_view::npos &&
      !set_frames(letter, sensors_[station], arguments))
    return complain(line, kMissing);
  if (letter == 'x' || letter == 'v') {
    if (arguments.size() > 4) return complain(line, kOutOfRange);
    for (std::size_t i = 0; i < arguments.size(); ++i) {
      if (arguments[i].empty()) continue;  // as it was
      const double value = std::atof(arguments[i].c_str());
      if (value < 0.0 || value > 1.0) return complain(line, kOutOfRange);
      filters_[letter == 'x' ? 0 : 1][i] = value;
    }
  }
  commands_.push_back(line);
}

// Numbers are in the units that are set. False where some are missing.
bool FastrakEmulator::set_frames(char letter, Sensor& sensor, const Arguments& arguments) {
  if (arguments.size() != (letter == 'A' ? 10 : letter == 'N' || letter == 'G' ? 4 : 1)) return false;
  const int station = std::atoi(arguments[0].c_str());
  const auto number = [&](std::size_t at) { return std::atof(arguments[at].c_str()); };
  const auto point = [&](std::size_t at) {
    const double inches = centimetres_ ? 1.0 / 2.54 : 1.0;
    return SensorFrames::Point{inches * number(at), inches * number(at + 1), inches * number(at + 2)};
  };
  if (letter == 'A') sensor.frames.align(point(1), point(4), point(7));
  if (letter == 'R') sensor.frames.reset_alignment();
  if (letter == 'G') sensor.reference = {0, 0, 0, number(1), number(2), number(3)};
  if (letter == 'B') sensor.frames.boresight(raw(sensor, station), sensor.reference, false);
  if (letter == 'b') sensor.frames.reset_boresight();
  if (letter == 'N') sensor.frames.set_tip(point(1));
  return true;
}

// An ISOTRAK's list is for all stations, and names none.
void FastrakEmulator::set_list(const std::string& line, const Arguments& arguments) {
  const bool names_station = kind_ == Kind::fastrak;
  std::vector<int> list;
  for (std::size_t i = names_station ? 1 : 0; i < arguments.size(); ++i) {
    if (arguments[i].empty()) return complain(line, kMissing);
    if (arguments[i].find_first_not_of("0123456789") != std::string::npos) return complain(line, kNotNumeric);
    list.push_back(std::atoi(arguments[i].c_str()));
    const int item = list.back() % 50;
    const bool known = item <= 7 || item == 11 || item == 16;
    if (!known || list.back() > 99) return complain(line, kOutOfRange);
  }
  const int station = std::atoi(arguments[0].c_str());
  if (names_station && (station < 1 || station > most())) return complain(line, kOutOfRange);
  for (int n = 1; n <= most(); ++n) {
    if (!names_station || n == station) sensors_[n].list = list;
  }
  commands_.push_back(line);
}

void FastrakEmulator::answer(int station, char letter, const std::string& text) {
  Bytes line;
  put_text(line, "2" + std::string(1, station ? static_cast<char>('0' + station) : ' ') + letter + text + "\r\n");
  if (slow_ && letter == 'E') return complaints_.push_back({std::move(line), false});
  for (Output& late : std::exchange(complaints_, {})) output_.push_back(std::move(late));
  output_.push_back({std::move(line), false});
}

void FastrakEmulator::complain(const std::string& line, int code) {
  answer(1, 'E', "*ERROR*" + line + "*ERROR* EC " + std::to_string(code));
}

void FastrakEmulator::press_button(bool down) {
  if (down && !button_ && button_starts_) continuous_ = !continuous_;
  button_ = down;
}

void FastrakEmulator::tick() {
  if (frozen_) return;
  ++count_;
  if (!continuous_ || suspended_) return;
  for (int i = 0; i < most(); ++i) {
    turn_ = turn_ % most() + 1;
    if (!sensors_[turn_].active) continue;
    // What nobody reads is lost after a while.
    if (output_.size() < 40) output_.push_back({record(turn_), true});
    return;
  }
}

std::deque<TrackerEmulator::Output> FastrakEmulator::drain() {
  return std::exchange(output_, {});
}

Bytes FastrakEmulator::take() {
  Bytes all;
  for (const Output& output : drain()) all.insert(all.end(), output.bytes.begin(), output.bytes.end());
  return all;
}

void FastrakEmulator::power_cycle() {
  for (auto& [station, sensor] : sensors_) {
    sensor.active = sensor.detected;
    sensor.hemisphere = {1, 0, 0};
    sensor.list = {2, 4, 1};
  }
  line_.clear();
  output_.clear();
  continuous_ = binary_ = centimetres_ = suspended_ = false;
  button_starts_ = true;
}

void FastrakEmulator::left_streaming() {
  write(kind_ == Kind::fastrak ? "UfO1,2,4,1\rCO1,2" : "UfO2,4,1\rCO2");
}

}  // namespace posed::test
