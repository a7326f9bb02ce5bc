#include <gtest/gtest.h>

#include <cstring>

#include "support/flight_worlds.hpp"
#include "trial/flight.hpp"

namespace avoidbench::lidar_flights {
namespace {

using Eigen::Vector3d;

LidarSpec lidar_named(const std::string& name) {
  for (const LidarSpec& lidar : lidar_presets()) {
    if (lidar.name == name) return lidar;
  }
  ADD_FAILURE() << "no lidar " << name;
  return {};
}

LidarSpec exact_lidar(const std::string& name) {
  LidarSpec lidar = lidar_named(name);
  lidar.range_sigma_m = lidar.angle_sigma_deg = lidar.dropout_ratio = 0.0;
  return lidar;
}

/// One sweep as a planner saw it.
struct Told {
  double call_s = 0.0, time_s = 0.0;
  std::uint32_t lidar = 0;
  Pose T_world_lidar;
  std::vector<ab_lidar_point> points;
  std::size_t miss_count = 0;
};

struct LidarFlight {
  std::vector<Told> sweeps;
  TrialRecord record;
};

/// Two seconds of a climbing, turning flight between a column and the floor.
LidarFlight lidar_flight(const TrialSpec& spec, const World& world, std::uint32_t needs) {
  const Scene scene(world);
  const Mission mission = test::straight_mission();
  Flight flight = begin_flight(spec, scene, mission, needs);
  LidarFlight all;
  while (const PlannerView* view = next_plan(flight)) {
    for (const CloudView& cloud : view->clouds) {
      all.sweeps.push_back({.call_s = view->call_time_s,
                            .time_s = cloud.time_s,
                            .lidar = cloud.lidar,
                            .T_world_lidar = cloud.T_world_lidar,
                            .points = {cloud.points.begin(), cloud.points.end()},
                            .miss_count = cloud.misses_lidar.size()});
    }
    PlanResult result;
    result.status = PlanStatus::command;
    result.command.kind = AB_COMMAND_VELOCITY;
    result.command.velocity_world_mps[1] = 4.0;
    result.command.velocity_world_mps[2] = 0.5;
    result.command.flags = AB_YAW_IS_RATE;
    result.command.yaw_rate_radps = 2.0;
    answer(flight, result);
  }
  all.record = end_flight(std::move(flight));
  return all;
}

World columns() {
  World world = test::flight_world();
  test::add_obstacle(world, test::cylinder_mesh(0.5, 8.0, 64), {3.0, -10.0, 0.0}, "column");
  return world;
}

TrialSpec spec_of(std::vector<LidarSpec> lidars) {
  TrialSpec spec;
  spec.mission.time_limit_s = 2.0;
  spec.sensor.method = NoCameraSpec{};
  spec.sensor.lidars = std::move(lidars);
  return spec;
}

/// The greatest distance of a point from the surfaces of the world, by the pose it is told with.
double farthest_off_m(const Told& sweep, const Scene& scene) {
  double most_m = 0.0;
  for (const ab_lidar_point& point : sweep.points) {
    const Vector3d place =
        sweep.T_world_lidar * Eigen::Vector3f(point.position_lidar_m).cast<double>();
    most_m = std::max(most_m, scene.nearest(place).distance_m);
  }
  return most_m;
}

TEST(LidarOfFlights, DeskewedPointsLieOnSurfacesAndRawOnesDoNot) {
  const World world = columns();
  const Scene scene(world);
  for (const char* name : {"mid360_like", "ouster_os0_32"}) {
    LidarSpec lidar = exact_lidar(name);
    const LidarFlight straight = lidar_flight(spec_of({lidar}), world, AB_INPUT_POINTS);
    lidar.deskewed = false;
    const LidarFlight raw = lidar_flight(spec_of({lidar}), world, AB_INPUT_POINTS);
    ASSERT_EQ(straight.sweeps.size(), 19U)
        << name;  // the one that ends with the flight is not seen
    ASSERT_EQ(raw.sweeps.size(), 19U);
    double most_raw_m = 0.0;
    for (std::size_t i = 0; i < straight.sweeps.size(); ++i) {
      ASSERT_GT(straight.sweeps[i].points.size(), 300U);
      EXPECT_LT(farthest_off_m(straight.sweeps[i], scene), 2e-3) << name << i;
      most_raw_m = std::max(most_raw_m, farthest_off_m(raw.sweeps[i], scene));
    }
    EXPECT_GT(most_raw_m, 0.2) << name;
  }
}

TEST(LidarOfFlights, SweepsComeAtTheirTimes) {
  LidarSpec fast = exact_lidar("velodyne_16"), late = exact_lidar("velodyne_16");
  fast.rate_hz = 15.0;  // whose period is no multiple of the physics'
  late.delay_ms = 40.0;
  const LidarFlight flight = lidar_flight(spec_of({fast, late}), columns(), AB_INPUT_POINTS);
  std::array<int, 2> counts{};
  for (const Told& sweep : flight.sweeps) {
    const double rate_hz = sweep.lidar == 0 ? 15.0 : 10.0;
    const int number = ++counts.at(sweep.lidar);
    EXPECT_NEAR(sweep.time_s, number / rate_hz, 1e-9);
    const double waits_s = sweep.call_s - sweep.time_s - (sweep.lidar == 1 ? 0.04 : 0.0);
    EXPECT_GE(waits_s, -1e-9);
    EXPECT_LT(waits_s, 1.0 / 30.0);
    EXPECT_EQ(static_cast<std::int64_t>(sweep.points.size() + sweep.miss_count),
              shots_per_sweep(fast));
  }
  EXPECT_EQ(counts[0], 29);
  EXPECT_EQ(counts[1], 19);
}

/// Whether points are seen changes no flight; a lidar that nobody sees fires nothing.
TEST(LidarOfFlights, ToBeSeenChangesNothing) {
  const TrialSpec spec = spec_of({lidar_named("mid360_like")});
  const LidarFlight with = lidar_flight(spec, columns(), AB_INPUT_POINTS);
  const LidarFlight without = lidar_flight(spec, columns(), AB_INPUT_STATE);
  EXPECT_TRUE(without.sweeps.empty());
  ASSERT_EQ(with.record.samples.size(), without.record.samples.size());
  for (std::size_t i = 0; i < with.record.samples.size(); ++i) {
    EXPECT_EQ(with.record.samples[i].position_world, without.record.samples[i].position_world);
  }
}

/// The same flight has the same points to the bit, noise and all; a lidar's own noise does not
/// depend on which others there are.
TEST(LidarOfFlights, PointsRepeat) {
  const LidarSpec lidar = lidar_named("mid360_like");
  const LidarFlight one = lidar_flight(spec_of({lidar}), columns(), AB_INPUT_POINTS);
  const LidarFlight two =
      lidar_flight(spec_of({lidar, lidar_named("velodyne_16")}), columns(), AB_INPUT_POINTS);
  std::size_t i = 0;
  for (const Told& sweep : two.sweeps) {
    if (sweep.lidar != 0) continue;
    ASSERT_LT(i, one.sweeps.size());
    const Told& same = one.sweeps[i++];
    ASSERT_EQ(sweep.points.size(), same.points.size());
    EXPECT_EQ(std::memcmp(sweep.points.data(), same.points.data(),
                          same.points.size() * sizeof(ab_lidar_point)),
              0);
  }
  EXPECT_EQ(i, one.sweeps.size());
}

/// What drifts is told as it is believed: a wall then lies where the odometry puts it.
TEST(LidarOfFlights, PosesAreTheOdometrys) {
  TrialSpec spec = spec_of({exact_lidar("ouster_os0_32")});
  spec.odometry.position_drift_ratio = 0.1;
  const World world = columns();
  const Scene scene(world);
  const LidarFlight flight = lidar_flight(spec, world, AB_INPUT_POINTS);
  EXPECT_GT(farthest_off_m(flight.sweeps.back(), scene), 0.03);
}

}  // namespace
}  // namespace avoidbench::lidar_flights
