// Who holds which goal, or tracker: while somebody drags one, others' edits of it wait. Time comes in; nothing here
// sees a clock.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <utility>

#include "common/result.h"
#include "common/time.h"

namespace posed {

class Holds {
 public:
  static constexpr Nanoseconds kIdle = 5'000'000'000;  // without an edit a hold ends

  using Owner = std::uint64_t;  // a connection

  explicit Holds(std::string what = "goal", std::string path = "/id")
      : what_(std::move(what)), path_(std::move(path)) {}

  // "held", and by whom, where it is another's.
  Status check(const std::string& goal, Owner owner, Nanoseconds now) const;
  // Takes it, or keeps it for longer.
  void take(const std::string& goal, Owner owner, const std::string& name, Nanoseconds now);
  // An edit by who holds it is no idling.
  void renew(const std::string& goal, Owner owner, Nanoseconds now, Nanoseconds busy_for = 0);
  void release(const std::string& goal) { holds_.erase(goal); }
  void release_all(Owner owner);
  std::string holder(const std::string& goal, Nanoseconds now) const;  // empty: nobody

 private:
  struct Hold {
    Owner owner;
    std::string name;
    Nanoseconds until;
  };
  std::string what_, path_;
  std::map<std::string, Hold> holds_;
};

}  // namespace posed
