// A tracker in software: bytes written to it are commands, tick() is one measurement cycle, drain() is what waits to be
// read. Emulators are written from the manuals and not from posed's decoders, so that the two can disagree.
// Pure; one thread (lock around it otherwise).
#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <span>
#include <string_view>
#include <vector>

namespace posed::test {

// Source frame (X forward, Y right, Z down); inches and degrees, which is what these devices themselves think in.
struct SourcePose {
  double x = 10.0, y = -2.5, z = 3.25;
  double azimuth = 45.0, elevation = -30.0, roll = 15.0;
};

using Motion = std::function<SourcePose(int station, std::uint32_t count)>;

class TrackerEmulator {
 public:
  struct Output {
    std::vector<std::uint8_t> bytes;  // one answer, or one cycle's records
    bool cycle = false;
  };

  virtual ~TrackerEmulator() = default;
  virtual int rate_hz() const = 0;
  virtual void write(std::span<const std::uint8_t> bytes) = 0;
  void write(std::string_view text) {
    write(std::span(reinterpret_cast<const std::uint8_t*>(text.data()), text.size()));
  }
  virtual void tick() = 0;  // one measurement cycle: the count goes on, and records come out where the device streams
  virtual std::deque<Output> drain() = 0;
  virtual bool streaming() const = 0;
  virtual void power_cycle() = 0;  // back to the factory's settings, and it says what it says at its start
  // What a program that crashed leaves behind: it streams, in other units and with another list.
  virtual void left_streaming() = 0;

  // The hand on the plugs, and on what the device measures.
  virtual void plug_sensor(int station) = 0;
  virtual void unplug_sensor(int station) = 0;
  virtual void set_pose(int station, SourcePose pose) = 0;
  virtual void set_motion(Motion motion) = 0;
  virtual void set_error_letter(int station, char letter) = 0;
  virtual void stop_streaming() = 0;                  // as a stylus button may do
  void set_frozen(bool frozen) { frozen_ = frozen; }  // measures nothing, as with the source unplugged
  void set_deaf(bool deaf) { deaf_ = deaf; }          // takes commands and does nothing

 protected:
  bool frozen_ = false, deaf_ = false;
};

// Of azimuth, elevation and roll, by half angles (LIBERTY manual, appendix A): scalar first.
void rotation_of(const SourcePose& pose, double q[4]);
// Rows of the matrix: the sensor's axes, in columns, in the source frame.
void matrix_of(const SourcePose& pose, double m[9]);
// Beyond the boundary of the hemisphere the position comes out mirrored: the field looks the same from both sides.
SourcePose mirrored(SourcePose pose, const double zenith[3]);

}  // namespace posed::test
