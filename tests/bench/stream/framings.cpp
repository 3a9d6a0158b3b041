#include "tests/bench/stream/framings.h"

#include <algorithm>
#include <charconv>

namespace posed::test {
namespace {

constexpr std::string_view kTopic = "pose";
constexpr std::string_view kStamp = "\"t_ns\":";
constexpr std::size_t kStampWithin = 160;

std::uint8_t byte(std::string_view bytes, std::size_t i) {
  return static_cast<std::uint8_t>(bytes[i]);
}

std::string mqtt_text(std::string_view text) {
  return std::string{static_cast<char>(text.size() >> 8), static_cast<char>(text.size())}.append(text);
}

std::string mqtt_packet(int type_and_flags, std::string_view body) {
  std::string packet{static_cast<char>(type_and_flags)};
  std::size_t left = body.size();
  do {
    packet += static_cast<char>((left & 0x7f) | (left > 0x7f ? 0x80 : 0));
    left >>= 7;
  } while (left > 0);
  return packet.append(body);
}

std::string mqtt_connect() {
  // MQTT 3.1.1, a clean session, no keep-alive, and an id that the broker makes up.
  return mqtt_packet(0x10, mqtt_text("MQTT") + std::string{4, 2, 0, 0} + mqtt_text(""));
}

Piece cut_line(std::string_view bytes) {
  const std::size_t end = bytes.find('\n');
  if (end == std::string_view::npos) return {};
  return {end + 1, bytes.substr(0, end), false};
}

Piece cut_websocket(std::string_view bytes) {
  if (bytes.starts_with("HTTP/")) {
    const std::size_t end = bytes.find("\r\n\r\n");
    return end == std::string_view::npos ? Piece{} : Piece{end + 4, {}, false};
  }
  if (bytes.size() < 2) return {};
  std::size_t header = 2, size = byte(bytes, 1);
  if (size >= 126) {
    const std::size_t width = size == 126 ? 2 : 8;
    if (bytes.size() < header + width) return {};
    size = 0;
    for (std::size_t i = 0; i < width; ++i) size = size << 8 | byte(bytes, header + i);
    header += width;
  }
  if (bytes.size() < header + size) return {};
  return {header + size, bytes.substr(header, size), false};
}

// "MSG pose 1 1300\r\n", so many bytes, "\r\n"; or INFO, PING, +OK on a line.
Piece cut_nats(std::string_view bytes) {
  const std::size_t end = bytes.find("\r\n");
  if (end == std::string_view::npos) return {};
  const std::string_view head = bytes.substr(0, end);
  if (!head.starts_with("MSG ")) return {end + 2, {}, head == "PING"};
  const std::string_view number = head.substr(head.rfind(' ') + 1);
  std::size_t size = 0;
  std::from_chars(number.data(), number.data() + number.size(), size);
  if (bytes.size() < end + 2 + size + 2) return {};
  return {end + 2 + size + 2, bytes.substr(end + 2, size), false};
}

Piece cut_mqtt(std::string_view bytes) {
  std::size_t size = 0, header = 1;
  for (int shift = 0;; shift += 7) {
    if (header >= bytes.size()) return {};
    const std::size_t part = byte(bytes, header++);
    size |= (part & 0x7f) << shift;
    if (part < 0x80) break;
  }
  if (bytes.size() < header + size) return {};
  if (byte(bytes, 0) >> 4 != 3) return {header + size, {}, false};
  const std::size_t topic = 2 + kTopic.size();
  return {header + size, bytes.substr(header + topic, size - topic), false};
}

}  // namespace

std::string greeting(Framing framing, const std::string& subscribe) {
  switch (framing) {
    case Framing::lines:
      return subscribe.empty() ? "" : subscribe + "\n";
    case Framing::websocket:
      return "GET /ws HTTP/1.1\r\nHost: localhost\r\nUpgrade: websocket\r\nConnection: Upgrade\r\n"
             "Sec-WebSocket-Version: 13\r\nSec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\n\r\n";
    case Framing::nats:
      return publisher_greeting(framing) + "SUB " + std::string(kTopic) + " 1\r\n";
    case Framing::mqtt:
      return mqtt_connect() + mqtt_packet(0x82, std::string{0, 1} + mqtt_text(kTopic) + std::string{0});
  }
  return "";
}

std::string websocket_text(std::string_view text) {
  std::string frame{static_cast<char>(0x81)};
  if (text.size() < 126) {
    frame += static_cast<char>(0x80 | text.size());
  } else {
    frame += static_cast<char>(0x80 | 126);
    frame += static_cast<char>(text.size() >> 8);
    frame += static_cast<char>(text.size());
  }
  return frame.append(4, '\0').append(text);  // a mask of zeros changes nothing
}

Piece cut(Framing framing, std::string_view bytes) {
  switch (framing) {
    case Framing::lines:
      return cut_line(bytes);
    case Framing::websocket:
      return cut_websocket(bytes);
    case Framing::nats:
      return cut_nats(bytes);
    case Framing::mqtt:
      return cut_mqtt(bytes);
  }
  return {};
}

std::string pong(Framing framing) {
  return framing == Framing::nats ? "PONG\r\n" : "";
}

std::string publisher_greeting(Framing framing) {
  return framing == Framing::nats ? "CONNECT {\"verbose\":false,\"pedantic\":false}\r\n" : mqtt_connect();
}

std::string published(Framing framing, std::string_view frame) {
  if (framing == Framing::mqtt) return mqtt_packet(0x30, mqtt_text(kTopic).append(frame));
  return "PUB " + std::string(kTopic) + ' ' + std::to_string(frame.size()) + "\r\n" + std::string(frame) + "\r\n";
}

std::optional<Nanoseconds> stamp_of(std::string_view payload) {
  payload = payload.substr(0, kStampWithin);
  const std::size_t at = payload.find(kStamp);
  if (at == std::string_view::npos) return std::nullopt;
  Nanoseconds stamp = 0;
  std::from_chars(payload.data() + at + kStamp.size(), payload.data() + payload.size(), stamp);
  return stamp;
}

}  // namespace posed::test
