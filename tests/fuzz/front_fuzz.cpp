// The port's front as a peer meets it: its first bytes decide what it speaks, then HTTP, a WebSocket or lines. The
// faces are the real ones; only the socket is not. Whatever comes, and in whatever pieces, what is understood, said and
// closed is the same. The first byte says how it begins and ends.
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "server/net/detect_face.h"
#include "server/net/http_face.h"
#include "server/net/line_face.h"
#include "server/net/websocket_face.h"
#include "tests/fuzz/require.h"

namespace {

using namespace posed;
using namespace posed::net;

Limits small_limits() {
  Limits limits;
  limits.line_bytes = 256;
  return limits;
}
const Limits kLimits = small_limits();
constexpr int kMostAsked = 5;

HttpSite& site() {
  static HttpSite made = [] {
    HttpSite pages(HostPolicy(true, {}, {}), {});
    pages.set_page("/metrics", "text/plain", std::make_shared<const std::string>("posed_connections 1\n"));
    return pages;
  }();
  return made;
}

// A connection without a socket: writes down what its faces ask for.
class Visitor final : public Link {
 public:
  // `most`: lines that may be unanswered.
  Visitor(bool after_handshake, std::size_t most) : most_(most) {
    if (after_handshake)
      face_ = std::make_unique<WebsocketFace>(*this, kLimits.line_bytes);
    else
      face_ = std::make_unique<DetectFace>(*this, kLimits.http_request, [this](Detected detected) {
        if (detected == Detected::http) return std::unique_ptr<Face>(new HttpFace(*this, site(), kLimits, tally_));
        if (detected == Detected::tls) part(close_code::kPolicy, std::nullopt, Owed::forget);
        return std::unique_ptr<Face>(new LineFace(*this, kLimits.line_bytes));
      });
  }

  void take(std::string_view bytes) {
    if (parted_) return;
    face_->take(bytes);
    settle();
  }
  void end() {
    if (parted_) return;
    const Face* const before = face_.get();
    face_->end();
    if (face_.get() != before) face_->end();
  }
  const std::string& log() const { return log_; }

  bool room() const override { return !parted_ && unanswered_ < most_; }
  bool idle() const override { return idle_; }
  bool may_ask() override { return ++asked_ <= kMostAsked; }
  void hand_up(std::string_view line) override {
    ++unanswered_;
    log_.append("line ").append(line).append("\n");
  }
  void send(SharedLine bytes) override {
    fuzz::require(bytes != nullptr, "nothing to send", log_);
    idle_ = false;
    log_.append("send ").append(*bytes).append("\n");
  }
  void open(bool websocket) override { log_.append(websocket ? "websocket\n" : "lines\n"); }
  void become(std::unique_ptr<Face> face, std::string_view rest) override {
    retired_.push_back(std::move(face_));
    face_ = std::move(face);
    if (!rest.empty() && !parted_) face_->take(rest);
  }
  void deadline(Nanoseconds) override {}
  void part(std::uint16_t code, std::optional<Error> last_words, Owed) override {
    if (parted_) return;
    parted_ = true;
    log_.append("part ").append(std::to_string(code)).append(last_words ? last_words->code : "").append("\n");
    if (const SharedLine last = face_->goodbye(code)) log_.append(*last);
  }

 private:
  // All is sent and answered: what was held back goes on.
  void settle() {
    do {
      idle_ = true;
      unanswered_ = 0;
      retired_.clear();
      if (parted_ || !face_->ready()) return;
      face_->take({});
    } while (true);
  }

  const std::size_t most_;
  Tally tally_;
  std::unique_ptr<Face> face_;
  std::vector<std::unique_ptr<Face>> retired_;
  std::string log_;
  std::size_t unanswered_ = 0;
  int asked_ = 0;
  bool idle_ = true, parted_ = false;
};

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  const bool after_handshake = data[0] & 1, ends = data[0] & 2;
  const std::size_t step = 1 + data[0] / 4 % 16, most = 1 + data[0] / 64;
  std::string_view text(reinterpret_cast<const char*>(data) + 1, size - 1);
  Visitor whole(after_handshake, 1'000'000), pieces(after_handshake, most);
  whole.take(text);
  if (ends) whole.end();
  const std::string_view all = text;
  for (std::size_t piece = step; !text.empty();) {
    piece = piece * 7 % 13 % step + 1;
    pieces.take(text.substr(0, piece));
    text.remove_prefix(std::min(piece, text.size()));
  }
  if (ends) pieces.end();
  fuzz::require(whole.log() == pieces.log(), "otherwise in pieces", all);
  return 0;
}
