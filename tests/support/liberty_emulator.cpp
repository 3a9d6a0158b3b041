#include "tests/support/liberty_emulator.h"

#include <cctype>
#include <cmath>
#include <cstdlib>
#include <utility>

#include "tests/support/emulator_pack.h"

namespace posed::test {
namespace {

constexpr std::size_t kFifo = 2300;

enum ErrorCode { kInvalidCommand = 1, kInvalidStation = 2, kInvalidParameter = 3, kTooFew = 4, kTooMany = 5 };

std::vector<std::string> split(const std::string& text) {
  std::vector<std::string> fields(1);
  for (const char c : text) {
    if (c == ',') {
      fields.emplace_back();
    } else if (c != ' ') {
      fields.back() += c;
    }
  }
  return fields;
}

bool matches_station(const std::string& field, int station) {
  return field == "*" || std::atoi(field.c_str()) == station;
}

bool valid_station(const std::string& field, int most) {
  return field == "*" || (std::atoi(field.c_str()) >= 1 && std::atoi(field.c_str()) <= most);
}

}  // namespace

LibertyEmulator::LibertyEmulator(int stations, LibertyKind kind) : kind_(std::move(kind)) {
  for (int station = 1; station <= stations; ++station) plug_sensor(station);
}

void LibertyEmulator::write(std::span<const std::uint8_t> bytes) {
  for (const std::uint8_t byte : bytes) {
    if (deaf_ || byte == '\n') continue;
    if (line_.empty() && (byte == 'P' || byte == 'p')) {
      continuous_ = false;
      commands_.emplace_back("P");
      if (!frozen_) output_.push_back({cycle('P'), true});
    } else if (byte == '\r') {
      execute(line_);
      line_.clear();
    } else {
      line_ += static_cast<char>(byte);
    }
  }
}

void LibertyEmulator::tick() {
  if (frozen_) return;
  if (rate_ == 3 && ++ticks_ % 2 != 0) return;
  ++count_;
  if (!continuous_) return;
  Bytes bytes = cycle('C');
  if (bytes.empty()) return;
  std::size_t waiting = 0;
  if (!buffering_) std::erase_if(output_, [](const Output& output) { return output.cycle; });
  for (const Output& output : output_) waiting += output.bytes.size();
  if (waiting + bytes.size() <= kFifo) output_.push_back({std::move(bytes), true});
}

std::deque<TrackerEmulator::Output> LibertyEmulator::drain() {
  return std::exchange(output_, {});
}

std::deque<std::vector<std::uint8_t>> LibertyEmulator::take() {
  std::deque<std::vector<std::uint8_t>> taken;
  for (Output& output : drain()) taken.push_back(std::move(output.bytes));
  return taken;
}

void LibertyEmulator::press_button(int station, bool down) {
  SensorState& sensor = sensors_[station];
  if (down && !sensor.button && sensor.button_starts) continuous_ = !continuous_;
  sensor.button = down;
}

void LibertyEmulator::power_cycle() {
  const std::map<int, SensorState> before = std::exchange(sensors_, {});
  for (const auto& [station, sensor] : before) {
    if (!sensor.detected) continue;
    plug_sensor(station);
    sensors_[station].pose = sensor.pose;
  }
  line_.clear();
  output_.clear();
  count_ = 0;
  rate_ = 4;
  continuous_ = binary_ = centimetres_ = echo_ = false;
  buffering_ = true;
  Bytes banner;
  put_text(banner, kind_.banner + "\r\n");
  if (on_serial_) output_.push_back({std::move(banner), false});
}

void LibertyEmulator::left_streaming() {
  write("F1\rU0\rO*,8,9,11,3,7\rC\rO*,8");
}

void LibertyEmulator::execute(const std::string& line) {
  if (line.empty()) return complain('\r', kInvalidCommand, line);
  const char command = static_cast<char>(std::toupper(static_cast<unsigned char>(line[0])));
  // The one command of two letters.
  if (command == '@') {
    if (line.size() == 3 && std::toupper(static_cast<unsigned char>(line[1])) == 'B')
      return set('@', {line.substr(2)}, line);
    return complain('@', kInvalidCommand, line);
  }
  const std::string rest = line.substr(1);
  if (echo_) answer(command, 0, Bytes(line.begin(), line.end()), line);
  constexpr std::string_view kKnown = "ABCFUNOLRHQXY\x02\x05\x12\x15";
  if (kKnown.find(command) == std::string_view::npos) return complain(command, kInvalidCommand, line);
  if (command == 'C') {
    commands_.push_back(line);
    continuous_ = true;
  } else if (rest.empty() || (std::string_view("ABHLNO").find(command) != std::string_view::npos &&
                              rest.find(',') == std::string::npos)) {
    query(command, std::atoi(rest.c_str()));
  } else {
    set(command, split(rest), line);
  }
}

void LibertyEmulator::set(char command, const Arguments& arguments, const std::string& line) {
  const int value = std::atoi(arguments[0].c_str());
  const bool flag = arguments.size() == 1 && (arguments[0] == "0" || arguments[0] == "1");
  if (command == 'O') return set_list(arguments, line);
  if (std::string_view("ABN\x02\x12").find(command) != std::string_view::npos)
    return set_frames(command, arguments, line);
  if (command == 'L') {
    if (!valid_station(arguments[0], kind_.stations)) return complain(command, kInvalidStation, line);
    if (arguments.size() != 2) return complain(command, arguments.size() < 2 ? kTooFew : kTooMany, line);
    for (auto& [station, sensor] : sensors_) {
      if (matches_station(arguments[0], station)) sensor.button_starts = arguments[1] == "1";
    }
  }
  if (command == 0x15) return set_stations(arguments, line);
  if (command == 'H') {
    if (!valid_station(arguments[0], kind_.stations)) return complain(command, kInvalidStation, line);
    if (arguments.size() != 4) return complain(command, arguments.size() < 4 ? kTooFew : kTooMany, line);
    for (auto& [station, sensor] : sensors_) {
      for (std::size_t i = 0; i < 3 && matches_station(arguments[0], station); ++i) {
        sensor.hemisphere[i] = std::atof(arguments[i + 1].c_str());
      }
    }
  } else if (command == 'X' || command == 'Y') {
    if (arguments.size() != 4) return complain(command, arguments.size() < 4 ? kTooFew : kTooMany, line);
    std::array<double, 4>& filter = filters_[command];
    for (std::size_t i = 0; i < 4; ++i) filter[i] = std::atof(arguments[i].c_str());
  } else if (command == 'R') {
    if (kind_.rate_hz != 240) return complain(command, kInvalidParameter, line);
    if (value != 3 && value != 4) return complain(command, kInvalidParameter, line);
    rate_ = value;
  } else if (command == 'Q') {
    if (value < 0 || value > 2) return complain(command, kInvalidParameter, line);
    count_ = 0;
  } else if (command != 'L') {
    if (!flag) return complain(command, kInvalidParameter, line);
    if (command == 'F') binary_ = value == 1;
    if (command == 'U') centimetres_ = value == 1;
    if (command == 0x05) echo_ = value == 1;
    if (command == '@') buffering_ = value == 1;
  }
  commands_.push_back(line);
}

// Numbers are in the units that are set.
void LibertyEmulator::set_frames(char command, const Arguments& arguments, const std::string& line) {
  if (!valid_station(arguments[0], kind_.stations)) return complain(command, kInvalidStation, line);
  const std::size_t wanted = command == 'A' ? 10 : command == 'B' ? 5 : command == 'N' ? 4 : 1;
  if (arguments.size() != wanted) return complain(command, arguments.size() < wanted ? kTooFew : kTooMany, line);
  const auto point = [&](std::size_t at) {
    const double inches = centimetres_ ? 1.0 / 2.54 : 1.0;
    return SensorFrames::Point{inches * std::atof(arguments[at].c_str()), inches * std::atof(arguments[at + 1].c_str()),
                               inches * std::atof(arguments[at + 2].c_str())};
  };
  for (auto& [station, sensor] : sensors_) {
    if (!matches_station(arguments[0], station)) continue;
    if (command == 'A') sensor.frames.align(point(1), point(4), point(7));
    if (command == 'N') sensor.frames.set_tip(point(1));
    if (command == 0x12) sensor.frames.reset_alignment();
    if (command == 0x02) sensor.frames.reset_boresight();
    if (command == 'B') {
      const SourcePose reference{
          0, 0, 0, std::atof(arguments[1].c_str()), std::atof(arguments[2].c_str()), std::atof(arguments[3].c_str())};
      sensor.frames.boresight(raw(station), reference, arguments[4] == "1");
    }
  }
  commands_.push_back(line);
}

void LibertyEmulator::set_list(const Arguments& arguments, const std::string& line) {
  if (!valid_station(arguments[0], kind_.stations)) return complain('O', kInvalidStation, line);
  if (arguments.size() > 21) return complain('O', kTooMany, line);
  std::vector<int> list;
  for (std::size_t i = 1; i < arguments.size(); ++i) {
    const int item = std::atoi(arguments[i].c_str());
    if (arguments[i].empty() || item < 0 || item > 12) return complain('O', kInvalidParameter, line);
    list.push_back(item);
  }
  for (int station = 1; station <= kind_.stations; ++station) {
    if (matches_station(arguments[0], station)) sensors_[station].list = list;
  }
  commands_.push_back(line);
}

void LibertyEmulator::set_stations(const Arguments& arguments, const std::string& line) {
  const int station = std::atoi(arguments[0].c_str());
  if (station > kind_.stations) return complain(0x15, kInvalidStation, line);
  commands_.push_back(line);
  if (arguments.size() == 1) return query(0x15, station);
  if (station != 0) {
    sensors_[station].active = arguments[1] == "1";
    return;
  }
  const unsigned long map = std::strtoul(arguments[1].c_str(), nullptr, 16);
  for (int i = 0; i < kind_.stations; ++i) sensors_[i + 1].active = (map >> i & 1) != 0;
}

void LibertyEmulator::query(char command, int station) {
  Bytes body;
  std::string text;
  const auto number = [&](std::uint32_t v) {
    put_u32(body, v);
    text = std::to_string(v);
  };
  if (command == 'F') number(binary_);
  if (command == 'U') number(centimetres_);
  if (command == 'R') number(static_cast<std::uint32_t>(rate_));
  if (command == 0x05) number(echo_);
  if (command == 0x15) {
    std::uint32_t detected = 0, active = 0;
    for (const auto& [n, sensor] : sensors_) {
      detected |= static_cast<std::uint32_t>(sensor.detected) << (n - 1);
      active |= static_cast<std::uint32_t>(sensor.active) << (n - 1);
    }
    put_u32(body, detected << 16 | active);  // a 32-bit number: detected in its upper half
    text = format("%04.0f", 0);
    char hex[12];
    std::snprintf(hex, sizeof hex, "%04X%04X", detected, active);
    text = hex;
  }
  if (command == 'H') {
    for (const double v : sensors_[station].hemisphere) {
      put_f32(body, v);
      text += format("% 7.3f", v);
    }
  }
  if (command == 'O') {
    const std::vector<int>& list = sensors_[station].list;
    for (std::size_t i = 0; i < 20; ++i) put_u32(body, i < list.size() ? static_cast<std::uint32_t>(list[i]) : ~0u);
    for (const int item : list) text += std::to_string(item) + " ";
  }
  answer(command, station, body, text);
}

void LibertyEmulator::answer(char command, int station, const Bytes& body, const std::string& text) {
  if (binary_) {
    output_.push_back({framed(station, command, 0, body), false});
    return;
  }
  // Two digits of the station, the letter (lower case for control commands), the error, a blank.
  const char letter = command < 0x20 ? static_cast<char>(command + 0x60) : command;
  Bytes line;
  put_text(line, format("%02.0f", station) + letter + "  " + text + "\r\n");
  output_.push_back({std::move(line), false});
}

void LibertyEmulator::complain(char command, int error, const std::string& line) {
  static const char* const kNames[] = {
      "", "Invalid Command", "Invalid Station", "Invalid Parameter", "Too Few Parameters", "Too Many Parameters"};
  Bytes text;
  put_text(text, std::string("*** ") + kNames[error] + " ***" + line + "\r\n");
  if (binary_) text = framed(0, command, error, text);
  output_.push_back({std::move(text), false});
}

Bytes LibertyEmulator::framed(int station, char command, int error, const Bytes& body) const {
  return liberty_frame(station, static_cast<std::uint8_t>(command), static_cast<std::uint8_t>(error), body, kind_.tag);
}

Bytes liberty_frame(int station, std::uint8_t command, std::uint8_t error, const Bytes& body, const std::string& tag) {
  Bytes frame{static_cast<std::uint8_t>(tag[0]),
              static_cast<std::uint8_t>(tag[1]),
              static_cast<std::uint8_t>(station),
              command,
              error,
              0};
  put_u16(frame, static_cast<std::uint32_t>(body.size()));
  frame.insert(frame.end(), body.begin(), body.end());
  return frame;
}

}  // namespace posed::test
