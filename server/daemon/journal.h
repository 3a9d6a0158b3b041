// What waits for the disk: the store is given what edits have changed, and whoever waits for them is told when it has
// it. One transaction for all edits that arrive while the disk is at work. Station loop only.
#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "server/daemon/calibrations.h"
#include "server/daemon/loop.h"
#include "server/daemon/once.h"
#include "server/scene/editing.h"
#include "server/store/store.h"

namespace posed {

class Journal {
 public:
  using Told = std::function<void(const Status&)>;

  // `failed` is called when edits that the disk did not take have been undone, before those who wait are told.
  Journal(Loop& loop, Store& store, Scene& scene, const Calibrations& calibrations, Editing& editing, OnceMemory& once,
          std::function<void()> failed);

  // An edit that was done; `once` is its UUID or empty. To be followed by `write`, when its pose is solved.
  void add(Done done, std::string once);
  // The whole scene is new to the store.
  void add_all() { all_ = true; }
  // Told, in the order of the calls, when the disk has all edits that were added before; at once if it has.
  void when_stored(Told told);
  // Gives the store what has changed; where it is at work, afterwards.
  void write();

 private:
  struct Waiting {
    Done done;
    std::string once;
  };

  void begin();
  StoredChanges gather();
  void put(const std::string& path, StoredChanges& changes) const;
  void stored(const Status& status);

  Loop& loop_;
  Store& store_;
  Scene& scene_;
  const Calibrations& calibrations_;
  Editing& editing_;
  OnceMemory& once_;
  const std::function<void()> failed_;
  std::vector<Waiting> edits_;  // that the disk does not have, oldest first
  std::size_t writing_ = 0;     // of them: given to the store
  bool at_work_ = false, ready_ = false, all_ = false;
  std::uint64_t first_ = 1;                              // the number of edits_[0]
  std::deque<std::pair<std::uint64_t, Told>> told_;      // by the last edit that they wait for
  std::map<std::string, std::vector<double>> stored_q_;  // by figure, as the store has it or was last given it
};

}  // namespace posed
