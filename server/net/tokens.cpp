#include "server/net/tokens.h"

#include <openssl/crypto.h>
#include <openssl/sha.h>

#include <fstream>
#include <sstream>
#include <stdexcept>

#include "proto/codec.h"

namespace posed::net {
namespace {

constexpr std::string_view kPrefix = "sha256:";

std::optional<unsigned char> hex_digit(char c) {
  if (c >= '0' && c <= '9') return static_cast<unsigned char>(c - '0');
  if (c >= 'a' && c <= 'f') return static_cast<unsigned char>(c - 'a' + 10);
  return std::nullopt;
}

bool read_digest(std::string_view text, std::array<unsigned char, 32>& digest) {
  if (!text.starts_with(kPrefix) || text.size() != kPrefix.size() + 2 * digest.size()) return false;
  text.remove_prefix(kPrefix.size());
  for (std::size_t i = 0; i < digest.size(); ++i) {
    const auto high = hex_digit(text[2 * i]), low = hex_digit(text[2 * i + 1]);
    if (!high || !low) return false;
    digest[i] = static_cast<unsigned char>(*high << 4 | *low);
  }
  return true;
}

}  // namespace

Tokens Tokens::parse(std::string_view text, const std::string& where) {
  Tokens tokens;
  std::istringstream lines{std::string(text)};
  int number = 0;
  for (std::string line; std::getline(lines, line);) {
    ++number;
    std::istringstream words(line);
    std::string role, name, digest, more;
    words >> role >> name >> digest >> more;
    if (role.empty() || role.starts_with('#')) continue;
    Entry entry;
    const auto known = proto::find_role(role);
    if (!known || *known == proto::Role::none || !more.empty() || !read_digest(digest, entry.digest)) {
      throw std::runtime_error(
          where + ", line " + std::to_string(number) +
          ": a line is ROLE NAME sha256:HEX, with a role of viewer, editor or operator; posectl token "
          "makes one");
    }
    entry.holder = {name, *known};
    tokens.entries_.push_back(std::move(entry));
  }
  if (tokens.entries_.empty())
    throw std::runtime_error(where + " names nobody, so that nobody could come in; posectl token makes a line for it");
  return tokens;
}

Tokens Tokens::read(const std::filesystem::path& file) {
  std::ifstream in(file);
  std::stringstream text;
  if (!in || !(text << in.rdbuf()))
    throw std::runtime_error(file.string() + " can't be read; name the file of tokens with --auth.tokens");
  return parse(text.str(), file.string());
}

std::optional<Tokens::Holder> Tokens::find(std::string_view token) const {
  std::array<unsigned char, 32> digest;
  ::SHA256(reinterpret_cast<const unsigned char*>(token.data()), token.size(), digest.data());
  const Entry* found = nullptr;
  for (const Entry& entry : entries_) {
    if (CRYPTO_memcmp(entry.digest.data(), digest.data(), digest.size()) == 0) found = &entry;
  }
  if (!found) return std::nullopt;
  return found->holder;
}

}  // namespace posed::net
