#include "plugin/world_door.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "avoidbench/planner.hpp"
#include "plugin/host_buffers.hpp"

namespace avoidbench {
namespace {

/// A ground at z = 0, and a straight way along x for balls of up to half a metre.
PlannerWorld plain() {
  return {.distance_m = [](const Eigen::Vector3d& place) { return std::min(place.z(), 2.5); },
          .shortest_path_world =
              [](double radius_m) {
                using Path = std::vector<Eigen::Vector3d>;
                return radius_m > 0.5 ? Path{} : Path{{0.0, 0.0, radius_m}, {9.0, 0.0, radius_m}};
              }};
}

TEST(WorldDoor, IsShutForPlannersThatDoNotSayThatTheySeeTheMap) {
  const HostSide host(true, AB_INPUT_STATE | AB_INPUT_DEPTH);
  EXPECT_EQ(host.table().get_extension(host.table().context, AB_WORLD_EXTENSION), nullptr);
  EXPECT_THROW(KnownWorld{host.table()}, std::runtime_error);
}

TEST(WorldDoor, PassesQuestionsOn) {
  HostSide host(true, AB_INPUT_WORLD);
  const KnownWorld world(host.table());
  host.show_world(plain());
  EXPECT_EQ(world.distances_m({{0.0, 0.0, 1.0}, {5.0, 0.0, 9.0}}), (std::vector<double>{1.0, 2.5}));
  EXPECT_TRUE(world.distances_m({}).empty());
  EXPECT_EQ(world.shortest_path_m(0.25), (std::vector<Vec3>{{0.0, 0.0, 0.25}, {9.0, 0.0, 0.25}}));
  EXPECT_TRUE(world.shortest_path_m(0.75).empty());
}

TEST(WorldDoor, RefusesWhatIsNoQuestion) {
  HostSide host(true, AB_INPUT_WORLD);
  const KnownWorld world(host.table());
  EXPECT_THROW(world.distances_m({{0.0, 0.0, 1.0}}), std::runtime_error);  // before a trial
  EXPECT_THROW(world.shortest_path_m(0.25), std::runtime_error);
  host.show_world(plain());
  const double not_a_number = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(world.distances_m({{0.0, not_a_number, 1.0}}), std::runtime_error);
  for (const double radius_m : {0.0, -1.0, not_a_number, std::numeric_limits<double>::infinity()}) {
    EXPECT_THROW(world.shortest_path_m(radius_m), std::runtime_error) << radius_m;
  }
}

}  // namespace
}  // namespace avoidbench
