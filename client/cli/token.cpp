#include <openssl/rand.h>
#include <openssl/sha.h>

#include <array>

#include "client/cli/output.h"

namespace posed::cli {
namespace {

template <std::size_t N>
std::string hex(const std::array<unsigned char, N>& bytes) {
  std::string text;
  for (const unsigned char byte : bytes) text += format("%02x", byte);
  return text;
}

}  // namespace

int make_token(const std::string& role, const std::string& name) {
  std::array<unsigned char, 32> random{};
  if (RAND_bytes(random.data(), static_cast<int>(random.size())) != 1)
    return fail({"internal", "this machine gives no random numbers", "", ""});
  const std::string token = hex(random);
  std::array<unsigned char, 32> digest{};
  SHA256(reinterpret_cast<const unsigned char*>(token.data()), token.size(), digest.data());
  std::fprintf(stderr, "posectl: the token of %s, shown this once: %s\n", name.c_str(), token.c_str());
  print_line(role + ' ' + name + " sha256:" + hex(digest));
  return kDone;
}

}  // namespace posed::cli
