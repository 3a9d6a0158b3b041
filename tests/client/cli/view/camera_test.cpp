#include "client/cli/view/camera.h"

#include <gtest/gtest.h>

#include "client/cli/view/shapes.h"

namespace posed::view {
namespace {

constexpr int kWidth = 80, kHeight = 40;

Camera camera_of(View view) {
  return Cameras().camera(view, kWidth, kHeight);
}

TEST(Camera, AxesLieAsThePaperHasThem) {
  const auto shift = [](View view, Vec3 by) {
    const Camera c = camera_of(view);
    const auto a = c.project({0, 0, 1}), b = c.project(Vec3(0, 0, 1) + 0.1 * by);
    return Vec3(b->x - a->x, a->y - b->y, a->depth - b->depth);  // right, up, nearer
  };
  const auto points_to = [](const Vec3& v, int axis) { return v[axis] > 0.09 && glm::length(v) - v[axis] < 1e-9; };
  EXPECT_TRUE(points_to(shift(View::top, kY), 0));
  EXPECT_TRUE(points_to(-shift(View::top, kX), 1));
  EXPECT_TRUE(points_to(shift(View::top, kZ), 2));
  EXPECT_TRUE(points_to(shift(View::front, kY), 0));
  EXPECT_TRUE(points_to(shift(View::front, kZ), 1));
  EXPECT_TRUE(points_to(shift(View::front, kX), 2));
  EXPECT_TRUE(points_to(shift(View::side, kX), 0));
  EXPECT_TRUE(points_to(shift(View::side, kZ), 1));
  EXPECT_TRUE(points_to(-shift(View::side, kY), 2));
  EXPECT_GT(shift(View::perspective, kZ).y, 0.0);
}

TEST(Camera, RaysGoThroughWhatTheyShow) {
  for (const View view : kViews) {
    const Camera c = camera_of(view);
    for (const Vec3 point : {Vec3(0.3, -0.2, 1.1), Vec3(0, 0, 0), Vec3(-0.5, 0.4, 1.8)}) {
      const auto seen = c.project(point);
      ASSERT_TRUE(seen);
      const Camera::Rays r = c.rays();
      const Vec3 origin = r.origin + seen->x * r.origin_x + seen->y * r.origin_y;
      const Vec3 direction = r.direction + seen->x * r.direction_x + seen->y * r.direction_y;
      EXPECT_LT(glm::length(origin + seen->depth * direction - point), 1e-9) << static_cast<int>(view);
    }
  }
}

TEST(Camera, WhatIsBehindThePerspectiveEyeIsNotSeen) {
  const Camera c = camera_of(View::perspective);
  EXPECT_FALSE(c.project(c.eye + c.back));
  EXPECT_TRUE(camera_of(View::top).project({0, 0, 100}));
}

TEST(Cameras, AFramedBoxIsSeenWholeAndFillsThePane) {
  Box box;
  box.add({-0.3, -0.9, 0.0});
  box.add({0.3, 0.9, 1.8});
  Cameras cameras;
  cameras.fit(box, {{{kWidth, kHeight}, {kWidth, kHeight}, {kWidth, kHeight}, {kWidth, kHeight}}});
  for (const View view : kViews) {
    const Camera c = cameras.camera(view, kWidth, kHeight);
    double highest = 0.0;
    for (int corner = 0; corner < 8; ++corner) {
      const Vec3 at(corner & 1 ? 0.3 : -0.3, corner & 2 ? 0.9 : -0.9, corner & 4 ? 1.8 : 0.0);
      const auto seen = c.project(at);
      ASSERT_TRUE(seen);
      EXPECT_TRUE(seen->x >= 0 && seen->x < kWidth && seen->y >= 0 && seen->y < kHeight) << static_cast<int>(view);
      highest = std::max(highest, std::abs(seen->y - c.y0));
    }
    if (view != View::top) {
      EXPECT_GT(highest, 0.35 * kHeight) << static_cast<int>(view);
    }
  }
}

TEST(Cameras, ZoomIsOfAllFourAndPanOfThePlane) {
  Cameras cameras;
  const double before = cameras.camera(View::front, kWidth, kHeight).scale;
  cameras.zoom(0.5);
  EXPECT_NEAR(cameras.camera(View::side, kWidth, kHeight).scale, 2.0 * before, 1e-9);
  const Vec3 eye = cameras.camera(View::front, kWidth, kHeight).eye;
  cameras.pan(View::front, kWidth, kHeight, 2.0 * before, 0.0);
  EXPECT_LT(glm::length(cameras.camera(View::front, kWidth, kHeight).eye - eye - kY), 1e-9);
  for (int i = 0; i < 1000; ++i) cameras.zoom(0.5), cameras.orbit(1.0, 1.0);
  EXPECT_TRUE(finite(cameras.camera(View::perspective, kWidth, kHeight).eye));
}

TEST(Shapes, RaysMeetThemWhereTheyAre) {
  const Vec3 from(-5, 0, 0);
  const Shape sphere{Shape::Kind::ellipsoid, kZero, {1, 2, 3}, 0};
  EXPECT_NEAR(meet(sphere, from, kX)->depth, 4.0, 1e-9);
  EXPECT_FALSE(meet(sphere, from + 2.1 * kY, kX));
  const Shape box{Shape::Kind::box, {1, 0, 0}, {0.5, 1, 1}, 0};
  EXPECT_NEAR(meet(box, from, kX)->depth, 5.5, 1e-9);
  EXPECT_EQ(meet(box, from, kX)->normal, -kX);
  EXPECT_FALSE(meet(box, from + 1.1 * kZ, kX));
  const Shape upright{Shape::Kind::capsule, {0, 0, -1}, {0, 0, 1}, 0.25};
  EXPECT_NEAR(meet(upright, from, kX)->depth, 4.75, 1e-9);
  EXPECT_NEAR(meet(upright, from + 1.0 * kZ, kX)->depth, 4.75, 1e-9);
  EXPECT_FALSE(meet(upright, from + 1.3 * kZ, kX));
  const Shape along{Shape::Kind::capsule, {-1, 0, 0}, {1, 0, 0}, 0.25};
  EXPECT_NEAR(meet(along, from, kX)->depth, 3.75, 1e-9);
  EXPECT_FALSE(meet(along, from + 0.3 * kY, kX));
  const Shape point{Shape::Kind::capsule, kZero, kZero, 0.5};
  EXPECT_NEAR(meet(point, from, kX)->depth, 4.5, 1e-9);
}

TEST(Shapes, WhatIsThinnerThanADotIsSeenAllTheSame) {
  const Camera c = camera_of(View::front);
  Canvas canvas(kWidth / 2, kHeight / 4);
  const Shape hair{Shape::Kind::capsule, {0, 0, 0.3}, {0, 0, 1.5}, 1e-4};
  draw_shape(canvas, c, hair, {}, Layer::figure, 1, [](double) { return 7; });
  Grid grid({kWidth / 2, kHeight / 4});
  canvas.draw(grid, 0, 0, Glyphs::braille);
  int seen = 0;
  for (int row = 0; row < kHeight / 4; ++row)
    for (int column = 0; column < kWidth / 2; ++column) seen += grid.at(column, row).style.fg == 7;
  EXPECT_GE(seen, 5);
}

}  // namespace
}  // namespace posed::view
