#include "server/daemon/once.h"

#include <algorithm>

namespace posed {

void OnceMemory::add(Remembered edit) {
  bytes_ += edit.result.size();
  order_.push_back(edit.uuid);
  by_uuid_.insert_or_assign(order_.back(), std::move(edit));
  while (order_.size() > kMostEdits || bytes_ > kMostBytes) forget(std::string(order_.front()));
}

void OnceMemory::forget(const std::string& uuid) {
  const auto found = by_uuid_.find(uuid);
  if (found == by_uuid_.end()) return;
  bytes_ -= found->second.result.size();
  by_uuid_.erase(found);
  order_.erase(std::find(order_.begin(), order_.end(), uuid));
}

}  // namespace posed
