#include "server/store/store.h"

#include <condition_variable>
#include <deque>
#include <mutex>
#include <stdexcept>
#include <thread>

#include "server/store/database.h"
#include "server/store/directory_lock.h"

namespace posed {

struct Store::Impl {
  explicit Impl(const std::filesystem::path& directory)
      : directory_lock(directory), database(directory / "posed.db"), live(database.live()), thread([this] { run(); }) {}
  ~Impl() {
    post({});  // an empty task ends the thread, after those before it
    thread.join();
  }

  void post(std::function<void()> task) {
    {
      const std::lock_guard lock(mutex);
      tasks.push_back(std::move(task));
    }
    wake.notify_one();
  }

  void run() {
    for (;;) {
      std::unique_lock lock(mutex);
      wake.wait(lock, [this] { return !tasks.empty(); });
      const std::function<void()> task = std::move(tasks.front());
      tasks.pop_front();
      lock.unlock();
      if (!task) return;
      task();
    }
  }

  DirectoryLock directory_lock;
  Database database;
  const StoredScene live;
  std::mutex mutex;  // the mailbox's; held for a move only
  std::condition_variable wake;
  std::deque<std::function<void()>> tasks;
  std::thread thread;
};

Store::Store(const std::filesystem::path& directory) {
  std::error_code error;
  std::filesystem::create_directories(directory, error);
  if (error) {
    throw std::runtime_error("cannot make the data directory " + directory.string() + ": " + error.message() +
                             "; choose another with --data");
  }
  impl_ = std::make_unique<Impl>(directory);
}

Store::~Store() = default;

const StoredScene& Store::live() const {
  return impl_->live;
}

void Store::commit(StoredChanges changes, std::function<void(Status)> done) {
  impl_->post([this, changes = std::move(changes), done = std::move(done)] { done(impl_->database.commit(changes)); });
}

void Store::save(std::string name, std::string document, std::function<void(Status)> done) {
  impl_->post([this, name = std::move(name), document = std::move(document), done = std::move(done)] {
    done(impl_->database.save(name, document));
  });
}

void Store::load(std::string name, std::function<void(Result<std::string>)> done) {
  impl_->post([this, name = std::move(name), done = std::move(done)] { done(impl_->database.load(name)); });
}

void Store::remove(std::string name, std::function<void(Status)> done) {
  impl_->post([this, name = std::move(name), done = std::move(done)] { done(impl_->database.remove(name)); });
}

void Store::list(std::function<void(Result<std::vector<std::string>>)> done) {
  impl_->post([this, done = std::move(done)] { done(impl_->database.list()); });
}

}  // namespace posed
