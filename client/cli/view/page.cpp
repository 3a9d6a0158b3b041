#include "client/cli/view/page.h"

#include <algorithm>

#include "client/cli/view/palette.h"
#include "client/cli/view/scenery.h"
#include "client/cli/view/words.h"
#include "proto/codec.h"

namespace posed::view {
namespace {

struct Title {
  const char *name, *axes, *ascii_axes;
};
const Title& title_of(View view) {
  static constexpr std::array<Title, 4> kTitles{{{"1 Top", "y→ x↓", "y> xv"},
                                                 {"4 Perspective", "", ""},
                                                 {"2 Front", "y→ z↑", "y> z^"},
                                                 {"3 Side", "x→ z↑", "x> z^"}}};
  return kTitles[static_cast<std::size_t>(view)];
}

class Page {
 public:
  Page(Size size, const Station& station, const Desk& desk, Glyphs glyphs, double now)
      : grid(size), station_(station), desk_(desk), ascii_(glyphs == Glyphs::ascii), glyphs_(glyphs), now_(now) {}

  Grid grid;

  void draw(const Meter& meter) {
    const Layout l = layout(grid.size(), desk_.alone(), desk_.view(), desk_.list());
    box(l.frame);
    if (l.split_column > 0) split(l);
    std::map<std::string, Vec3> moved;
    for (const auto& [id, pending] : desk_.pending()) {
      const Vec3* position = position_of(pending.goal.payload);
      if (position != nullptr && pending.goal.relative_to.kind == GoalBase::Kind::world) moved[id] = *position;
    }
    for (const View view : kViews) {
      const auto i = static_cast<std::size_t>(view);
      const Area& a = l.panes[i];
      if (a.empty()) continue;
      const auto dots = l.dots()[i];
      draw_scenery(grid, {a.column, a.row, {a.columns, a.rows}, view, desk_.cameras().camera(view, dots[0], dots[1])},
                   station_, desk_.goal(), moved, glyphs_);
      title(a, view);
    }
    if (!station_.pose) middle(l.frame, "waiting for the first pose");
    if (station_.pose && station_.pose->figures.empty())
      middle(l.frame, "there is no figure: posectl scene new standing");
    meters(l.frame, meter);
    if (!l.list.empty()) list(l.list);
    words(l.words);
    if (desk_.help()) help();
  }

 private:
  char32_t lines(char32_t line, char32_t ascii) const { return ascii_ ? ascii : line; }

  void row(int column, int line, int columns, char32_t glyph, Style style) {
    for (int i = 0; i < columns; ++i) grid.put(column + i, line, {glyph, style});
  }
  void column(int at, int line, int rows, char32_t glyph, Style style) {
    for (int i = 0; i < rows; ++i) grid.put(at, line + i, {glyph, style});
  }

  void box(const Area& a, Style style = kFrame) {
    const int right = a.column + a.columns - 1, bottom = a.row + a.rows - 1;
    row(a.column, a.row, a.columns, lines(U'─', U'-'), style);
    row(a.column, bottom, a.columns, lines(U'─', U'-'), style);
    column(a.column, a.row, a.rows, lines(U'│', U'|'), style);
    column(right, a.row, a.rows, lines(U'│', U'|'), style);
    grid.put(a.column, a.row, {lines(U'╭', U'+'), style});
    grid.put(right, a.row, {lines(U'╮', U'+'), style});
    grid.put(a.column, bottom, {lines(U'╰', U'+'), style});
    grid.put(right, bottom, {lines(U'╯', U'+'), style});
  }

  void split(const Layout& l) {
    row(1, l.split_row, l.frame.columns - 2, lines(U'─', U'-'), kFrame);
    column(l.split_column, 1, l.frame.rows - 2, lines(U'│', U'|'), kFrame);
    grid.put(l.split_column, 0, {lines(U'┬', U'+'), kFrame});
    grid.put(l.split_column, l.frame.rows - 1, {lines(U'┴', U'+'), kFrame});
    grid.put(0, l.split_row, {lines(U'├', U'+'), kFrame});
    grid.put(l.frame.columns - 1, l.split_row, {lines(U'┤', U'+'), kFrame});
    grid.put(l.split_column, l.split_row, {lines(U'┼', U'+'), kFrame});
  }

  void title(const Area& a, View view) {
    const bool active = view == desk_.view();
    const Style style = active ? kFrameActive : kFrame;
    if (active) row(a.column, a.row - 1, a.columns, lines(U'─', U'-'), style);
    const Title& t = title_of(view);
    int at = grid.text(a.column + 1, a.row - 1, std::string(" ") + t.name + ' ', active ? kTitleActive : kTitle);
    const char* axes = ascii_ ? t.ascii_axes : t.axes;
    if (*axes != '\0' && a.columns >= 30) grid.text(at + 1, a.row - 1, std::string(" ") + axes + ' ', kDim);
  }

  void middle(const Area& a, const std::string& text) {
    grid.text(a.column + (a.columns - width_of(text)) / 2, a.row + a.rows / 2, ' ' + text + ' ', kStrong);
  }

  // In the frame's lower edge.
  void meters(const Area& a, const Meter& meter) {
    const int line = a.row + a.rows - 1;
    int at = a.column + 2;
    const auto say = [&](const std::string& text, Style style) {
      if (at + width_of(text) + 2 < a.column + a.columns) at = grid.text(at, line, ' ' + text + ' ', style);
    };
    if (!station_.lost_why.empty()) {
      grid.text(at, line, " NO CONNECTION, trying again: " + station_.lost_why + ' ', kBad, a.columns - 4);
      return;
    }
    say(station_.rate_hz >= 0.5 ? std::to_string(std::lround(station_.rate_hz)) + " Hz" : "still", kTitle);
    if (station_.age_ms) say("age " + milliseconds(*station_.age_ms), *station_.age_ms > 100.0 ? kWarning : kDim);
    if (meter.terminal_ms)
      say("terminal " + milliseconds(*meter.terminal_ms), *meter.terminal_ms > 250.0 ? kWarning : kDim);
    say("lost " + std::to_string(station_.lost), station_.lost > 0 ? kWarning : kDim);
    if (station_.pose) say("rev " + std::to_string(station_.pose->revision), kDim);
    say(meter.where, kDim);
    const std::string help = "? help";
    if (at + width_of(help) + 4 < a.column + a.columns)
      grid.text(a.column + a.columns - width_of(help) - 4, line, ' ' + help + ' ', kKey);
  }

  static std::string milliseconds(double ms) {
    const int shown = static_cast<int>(std::lround(std::clamp(ms, 0.0, 1e6)));
    return (ms < 1.0 ? "<1" : std::to_string(shown)) + " ms";
  }

  const proto::GoalFrame* frame_of(const std::string& id) const {
    for (const proto::FigurePose& figure : station_.pose ? station_.pose->figures : kNone) {
      for (const proto::GoalFrame& goal : figure.goals)
        if (goal.id == id) return &goal;
    }
    return nullptr;
  }

  std::string mark(bool chosen) const { return ascii_ ? (chosen ? "X" : "+") : (chosen ? "◆" : "◇"); }

  // The chosen goal, and what holds it, or what there is to say.
  void words(int line) {
    const auto& goals = station_.entities->goals;
    const Goal* goal = desk_.wanted(desk_.goal(), station_);
    const int most = grid.size().columns - 2;
    if (goal == nullptr) {
      grid.text(1, line, "no goals; posectl goal set right_hand 0.5 -0.3 1.2 makes one", kDim, most);
    } else {
      const proto::GoalFrame* frame = frame_of(goal->id);
      const auto at = std::find_if(goals.begin(), goals.end(), [&](const auto& g) { return g.goal.id == goal->id; });
      const Style color{color_of(frame != nullptr ? frame->state : GoalState::off), -1, true};
      int end = grid.text(1, line, mark(true) + ' ', color);
      end =
          grid.text(end, line, std::to_string(at - goals.begin() + 1) + '/' + std::to_string(goals.size()) + ' ', kDim);
      end = grid.text(end, line, goal_name(goal->id), kStrong, std::max(12, most - 56));
      if (kind_of(goal->payload) != GoalKind::position)
        end = grid.text(end, line, std::string("  ") + name_of(kind_of(goal->payload)), kDim);
      if (frame != nullptr) {
        end = grid.text(end, line, "  " + std::string(proto::name_of(frame->state)), color);
        end = grid.text(end, line, "  " + metres_text(frame->error), kPlain);
      }
      end = grid.text(end, line, "  weight " + weight_text(goal->weight), kPlain, most - end);
      end = grid.text(end, line, "  step " + metres_text(desk_.step()), kDim, most - end);
    }
    if (const Note* note = desk_.note(now_)) {
      grid.text(1, line + 1, note->text, note->bad ? kBad : kGood, most);
    } else if (goal != nullptr) {
      grid.text(1, line + 1, why(*goal), kDim, most);
    }
  }

  std::string why(const Goal& goal) const {
    const proto::GoalFrame* frame = frame_of(goal.id);
    std::string text = frame == nullptr ? "" : causes_text(frame->causes);
    const auto add = [&](const std::string& more) { text += (text.empty() ? "" : "; ") + more; };
    if (const Binding* binding = station_.entities->bound_to(goal.id)) add("led by " + binding->sensor);
    const proto::GoalResult* known = station_.entities->goal(goal.id);
    if (known != nullptr && !known->held_by.empty()) add(known->held_by + " has it in hand");
    if (!goal.enabled) add("switched off (o switches it on)");
    if (!goal.label.empty()) add(goal.label);
    return text.empty() ? "arrows nudge it, [ ] change its weight, n the next goal" : text;
  }

  void list(const Area& a) {
    box(a);
    grid.text(a.column + 2, a.row, " Goals ", kTitle);
    const auto& goals = station_.entities->goals;
    const int room = a.rows - 2;
    const auto chosen =
        std::find_if(goals.begin(), goals.end(), [&](const auto& g) { return g.goal.id == desk_.goal(); });
    // Two lines a goal where they all fit.
    const int height = 2 * static_cast<int>(goals.size()) <= room ? 2 : 1;
    const int shown = room / height;
    const int first = std::max(0, static_cast<int>(chosen - goals.begin()) - shown + 1);
    for (int i = 0; i < shown && first + i < static_cast<int>(goals.size()); ++i)
      entry(a, a.row + 1 + i * height, *desk_.wanted(goals[static_cast<std::size_t>(first + i)].goal.id, station_),
            height);
  }

  void entry(const Area& a, int line, const Goal& goal, int height) {
    const bool chosen = goal.id == desk_.goal();
    const proto::GoalFrame* frame = frame_of(goal.id);
    const Style color{color_of(frame != nullptr ? frame->state : GoalState::off), -1, chosen};
    grid.text(a.column + 2, line, mark(chosen), color);
    grid.text(a.column + 4, line, goal_name(goal.id), chosen ? kStrong : kPlain, a.columns - 23);
    const std::string error = frame != nullptr ? metres_text(frame->error) : "";
    grid.text(a.column + a.columns - 10 - width_of(error), line, error, color);
    const std::string weight = weight_text(goal.weight);
    grid.text(a.column + a.columns - 2 - width_of(weight), line, weight, kDim);
    if (height < 2) return;
    std::string more = frame != nullptr ? std::string(proto::name_of(frame->state)) : "";
    if (kind_of(goal.payload) != GoalKind::position) more = std::string(name_of(kind_of(goal.payload))) + ", " + more;
    const std::string causes = frame != nullptr ? causes_text(frame->causes) : "";
    if (!causes.empty()) more += ", " + causes;
    grid.text(a.column + 4, line + 1, more, kDim, a.columns - 6);
  }

  void help() {
    const auto& sheet = help_sheet();
    int keys = 0, says = 0;
    for (const Help& h : sheet) keys = std::max(keys, width_of(h.keys)), says = std::max(says, width_of(h.says));
    const Size size = grid.size();
    const int columns = std::min(size.columns, keys + says + 7);
    const int rows = std::min(size.rows, static_cast<int>(sheet.size()) + 2);
    const Area a{(size.columns - columns) / 2, (size.rows - rows) / 2, columns, rows};
    for (int i = 0; i < rows; ++i) row(a.column, a.row + i, columns, U' ', kPlain);
    box(a, kFrameActive);
    grid.text(a.column + 2, a.row, " Keys ", kTitleActive);
    for (int i = 0; i < rows - 2; ++i) {
      const Help& h = sheet[static_cast<std::size_t>(i)];
      grid.text(a.column + 2, a.row + 1 + i, h.keys, kKey);
      grid.text(a.column + 4 + keys, a.row + 1 + i, h.says, kPlain, columns - keys - 6);
    }
  }

  inline static const std::vector<proto::FigurePose> kNone;
  const Station& station_;
  const Desk& desk_;
  bool ascii_;
  Glyphs glyphs_;
  double now_;
};

}  // namespace

Grid page(Size size, const Station& station, const Desk& desk, const Meter& meter, Glyphs glyphs, double now) {
  if (size.columns < kLeast.columns || size.rows < kLeast.rows) {
    Grid grid(size);
    grid.text(0, 0, "too small: 40 x 12 is the least", kBad, size.columns);
    return grid;
  }
  Page made(size, station, desk, glyphs, now);
  made.draw(meter);
  return std::move(made.grid);
}

std::string plain_text(const Grid& grid) {
  std::string text;
  for (int row = 0; row < grid.size().rows; ++row) {
    std::string line;
    for (int column = 0; column < grid.size().columns; ++column) append_utf8(line, grid.at(column, row).glyph);
    line.erase(line.find_last_not_of(' ') + 1);
    text += line + '\n';
  }
  return text;
}

}  // namespace posed::view
