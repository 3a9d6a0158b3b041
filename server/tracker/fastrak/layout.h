// The body of a FASTRAK data record: items in the order of the output list (command O), in binary or in columns of
// ASCII. Source: FASTRAK manual OPM00PI002 Rev G, command O and its table of items; in binary the floats are IEEE
// single, little-endian. Pure; throws nothing.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "common/frame.h"
#include "common/result.h"
#include "server/tracker/axes.h"

namespace posed::tracker {

class FastrakLayout {
 public:
  // Error out_of_range: an unknown item, none for the position (2, 52) or none for the rotation (4, 54, 11, 61).
  static Result<FastrakLayout> make(std::span<const int> items, bool binary);

  std::size_t body_size() const { return body_size_; }

  // Fills position (m), rotation (both in world axes) and buttons. `body` holds body_size() bytes. False where no
  // device could have sent them.
  bool decode(std::span<const std::uint8_t> body, double metres_per_unit, Sample& sample) const;

 private:
  struct Item {
    int id;  // without the 50 that asks for extended precision
    std::size_t size;
    std::size_t column;  // of one number in ASCII
  };
  bool numbers(std::span<const std::uint8_t> body, const Item& item, std::span<double> into) const;

  bool binary_ = true;
  std::vector<Item> items_;
  std::size_t body_size_ = 0;
};

}  // namespace posed::tracker
