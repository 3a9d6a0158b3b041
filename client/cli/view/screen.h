// From pages to bytes for a terminal: what has changed, and no more. Pure.
#pragma once

#include <optional>
#include <string>

#include "client/cli/view/cell.h"

namespace posed::view {

enum class Colors { none, sixteen, all };

class Screen {
 public:
  // `utf8` false: what is not ASCII becomes a question mark.
  Screen(Colors colors, bool utf8) : colors_(colors), utf8_(utf8) {}

  // The bytes that make a terminal which shows the page before show this one; empty if nothing has changed. The first
  // page, and one of another size, is drawn whole.
  std::string update(const Grid& page);
  // The terminal's picture is gone.
  void forget() { shown_.reset(); }

 private:
  void move(std::string& out, int column, int row);
  void style(std::string& out, const Style& wanted);
  void color(std::string& out, int color, bool back) const;

  Colors colors_;
  bool utf8_;
  std::optional<Grid> shown_;
  // Where the terminal's cursor and style are, as we have left them.
  int column_ = -1, row_ = -1;
  Style style_;
};

// Colours as the environment says: NO_COLOR, COLORTERM and TERM (null: not set).
Colors colors_of(const char* no_color, const char* colorterm, const char* term);

}  // namespace posed::view
