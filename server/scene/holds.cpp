#include "server/scene/holds.h"

namespace posed {

Status Holds::check(const std::string& goal, Owner owner, Nanoseconds now) const {
  const auto hold = holds_.find(goal);
  if (hold == holds_.end() || hold->second.owner == owner || now >= hold->second.until) return Ok{};
  return Error{"held", what_ + " " + goal + " is held by " + hold->second.name, path_,
               "wait: it is free once let go, or after 5 s of nothing; or say \"force\":true"};
}

void Holds::take(const std::string& goal, Owner owner, const std::string& name, Nanoseconds now) {
  holds_.insert_or_assign(goal, Hold{owner, name, now + kIdle});
}

void Holds::renew(const std::string& goal, Owner owner, Nanoseconds now, Nanoseconds busy_for) {
  const auto hold = holds_.find(goal);
  if (hold != holds_.end() && hold->second.owner == owner && now < hold->second.until)
    hold->second.until = now + busy_for + kIdle;
}

void Holds::release_all(Owner owner) {
  std::erase_if(holds_, [owner](const auto& entry) { return entry.second.owner == owner; });
}

std::string Holds::holder(const std::string& goal, Nanoseconds now) const {
  const auto hold = holds_.find(goal);
  return hold == holds_.end() || now >= hold->second.until ? "" : hold->second.name;
}

}  // namespace posed
