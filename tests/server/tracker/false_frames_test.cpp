// How often a decoder takes what no device has sent for a sample: random bodies behind a header that is right, records
// that are cut and put together wrongly, and random bytes alone. The table in deploy/doc/trackers.md is what this
// prints; where it is not, the test says so and prints the new one.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <functional>
#include <iterator>
#include <memory>
#include <random>
#include <string>
#include <vector>

#include "server/tracker/fastrak/decoder.h"
#include "server/tracker/isotrak/decoder.h"
#include "server/tracker/liberty/decoder.h"
#include "server/tracker/spacemouse/decoder.h"
#include "server/tracker/viper/decoder.h"
#include "tests/support/emulator_pack.h"
#include "tests/support/fastrak_emulator.h"
#include "tests/support/liberty_emulator.h"
#include "tests/support/viper_emulator.h"

namespace posed::tracker {
namespace {

using test::Bytes;

constexpr int kBodies = 300'000, kSplices = 100'000, kRecords = 32;
constexpr int kNoiseMegabytes = 8;

struct Format {
  std::string name;
  std::function<std::unique_ptr<Decoder>()> make;
  std::vector<Bytes> records;  // that are right, all of them different
  std::size_t body;            // where it begins, behind the header
  bool packed = false;         // bodies have seven bits a byte
  bool whole = false;          // the line says where records end
};

// Clear text of what is in a frame, without times.
std::string text_of(const Frame& frame) {
  std::string text;
  char one[200];
  for (const Sample& s : frame.samples) {
    std::snprintf(one, sizeof one, "%d %a %a %a %a %a %a %a;", s.station, s.position.x, s.position.y, s.position.z,
                  s.rotation.w, s.rotation.x, s.rotation.y, s.rotation.z);
    text += one;
  }
  return text;
}

class Measurement {
 public:
  explicit Measurement(const Format& format) : format_(format) {
    for (const Bytes& record : format_.records) {
      const auto frames = fed({record, record});
      EXPECT_FALSE(frames.empty()) << format_.name << ": a record itself is right";
      // A rotation may come out with either sign, as the one before it was.
      for (const Frame& frame : frames) {
        true_.push_back(text_of(frame));
        Frame other = frame;
        for (Sample& sample : other.samples) sample.rotation = -sample.rotation;
        true_.push_back(text_of(other));
      }
    }
    std::sort(true_.begin(), true_.end());
  }

  // Frames a body. A right record follows, so that the decoder does not wait for it.
  double of_bodies() {
    std::uint64_t taken = 0;
    for (int i = 0; i < kBodies; ++i) {
      Bytes bytes = any();
      for (std::size_t k = format_.body; k < bytes.size(); ++k)
        bytes[k] = static_cast<std::uint8_t>(format_.packed ? random_() & 0x7f : random_());
      taken += false_ones(format_.whole ? std::vector<Bytes>{bytes} : std::vector<Bytes>{bytes, any()});
    }
    return static_cast<double>(taken) / kBodies;
  }

  // Frames a splice: the beginning of one record and the end of another, half of them where each goes on as the other
  // did.
  double of_splices() {
    std::uint64_t taken = 0;
    for (int i = 0; i < kSplices; ++i) {
      const Bytes one = any(), other = any();
      const std::size_t cut = 1 + random_() % (one.size() - 1);
      const std::size_t from = i % 2 == 0 ? cut : 1 + random_() % (other.size() - 1);
      Bytes spliced(one.begin(), one.begin() + static_cast<std::ptrdiff_t>(cut));
      spliced.insert(spliced.end(), other.begin() + static_cast<std::ptrdiff_t>(from), other.end());
      taken +=
          false_ones(format_.whole ? std::vector<Bytes>{spliced} : std::vector<Bytes>{any(), spliced, any(), any()});
    }
    return static_cast<double>(taken) / kSplices;
  }

  // Frames a megabyte.
  double of_noise() {
    auto decoder = begun();
    std::uint64_t taken = 0;
    const std::size_t chunk = format_.whole ? format_.records[0].size() : 1 << 16;
    Bytes noise(chunk);
    for (std::size_t done = 0; done < std::size_t{kNoiseMegabytes} << 20; done += chunk) {
      for (std::uint8_t& byte : noise) byte = static_cast<std::uint8_t>(random_());
      taken += decoder->feed(noise, 0).frames.size();
    }
    return static_cast<double>(taken) / kNoiseMegabytes;
  }

 private:
  std::unique_ptr<Decoder> begun() const {
    auto decoder = format_.make();
    decoder->expect_up_to(1);
    return decoder;
  }
  const Bytes& any() { return format_.records[random_() % format_.records.size()]; }
  std::vector<Frame> fed(const std::vector<Bytes>& parts) const {
    const auto decoder = begun();
    std::vector<Frame> frames;
    for (const Bytes& part : parts) {
      for (Frame& frame : decoder->feed(part, 0).frames) frames.push_back(std::move(frame));
    }
    return frames;
  }
  std::uint64_t false_ones(const std::vector<Bytes>& parts) const {
    const auto frames = fed(parts);
    return static_cast<std::uint64_t>(std::count_if(frames.begin(), frames.end(), [this](const Frame& frame) {
      return !std::binary_search(true_.begin(), true_.end(), text_of(frame));
    }));
  }

  const Format& format_;
  std::vector<std::string> true_;
  std::mt19937_64 random_{2026};
};

test::SourcePose somewhere(std::uint32_t i) {
  return {12.0 + std::sin(0.7 * i), -3.0 + std::cos(0.9 * i), 4.0 + std::sin(1.1 * i),
          20.0 * std::sin(0.3 * i), 30.0 * std::cos(0.5 * i), 40.0 * std::sin(0.2 * i)};
}

template <class Emulator>
std::vector<Bytes> records_of(Emulator device, const char* commands) {
  device.set_motion([](int, std::uint32_t count) { return somewhere(count); });
  device.write(std::string_view(commands));
  device.drain();
  std::vector<Bytes> records;
  while (records.size() < kRecords) {
    device.tick();
    for (const auto& output : device.drain()) {
      if (output.cycle) records.push_back(output.bytes);
    }
  }
  return records;
}

std::vector<Format> formats() {
  std::vector<Format> all;
  all.push_back({"LIBERTY, PATRIOT, list 8,9,10,11,3,7",
                 [] {
                   LibertyFormat format;
                   format.items = {8, 9, 10, 11, 3, 7};
                   return std::make_unique<LibertyDecoder>(std::move(*LibertyDecoder::make(format)));
                 },
                 records_of(test::LibertyEmulator(1), "F1\rU1\rO*,8,9,10,11,3,7\rC\r"), 8});
  all.push_back({"LIBERTY, PATRIOT at a serial port, list 9,10,3,7",
                 [] {
                   LibertyFormat format;
                   format.items = {9, 10, 3, 7};
                   return std::make_unique<LibertyDecoder>(std::move(*LibertyDecoder::make(format)));
                 },
                 records_of(test::LibertyEmulator(1), "F1\rU1\rO*,9,10,3,7\rC\r"), 8});
  all.push_back({"FASTRAK, list 2,11,16,0",
                 [] { return std::make_unique<FastrakDecoder>(std::move(*FastrakDecoder::make({}))); },
                 records_of(test::FastrakEmulator(1), "ufO1,2,11,16,0\rC"), 3});
  all.push_back({"ISOTRAK II, list 2,11", [] { return std::make_unique<IsotrakDecoder>(IsotrakFormat{}); },
                 records_of(test::FastrakEmulator(1, test::FastrakEmulator::Kind::isotrak), "ufO2,11\rC"), 3, true});
  test::ViperEmulator viper(1);
  viper.set_units(3, 2);
  viper.start();
  all.push_back({"VIPER (a CRC of 16 bits in a word of 32)",
                 [] { return std::make_unique<ViperDecoder>(ViperFormat{}); }, records_of(viper, ""), 24});
  std::vector<Bytes> reports;
  for (int i = 0; i < kRecords; ++i) {
    Bytes report{1};
    for (int k = 0; k < 6; ++k) test::put_u16(report, static_cast<std::uint32_t>(10 * i + k + 1));
    reports.push_back(report);
  }
  all.push_back({"SpaceMouse (reports that the kernel has cut)",
                 [] { return std::make_unique<SpacemouseDecoder>(SpacemouseFormat{}); }, reports, 1, false, true});
  return all;
}

std::string row_of(const Format& format) {
  Measurement measurement(format);
  const double bodies = measurement.of_bodies(), splices = measurement.of_splices(), noise = measurement.of_noise();
  char row[200];
  std::snprintf(row, sizeof row, "| %s | %.2g | %.2g | %.2g |", format.name.c_str(), bodies, splices, noise);
  return row;
}

TEST(FalseFrames, AreAsOftenAsThePageSays) {
  std::ifstream file(POSED_SOURCE_DIR "/deploy/doc/trackers.md");
  const std::string page{std::istreambuf_iterator<char>(file), {}};
  ASSERT_FALSE(page.empty());
  for (const Format& format : formats()) {
    const std::string row = row_of(format);
    std::printf("%s\n", row.c_str());
    EXPECT_NE(page.find(row), std::string::npos) << "deploy/doc/trackers.md says otherwise";
  }
}

}  // namespace
}  // namespace posed::tracker
