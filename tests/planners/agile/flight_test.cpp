#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <limits>
#include <vector>

#include "base/input_error.hpp"
#include "planners/support/trajectory_flight.hpp"
#include "planners/support/trajectory_suite.hpp"
#include "support/input_error_message.hpp"

namespace avoidbench::kinematic {
namespace {

const TrajectoryPlanner kAgile{.name = "agile",
                               .file = PLANNER_FILE,
                               .speed_limit_mps = 3.16,
                               .detour = 1.05,
                               .height_band_m = 0.5,
                               .published_speed_limit_mps = 7.4,
                               .is_random = false};

INSTANTIATE_TEST_SUITE_P(Each, TrajectoryFlight, testing::Values(kAgile), name_of);
INSTANTIATE_TEST_SUITE_P(Each, TrajectoryFlightSlow, testing::Values(kAgile), name_of);

TEST(Agile, StopsBeforeAWallWithoutAGap) {
  PlannerInstance planner = instance_of(PLANNER_FILE);
  Course course = meadow();
  add_hedge(course, {-25.0, 15.0}, {25.0, 15.0});
  const TrajectoryResult result = fly_trajectories(planner, course, 25.0);
  EXPECT_EQ(result.flight.ending, Ending::timed_out) << result.flight.reason;
  expect_flyable(result.demands, kAgile.speed_limit_mps);
}

PlannerMission mission_to(const Eigen::Vector3d& goal_world) {
  PlannerMission mission;
  mission.start_world = {0.0, 0.0, 2.0};
  mission.goal_world = goal_world;
  mission.goal_radius_m = 0.8;
  mission.time_limit_s = 60.0;
  mission.lowest_world = {-10.0, -20.0, 0.0};
  mission.highest_world = {50.0, 20.0, 6.0};
  return mission;
}

/// Flies 3 s where each image is `depth_m` all over; the host refuses numbers that are not finite.
void fly_blind(PlannerInstance& planner, const PlannerMission& mission, float depth_m) {
  const CameraSetup camera = vehicle_setup().cameras.front();
  const std::vector<float> image(std::size_t(camera.width_px) * std::size_t(camera.height_px),
                                 depth_m);
  ASSERT_EQ(planner.reset(mission), "");
  PlannerView view;
  view.position_world = mission.start_world;
  view.velocity_world.setZero();
  view.rates_body.setZero();
  view.q_world_body.setIdentity();
  for (int i = 0; i < 90; ++i) {
    view.time_s = view.call_time_s = i / 30.0;
    view.depth = {
        {.time_s = view.time_s,
         .T_world_camera = Eigen::Translation3d(view.position_world) * camera.T_body_camera,
         .camera = 0,
         .depth_m = image}};
    const PlanResult result = planner.plan(view);
    ASSERT_TRUE(result.status == PlanStatus::command || result.status == PlanStatus::no_plan)
        << result.reason;
    if (result.status != PlanStatus::command) continue;
    // It is where it was told to be.
    view.position_world = Eigen::Vector3d::Map(result.points[0].position_world_m);
    view.velocity_world = Eigen::Vector3d::Map(result.points[0].velocity_world_mps);
  }
}

TEST(Agile, FliesBrakesOrHasNoPlanWhateverItSees) {
  constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  PlannerInstance planner = instance_of(PLANNER_FILE);
  const Eigen::Vector3d ahead(30.0, 0.0, 2.0), behind(-8.0, 0.0, 2.0), near(0.5, 0.0, 2.0);
  for (const float depth_m : {kNaN, kInfinity, -kInfinity, 0.0F, -1.0F, 0.2F, 3.0F, 1e30F}) {
    for (const Eigen::Vector3d& goal : {ahead, behind, near}) {
      SCOPED_TRACE(testing::Message() << depth_m << " m, goal at " << goal.x() << " m");
      fly_blind(planner, mission_to(goal), depth_m);
    }
  }
}

TEST(Agile, FliesSlowlyWhereThatIsTheLimit) {
  PlannerInstance planner = instance_of(PLANNER_FILE, {{"max_speed_mps", ParameterValue{0.3, ""}}});
  const TrajectoryResult result = fly_trajectories(planner, meadow(), 20.0);
  EXPECT_EQ(result.flight.ending, Ending::timed_out) << result.flight.reason;
  EXPECT_GT(result.flight.path_m, 3.0);
  EXPECT_LE(result.demands.speed_mps, 0.3 * 1.06);
}

/// A copy of the plugin in a folder of its own, with these bytes beside it as its weights.
class PluginCopy {
 public:
  explicit PluginCopy(const std::string& name)
      : folder_(std::filesystem::path(testing::TempDir()) / ("agile_" + name)) {
    std::filesystem::remove_all(folder_);
    std::filesystem::create_directories(folder_);
    std::filesystem::copy_file(PLANNER_FILE, plugin());
  }
  ~PluginCopy() { std::filesystem::remove_all(folder_); }
  PluginCopy(const PluginCopy&) = delete;
  PluginCopy& operator=(const PluginCopy&) = delete;

  std::filesystem::path plugin() const { return folder_ / "agile.so"; }
  std::filesystem::path weights() const { return folder_ / "agile.safetensors"; }
  std::string error() const {
    return test::message_of([&] { describe_planner(plugin().string(), 10.0); });
  }

 private:
  std::filesystem::path folder_;
};

/// Before the first trial, since the planner is described then.
TEST(Agile, WithoutWholeWeightsIsAnErrorWhenItIsDescribed) {
  const PluginCopy copy("weights");
  EXPECT_NE(copy.error().find("agile.safetensors"), std::string::npos) << copy.error();
  std::filesystem::copy_file(WEIGHTS_FILE, copy.weights());
  EXPECT_EQ(copy.error(), "");
  std::filesystem::resize_file(copy.weights(), 100000);
  EXPECT_NE(copy.error().find("can't fly: "), std::string::npos) << copy.error();
  EXPECT_NE(copy.error().find("agile.safetensors"), std::string::npos) << copy.error();
}

/// Its trials are known by its weights, too.
TEST(Agile, OfOtherWeightsIsAnotherPlanner) {
  const PluginCopy copy("digest");
  std::filesystem::copy_file(WEIGHTS_FILE, copy.weights());
  const std::string before = describe_planner(copy.plugin().string(), 10.0).file_digest;
  std::fstream file(copy.weights(), std::ios::in | std::ios::out | std::ios::binary);
  file.seekp(-2, std::ios::end);
  file.put('\x01');  // the last half of a float
  file.close();
  EXPECT_NE(describe_planner(copy.plugin().string(), 10.0).file_digest, before);
}

}  // namespace
}  // namespace avoidbench::kinematic
