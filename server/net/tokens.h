// Who may come in: tokens with their roles. A file holds their digests only; a token is long and random, so that a
// plain SHA-256 can't be turned back.
#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "proto/messages.h"

namespace posed::net {

class Tokens {
 public:
  struct Holder {
    std::string name;
    proto::Role role = proto::Role::none;
  };

  // Lines of ROLE NAME sha256:HEX; empty ones and those that begin with # are comments. Throws std::runtime_error that
  // names the line and the cure.
  static Tokens read(const std::filesystem::path& file);
  static Tokens parse(std::string_view text, const std::string& where);

  // Takes equally long whichever it is, and if it is none.
  std::optional<Holder> find(std::string_view token) const;
  std::size_t size() const { return entries_.size(); }

 private:
  struct Entry {
    Holder holder;
    std::array<unsigned char, 32> digest{};
  };
  std::vector<Entry> entries_;
};

}  // namespace posed::net
