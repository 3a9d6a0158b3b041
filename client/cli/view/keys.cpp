#include "client/cli/view/keys.h"

#include <algorithm>

namespace posed::view {
namespace {

constexpr char kEscape = '\x1b';
constexpr std::size_t kLongest = 64;  // of a sequence; more is noise

// The key of CSI PARAMETERS FINAL.
std::optional<Key> key_of(std::string_view parameters, char final) {
  const bool plain = parameters.empty();  // "?62;4c" is what a terminal says of itself
  if (!plain && (parameters[0] < '0' || parameters[0] > '9')) return std::nullopt;
  // "1;2": the second number less 1 has a bit for Shift.
  bool shift = false;
  if (const std::size_t semicolon = parameters.find(';'); semicolon != std::string_view::npos) {
    const std::string_view modifier = parameters.substr(semicolon + 1);
    shift = modifier.size() == 1 && modifier[0] >= '2' && ((modifier[0] - '1') & 1) != 0;
  }
  switch (final) {
    case 'A':
      return Key(Special::up, shift);
    case 'B':
      return Key(Special::down, shift);
    case 'C':
      return Key(Special::right, shift);
    case 'D':
      return Key(Special::left, shift);
    case 'a':  // rxvt: with Shift
      return plain ? std::optional(Key(Special::up, true)) : std::nullopt;
    case 'b':
      return plain ? std::optional(Key(Special::down, true)) : std::nullopt;
    case 'c':
      return plain ? std::optional(Key(Special::right, true)) : std::nullopt;
    case 'd':
      return plain ? std::optional(Key(Special::left, true)) : std::nullopt;
    case 'H':
      return Key(Special::home);
    case 'F':
      return Key(Special::end);
    case 'Z':
      return Key(Special::back_tab);
    case 'n':  // the answer to "are you there?"
      return parameters == "0" ? std::optional(Key(Special::alive)) : std::nullopt;
    case '~':
      if (parameters.starts_with("5")) return Key(Special::page_up, shift);
      if (parameters.starts_with("6")) return Key(Special::page_down, shift);
      return std::nullopt;
    default:
      return std::nullopt;
  }
}

// How long the sequence at the front is, and its key; 0: it is not whole yet.
std::size_t take_sequence(std::string_view text, std::optional<Key>& key) {
  if (text.size() < 2) return 0;
  if (text[1] == 'O') {  // arrows of a keypad in application mode
    if (text.size() < 3) return 0;
    key = key_of("", text[2]);
    return 3;
  }
  if (text[1] != '[') {  // an escape by itself, before another key
    key = Key(Special::escape);
    return 1;
  }
  for (std::size_t i = 2; i < text.size(); ++i) {
    if (text[i] >= 0x40 && text[i] <= 0x7e) {
      key = key_of(text.substr(2, i - 2), text[i]);
      return i + 1;
    }
    if (text[i] < 0x20 || i > kLongest) return i;
  }
  return 0;
}

std::size_t take_character(std::string_view text, std::optional<Key>& key) {
  const auto lead = static_cast<unsigned char>(text[0]);
  const std::size_t length = lead < 0xc0 ? 1 : lead < 0xe0 ? 2 : lead < 0xf0 ? 3 : 4;
  if (text.size() < length) return 0;
  // What we know is ASCII; the rest is passed over whole.
  if (lead < 0x80) key = Key(static_cast<char32_t>(lead));
  return length;
}

}  // namespace

std::vector<Key> KeyReader::push(std::string_view bytes) {
  rest_ += bytes;
  std::vector<Key> keys;
  std::string_view left = rest_;
  while (!left.empty()) {
    std::optional<Key> key;
    const std::size_t taken = left[0] == kEscape ? take_sequence(left, key) : take_character(left, key);
    if (taken == 0) break;
    if (key) keys.push_back(*key);
    left.remove_prefix(taken);
  }
  rest_ = std::string(left);
  return keys;
}

std::vector<Key> KeyReader::pause() {
  const bool escape = rest_ == std::string(1, kEscape);
  rest_.clear();
  return escape ? std::vector{Key(Special::escape)} : std::vector<Key>{};
}

const std::vector<Help>& help_sheet() {
  using C = Command;
  using S = Special;
  static const std::vector<Help> kSheet{
      {"n p", "next, previous goal", {{U'n', C::next_goal}, {U'p', C::previous_goal}}},
      {"arrows",
       "nudge the goal in the view's plane; with Shift ten times as far",
       {{S::up, C::nudge_up}, {S::down, C::nudge_down}, {S::right, C::nudge_right}, {S::left, C::nudge_left}}},
      {"PgUp PgDn",
       "nudge it away from you, towards you",
       {{S::page_up, C::nudge_farther}, {S::page_down, C::nudge_nearer}}},
      {"s", "the step of a nudge: 1, 10 or 100 mm", {{U's', C::step}}},
      {"[ ]", "less, more weight", {{U'[', C::lighter}, {U']', C::heavier}}},
      {"o", "the goal on or off", {{U'o', C::on_off}}},
      {"u r", "undo, redo what you have done", {{U'u', C::undo}, {U'r', C::redo}, {U'\x12', C::redo}}},
      {"h j k l",
       "orbit the perspective view; elsewhere move what is seen",
       {{U'h', C::orbit_left}, {U'j', C::orbit_down}, {U'k', C::orbit_up}, {U'l', C::orbit_right}}},
      {"H J K L",
       "move what is seen, in the perspective view too",
       {{U'H', C::pan_left}, {U'J', C::pan_down}, {U'K', C::pan_up}, {U'L', C::pan_right}}},
      {"+ -", "nearer, farther (all views)", {{U'+', C::nearer}, {U'=', C::nearer}, {U'-', C::farther}}},
      {"f", "frame all there is", {{U'f', C::fit}}},
      {"1 2 3 4",
       "top, front, side, perspective view; again: that view alone",
       {{U'1', C::top}, {U'2', C::front}, {U'3', C::side}, {U'4', C::perspective}}},
      {"Tab", "the next view", {{U'\t', C::next_view}, {S::back_tab, C::previous_view}}},
      {"m Enter", "this view alone, or all four", {{U'm', C::maximise}, {U'\r', C::maximise}, {U'\n', C::maximise}}},
      {"g", "the list of goals, shown or not", {{U'g', C::list}}},
      {"?", "this sheet", {{U'?', C::help}}},
      {"q",
       "quit",
       {{U'q', C::quit}, {U'\x03', C::quit}, {S::escape, C::leave}, {U'\x0c', C::redraw}, {U'\x1a', C::suspend}}}};
  return kSheet;
}

std::optional<Command> command_of(Key key) {
  for (const Help& help : help_sheet()) {
    for (const Bound& bound : help.bound)
      if (bound.key.code == key.code) return bound.command;
  }
  return std::nullopt;
}

}  // namespace posed::view
