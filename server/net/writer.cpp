#include "server/net/writer.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <string_view>

#include "server/net/websocket_frames.h"

namespace posed::net {
namespace {

constexpr std::size_t kGather = 16;  // lines in one write
constexpr std::string_view kNewline = "\n";

bool would_block() {
  return errno == EAGAIN || errno == EWOULDBLOCK || errno == ENOBUFS;
}

std::size_t framed_size(const Outgoing& out) {
  const std::size_t size = out.bytes.size();
  if (out.framing == Framing::line) return size + kNewline.size();
  return out.framing == Framing::text ? size + frame_header(Opcode::text, size).size : size;
}

}  // namespace

Writer::State Writer::write(Wire& wire, Outbox& outbox, Nanoseconds now) {
  while (!begun_.empty() || fill(outbox, now)) {
    const long sent = send_once(wire);
    if (sent >= 0) {
      advance(static_cast<std::size_t>(sent), now);
    } else if (would_block()) {
      return State::blocked;
    } else if (errno != EINTR) {
      return State::broken;
    }
  }
  return State::done;
}

Writer::State Writer::write_frame(Wire& wire, const StreamFrame& frame, Framing framing, const Clock& clock) {
  const std::string_view bytes = frame.as(framing);
  const iovec part{const_cast<char*>(bytes.data()), bytes.size()};
  const long sent = wire.send(&part, 1);
  if (sent < 0 && !would_block() && errno != EINTR) return State::broken;
  if (sent == static_cast<long>(bytes.size())) {
    sent_ += bytes.size();
    add(tally_.bytes_out, bytes.size());
    add(tally_.frames);
    if (frame.t_ns() != 0) tally_.sent_age.add(clock.now() - frame.t_ns());
    return State::done;
  }
  begun_.push_back({frame.wire(), bytes, Framing::raw, true, frame.t_ns()});
  advance(sent > 0 ? static_cast<std::size_t>(sent) : 0, 0);
  return State::blocked;
}

bool Writer::fill(Outbox& outbox, Nanoseconds now) {
  while (begun_.size() < kGather) {
    auto out = outbox.next(now);
    if (!out) break;
    begun_.push_back(std::move(*out));
    if (begun_.back().frame) break;  // what would go after it may be stale by then
  }
  return !begun_.empty();
}

// The shared line goes out as it is, with what frames it beside it: nothing is copied.
long Writer::send_once(Wire& wire) const {
  std::array<FrameHeader, kGather> headers;
  std::array<iovec, 2 * kGather> parts;
  std::size_t count = 0;
  std::size_t skip = written_;
  const auto append = [&](const char* data, std::size_t size) {
    const std::size_t gone = std::min(skip, size);
    skip -= gone;
    if (size > gone) parts[count++] = {const_cast<char*>(data + gone), size - gone};
  };
  for (std::size_t i = 0; i < begun_.size(); ++i) {
    const Outgoing& out = begun_[i];
    if (out.framing == Framing::text) {
      headers[i] = frame_header(Opcode::text, out.bytes.size());
      append(headers[i].bytes.data(), headers[i].size);
    }
    append(out.bytes.data(), out.bytes.size());
    if (out.framing == Framing::line) append(kNewline.data(), kNewline.size());
  }
  return wire.send(parts.data(), count);
}

void Writer::advance(std::size_t bytes, Nanoseconds now) {
  sent_ += bytes;
  add(tally_.bytes_out, bytes);
  written_ += bytes;
  std::size_t done = 0;
  for (; done < begun_.size(); ++done) {
    const std::size_t size = framed_size(begun_[done]);
    if (written_ < size) break;
    written_ -= size;
    if (!begun_[done].frame) continue;
    add(tally_.frames);
    if (begun_[done].t_ns != 0) tally_.sent_age.add(now - begun_[done].t_ns);
  }
  begun_.erase(begun_.begin(), begun_.begin() + static_cast<std::ptrdiff_t>(done));
}

}  // namespace posed::net
