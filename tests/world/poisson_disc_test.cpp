#include "world/poisson_disc.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

namespace avoidbench {
namespace {

struct Field {
  Eigen::Vector2d size_m;
  double radius_m;
  std::uint64_t seed;
};

double squared_distance_to_nearest(const std::vector<Eigen::Vector2d>& points,
                                   const Eigen::Vector2d& place) {
  double least = std::numeric_limits<double>::infinity();
  for (const Eigen::Vector2d& point : points)
    least = std::min(least, (point - place).squaredNorm());
  return least;
}

class PoissonDisc : public testing::TestWithParam<Field> {
 protected:
  std::vector<Eigen::Vector2d> sample() const {
    RandomStream random(GetParam().seed);
    return poisson_disc(GetParam().size_m, GetParam().radius_m, random);
  }
};

TEST_P(PoissonDisc, KeepsTheLeastDistanceInsideTheArea) {
  const Field& field = GetParam();
  const auto points = sample();
  for (std::size_t i = 0; i < points.size(); ++i) {
    EXPECT_TRUE((points[i].array() >= 0.0).all() &&
                (points[i].array() < field.size_m.array()).all());
    for (std::size_t j = 0; j < i; ++j) {
      ASSERT_GE((points[i] - points[j]).norm(), field.radius_m * (1.0 - 1e-12)) << i << ' ' << j;
    }
  }
}

TEST_P(PoissonDisc, HasNoRoomForOneMorePoint) {
  const Field& field = GetParam();
  const auto points = sample();
  constexpr int kSteps = 400;
  for (int row = 0; row <= kSteps; ++row) {
    for (int column = 0; column <= kSteps; ++column) {
      const Eigen::Vector2d place(field.size_m.x() * column / kSteps,
                                  field.size_m.y() * row / kSteps);
      ASSERT_LT(squared_distance_to_nearest(points, place),
                field.radius_m * field.radius_m * (1.0 + 1e-8))
          << place.transpose();
    }
  }
}

TEST_P(PoissonDisc, IsTheSameAgain) { EXPECT_EQ(sample(), sample()); }

INSTANTIATE_TEST_SUITE_P(Fields, PoissonDisc,
                         testing::Values(Field{{40.0, 40.0}, 3.5, 1}, Field{{40.0, 40.0}, 2.3, 2},
                                         Field{{19.0, 29.0}, 1.7, 3}, Field{{15.0, 60.0}, 6.0, 4},
                                         Field{{3.0, 1.0}, 5.0, 5}));

TEST(PoissonDiscDensity, IsThatOfAMaximalField) {
  // Maximal random fields hold 0.63–0.76 points per radius² (hexagonal packing: 1.15); edges add a
  // little.
  RandomStream random(7);
  const double count = static_cast<double>(poisson_disc({160.0, 160.0}, 2.3, random).size()) * 2.3 *
                       2.3 / (160.0 * 160.0);
  EXPECT_GT(count, 0.63);
  EXPECT_LT(count, 0.78);
}

// Another way of drawing them would give a maximal field, too, but not the maps that were
// published.
TEST(PoissonDiscPoints, AreThoseOfEveryMachine) {
  RandomStream random(11);
  const auto points = poisson_disc({12.0, 9.0}, 2.0, random);
  ASSERT_EQ(points.size(), 25U);
  EXPECT_EQ(points[0], Eigen::Vector2d(0x1.56f2fe8e7759cp+1, 0x1.91f9e2b47e054p-1));
  EXPECT_EQ(points[1], Eigen::Vector2d(0x1.63c96dec4fda4p+0, 0x1.cc35654ce31d5p+1));
  EXPECT_EQ(points.back(), Eigen::Vector2d(0x1.020ec75ee7847p-9, 0x1.1f772e4cb65e6p+3));
}

TEST(PoissonDiscDensity, IsEvenOverTheArea) {
  RandomStream random(8);
  const auto points = poisson_disc({160.0, 160.0}, 2.3, random);
  std::array<int, 4> quarters{};
  for (const Eigen::Vector2d& p : points) {
    ++quarters[(p.x() > 80.0 ? 1U : 0U) + (p.y() > 80.0 ? 2U : 0U)];
  }
  const auto [least, most] = std::minmax_element(quarters.begin(), quarters.end());
  EXPECT_LT(*most - *least, 0.05 * static_cast<double>(points.size()) / 4.0);
}

}  // namespace
}  // namespace avoidbench
