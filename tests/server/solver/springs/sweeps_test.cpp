#include "server/solver/springs/sweeps.h"

#include <gtest/gtest.h>

#include <vector>

#include "server/solver/kinematics.h"
#include "tests/support/freedoms.h"
#include "tests/support/spring_figures.h"

namespace posed {
namespace {

TEST(Sweeps, ArcTangentsAreThoseOfTheLibrary) {
  std::vector<double> y, x;
  for (const double a : {0.0, 1e-300, 1e-12, 1e-6, 0.1, 0.5, 1.0, 1.0 + 1e-12, 3.0, 1e6, 1e12}) {
    for (const double b : {0.0, 1e-300, 1e-9, 0.3, 1.0, 2.0, 1e8}) {
      for (const double signs : {1.0, -1.0}) {
        y.insert(y.end(), {a, -a}), x.insert(x.end(), {signs * b, signs * b});
      }
    }
  }
  const std::size_t n = y.size();
  for (auto* v : {&y, &x}) v->resize(springs::padded(n));
  std::vector<double> angle(springs::padded(n));
  springs::arc_tangents(y.data(), x.data(), n, angle.data());
  for (std::size_t i = 0; i < n; ++i) {
    if (y[i] == 0.0 && x[i] == 0.0) {
      EXPECT_EQ(angle[i], 0.0) << i;
    } else if (y[i] != 0.0 || x[i] > 0.0) {
      EXPECT_NEAR(angle[i], std::atan2(y[i], x[i]), 1e-15) << y[i] << " over " << x[i];
    } else {
      EXPECT_NEAR(std::abs(angle[i]), M_PI, 1e-15) << y[i] << " over " << x[i];
    }
  }
}

TEST(Sweeps, HalfSinesAreThoseOfTheLibrary) {
  std::vector<double> angle;
  for (double a = -7.0; a < 7.0; a += 0.0137) angle.push_back(a);
  const std::size_t n = angle.size();
  angle.resize(springs::padded(n));
  std::vector<double> sine(angle.size()), cosine(angle.size());
  springs::half_sines(angle.data(), n, sine.data(), cosine.data());
  for (std::size_t i = 0; i < n; ++i) {
    EXPECT_NEAR(sine[i], std::sin(0.5 * angle[i]), 1e-15) << angle[i];
    EXPECT_NEAR(cosine[i], std::cos(0.5 * angle[i]), 1e-15) << angle[i];
  }
}

TEST(Sweeps, SegmentsAreWherePlainKinematicsPutsThem) {
  std::mt19937 random(141);
  for (int n = 0; n < 200; ++n) {
    const auto tree = test::build(n % 2 == 0 ? test::random_limited_figure(random, 12) : test::all_joints());
    const auto q = test::random_q(random, *tree);
    std::vector<Transform> plain(static_cast<std::size_t>(tree->size())), swept(plain);
    forward_kinematics(*tree, q, plain);
    springs::place_segments(*tree, q, swept);
    for (std::size_t i = 0; i < plain.size(); ++i) {
      EXPECT_LT(glm::length(plain[i].position - swept[i].position), 1e-13) << n << " " << i;
      for (int k = 0; k < 4; ++k) EXPECT_NEAR(plain[i].rotation[k], swept[i].rotation[k], 1e-14) << n << " " << i;
    }
  }
}

}  // namespace
}  // namespace posed
