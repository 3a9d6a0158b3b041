#include "tests/support/power_cut.h"

#include <sqlite3.h>

#include <algorithm>
#include <atomic>
#include <cstring>
#include <fstream>
#include <iterator>
#include <map>
#include <mutex>
#include <random>
#include <string>
#include <vector>

namespace posed::test {

struct PowerCut::Disk {
  struct Write {
    std::int64_t at;  // a truncation has no bytes
    std::string bytes;
    bool truncates;
  };
  struct File {
    std::string synced;          // what surely is on the disk
    std::vector<Write> pending;  // what may be
  };

  sqlite3_vfs* below = nullptr;
  sqlite3_vfs vfs{};
  std::mt19937 random;
  mutable std::mutex mutex;
  std::map<std::string, File> files;
  std::uint64_t done = 0, last = ~std::uint64_t{0};
  bool dead = false;
  bool bounded = false;
  std::uint64_t space = 0;

  // False: the power is gone.
  bool operate() {
    if (!dead && ++done > last) dead = true;
    return !dead;
  }

  static void put(std::string& content, const Write& write) {
    const auto at = static_cast<std::size_t>(write.at);
    if (write.truncates) return content.resize(at);
    content.resize(std::max(content.size(), at + write.bytes.size()));
    content.replace(at, write.bytes.size(), write.bytes);
  }
};

namespace {

PowerCut::Disk* disk = nullptr;

struct OpenFile {
  sqlite3_file base;
  std::string* path;  // null: one that SQLite throws away itself
  sqlite3_file* below() { return reinterpret_cast<sqlite3_file*>(this + 1); }
};

OpenFile* of(sqlite3_file* file) {
  return reinterpret_cast<OpenFile*>(file);
}
const sqlite3_io_methods* methods(sqlite3_file* file) {
  return of(file)->below()->pMethods;
}

int close_file(sqlite3_file* file) {
  const int result = methods(file) ? methods(file)->xClose(of(file)->below()) : SQLITE_OK;
  delete of(file)->path;
  return result;
}

int read_file(sqlite3_file* file, void* to, int size, sqlite3_int64 at) {
  {
    const std::lock_guard lock(disk->mutex);
    if (disk->dead) return SQLITE_IOERR_READ;
  }
  return methods(file)->xRead(of(file)->below(), to, size, at);
}

int write_file(sqlite3_file* file, const void* from, int size, sqlite3_int64 at) {
  {
    const std::lock_guard lock(disk->mutex);
    if (!disk->operate()) return SQLITE_IOERR_WRITE;
    if (disk->bounded) {
      if (disk->space < static_cast<std::uint64_t>(size)) return SQLITE_FULL;
      disk->space -= static_cast<std::uint64_t>(size);
    }
    if (of(file)->path)
      disk->files[*of(file)->path].pending.push_back(
          {at, std::string(static_cast<const char*>(from), static_cast<std::size_t>(size)), false});
  }
  return methods(file)->xWrite(of(file)->below(), from, size, at);
}

int truncate_file(sqlite3_file* file, sqlite3_int64 size) {
  {
    const std::lock_guard lock(disk->mutex);
    if (!disk->operate()) return SQLITE_IOERR_TRUNCATE;
    if (of(file)->path) disk->files[*of(file)->path].pending.push_back({size, "", true});
  }
  return methods(file)->xTruncate(of(file)->below(), size);
}

int sync_file(sqlite3_file* file, int flags) {
  const std::lock_guard lock(disk->mutex);
  if (!disk->operate()) return SQLITE_IOERR_FSYNC;
  if (of(file)->path) {
    PowerCut::Disk::File& state = disk->files[*of(file)->path];
    for (const auto& write : state.pending) PowerCut::Disk::put(state.synced, write);
    state.pending.clear();
  }
  (void)flags;  // the test's own disk need not spin
  return SQLITE_OK;
}

int file_size(sqlite3_file* file, sqlite3_int64* size) {
  return methods(file)->xFileSize(of(file)->below(), size);
}
int lock_file(sqlite3_file* file, int level) {
  return methods(file)->xLock(of(file)->below(), level);
}
int unlock_file(sqlite3_file* file, int level) {
  return methods(file)->xUnlock(of(file)->below(), level);
}
int check_lock(sqlite3_file* file, int* out) {
  return methods(file)->xCheckReservedLock(of(file)->below(), out);
}
int control(sqlite3_file* file, int op, void* argument) {
  return methods(file)->xFileControl(of(file)->below(), op, argument);
}
int sector(sqlite3_file*) {
  return 512;
}
int traits(sqlite3_file*) {
  return 0;  // it promises nothing
}
int shm_map(sqlite3_file* file, int page, int size, int extend, void volatile** out) {
  return methods(file)->xShmMap(of(file)->below(), page, size, extend, out);
}
int shm_lock(sqlite3_file* file, int offset, int n, int flags) {
  return methods(file)->xShmLock(of(file)->below(), offset, n, flags);
}
void shm_barrier(sqlite3_file* file) {
  methods(file)->xShmBarrier(of(file)->below());
}
int shm_unmap(sqlite3_file* file, int remove) {
  return methods(file)->xShmUnmap(of(file)->below(), remove);
}

const sqlite3_io_methods kMethods = {2,           close_file, read_file, write_file,  truncate_file,
                                     sync_file,   file_size,  lock_file, unlock_file, check_lock,
                                     control,     sector,     traits,    shm_map,     shm_lock,
                                     shm_barrier, shm_unmap,  nullptr,   nullptr};

int open_file(sqlite3_vfs*, const char* name, sqlite3_file* file, int flags, int* out_flags) {
  OpenFile* open = of(file);
  open->base.pMethods = nullptr;
  open->path = nullptr;
  const int result = disk->below->xOpen(disk->below, name, open->below(), flags, out_flags);
  if (result != SQLITE_OK) return result;
  open->base.pMethods = &kMethods;
  if (name && (flags & SQLITE_OPEN_DELETEONCLOSE) == 0) {
    const std::lock_guard lock(disk->mutex);
    open->path = new std::string(name);
    if (!disk->files.contains(name)) {
      std::ifstream in(name, std::ios::binary);
      disk->files[name].synced = std::string(std::istreambuf_iterator<char>(in), {});
    }
  }
  return SQLITE_OK;
}

int delete_file(sqlite3_vfs*, const char* name, int sync) {
  {
    const std::lock_guard lock(disk->mutex);
    if (!disk->operate()) return SQLITE_IOERR_DELETE;
    disk->files.erase(name);
  }
  return disk->below->xDelete(disk->below, name, sync);
}

}  // namespace

PowerCut::PowerCut(unsigned seed) : disk_(std::make_unique<Disk>()) {
  disk_->random.seed(seed);
  disk_->below = sqlite3_vfs_find(nullptr);
  disk_->vfs = *disk_->below;
  disk_->vfs.pNext = nullptr;
  disk_->vfs.zName = "power_cut";
  disk_->vfs.szOsFile = static_cast<int>(sizeof(OpenFile)) + disk_->below->szOsFile;
  disk_->vfs.xOpen = open_file;
  disk_->vfs.xDelete = delete_file;
  disk = disk_.get();
  sqlite3_vfs_register(&disk_->vfs, 1);
}

PowerCut::~PowerCut() {
  sqlite3_vfs_unregister(&disk_->vfs);
  sqlite3_vfs_register(disk_->below, 1);
  disk = nullptr;
}

void PowerCut::cut_after(std::uint64_t operations) {
  const std::lock_guard lock(disk_->mutex);
  disk_->last = disk_->done + operations;
}

bool PowerCut::cut() const {
  const std::lock_guard lock(disk_->mutex);
  return disk_->dead;
}

std::uint64_t PowerCut::operations() const {
  const std::lock_guard lock(disk_->mutex);
  return disk_->done;
}

void PowerCut::full_after(std::uint64_t bytes) {
  const std::lock_guard lock(disk_->mutex);
  disk_->bounded = bytes > 0;
  disk_->space = bytes;
}

void PowerCut::restart() {
  const std::lock_guard lock(disk_->mutex);
  for (auto& [path, file] : disk_->files) {
    std::string content = std::move(file.synced);
    for (Disk::Write& write : file.pending) {
      const unsigned fate = disk_->random() % 4;  // gone, half of it, there
      if (fate == 0) continue;
      if (fate == 1) write.bytes.resize(write.bytes.size() / 2 / 512 * 512);
      Disk::put(content, write);
    }
    std::ofstream(path, std::ios::binary | std::ios::trunc) << content;
  }
  disk_->files.clear();
  disk_->dead = false;
  disk_->last = ~std::uint64_t{0};
}

}  // namespace posed::test
