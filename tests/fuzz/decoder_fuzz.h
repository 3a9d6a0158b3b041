// What must hold of every tracker's decoder, whatever bytes a hostile device sends: frames are well formed, bytes are
// all accounted for, and where the bytes were cut makes no difference.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <span>

#include "server/tracker/decoder.h"

namespace posed::tracker::fuzz {

inline void require(bool holds) {
  if (!holds) std::abort();
}

inline std::size_t samples_in(const Heard& out, int stations) {
  std::size_t samples = 0;
  for (const Frame& frame : out.frames) {
    require(!frame.samples.empty());
    int last = 0;
    for (const Sample& sample : frame.samples) {
      require(sample.station > last && sample.station <= stations);
      last = sample.station;
      require(finite(sample.position) && finite(sample.rotation));
      require(std::abs(glm::length(sample.rotation) - 1.0) < 1e-9);
      require(((sample.flags & kFlagError) != 0) == (sample.error_letter != 0));
      ++samples;
    }
  }
  return samples;
}

// `one` and `other` are alike and fresh. `cut`: any number; `loses`: the line loses bytes there.
inline void check_decoder(Decoder& one, Decoder& other, int stations, std::span<const std::uint8_t> bytes,
                          std::size_t cut, bool loses) {
  cut = bytes.empty() ? 0 : cut % (bytes.size() + 1);
  const Heard first = one.feed(bytes.first(cut), 1);
  if (loses) one.lost_bytes();
  const Heard second = one.feed(bytes.subspan(cut), 2);
  const std::size_t samples = samples_in(first, stations) + samples_in(second, stations);
  require(one.bad_bytes() <= bytes.size());
  if (loses) return;
  const Heard all = other.feed(bytes, 1);
  require(samples_in(all, stations) == samples);
  require(all.frames.size() == first.frames.size() + second.frames.size());
  require(all.replies.size() == first.replies.size() + second.replies.size());
  require(other.bad_bytes() == one.bad_bytes());
}

}  // namespace posed::tracker::fuzz
