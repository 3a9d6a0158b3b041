#include "server/calibration/rigid_fit.h"

#include "server/calibration/symmetric.h"

namespace posed::calibration {
namespace {

constexpr double kMaxPlace = 1e6;      // m
constexpr double kLeastSpread = 0.01;  // m, of the points, along the second of their axes
constexpr double kLeastShare = 0.02;   // and of that along the first

Matrix<3> scatter(const std::vector<AlignedPoint>& points, const Vec3& mean, Vec3 AlignedPoint::*part) {
  Matrix<3> m{};
  for (const AlignedPoint& p : points) {
    const Vec3 d = p.*part - mean;
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 3; ++j) m[static_cast<std::size_t>(i)][static_cast<std::size_t>(j)] += d[i] * d[j];
    }
  }
  return m;
}

// The points must span a plane: else the turn about their line is anybody's.
Status check_span(const std::vector<AlignedPoint>& points, const Vec3& mean, Vec3 AlignedPoint::*part,
                  const char* where) {
  const Eigen<3> axes = eigen(scatter(points, mean, part));
  const auto n = static_cast<double>(points.size());
  const double second = std::sqrt(std::max(axes.values[1], 0.0) / n), first = std::sqrt(axes.values[2] / n);
  if (second >= kLeastSpread && second >= kLeastShare * first) return Ok{};
  return Error{"invalid_params", std::string("the points, as ") + where + ", coincide or lie on a line", "/points",
               "touch points that span a triangle, some tenths of a metre apart"};
}

Status check_numbers(const std::vector<AlignedPoint>& points) {
  for (std::size_t i = 0; i < points.size(); ++i) {
    for (int k = 0; k < 3; ++k) {
      const bool source = std::abs(points[i].source[k]) <= kMaxPlace;
      if (source && std::abs(points[i].world[k]) <= kMaxPlace) continue;
      return Error{"out_of_range", "a point is too far away",
                   "/points/" + std::to_string(i) + (source ? "/world/" : "/source/") + std::to_string(k), "in metres"};
    }
  }
  return Ok{};
}

}  // namespace

Result<RigidFit> fit_rigid(std::vector<AlignedPoint> points) {
  if (points.size() < 3)
    return Error{"invalid_params", "an alignment needs three points or more", "/points",
                 "touch more points whose place in the world you know"};
  if (const Status good = check_numbers(points); !good) return good.error();
  Vec3 source = kZero, world = kZero;
  for (const AlignedPoint& p : points) {
    source += p.source / static_cast<double>(points.size());
    world += p.world / static_cast<double>(points.size());
  }
  if (const Status spans = check_span(points, world, &AlignedPoint::world, "the world has them"); !spans)
    return spans.error();
  if (const Status spans = check_span(points, source, &AlignedPoint::source, "the tracker has them"); !spans)
    return spans.error();

  double s[3][3] = {};
  for (const AlignedPoint& p : points) {
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 3; ++j) s[i][j] += (p.source[i] - source[i]) * (p.world[j] - world[j]);
    }
  }
  // The quaternion of the turn, w x y z, is the eigenvector of the greatest eigenvalue.
  const Matrix<4> n{{{s[0][0] + s[1][1] + s[2][2], s[1][2] - s[2][1], s[2][0] - s[0][2], s[0][1] - s[1][0]},
                     {s[1][2] - s[2][1], s[0][0] - s[1][1] - s[2][2], s[0][1] + s[1][0], s[2][0] + s[0][2]},
                     {s[2][0] - s[0][2], s[0][1] + s[1][0], -s[0][0] + s[1][1] - s[2][2], s[1][2] + s[2][1]},
                     {s[0][1] - s[1][0], s[2][0] + s[0][2], s[1][2] + s[2][1], -s[0][0] - s[1][1] + s[2][2]}}};
  const auto q = eigen(n).vectors[3];
  RigidFit fit;
  fit.world_from_source.rotation = same_sign(quat_identity(), glm::normalize(Quat(q[0], q[1], q[2], q[3])));
  fit.world_from_source.position = world - fit.world_from_source.rotation * source;
  double sum = 0.0;
  for (AlignedPoint& p : points) {
    p.residual_m = glm::length(fit.world_from_source * p.source - p.world);
    sum += p.residual_m * p.residual_m;
  }
  fit.residual_m = std::sqrt(sum / static_cast<double>(points.size()));
  fit.points = std::move(points);
  return fit;
}

}  // namespace posed::calibration
