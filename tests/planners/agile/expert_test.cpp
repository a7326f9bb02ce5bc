#include "expert/expert.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <utility>

#include "expert/clearance_field.hpp"
#include "expert/trajectory_cost.hpp"

namespace agile {
namespace {

using Eigen::Vector3d;
using planning::Motion;
using planning::Quintic;

/// 20 × 12 × 5 m with a wall across at x = `wall_m` from y = 4 on, and nothing else: clearance by
/// the closed form.
ClearanceField walled(double wall_m) {
  ClearanceField field;
  field.origin_world = {0.1, 0.1, 0.1};
  field.size = {100, 60, 25};
  for (int z = 0; z < field.size.z(); ++z) {
    for (int y = 0; y < field.size.y(); ++y) {
      for (int x = 0; x < field.size.x(); ++x) {
        const Vector3d at = field.origin_world + field.cell_m * Vector3d(x, y, z);
        const double beside_m = std::max(0.0, 4.0 - at.y());
        const double clearance_m = std::hypot(at.x() - wall_m, beside_m);
        field.steps.push_back(static_cast<std::uint8_t>(
            std::lround(std::clamp((clearance_m + 0.5) * 100.0, 0.0, 255.0))));
      }
    }
  }
  return field;
}

Situation from(const Vector3d& position, const Vector3d& velocity) {
  Situation situation;
  situation.frame.origin_world = position;
  situation.start.position = position;
  situation.start.velocity = velocity;
  situation.goal_world = position + Vector3d(15.0, 0.0, 0.0);
  situation.desired_speed_mps = 3.0;
  situation.lowest_world = {0.0, 0.0, 0.0};
  situation.highest_world = {20.0, 12.0, 5.0};
  return situation;
}

Quintic straight(const Situation& situation) {
  const Vector3d v = situation.start.velocity;
  return quintic_between(situation.start,
                         {situation.start.position + kHorizon_s * v, v, Vector3d::Zero()},
                         kHorizon_s);
}

TEST(ClearanceFieldTest, IsTrilinearAndGoesOnBeyondItsRim) {
  const ClearanceField field = walled(10.0);
  EXPECT_NEAR(field.at({9.0, 8.0, 2.0}), 1.0, 0.011);
  EXPECT_NEAR(field.at({9.37, 8.05, 2.11}), 0.63, 0.011);
  EXPECT_NEAR(field.at({10.0, 3.0, 2.0}), 1.0, 0.02);
  EXPECT_NEAR(field.at({9.0, 50.0, -7.0}), 1.0, 0.011);
}

TEST(TrajectoryCostTest, OfFreeStraightFlightIsNothing) {
  const Situation situation = from({2.0, 6.0, 2.0}, {3.0, 0.0, 0.0});
  const TrajectoryCost cost = trajectory_cost(walled(30.0), situation, straight(situation));
  EXPECT_NEAR(cost.total(), 0.0, 1e-9);
}

TEST(TrajectoryCostTest, OfStandingStillIsOne) {
  const Situation situation = from({2.0, 6.0, 2.0}, Vector3d::Zero());
  const TrajectoryCost cost = trajectory_cost(walled(30.0), situation, straight(situation));
  EXPECT_NEAR(cost.progress, 1.0, 1e-9);
  EXPECT_NEAR(cost.total(), 1.0, 1e-9);
}

TEST(TrajectoryCostTest, CountsWallsTheMapsSidesAndHaste) {
  const Situation situation = from({2.0, 6.0, 2.0}, {3.0, 0.0, 0.0});
  EXPECT_GT(trajectory_cost(walled(6.0), situation, straight(situation)).collision, 0.3);
  Situation beside = from({2.0, 11.7, 2.0}, {3.0, 0.0, 0.0});
  EXPECT_GT(trajectory_cost(walled(30.0), beside, straight(beside)).collision, 1.0);
  Situation fast = from({2.0, 6.0, 2.0}, {3.3, 0.0, 0.0});
  EXPECT_NEAR(trajectory_cost(walled(30.0), fast, straight(fast)).limits, 20.0 * 0.01, 1e-9);
  // 1 m/s upward, and the goal level: 0.1 × the mean of the squares of 0.1 m to 2 m.
  Situation climbing = from({2.0, 6.0, 2.0}, {2.8, 0.0, 1.0});
  EXPECT_NEAR(trajectory_cost(walled(30.0), climbing, straight(climbing)).height,
              0.1 * 0.01 * 20.0 * 21.0 * 41.0 / 6.0 / 20.0, 1e-9);
  Situation aside = from({2.0, 3.0, 2.0}, {0.0, 3.0, 0.0});  // 90° from where it looks
  EXPECT_GT(trajectory_cost(walled(30.0), aside, straight(aside)).view, 0.2);
}

/// 0 from 0.8 m on, 1 at 0.4 m, 4 at a surface, with parabola and line between and beyond.
TEST(TrajectoryCostTest, OfCollisionIsThatOfTheClearanceWhereThisIsTheSameAllTheWay) {
  const Situation situation = from({2.0, 6.0, 2.0}, {3.0, 0.0, 0.0});
  ClearanceField field = walled(30.0);
  for (const auto& [clearance_m, expected] :
       {std::pair{0.9, 0.0}, {0.6, 0.5}, {0.4, 1.0}, {0.2, 3.25}, {0.0, 4.0}, {-0.25, 6.0}}) {
    const double steps = std::round(100.0 * (clearance_m + 0.5));
    field.steps.assign(field.steps.size(), static_cast<std::uint8_t>(steps));
    const TrajectoryCost cost = trajectory_cost(field, situation, straight(situation));
    EXPECT_NEAR(cost.collision, expected, 1e-9) << clearance_m;
  }
}

/// Step i of 20 weighs 1.5 - i / 20: all of them together 19.5.
TEST(TrajectoryCostTest, OfCollisionWeighsWhatComesSoonMore) {
  const Situation situation = from({2.0, 6.0, 2.0}, {3.0, 0.0, 0.0});
  // The field before or behind x = 5, where step 10 is, is a surface.
  const auto cost_where = [&](auto is_surface) {
    ClearanceField field = walled(30.0);
    for (std::size_t i = 0; i < field.steps.size(); ++i) {
      const auto column = static_cast<double>(i % static_cast<std::size_t>(field.size.x()));
      field.steps[i] = is_surface(field.origin_world.x() + field.cell_m * column) ? 50 : 255;
    }
    return trajectory_cost(field, situation, straight(situation)).collision;
  };
  // Steps 1 to 9, and 11 to 20.
  EXPECT_NEAR(cost_where([](double x) { return x < 5.0; }), 4.0 * 11.25 / 19.5, 1e-9);
  EXPECT_NEAR(cost_where([](double x) { return x > 5.0; }), 4.0 * 7.25 / 19.5, 1e-9);
}

TEST(ExpertTest, FliesRoundAWallAndBestFirst) {
  const ClearanceField field = walled(6.5);
  const Situation situation = from({2.0, 5.0, 2.0}, {2.0, 0.0, 0.0});
  avoidbench::RandomStream random(1);
  const auto labels = expert_labels(field, situation, random);
  EXPECT_LE(labels[0].cost, labels[1].cost);
  EXPECT_LE(labels[0].cost, labels[2].cost);  // a copy of the best where there are only two
  EXPECT_LT(labels[0].cost, 0.9);
  for (int i = 0; i <= 20; ++i) {
    const Vector3d at = motion_at(labels[0].curve, 0.1 * i).position;
    EXPECT_GT(field.at(at), 0.35) << at.transpose();
  }
  EXPECT_LT(motion_at(labels[0].curve, kHorizon_s).position.y(), 4.0);
}

TEST(ExpertTest, StopsBeforeAWallWithoutAWayRound) {
  ClearanceField field = walled(6.0);
  // The same at all y.
  for (int z = 0; z < field.size.z(); ++z) {
    for (int y = 0; y < 20; ++y) {
      for (int x = 0; x < field.size.x(); ++x) {
        const auto at = [&](int row) {
          return std::size_t((z * field.size.y() + row) * field.size.x() + x);
        };
        field.steps[at(y)] = field.steps[at(30)];
      }
    }
  }
  const Situation situation = from({2.0, 5.0, 2.0}, {3.0, 0.0, 0.0});
  avoidbench::RandomStream random(1);
  const Quintic best = expert_labels(field, situation, random)[0].curve;
  for (int i = 0; i <= 20; ++i) EXPECT_GT(field.at(motion_at(best, 0.1 * i).position), 0.3);
  EXPECT_LT(motion_at(best, kHorizon_s).position.x(), 6.0);
}

TEST(ExpertTest, SaysTheSameForTheSameSeed) {
  const ClearanceField field = walled(6.5);
  const Situation situation = from({2.0, 5.0, 2.0}, {2.0, 0.5, 0.0});
  avoidbench::RandomStream first(7), again(7);
  const auto a = expert_labels(field, situation, first), b = expert_labels(field, situation, again);
  for (std::size_t i = 0; i < a.size(); ++i) {
    EXPECT_EQ(a[i].curve.coefficients, b[i].curve.coefficients);
  }
}

}  // namespace
}  // namespace agile
