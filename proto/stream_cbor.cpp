// Frames in CBOR (RFC 8949) are made of their text, so that both say the same. Lengths are indefinite: nothing has to
// be counted first.
#include <array>
#include <bit>
#include <nlohmann/json.hpp>

#include "proto/codec.h"

namespace posed::proto {
namespace {

enum Major : std::uint8_t { kUnsigned = 0x00, kNegative = 0x20, kText = 0x60 };
constexpr char kArray = '\x9f', kMap = '\xbf', kBreak = '\xff';
constexpr char kFalse = '\xf4', kTrue = '\xf5', kNull = '\xf6', kFloat = '\xfa', kDouble = '\xfb';

class Writer final : public nlohmann::json_sax<nlohmann::json> {
 public:
  Writer(std::string& out, bool exact) : out_(out), exact_(exact) {}

  bool null() override { return put(kNull); }
  bool boolean(bool value) override { return put(value ? kTrue : kFalse); }
  bool number_integer(number_integer_t value) override {
    return value < 0 ? head(kNegative, static_cast<std::uint64_t>(-1 - value))
                     : head(kUnsigned, static_cast<std::uint64_t>(value));
  }
  bool number_unsigned(number_unsigned_t value) override { return head(kUnsigned, value); }
  bool number_float(number_float_t value, const string_t&) override {
    const auto narrow = static_cast<float>(value);
    if (exact_ && static_cast<double>(narrow) != value)
      return put(kDouble) && bytes(std::bit_cast<std::uint64_t>(value), 8);
    return put(kFloat) && bytes(std::bit_cast<std::uint32_t>(narrow), 4);
  }
  bool string(string_t& text) override { return head(kText, text.size()) && (out_ += text, true); }
  bool binary(binary_t&) override { return false; }
  bool start_object(std::size_t) override { return put(kMap); }
  bool key(string_t& text) override { return string(text); }
  bool end_object() override { return put(kBreak); }
  bool start_array(std::size_t) override { return put(kArray); }
  bool end_array() override { return put(kBreak); }
  bool parse_error(std::size_t, const std::string&, const nlohmann::detail::exception&) override { return false; }

 private:
  bool put(char byte) { return out_ += byte, true; }
  bool bytes(std::uint64_t value, int count) {
    while (count-- > 0) out_ += static_cast<char>(value >> (8 * count));
    return true;
  }
  // The shortest of the five forms.
  bool head(Major major, std::uint64_t value) {
    if (value < 24) return put(static_cast<char>(major | value));
    const int log = value <= 0xff ? 0 : value <= 0xffff ? 1 : value <= 0xffff'ffff ? 2 : 3;
    return put(static_cast<char>(major | (24 + log))) && bytes(value, 1 << log);
  }

  std::string& out_;
  bool exact_;
};

}  // namespace

std::string encode_cbor(std::string_view frame, Stream stream) {
  std::string out;
  out.reserve(frame.size());
  Writer writer(out, stream == Stream::scene);
  nlohmann::json::sax_parse(frame, &writer);
  return out;
}

}  // namespace posed::proto
