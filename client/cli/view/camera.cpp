#include "client/cli/view/camera.h"

#include <algorithm>

namespace posed::view {
namespace {

constexpr double kHalfField = 0.279;  // rad, half the perspective's field of view
constexpr double kMargin = 1.06;      // around what is framed

}  // namespace

std::optional<Camera::Point> Camera::project(const Vec3& world) const {
  const Vec3 v = world - eye;
  const double depth = -glm::dot(v, back);
  if (perspective && depth < kNear) return std::nullopt;
  const double s = perspective ? scale / depth : scale;
  return Point{x0 + s * glm::dot(v, right), y0 - s * glm::dot(v, up), depth};
}

Camera::Rays Camera::rays() const {
  const Vec3 x = right / scale, y = -up / scale;
  const Vec3 to_centre = -x0 * x - y0 * y;
  if (perspective) return {eye, kZero, kZero, to_centre - back, x, y};
  return {eye + to_centre, x, y, -back, kZero, kZero};
}

void Box::add(const Vec3& point, double radius) {
  low = glm::min(low, point - radius);
  high = glm::max(high, point + radius);
}

Camera Cameras::camera(View view, int width, int height) const {
  Camera camera;
  const int shorter = std::max(1, std::min(width, height));
  camera.x0 = 0.5 * (width - 1);
  camera.y0 = 0.5 * (height - 1);
  camera.eye = centre_;
  camera.scale = shorter / span_;
  switch (view) {
    case View::top:
      camera.right = kY, camera.up = -kX, camera.back = kZ;
      break;
    case View::front:
      camera.right = kY, camera.up = kZ, camera.back = kX;
      break;
    case View::side:
      camera.right = kX, camera.up = kZ, camera.back = -kY;
      break;
    case View::perspective:
      camera.back = Vec3(std::cos(pitch_) * std::cos(yaw_), std::cos(pitch_) * std::sin(yaw_), std::sin(pitch_));
      camera.right = Vec3(-std::sin(yaw_), std::cos(yaw_), 0.0);
      camera.up = glm::cross(camera.back, camera.right);
      camera.eye = centre_ + distance_ * camera.back;
      camera.scale = 0.5 * shorter / std::tan(kHalfField);
      camera.perspective = true;
  }
  return camera;
}

void Cameras::fit(const Box& box, const std::array<std::array<int, 2>, 4>& panes) {
  if (box.empty()) return;
  centre_ = 0.5 * (box.low + box.high);
  const Vec3 half = 0.5 * (box.high - box.low);
  double span = 0.15, distance = 0.3;
  for (const View view : kViews) {
    const auto [width, height] = panes[static_cast<std::size_t>(view)];
    if (width <= 0 || height <= 0) continue;
    const Camera c = camera(view, width, height);
    const int shorter = std::min(width, height);
    for (int corner = 0; corner < 8; ++corner) {
      const Vec3 v = half * Vec3(corner & 1 ? 1 : -1, corner & 2 ? 1 : -1, corner & 4 ? 1 : -1);
      const double across =
          std::max(std::abs(glm::dot(v, c.right)) * shorter / width, std::abs(glm::dot(v, c.up)) * shorter / height);
      if (c.perspective)
        distance = std::max(distance, across / std::tan(kHalfField) + glm::dot(v, c.back));
      else
        span = std::max(span, 2.0 * across);
    }
  }
  span_ = span * kMargin;
  distance_ = distance * kMargin;
}

void Cameras::orbit(double yaw, double pitch) {
  yaw_ = std::remainder(yaw_ + yaw, 2.0 * 3.14159265358979323846);
  pitch_ = std::clamp(pitch_ + pitch, -1.5, 1.5);
}

void Cameras::pan(View view, int width, int height, double right, double up) {
  const Camera c = camera(view, width, height);
  const double metres = c.metres_a_dot(distance_);
  centre_ += metres * (right * c.right + up * c.up);
}

void Cameras::zoom(double factor) {
  span_ = std::clamp(span_ * factor, 0.05, 50.0);
  distance_ = std::clamp(distance_ * factor, 0.2, 50.0);
}

}  // namespace posed::view
