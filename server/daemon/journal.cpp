#include "server/daemon/journal.h"

#include <set>
#include <utility>

#include "common/log.h"
#include "proto/codec.h"

namespace posed {
namespace {

template <class Entities, class Text>
bool put_entity(const Entities& entities, const std::string& path, const std::string& id, StoredChanges& changes,
                Text text) {
  const auto found = entities.find(id);
  if (found == entities.end())
    changes.removed.push_back(path);
  else
    changes.set.push_back({path, found->second.revision, text(found->second)});
  return true;
}

}  // namespace

Journal::Journal(Loop& loop, Store& store, Scene& scene, const Calibrations& calibrations, Editing& editing,
                 OnceMemory& once, std::function<void()> failed)
    : loop_(loop),
      store_(store),
      scene_(scene),
      calibrations_(calibrations),
      editing_(editing),
      once_(once),
      failed_(std::move(failed)) {}

void Journal::add(Done done, std::string once) {
  edits_.push_back({std::move(done), std::move(once)});
  ready_ = false;
}

void Journal::when_stored(Told told) {
  if (edits_.empty() && told_.empty()) return told(Ok{});
  told_.emplace_back(first_ + edits_.size() - 1, std::move(told));
}

void Journal::write() {
  ready_ = true;
  if (!at_work_) begin();
}

void Journal::begin() {
  if (edits_.empty() && !all_) return;
  at_work_ = true;
  writing_ = edits_.size();
  store_.commit(gather(), [this](const Status& status) { loop_.post([this, status] { stored(status); }); });
}

// "/goals/g1", as it is now.
void Journal::put(const std::string& path, StoredChanges& changes) const {
  const std::size_t slash = path.find('/', 1);
  const std::string kind = path.substr(1, slash - 1), id = path.substr(slash + 1);
  if (kind == "figures") {
    put_entity(scene_.figures(), path, id, changes, [](const auto& f) { return proto::encode_entity(f.entry); });
    if (!scene_.figures().contains(id)) changes.removed.push_back(path + "/q");
  } else if (kind == "objects") {
    put_entity(scene_.objects(), path, id, changes, [](const auto& o) { return proto::encode_entity(o.object); });
  } else if (kind == "goals") {
    put_entity(scene_.goals(), path, id, changes, [](const auto& g) { return proto::encode_entity(g.goal); });
  } else if (kind == "calibrations") {
    if (const auto document = calibrations_.document(path))
      changes.set.push_back({path, 0, *document});
    else
      changes.removed.push_back(path);
  } else if (kind == "cameras") {
    put_entity(scene_.cameras(), path, id, changes, [](const auto& c) { return proto::encode_entity(c.camera); });
  } else {
    put_entity(scene_.bindings(), path, id, changes, [](const auto& b) { return proto::encode_entity(b.binding); });
  }
}

StoredChanges Journal::gather() {
  StoredChanges changes;
  changes.revision = scene_.revision();
  std::set<std::string> paths;
  for (const Waiting& edit : edits_) {
    for (const std::string& path : edit.done.entities) {
      // An edit of the pose alone still counts the figure up.
      paths.insert(path.ends_with("/q") && path.starts_with("/figures/") ? path.substr(0, path.size() - 2) : path);
    }
    if (const OnceMemory::Remembered* once = edit.once.empty() ? nullptr : once_.find(edit.once))
      changes.once.push_back({once->uuid, once->method, once->result});
  }
  if (std::exchange(all_, false)) {
    changes.anew = true;
    stored_q_.clear();
    for (const auto& [id, figure] : scene_.figures()) paths.insert("/figures/" + id);
    for (const auto& [id, object] : scene_.objects()) paths.insert("/objects/" + id);
    for (const auto& [id, goal] : scene_.goals()) paths.insert("/goals/" + id);
    for (const auto& [id, binding] : scene_.bindings()) paths.insert("/bindings/" + id);
    for (const auto& [id, camera] : scene_.cameras()) paths.insert("/cameras/" + id);
    for (std::string& path : calibrations_.paths()) paths.insert(std::move(path));
  }
  for (const std::string& path : paths) put(path, changes);
  std::erase_if(stored_q_, [this](const auto& entry) { return !scene_.figures().contains(entry.first); });
  for (const auto& [id, figure] : scene_.figures()) {
    std::vector<double>& q = stored_q_[id];
    if (q == figure.q) continue;
    q = figure.q;
    changes.set.push_back({"/figures/" + id + "/q", 0, proto::encode_q(q)});
  }
  return changes;
}

void Journal::stored(const Status& status) {
  at_work_ = false;
  std::deque<std::pair<std::uint64_t, Told>> told;
  if (status) {
    first_ += writing_;
    edits_.erase(edits_.begin(), edits_.begin() + static_cast<std::ptrdiff_t>(writing_));
    while (!told_.empty() && told_.front().first < first_) {
      told.push_back(std::move(told_.front()));
      told_.pop_front();
    }
  } else {
    // What came after stands on what is lost, and goes with it.
    log_warning(status.error().message + ": " + std::to_string(edits_.size()) + " edits are undone");
    std::vector<Done> lost;
    for (Waiting& edit : edits_) {
      if (!edit.once.empty()) once_.forget(edit.once);
      if (!edit.done.change.empty()) lost.push_back(std::move(edit.done));
    }
    first_ += edits_.size();
    edits_.clear();
    told.swap(told_);
    editing_.discard(std::move(lost));
    all_ = true;  // whatever the disk has now: the next transaction says it all
    failed_();
  }
  writing_ = 0;
  for (auto& [number, tell] : told) tell(status);
  if (ready_ && !at_work_ && !edits_.empty()) begin();
}

}  // namespace posed
