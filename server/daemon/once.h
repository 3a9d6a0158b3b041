// The results of edits that may be sent again ("once"): a retry gets the same one and does nothing. Bounded: the oldest
// are forgotten.
#pragma once

#include <deque>
#include <map>
#include <string>

namespace posed {

class OnceMemory {
 public:
  static constexpr std::size_t kMostEdits = 1000;
  static constexpr std::size_t kMostBytes = 4 << 20;

  struct Remembered {
    std::string uuid;
    std::string method;
    std::string result;  // JSON text
  };

  // Null: it is not known.
  const Remembered* find(const std::string& uuid) const {
    const auto found = by_uuid_.find(uuid);
    return found == by_uuid_.end() ? nullptr : &found->second;
  }
  void add(Remembered edit);
  void forget(const std::string& uuid);

 private:
  std::map<std::string, Remembered> by_uuid_;
  std::deque<std::string> order_;
  std::size_t bytes_ = 0;
};

}  // namespace posed
