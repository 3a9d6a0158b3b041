#include "client/cli/view/view.h"

#include <langinfo.h>
#include <poll.h>

#include <algorithm>
#include <array>
#include <clocale>
#include <cmath>
#include <csignal>
#include <cstdlib>
#include <deque>

#include "client/cli/view/link.h"
#include "client/cli/view/page.h"
#include "client/cli/view/screen.h"
#include "client/cli/view/terminal.h"
#include "client/lib/clock.h"

namespace posed::view {
namespace {

constexpr double kEscapeSeconds = 0.05;     // what follows an escape comes sooner, if it belongs to it
constexpr double kLeastSeconds = 1.0 / 70;  // between two pages
constexpr double kAnswerSeconds = 2.0;      // a terminal that has not answered by then does not, or has stalled
constexpr std::size_t kPagesAhead = 2;      // that the terminal has not shown yet
constexpr std::string_view kAreYouThere = "\x1b[5n";

double now() {
  return 1e-9 * static_cast<double>(client::steady_now());
}

bool utf8() {
  std::setlocale(LC_CTYPE, "");
  return std::string_view(nl_langinfo(CODESET)) == "UTF-8";
}

Glyphs glyphs_for(const Options& options, bool is_utf8) {
  if (options.glyphs) return *options.glyphs;
  if (!is_utf8) return Glyphs::ascii;
  const char* term = std::getenv("TERM");
  // The console's fonts have blocks, and no braille.
  return term != nullptr && std::string_view(term) == "linux" ? Glyphs::blocks : Glyphs::braille;
}

// The terminal's own measure of what it has shown: it answers a question behind each page. Two pages may be on the way;
// who is at the end of a slow line sees the newest pose then, and not those before. A terminal that does not answer is
// sent pages as fast as it takes bytes.
class Ahead {
 public:
  void sent(double t) { asked_.push_back(t); }
  void answered(double t) {
    answers_ = true;
    if (asked_.empty()) return;
    const double ms = 1e3 * (t - asked_.front());
    trip_ms_ = trip_ms_ ? 0.8 * *trip_ms_ + 0.2 * ms : ms;
    asked_.pop_front();
  }
  bool room(double t) {
    if (!answers_ && !asked_.empty() && t - asked_.front() > kAnswerSeconds) asked_.clear();
    if (!answers_ || asks()) return true;
    // It has stalled; a page now and then, so that a lost answer is not the end.
    if (t - asked_.back() < kAnswerSeconds) return false;
    asked_.pop_front();
    return true;
  }
  bool asks() const { return asked_.size() < kPagesAhead; }
  bool waits() const { return answers_ && !asked_.empty(); }
  std::optional<double> trip_ms() const { return answers_ ? trip_ms_ : std::nullopt; }
  void forget() { asked_.clear(); }

 private:
  std::deque<double> asked_;
  bool answers_ = false;
  std::optional<double> trip_ms_;
};

class Viewer {
 public:
  Viewer(Terminal& terminal, Link& link, const Options& options, bool is_utf8)
      : terminal_(terminal),
        link_(link),
        glyphs_(glyphs_for(options, is_utf8)),
        screen_(colors_of(std::getenv("NO_COLOR"), std::getenv("COLORTERM"), std::getenv("TERM")), is_utf8),
        desk_("view-" + std::to_string(client::steady_now())) {
    meter_.where = options.where;
  }

  void run() {
    size_ = terminal_.size();
    while (!quit_) {
      draw();
      wait();
      hear_signals();
      if (!quit_) hear_keys();
      hear_daemon();
    }
    // The answers that are on the way would be typed at the shell.
    for (const double until = now() + 0.3; ahead_.waits() && now() < until && terminal_usable_;) {
      pollfd input{terminal_.input(), POLLIN, 0};
      ::poll(&input, 1, 50);
      read_keys();
    }
    terminal_.drop_input();
  }

 private:
  void draw() {
    const double t = now();
    if (!dirty_ || terminal_.owes() || t < next_page_ || !ahead_.room(t)) return;
    dirty_ = false;
    next_page_ = t + kLeastSeconds;
    meter_.terminal_ms = ahead_.trip_ms();
    std::string bytes = screen_.update(page(size_, station_, desk_, meter_, glyphs_, t));
    if (bytes.empty()) return;
    if (ahead_.asks()) {
      bytes += kAreYouThere;
      ahead_.sent(t);
    }
    if (!terminal_.write(bytes)) lose_terminal();
  }

  void wait() {
    const double t = now();
    double seconds = 0.25;  // notes go by themselves
    if (dirty_ && !terminal_.owes() && ahead_.room(t)) seconds = std::max(0.0, next_page_ - t);
    if (keys_.waits()) seconds = std::min(seconds, kEscapeSeconds);
    std::array<pollfd, 4> polls{{{terminal_.signals(), POLLIN, 0},
                                 {link_.changed(), POLLIN, 0},
                                 {terminal_.input(), POLLIN, 0},
                                 {terminal_.output(), POLLOUT, 0}}};
    ::poll(polls.data(), terminal_.owes() ? 4 : 3, static_cast<int>(std::ceil(1e3 * seconds)));
    if (terminal_.owes() && !terminal_.flush()) lose_terminal();
    if (desk_.note(t) != nullptr) dirty_ = true;
  }

  void hear_signals() {
    while (const int signal = terminal_.next_signal()) {
      if (signal == SIGWINCH) {
        size_ = terminal_.size();
        redraw();
      } else if (signal == SIGCONT) {
        terminal_.hold();
        redraw();
      } else if (signal == SIGTSTP) {
        suspend();
      } else {
        quit_ = true;
      }
    }
  }

  std::vector<Key> read_keys() {
    auto bytes = terminal_.read();
    if (!bytes) return lose_terminal(), std::vector<Key>{};
    const double t = now();
    std::vector<Key> keys;
    if (!bytes->empty())
      last_byte_ = t, keys = keys_.push(*bytes);
    else if (keys_.waits() && t - last_byte_ >= kEscapeSeconds)
      keys = keys_.pause();
    for (const Key key : keys) {
      if (key == Key(Special::alive)) ahead_.answered(t), dirty_ = true;
    }
    return keys;
  }

  void hear_keys() {
    for (const Key key : read_keys()) {
      const auto command = command_of(key);
      if (!command) continue;
      dirty_ = true;
      Desk::Outcome outcome = desk_.act(*command, key.shift, station_, size_, now());
      if (outcome.edit) desk_.sent(link_.send(std::move(*outcome.edit)));
      if (outcome.then == Desk::Then::quit) quit_ = true;
      if (outcome.then == Desk::Then::suspend) suspend();
      if (outcome.then == Desk::Then::redraw) redraw();
    }
  }

  void hear_daemon() {
    pollfd changed{link_.changed(), POLLIN, 0};
    if (::poll(&changed, 1, 0) > 0) {
      link_.heard();
      station_ = link_.station();
      dirty_ = true;
    }
    desk_.follow(station_, size_, now());
  }

  void suspend() {
    terminal_.suspend();
    size_ = terminal_.size();
    redraw();
  }

  void redraw() {
    screen_.forget();
    ahead_.forget();
    dirty_ = true;
    next_page_ = 0.0;
  }

  void lose_terminal() {
    terminal_usable_ = false;
    quit_ = true;
  }

  Terminal& terminal_;
  Link& link_;
  Glyphs glyphs_;
  Screen screen_;
  Desk desk_;
  KeyReader keys_;
  Ahead ahead_;
  Meter meter_;
  Size size_;
  Station station_;
  bool dirty_ = true, quit_ = false, terminal_usable_ = true;
  double next_page_ = 0.0, last_byte_ = 0.0;
};

}  // namespace

Status run(client::Client& client, const Options& options) {
  const bool is_utf8 = utf8();
  auto terminal = Terminal::take();
  if (!terminal) return terminal.error();
  // After the terminal, whose signals its thread must not see; ended after the terminal is let go, since a daemon that
  // is gone takes a moment to be left.
  std::optional<Link> link(std::in_place, client, options.figure, options.max_rate_hz);
  {
    const std::unique_ptr<Terminal> held = std::move(*terminal);
    Viewer(*held, *link, options, is_utf8).run();
  }
  return Ok{};
}

Result<std::string> once(client::Client& client, const Options& options) {
  const Size size = options.size.value_or(Size{});
  Station station;
  auto entities = Link::ask(client, Entities{});
  if (!entities) return entities.error();
  station.entities = std::move(*entities);
  proto::StreamSubscribe pose;
  if (!options.figure.empty()) pose.figures = {options.figure};
  if (const Status subscribed = client.subscribe(pose); !subscribed) return subscribed.error();
  const auto frame = client.next(std::chrono::seconds(5));
  if (!frame) return frame.error();
  auto data = proto::decode_message<proto::PoseData>(frame->data);
  if (!data) return data.error();
  station.pose = std::make_shared<const proto::PoseData>(std::move(*data));
  Desk desk("once");
  desk.follow(station, size, 0.0);
  const bool is_utf8 = utf8();
  return plain_text(page(size, station, desk, {options.where, {}}, glyphs_for(options, is_utf8), 0.0));
}

}  // namespace posed::view
