#include "server/net/http_files.h"

#include <fstream>
#include <system_error>

namespace posed::net {
namespace {

namespace fs = std::filesystem;

constexpr std::uintmax_t kMaxFile = 64 << 20;
constexpr std::size_t kMaxKept = 64 << 20;

int hex_digit(char c) {
  if (c >= '0' && c <= '9') return c - '0';
  if (c >= 'a' && c <= 'f') return c - 'a' + 10;
  if (c >= 'A' && c <= 'F') return c - 'A' + 10;
  return -1;
}

SharedLine read(const fs::path& file, std::uintmax_t size) {
  std::string bytes(static_cast<std::size_t>(size), '\0');
  std::ifstream in(file, std::ios::binary);
  if (!in.read(bytes.data(), static_cast<std::streamsize>(size))) return nullptr;
  return std::make_shared<const std::string>(std::move(bytes));
}

}  // namespace

std::optional<std::string> plain_path(std::string_view target) {
  target = target.substr(0, target.find_first_of("?#"));
  if (!target.starts_with('/')) return std::nullopt;
  std::string path;
  for (std::size_t i = 1; i < target.size(); ++i) {
    char c = target[i];
    if (c == '%') {
      if (i + 2 >= target.size()) return std::nullopt;
      const int high = hex_digit(target[i + 1]), low = hex_digit(target[i + 2]);
      if (high < 0 || low < 0) return std::nullopt;
      c = static_cast<char>(high * 16 + low);
      i += 2;
    }
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f || c == '\\') return std::nullopt;
    path.push_back(c);
  }
  if (path.empty() || path.ends_with('/')) path.append("index.html");
  for (std::size_t begin = 0; begin <= path.size();) {
    const std::size_t end = std::min(path.find('/', begin), path.size());
    if (begin == end || path[begin] == '.') return std::nullopt;
    begin = end + 1;
  }
  return path;
}

std::string_view content_type_of(std::string_view file_name) {
  static constexpr std::pair<std::string_view, std::string_view> kTypes[] = {
      {"html", "text/html; charset=utf-8"},
      {"js", "text/javascript; charset=utf-8"},
      {"mjs", "text/javascript; charset=utf-8"},
      {"css", "text/css; charset=utf-8"},
      {"json", "application/json"},
      {"map", "application/json"},
      {"webmanifest", "application/manifest+json"},
      {"svg", "image/svg+xml"},
      {"png", "image/png"},
      {"jpg", "image/jpeg"},
      {"webp", "image/webp"},
      {"ico", "image/x-icon"},
      {"wasm", "application/wasm"},
      {"glb", "model/gltf-binary"},
      {"gltf", "model/gltf+json"},
      {"woff2", "font/woff2"},
      {"txt", "text/plain; charset=utf-8"},
  };
  const std::size_t dot = file_name.rfind('.');
  if (dot != std::string_view::npos) {
    for (const auto& [ending, type] : kTypes) {
      if (file_name.substr(dot + 1) == ending) return type;
    }
  }
  return "application/octet-stream";
}

bool HttpFiles::present() const {
  std::error_code error;
  return !root_.empty() && fs::is_regular_file(root_ / "index.html", error);
}

// What is at a path inside the root, if that is a plain file.
std::optional<HttpFiles::OnDisk> HttpFiles::look(const std::string& path) const {
  std::error_code error;
  const fs::path root = fs::canonical(root_, error);
  if (error) return std::nullopt;
  OnDisk found{fs::canonical(root / path, error), {}, 0};
  if (error) return std::nullopt;
  // A link that leads out of the root is as bad as "..".
  const auto inside = found.path.lexically_relative(root);
  if (inside.empty() || *inside.begin() == "..") return std::nullopt;
  if (!fs::is_regular_file(found.path, error)) return std::nullopt;
  found.size = fs::file_size(found.path, error);
  if (!error) found.changed = fs::last_write_time(found.path, error);
  if (error || found.size > kMaxFile) return std::nullopt;
  return found;
}

std::optional<HttpFiles::File> HttpFiles::find(std::string_view target) {
  const auto path = plain_path(target);
  if (!path || root_.empty()) return std::nullopt;
  const auto plain = look(*path);
  if (!plain) return std::nullopt;
  auto gzip = look(*path + ".gz");
  // What was packed before the file was last written is of another one.
  if (gzip && gzip->changed < plain->changed) gzip.reset();

  auto kept = kept_.find(*path);
  if (kept != kept_.end() && kept->second.plain == *plain && kept->second.gzip == gzip) return kept->second.file;

  File result;
  result.content_type = content_type_of(*path);
  result.etag = std::to_string(plain->changed.time_since_epoch().count()) + '-' + std::to_string(plain->size);
  // The bundler names the files in assets/ by their content.
  result.cache_control = path->starts_with("assets/") ? "public, max-age=31536000, immutable" : "no-cache";
  result.body = read(plain->path, plain->size);
  if (!result.body) return std::nullopt;
  if (gzip) result.gzip = read(gzip->path, gzip->size);

  const auto bytes = [](const File& file) { return file.body->size() + (file.gzip ? file.gzip->size() : 0); };
  if (kept != kept_.end()) {
    kept_bytes_ -= bytes(kept->second.file);
    kept_.erase(kept);
  }
  if (kept_bytes_ + bytes(result) <= kMaxKept) {
    kept_bytes_ += bytes(result);
    kept_[*path] = {*plain, gzip, result};
  }
  return result;
}

}  // namespace posed::net
