#include "client/cli/view/cell.h"

#include <string>

namespace posed::view {
namespace {

// The next character, or U'?' for what is no UTF-8 or not surely one column wide: a page's columns must stay where they
// are in every terminal.
char32_t take(std::string_view& text) {
  const auto lead = static_cast<unsigned char>(text.front());
  const std::size_t length = lead < 0x80 ? 1 : lead < 0xe0 ? 2 : lead < 0xf0 ? 3 : 4;
  if (length > text.size() || (lead >= 0x80 && lead < 0xc2)) {
    text.remove_prefix(1);
    return U'?';
  }
  char32_t glyph = length == 1 ? lead : lead & (0x7f >> length);
  for (std::size_t i = 1; i < length; ++i) {
    const auto next = static_cast<unsigned char>(text[i]);
    if ((next & 0xc0) != 0x80) {
      text.remove_prefix(i);
      return U'?';
    }
    glyph = glyph << 6 | (next & 0x3f);
  }
  text.remove_prefix(length);
  const bool control = glyph < 0x20 || (glyph >= 0x7f && glyph < 0xa0) || glyph == 0xad;
  // Latin, Greek and Cyrillic without combining marks; punctuation, arrows, mathematics, boxes and blocks, braille.
  const bool narrow = glyph < 0x300 || (glyph >= 0x370 && glyph < 0x483) || (glyph >= 0x48a && glyph < 0x590) ||
                      (glyph >= 0x2010 && glyph < 0x2028) || (glyph >= 0x2030 && glyph < 0x2060) ||
                      (glyph >= 0x2190 && glyph < 0x2300) || (glyph >= 0x2500 && glyph < 0x2614) ||
                      (glyph >= 0x2800 && glyph < 0x2900);
  return control || !narrow ? U'?' : glyph;
}

}  // namespace

int width_of(std::string_view utf8) {
  int width = 0;
  for (; !utf8.empty(); ++width) take(utf8);
  return width;
}

int Grid::text(int column, int row, std::string_view utf8, Style style, int most) {
  const bool cut = width_of(utf8) > most;
  for (int left = cut ? most - 1 : most; left > 0 && !utf8.empty(); --left) put(column++, row, {take(utf8), style});
  if (cut && most > 0) put(column++, row, {U'…', style});
  return column;
}

void append_utf8(std::string& text, char32_t glyph) {
  const auto tail = [&](int shift) { text += static_cast<char>(0x80 | (glyph >> shift & 0x3f)); };
  if (glyph < 0x80) {
    text += static_cast<char>(glyph);
  } else if (glyph < 0x800) {
    text += static_cast<char>(0xc0 | glyph >> 6);
    tail(0);
  } else if (glyph < 0x10000) {
    text += static_cast<char>(0xe0 | glyph >> 12);
    tail(6);
    tail(0);
  } else {
    text += static_cast<char>(0xf0 | glyph >> 18);
    tail(12);
    tail(6);
    tail(0);
  }
}

}  // namespace posed::view
