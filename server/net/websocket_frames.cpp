#include "server/net/websocket_frames.h"

#include "server/net/sha1.h"

namespace posed::net {

FrameHeader frame_header(Opcode opcode, std::size_t size) {
  FrameHeader header{};
  header.bytes[0] = static_cast<char>(0x80 | static_cast<std::uint8_t>(opcode));
  std::size_t length_bytes = 0;
  if (size < 126) {
    header.bytes[1] = static_cast<char>(size);
  } else {
    length_bytes = size < 65536 ? 2 : 8;
    header.bytes[1] = length_bytes == 2 ? 126 : 127;
  }
  for (std::size_t i = 0; i < length_bytes; ++i) {
    header.bytes[2 + i] = static_cast<char>(size >> (8 * (length_bytes - 1 - i)));
  }
  header.size = 2 + length_bytes;
  return header;
}

std::string control_frame(Opcode opcode, std::string_view payload) {
  payload = payload.substr(0, 125);
  const FrameHeader header = frame_header(opcode, payload.size());
  return std::string(header.bytes.data(), header.size).append(payload);
}

std::string close_frame(std::uint16_t code, std::string_view reason) {
  std::string payload{static_cast<char>(code >> 8), static_cast<char>(code)};
  return control_frame(Opcode::close, payload.append(reason));
}

std::string accept_key(std::string_view key) {
  return base64(sha1(std::string(key).append("258EAFA5-E914-47DA-95CA-C5AB0DC85B11")));
}

void FrameReader::push(std::string_view bytes) {
  buffer_.erase(0, begin_);
  begin_ = 0;
  buffer_.append(bytes);
}

std::optional<FrameReader::Message> FrameReader::fail(std::uint16_t code) {
  error_ = code;
  buffer_.clear();
  begin_ = 0;
  return std::nullopt;
}

std::optional<FrameReader::Message> FrameReader::next() {
  while (error_ == 0) {
    const std::string_view left = std::string_view(buffer_).substr(begin_);
    if (left.size() < 2) return std::nullopt;
    const auto byte = [&](std::size_t i) { return static_cast<std::uint8_t>(left[i]); };
    const bool final = byte(0) & 0x80;
    const auto opcode = static_cast<Opcode>(byte(0) & 0x0f);
    const bool control = byte(0) & 0x08;
    const bool masked = byte(1) & 0x80;
    if ((byte(0) & 0x70) || !masked) return fail(close_code::kProtocol);
    if (control ? (opcode > Opcode::pong || !final || (byte(1) & 0x7f) > 125) : opcode > Opcode::binary) {
      return fail(close_code::kProtocol);
    }
    if (!control && (opcode == Opcode::continuation) != kind_.has_value()) return fail(close_code::kProtocol);

    std::uint64_t size = byte(1) & 0x7f;
    std::size_t header = 2;
    if (size >= 126) {
      const std::size_t length_bytes = size == 126 ? 2 : 8;
      if (left.size() < header + length_bytes) return std::nullopt;
      size = 0;
      for (std::size_t i = 0; i < length_bytes; ++i) size = size << 8 | byte(header + i);
      header += length_bytes;
    }
    if (!control && size > max_message_ - fragments_.size()) return fail(close_code::kTooBig);
    if (left.size() < header + 4 || left.size() - header - 4 < size) return std::nullopt;

    const std::string_view mask = left.substr(header, 4);
    std::string payload(left.substr(header + 4, size));
    for (std::size_t i = 0; i < payload.size(); ++i) payload[i] = static_cast<char>(payload[i] ^ mask[i & 3]);
    begin_ += header + 4 + size;
    if (control) return Message{opcode, std::move(payload)};
    if (opcode != Opcode::continuation) kind_ = opcode;
    if (fragments_.empty()) {
      fragments_ = std::move(payload);
    } else {
      fragments_.append(payload);
    }
    if (!final) continue;
    Message message{*kind_, std::move(fragments_)};
    kind_.reset();
    fragments_.clear();
    return message;
  }
  return std::nullopt;
}

}  // namespace posed::net
