// WebSocket framing (RFC 6455), server's side. Pure bytes, no sockets; no extensions.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace posed::net {

enum class Opcode : std::uint8_t { continuation = 0, text = 1, binary = 2, close = 8, ping = 9, pong = 10 };

namespace close_code {
inline constexpr std::uint16_t kNormal = 1000, kGoingAway = 1001, kProtocol = 1002, kUnsupported = 1003, kNone = 1005,
                               kPolicy = 1008, kTooBig = 1009;
}

// The header of an unmasked, final frame: what the server puts before a payload of `size` bytes.
struct FrameHeader {
  std::array<char, 10> bytes;
  std::size_t size;
};
FrameHeader frame_header(Opcode opcode, std::size_t size);

// A whole frame. Control frames carry at most 125 bytes.
std::string control_frame(Opcode opcode, std::string_view payload);
std::string close_frame(std::uint16_t code, std::string_view reason);

// Sec-WebSocket-Accept for a Sec-WebSocket-Key.
std::string accept_key(std::string_view key);

// Cuts what a client sends into messages: unmasks, joins fragments, checks the rules.
class FrameReader {
 public:
  struct Message {
    Opcode opcode = Opcode::text;  // never continuation
    std::string payload;
  };

  explicit FrameReader(std::size_t max_message) : max_message_(max_message) {}

  void push(std::string_view bytes);
  std::optional<Message> next();
  // The close code for what was wrong, or 0. Nothing is read after an error.
  std::uint16_t error() const { return error_; }

 private:
  std::optional<Message> fail(std::uint16_t code);

  std::size_t max_message_;
  std::string buffer_;
  std::size_t begin_ = 0;       // of the frame that is looked at
  std::string fragments_;       // of the message that is under way
  std::optional<Opcode> kind_;  // of that message
  std::uint16_t error_ = 0;
};

}  // namespace posed::net
