// A disk under SQLite that loses its power: of what was not synced yet some writes are gone, some are there, one may be
// there in half. Registered as SQLite's default way to files while it lives; one at a time.
#pragma once

#include <cstdint>
#include <memory>

namespace posed::test {

class PowerCut {
 public:
  explicit PowerCut(unsigned seed);
  ~PowerCut();

  // The power goes at this operation of the disk (a write, truncation or sync) from now on. Everything fails after.
  void cut_after(std::uint64_t operations);
  bool cut() const;
  std::uint64_t operations() const;  // so far
  // From now on writes beyond this many bytes fail for want of space; 0: none do.
  void full_after(std::uint64_t bytes);
  // Leaves on the disk what a real one may have after the cut; then the power is back.
  void restart();

  struct Disk;

 private:
  std::unique_ptr<Disk> disk_;
};

}  // namespace posed::test
