#include "client/cli/view/page.h"

#include <gtest/gtest.h>

#include "standing.h"

namespace posed::view {
namespace {

struct Picture {
  explicit Picture(Size wanted, Station s = test::standing(), Glyphs kind = Glyphs::braille)
      : size(wanted), station(std::move(s)), glyphs(kind) {
    desk.follow(station, size, 0.0);
  }
  std::string text(double now = 0.0) const {
    return plain_text(page(size, station, desk, {"tcp://there:1", {}}, glyphs, now));
  }
  Picture& press(Command command) {
    desk.act(command, false, station, size, 0.0);
    return *this;
  }
  Size size;
  Station station;
  Glyphs glyphs;
  Desk desk{"t"};
};

bool has(const std::string& text, std::string_view part) {
  return text.find(part) != std::string::npos;
}

std::size_t dots(const std::string& text) {
  std::size_t count = 0;
  for (std::size_t at = 0; (at = text.find("⣿", at)) != std::string::npos; at += 3) ++count;
  return count;
}

TEST(Page, FourFramedViewsWithTheirTitles) {
  for (const Size size : {Size{80, 24}, Size{200, 60}}) {
    const std::string text = Picture(size).text();
    for (const char* part : {"╭", "┬", "├", "┼", "┤", "┴", "╯", "1 Top", "2 Front", "3 Side", "4 Perspective", "x→ z↑"})
      EXPECT_TRUE(has(text, part)) << part << '\n' << text;
    EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), size.rows);
    EXPECT_GT(dots(text), 20u) << "the figure is solid\n" << text;
  }
}

TEST(Page, TheChosenGoalInPlainWords) {
  const std::string text = Picture({80, 24}).text();
  EXPECT_TRUE(has(text, "◆ 2/2 left arm  limited  447 mm  weight 10  step 10.0 mm")) << text;
  EXPECT_TRUE(has(text, "left elbow at its limit; 120 mm beyond reach")) << text;
}

TEST(Page, PinsSensorsAndCamerasAreMarkedInEachView) {
  const auto marked = [](const Station& station, std::string_view mark) {
    const std::string text = Picture({200, 60}, station).press(Command::list).text();
    std::size_t count = 0;
    for (std::size_t at = 0; (at = text.find(mark, at)) != std::string::npos; at += mark.size()) ++count;
    return count;
  };
  const Station before = test::standing();
  for (const char* mark : {"▪", "✶", "▸"}) EXPECT_EQ(marked(before, mark), 0u) << mark;

  Station pinned = test::standing();
  auto entities = std::make_shared<Entities>(*pinned.entities);
  entities->figures.at("body").entry.pins["trunk"] = {};
  pinned.entities = entities;
  EXPECT_EQ(marked(pinned, "▪"), 3u) << "at its touch point; from the side the hand's goal is before it";

  Station tracked = test::standing();
  tracked.sensors["liberty:1"] = {{0.3, 0.4, 1.0}, quat_identity()};
  EXPECT_EQ(marked(tracked, "✶"), 4u);

  Station filmed = test::standing();
  filmed.cameras.push_back({"main", {{0.5, -0.2, 0.8}, quat_identity()}, 0.9});
  EXPECT_EQ(marked(filmed, "▸"), 4u);
}

TEST(Page, ASegmentThatIsPinnedInAnotherFigureThanWeKnowIsPassedOver) {
  Station station = test::standing();
  auto entities = std::make_shared<Entities>(*station.entities);
  entities->figures.at("body").entry.pins["trunk"] = {};
  entities->figures.at("body").document.segments.pop_back();
  station.entities = entities;
  EXPECT_FALSE(has(Picture({200, 60}, station).text(), "▪"));
}

TEST(Page, AListOfGoalsWhereThereIsRoom) {
  EXPECT_TRUE(has(Picture({200, 60}).text(), " Goals "));
  EXPECT_FALSE(has(Picture({80, 24}).text(), " Goals "));
  EXPECT_FALSE(has(Picture({200, 60}).press(Command::list).text(), " Goals "));
}

TEST(Page, MeterAndLossOfTheConnection) {
  Picture picture({100, 24});
  EXPECT_TRUE(has(picture.text(), "still")) << picture.text();
  picture.station.rate_hz = 60.0;
  picture.station.age_ms = 3.4;
  picture.station.lost = 12;
  EXPECT_TRUE(has(picture.text(), "60 Hz  age 3 ms  lost 12  rev 7  tcp://there:1")) << picture.text();
  picture.station.lost_why = "nothing listens there";
  EXPECT_TRUE(has(picture.text(), "NO CONNECTION, trying again: nothing listens there")) << picture.text();
}

TEST(Page, OneViewAlone) {
  const std::string text = Picture({80, 24}).press(Command::front).press(Command::front).text();
  EXPECT_TRUE(has(text, "2 Front") && !has(text, "1 Top")) << text;
}

TEST(Page, TheHelpSheetFitsTheSmallTerminalWhole) {
  const std::string text = Picture({80, 24}).press(Command::help).text();
  for (const Help& help : help_sheet()) EXPECT_TRUE(has(text, help.says)) << help.says << '\n' << text;
}

TEST(Page, AsciiIsAscii) {
  Picture picture({80, 24}, test::standing(), Glyphs::ascii);
  for (const char byte : picture.text()) EXPECT_LT(static_cast<unsigned char>(byte), 0x80);
}

TEST(Page, AnySizeAndAnyStationMakesAPage) {
  for (int columns = 1; columns < 60; columns += 3)
    for (int rows = 1; rows < 30; rows += 2) Picture({columns, rows}).press(Command::help).text();
  EXPECT_TRUE(has(Picture({30, 8}).text(), "too small")) << Picture({30, 8}).text();
  EXPECT_TRUE(has(Picture({80, 24}, Station{}).text(), "waiting for the first pose"));
  Station empty;
  empty.pose = std::make_shared<const proto::PoseData>();
  EXPECT_TRUE(has(Picture({80, 24}, empty).text(), "posectl scene new"));
}

TEST(Page, AFigureWhoseSegmentsAreNotKnownYetIsLeftOut) {
  Station station = test::standing();
  auto pose = std::make_shared<proto::PoseData>(*station.pose);
  pose->figures[0].world_from_segment.resize(1);
  station.pose = pose;
  EXPECT_EQ(dots(Picture({80, 24}, station).text()), 0u);
}

}  // namespace
}  // namespace posed::view
