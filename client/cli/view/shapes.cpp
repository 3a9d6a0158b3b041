#include "client/cli/view/shapes.h"

#include <algorithm>

namespace posed::view {
namespace {

std::optional<Hit> meet_sphere(const Vec3& center, double radius, const Vec3& origin, const Vec3& direction) {
  const Vec3 o = origin - center;
  const double a = glm::dot(direction, direction), b = glm::dot(o, direction);
  const double h = b * b - a * (glm::dot(o, o) - radius * radius);
  if (h < 0.0) return std::nullopt;
  const double t = (-b - std::sqrt(h)) / a;
  return Hit{t, o + t * direction};
}

std::optional<Hit> nearer(const std::optional<Hit>& a, const std::optional<Hit>& b) {
  if (!a || !b) return a ? a : b;
  return a->depth < b->depth ? a : b;
}

std::optional<Hit> meet_capsule(const Shape& s, const Vec3& origin, const Vec3& direction) {
  const Vec3 axis = s.b - s.a, o = origin - s.a;
  const double aa = glm::dot(axis, axis), ad = glm::dot(axis, direction), ao = glm::dot(axis, o);
  const double a = aa * glm::dot(direction, direction) - ad * ad;
  if (a > 1e-12 * aa) {
    const double b = aa * glm::dot(o, direction) - ao * ad;
    const double c = aa * glm::dot(o, o) - ao * ao - s.radius * s.radius * aa;
    const double h = b * b - a * c;
    if (h < 0.0) return std::nullopt;
    const double t = (-b - std::sqrt(h)) / a;
    const double along = ao + t * ad;
    if (along > 0.0 && along < aa) return Hit{t, o + t * direction - axis * (along / aa)};
  }
  return nearer(meet_sphere(s.a, s.radius, origin, direction), meet_sphere(s.b, s.radius, origin, direction));
}

std::optional<Hit> meet_box(const Shape& s, const Vec3& origin, const Vec3& direction) {
  double enter = -1e300, leave = 1e300;
  int face = 0;
  for (int i = 0; i < 3; ++i) {
    const double o = origin[i] - s.a[i], d = direction[i];
    if (std::abs(d) < 1e-12) {
      if (std::abs(o) > s.b[i]) return std::nullopt;
      continue;
    }
    const double t = (-std::copysign(s.b[i], d) - o) / d;
    if (t > enter) enter = t, face = i;
    leave = std::min(leave, (std::copysign(s.b[i], d) - o) / d);
  }
  if (enter > leave) return std::nullopt;
  Vec3 normal = kZero;
  normal[face] = direction[face] > 0.0 ? -1.0 : 1.0;
  return Hit{enter, normal};
}

// Not thinner than `least`, m, anywhere.
Shape thickened(Shape shape, double least) {
  if (shape.kind == Shape::Kind::capsule)
    shape.radius = std::max(shape.radius, least);
  else
    shape.b = glm::max(shape.b, Vec3(least, least, least));
  return shape;
}

}  // namespace

std::optional<Hit> meet(const Shape& shape, const Vec3& origin, const Vec3& direction) {
  if (shape.kind == Shape::Kind::capsule) return meet_capsule(shape, origin, direction);
  if (shape.kind == Shape::Kind::box) return meet_box(shape, origin, direction);
  auto hit = meet_sphere(kZero, 1.0, (origin - shape.a) / shape.b, direction / shape.b);
  if (hit) hit->normal /= shape.b;
  return hit;
}

Ball around(const Shape& shape) {
  if (shape.kind == Shape::Kind::capsule)
    return {0.5 * (shape.a + shape.b), 0.5 * glm::length(shape.b - shape.a) + shape.radius};
  if (shape.kind == Shape::Kind::box) return {shape.a, glm::length(shape.b)};
  return {shape.a, std::max({shape.b.x, shape.b.y, shape.b.z})};
}

void draw_shape(Canvas& canvas, const Camera& camera, const Shape& thin, const Transform& world_from_shape, Layer layer,
                int part, const std::function<int(double)>& color) {
  const Ball thin_ball = around(thin);
  const auto center = camera.project(world_from_shape * thin_ball.center);
  if (!center) return;
  const double dot = camera.metres_a_dot(center->depth);
  const Shape shape = thickened(thin, 0.6 * dot);
  const double radius = around(shape).radius;
  // What is close to the eye is seen larger than by its middle's depth.
  const double nearest = camera.perspective ? std::max(center->depth - radius, Camera::kNear) : 1.0;
  const double reach = radius / camera.metres_a_dot(nearest) + 1.0;
  const auto clamp = [](double v, int high) { return static_cast<int>(std::clamp(v, -1.0, high + 1.0)); };
  const int left = std::max(0, clamp(std::floor(center->x - reach), canvas.width()));
  const int right = std::min(canvas.width() - 1, clamp(std::ceil(center->x + reach), canvas.width()));
  const int top = std::max(0, clamp(std::floor(center->y - reach), canvas.height()));
  const int bottom = std::min(canvas.height() - 1, clamp(std::ceil(center->y + reach), canvas.height()));

  const Transform shape_from_world = inverse(world_from_shape);
  const Quat turn = shape_from_world.rotation;
  Camera::Rays r = camera.rays();
  r.origin = shape_from_world * r.origin;
  for (Vec3* v : {&r.origin_x, &r.origin_y, &r.direction, &r.direction_x, &r.direction_y}) *v = turn * *v;
  const Vec3 light = turn * glm::normalize(0.7 * camera.back + 0.6 * camera.up - 0.4 * camera.right);
  for (int y = top; y <= bottom; ++y) {
    for (int x = left; x <= right; ++x) {
      const Vec3 direction =
          r.direction + static_cast<double>(x) * r.direction_x + static_cast<double>(y) * r.direction_y;
      const auto hit =
          meet(shape, r.origin + static_cast<double>(x) * r.origin_x + static_cast<double>(y) * r.origin_y, direction);
      if (!hit || (camera.perspective && hit->depth < Camera::kNear)) continue;
      const double length = glm::length(hit->normal);
      const double shine = length > 0.0 ? glm::dot(hit->normal, light) / length : 1.0;
      canvas.body(x, y, static_cast<float>(hit->depth), layer, color(std::max(0.0, shine)), part);
    }
  }
}

}  // namespace posed::view
