#include "client/cli/view/layout.h"

namespace posed::view {
namespace {

constexpr int kWords = 2;  // lines at the bottom
constexpr int kListColumns = 40;
constexpr int kListFrom = 120;  // columns of the page from which there is room for the list

}  // namespace

std::array<std::array<int, 2>, 4> Layout::dots() const {
  std::array<std::array<int, 2>, 4> all{};
  for (std::size_t i = 0; i < 4; ++i) all[i] = {panes[i].columns * 2, panes[i].rows * 4};
  return all;
}

Layout layout(Size size, bool alone, View view, bool list) {
  Layout l;
  const bool listed = list && size.columns >= kListFrom;
  l.words = size.rows - kWords;
  l.frame = {0, 0, size.columns - (listed ? kListColumns : 0), l.words};
  if (listed) l.list = {l.frame.columns, 0, kListColumns, l.words};
  const int columns = l.frame.columns - 2, rows = l.frame.rows - 2;
  if (alone) {
    l.panes[static_cast<std::size_t>(view)] = {1, 1, columns, rows};
    return l;
  }
  const int left = (columns - 1) / 2, top = (rows - 1) - (rows - 1) / 2;
  l.split_column = 1 + left;
  l.split_row = 1 + top;
  const int right = columns - left - 1, bottom = rows - top - 1;
  l.panes[static_cast<std::size_t>(View::top)] = {1, 1, left, top};
  l.panes[static_cast<std::size_t>(View::perspective)] = {l.split_column + 1, 1, right, top};
  l.panes[static_cast<std::size_t>(View::front)] = {1, l.split_row + 1, left, bottom};
  l.panes[static_cast<std::size_t>(View::side)] = {l.split_column + 1, l.split_row + 1, right, bottom};
  return l;
}

}  // namespace posed::view
