// The viewer's files, found by the path of a request. Keeps what it read, and reads again what has changed on disk.
// Beside a file NAME may stand NAME.gz, the same bytes packed by whoever built the viewer.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>

#include "server/net/subscription.h"

namespace posed::net {

class HttpFiles {
 public:
  struct File {
    std::string content_type;
    std::string etag;  // without its quotes, of the plain bytes
    std::string cache_control;
    SharedLine body;
    SharedLine gzip;  // the same, packed; null where there is none, or only one of an older file
  };

  // `root` may be empty or not exist (yet).
  explicit HttpFiles(std::filesystem::path root) : root_(std::move(root)) {}

  bool present() const;  // there is an index.html
  // `target` as it stands in the request, with its query. Nothing for what is not there, not a plain file, hidden, or
  // outside the root.
  std::optional<File> find(std::string_view target);

 private:
  struct OnDisk {
    std::filesystem::path path;  // with no link left in it
    std::filesystem::file_time_type changed;
    std::uintmax_t size;
    friend bool operator==(const OnDisk&, const OnDisk&) = default;
  };
  struct Kept {
    OnDisk plain;
    std::optional<OnDisk> gzip;
    File file;
  };

  std::optional<OnDisk> look(const std::string& path) const;

  std::filesystem::path root_;
  std::map<std::string, Kept> kept_;  // by path
  std::size_t kept_bytes_ = 0;
};

// The path of a target without query, percent signs decoded; nothing if a part of it is empty, hidden or "..", or if it
// holds what no file name of ours does.
std::optional<std::string> plain_path(std::string_view target);

std::string_view content_type_of(std::string_view file_name);

}  // namespace posed::net
