#include <gtest/gtest.h>

#include <cmath>

#include "metrics/known_world.hpp"
#include "metrics/map_record.hpp"
#include "planners/support/conformance_expectation.hpp"
#include "planners/support/kinematic_flight.hpp"
#include "smooth_line.hpp"
#include "speed_profile.hpp"
#include "trial/map_scene.hpp"
#include "trial/planner_view.hpp"
#include "trial/run_trial.hpp"

namespace avoidbench {
namespace {

using omniscient::Line;

TEST(Omniscient, KeepsEveryRule) { expect_conformance(PLANNER_FILE); }

TEST(Omniscient, GivesUpWhereThereIsNoWay) {
  PlannerInstance planner = kinematic::instance_of(PLANNER_FILE);
  planner.show_world({.distance_m = [](const Eigen::Vector3d&) { return 2.5; },
                      .shortest_path_world = [](double) { return Line{}; }});
  EXPECT_NE(planner.reset({}).find("no way to the goal is wide enough"), std::string::npos);
}

TEST(Omniscient, APathToWhatIsNoPlaceIsNoWay) {
  PlannerInstance planner = kinematic::instance_of(PLANNER_FILE);
  planner.show_world({.distance_m = [](const Eigen::Vector3d&) { return 2.5; },
                      .shortest_path_world =
                          [](double) {
                            return Line{{0, 0, 1}, Eigen::Vector3d::Constant(std::nan(""))};
                          }});
  EXPECT_NE(planner.reset({}).find("no way to the goal is wide enough"), std::string::npos);
}

/// In maps of all kinds: it arrives, and faster than any planner that has to see.
TEST(Omniscient, ArrivesFastOnMapsOfAllKinds) {
  TrialSpec forest, maze, overhangs;
  forest.map = ForestSpec{.area_m = {20, 30}, .poisson_radius_m = 2.6};
  maze.map = MazeSpec{.corridor_m = 3.0, .loop_ratio = 0.5};
  overhangs.map = OverhangsSpec{};
  for (TrialSpec spec : {forest, maze, overhangs}) {
    spec.map_seed = 5;
    const MapScene map(spec);
    ClearanceGrid grid(map.scene, map.world.bounds, kMapCell_m);
    const MissionRecord mission = make_mission_record(spec, map.scene, grid, 0);
    ASSERT_TRUE(mission.is_valid);
    PlannerInstance planner = kinematic::instance_of(PLANNER_FILE, {}, planner_setup(spec));
    planner.show_world(known_world(spec, map.scene, mission.mission));
    const TrialRecord record = run_trial(spec, map.scene, mission.mission, planner);
    EXPECT_EQ(record.outcome, Outcome::reached_goal) << record.reason;
    EXPECT_GT(mission.reference_length_m / record.end_time_s, 2.5);
  }
}

TEST(SmoothLine, ResamplesInEvenSteps) {
  const Line line = omniscient::resampled({{0, 0, 0}, {1.05, 0, 0}, {1.05, 1.0, 0}}, 0.1);
  for (std::size_t i = 1; i + 1 < line.size(); ++i) {
    EXPECT_LE((line[i] - line[i - 1]).norm(), 0.1 + 1e-12);
  }
  EXPECT_EQ(line.front(), Eigen::Vector3d(0, 0, 0));
  EXPECT_EQ(line.back(), Eigen::Vector3d(1.05, 1.0, 0));
}

/// A way that touches a post from the side it passes: the smooth line keeps its distance, passes on
/// the same side, and bends less.
TEST(SmoothLine, KeepsItsDistanceAndItsSide) {
  const auto post = [](const Line& places) {
    std::vector<double> distances;
    for (const Eigen::Vector3d& place : places) {
      distances.push_back(std::min(2.5, std::abs(place.head<2>().norm() - 0.1)));
    }
    return distances;
  };
  const Line corner = omniscient::resampled({{-5, 0, 2}, {0, 1.0, 2}, {5, 0, 2}}, 0.1);
  const Line smooth = omniscient::smoothed(corner, 0.6, post);
  ASSERT_EQ(smooth.size(), corner.size());
  double sharpest = 0.0;
  for (std::size_t i = 1; i + 1 < smooth.size(); ++i) {
    EXPECT_GT(smooth[i].head<2>().norm(), 0.6 + 0.1 - 0.03);
    sharpest = std::max(sharpest, (smooth[i - 1] - 2 * smooth[i] + smooth[i + 1]).norm());
  }
  EXPECT_GT(smooth[smooth.size() / 2].y(), 0.6);
  EXPECT_LT(sharpest, 0.02);  // of the corner: 0.039
}

/// The whole of a thin wall has free space on both sides: no line may jump through.
TEST(SmoothLine, DoesNotCutThroughAThinWall) {
  const auto wall = [](const Line& places) {  // x = 0 for y < 3
    std::vector<double> distances;
    for (const Eigen::Vector3d& place : places) {
      distances.push_back(std::min(2.5, std::hypot(place.x(), std::max(0.0, place.y() - 3.0))));
    }
    return distances;
  };
  const Line around = omniscient::resampled(
      {{-2, 0, 2}, {-0.8, 3.0, 2}, {0, 3.8, 2}, {0.8, 3.0, 2}, {2, 0, 2}}, 0.1);
  const Line smooth = omniscient::smoothed(around, 0.6, wall);
  ASSERT_FALSE(smooth.empty());
  for (std::size_t i = 1; i < smooth.size(); ++i) {
    if (smooth[i - 1].x() < 0.0 && smooth[i].x() >= 0.0) {
      EXPECT_GT(smooth[i].y(), 3.5);
    }
  }
}

/// Straight: half the way accelerating is never left, and the speed limit holds.
TEST(TimedLine, IsTimeOptimalOnAStraightLine) {
  const Line line = omniscient::resampled({{0, 0, 2}, {30, 0, 2}}, 0.1);
  const omniscient::TimedLine timed(line, {.speed_mps = 6.0, .acceleration_mps2 = 3.0});
  // 6 m in 2 s, then 24 m at 6 m/s; easing costs an eighth of a second.
  EXPECT_NEAR(timed.at(2.0 + 4.0 + 0.125).position_world.x(), 30.0, 0.15);
  double fastest = 0.0, before = 0.0;
  for (int i = 0; i <= 600; ++i) {
    const omniscient::Motion motion = timed.at(0.01 * i);
    EXPECT_LE(motion.acceleration_world.norm(), 3.0 * 1.05) << i;
    EXPECT_GE(motion.position_world.x(), before - 1e-12);
    before = motion.position_world.x();
    fastest = std::max(fastest, motion.velocity_world.norm());
  }
  EXPECT_NEAR(fastest, 6.0, 0.02);
}

/// Positions, velocities and accelerations fit each other: what the vehicle's trajectories need.
TEST(TimedLine, DerivativesAreThoseOfItsPositions) {
  Line arc;
  for (int i = 0; i < 120; ++i) {
    arc.emplace_back(4.0 * std::sin(0.025 * i), 4.0 - 4.0 * std::cos(0.025 * i), 2.0);
  }
  const omniscient::TimedLine timed(arc, {.speed_mps = 8.0, .acceleration_mps2 = 4.0});
  constexpr double kStep_s = 1e-4;
  for (int i = 10; i < 400; ++i) {
    const double time_s = 0.0093 * i;
    const auto before = timed.at(time_s - kStep_s), at = timed.at(time_s),
               after = timed.at(time_s + kStep_s);
    const Eigen::Vector3d velocity =
        (after.position_world - before.position_world) / (2.0 * kStep_s);
    const Eigen::Vector3d acceleration =
        (after.velocity_world - before.velocity_world) / (2.0 * kStep_s);
    EXPECT_LT((velocity - at.velocity_world).norm(), 1e-4) << time_s;
    EXPECT_LT((acceleration - at.acceleration_world).norm(), 0.05) << time_s;
    // Along an arc of 4 m the square of the speed over the radius.
    EXPECT_LE(at.velocity_world.squaredNorm() / 4.0, 4.0 * 1.1) << time_s;
  }
}

}  // namespace
}  // namespace avoidbench
