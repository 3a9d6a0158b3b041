// From what a terminal sends to what is meant. Pure.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace posed::view {

// A character, or one of these.
enum class Special : char32_t {
  up = 0x110000,
  down,
  right,
  left,
  page_up,
  page_down,
  home,
  end,
  back_tab,
  escape,
  alive
};

struct Key {
  char32_t code = 0;
  bool shift = false;  // of special ones
  Key() = default;
  Key(char32_t c) : code(c) {}
  Key(Special s, bool with_shift = false) : code(static_cast<char32_t>(s)), shift(with_shift) {}
  bool operator==(const Key&) const = default;
};

// Bytes as they come: a sequence may be split anywhere. Sequences that mean nothing to us are left out whole.
class KeyReader {
 public:
  std::vector<Key> push(std::string_view bytes);
  // Nothing more has come for a while: an escape that stands alone is the key.
  std::vector<Key> pause();
  bool waits() const { return !rest_.empty(); }

 private:
  std::string rest_;
};

enum class Command {
  nudge_up,
  nudge_down,
  nudge_right,
  nudge_left,
  nudge_nearer,
  nudge_farther,
  step,
  next_goal,
  previous_goal,
  heavier,
  lighter,
  on_off,
  undo,
  redo,
  orbit_up,
  orbit_down,
  orbit_right,
  orbit_left,
  pan_up,
  pan_down,
  pan_right,
  pan_left,
  nearer,
  farther,
  fit,
  top,
  perspective,
  front,
  side,
  next_view,
  previous_view,
  maximise,
  list,
  help,
  redraw,
  suspend,
  leave,
  quit
};

struct Bound {
  Key key;
  Command command;
};
// A line of the help sheet, with the keys that it speaks of: what is said and what is done can not drift apart.
struct Help {
  const char* keys;
  const char* says;
  std::vector<Bound> bound;
};
const std::vector<Help>& help_sheet();
std::optional<Command> command_of(Key key);

}  // namespace posed::view
