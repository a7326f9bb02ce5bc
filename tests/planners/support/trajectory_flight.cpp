#include "planners/support/trajectory_flight.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <limits>
#include <thread>

#include "geometry/pose.hpp"
#include "planning/polynomial.hpp"

namespace avoidbench::kinematic {
namespace {

using Eigen::Vector3d;
using planning::Motion;

constexpr double kGravity_mps2 = 9.81;
constexpr double kBodyRate_radps = 10.0;  ///< of the hummingbird's roll and pitch

struct Reference {
  Motion motion;
  double yaw_rad = 0.0;
};

Motion motion_of(const ab_point& point) {
  return {Vector3d(point.position_world_m), Vector3d(point.velocity_world_mps),
          Vector3d(point.acceleration_world_mps2)};
}

/// What a trajectory asks for: quintics through its points, the last one after them.
Reference asked(const std::vector<ab_point>& points, double time_s) {
  std::size_t next = 1;
  while (next + 1 < points.size() && points[next].time_s <= time_s) ++next;
  const ab_point& from = points[next - 1];
  const ab_point& to = points[next];
  const double length_s = to.time_s - from.time_s;
  const double part = std::clamp((time_s - from.time_s) / length_s, 0.0, 1.0);
  const planning::Quintic piece =
      planning::quintic_between(motion_of(from), motion_of(to), length_s);
  return {planning::motion_at(piece, part * length_s),
          from.yaw_rad + part * (to.yaw_rad - from.yaw_rad)};
}

Vector3d thrust_direction(const Vector3d& acceleration) {
  return (acceleration + Vector3d(0.0, 0.0, kGravity_mps2)).normalized();
}

Eigen::Quaterniond attitude(const Reference& reference) {
  const Vector3d up = thrust_direction(reference.motion.acceleration);
  const Vector3d heading(std::cos(reference.yaw_rad), std::sin(reference.yaw_rad), 0.0);
  Eigen::Matrix3d axes;
  axes.col(2) = up;
  axes.col(1) = up.cross(heading).normalized();
  axes.col(0) = axes.col(1).cross(up);
  return Eigen::Quaterniond(axes);
}

void raise(double& greatest, double value) { greatest = std::max(greatest, value); }

void note(Demands& demands, const std::vector<ab_point>& points) {
  constexpr double kStep_s = 0.01;
  Reference before = asked(points, 0.0);
  for (double t = kStep_s; t < points.back().time_s; t += kStep_s) {
    const Reference now = asked(points, t);
    raise(demands.speed_mps, now.motion.velocity.norm());
    raise(demands.acceleration_mps2, now.motion.acceleration.norm());
    raise(demands.yaw_rate_radps, std::abs(now.yaw_rad - before.yaw_rad) / kStep_s);
    const Vector3d turn = thrust_direction(before.motion.acceleration)
                              .cross(thrust_direction(now.motion.acceleration));
    raise(demands.body_rate_radps, turn.norm() / kStep_s);
    before = now;
  }
  raise(demands.end_speed_mps, motion_of(points.back()).velocity.norm());
}

PlannerView seen_by(const Reference& vehicle, const Course& near, const CameraSetup& camera,
                    double time_s, std::vector<float>& pixels) {
  PlannerView view;
  view.time_s = time_s;
  view.position_world = vehicle.motion.position;
  view.velocity_world = vehicle.motion.velocity;
  view.rates_body.setZero();
  view.q_world_body = attitude(vehicle);
  DepthView depth;
  depth.time_s = time_s;
  depth.T_world_camera =
      make_pose(vehicle.motion.position, view.q_world_body) * camera.T_body_camera;
  pixels = depth_image(near, camera, depth.T_world_camera);
  depth.depth_m = pixels;
  view.depth.push_back(depth);
  return view;
}

}  // namespace

TrajectoryResult fly_trajectories(PlannerInstance& planner, const Course& course,
                                  double time_limit_s, std::uint64_t seed) {
  const PlannerSetup setup = vehicle_setup();
  const double period_s = setup.plan_period_s;
  const Vector3d way = course.goal_world - course.start_world;
  PlannerMission mission;
  mission.seed = seed;
  mission.start_world = course.start_world;
  mission.goal_world = course.goal_world;
  mission.start_yaw_rad = std::atan2(way.y(), way.x());
  mission.goal_radius_m = 0.8;
  mission.time_limit_s = time_limit_s;

  TrajectoryResult result;
  Result& flight = result.flight;
  flight.reason = planner.reset(mission);
  flight.lowest_m = flight.highest_m = course.start_world.z();
  if (!flight.reason.empty()) flight.ending = Ending::failed;
  Reference vehicle;
  vehicle.motion.position = course.start_world;
  vehicle.yaw_rad = mission.start_yaw_rad;
  std::vector<ab_point> flown, next;  // a command takes effect one period after what it answers
  std::vector<float> pixels;
  while (flight.reason.empty() && flight.time_s < time_limit_s) {
    const Course near = nearby(course, vehicle.motion.position, setup.cameras.front().max_range_m);
    const PlanResult plan =
        planner.plan(seen_by(vehicle, near, setup.cameras.front(), flight.time_s, pixels));
    flight.positions.push_back(vehicle.motion.position);
    flown = next;
    if (plan.status != PlanStatus::command) {
      flight.ending = Ending::failed;
      flight.reason = "no command: " + plan.reason;
      break;
    }
    next = plan.points;
    note(result.demands, next);
    if (!flown.empty()) {
      const Motion before = asked(flown, period_s).motion, after = asked(next, 0.0).motion;
      raise(result.demands.jump_m, (after.position - before.position).norm());
      raise(result.demands.speed_jump_mps, (after.velocity - before.velocity).norm());
    }
    constexpr int kSteps = 10;
    for (int i = 1; i <= kSteps && !flown.empty(); ++i) {
      const Vector3d before = vehicle.motion.position;
      vehicle = asked(flown, i * period_s / kSteps);
      flight.path_m += (vehicle.motion.position - before).norm();
      if (clearance_m(near, vehicle.motion.position) < kBody_m) {
        flight.ending = Ending::collided;
        return result;
      }
    }
    flight.time_s += period_s;
    flight.lowest_m = std::min(flight.lowest_m, vehicle.motion.position.z());
    flight.highest_m = std::max(flight.highest_m, vehicle.motion.position.z());
    if ((vehicle.motion.position - course.goal_world).head<2>().norm() < mission.goal_radius_m) {
      flight.ending = Ending::reached_goal;
      break;
    }
  }
  return result;
}

void expect_flyable(const Demands& demands, double speed_mps) {
  const PlannerSetup setup = vehicle_setup();
  EXPECT_LE(demands.speed_mps, speed_mps);
  EXPECT_LE(demands.acceleration_mps2, setup.max_acceleration_mps2);
  EXPECT_LE(demands.yaw_rate_radps, setup.max_yaw_rate_radps);
  EXPECT_LE(demands.body_rate_radps, kBodyRate_radps);
  EXPECT_LE(demands.jump_m, 1e-3);
  EXPECT_LE(demands.speed_jump_mps, 0.02);
  EXPECT_LE(demands.end_speed_mps, 1e-9);
}

int reached_count(PlannerInstance& planner, double poisson_radius_m, std::uint64_t count,
                  double speed_mps) {
  int reached = 0;
  for (std::uint64_t seed = 0; seed < count; ++seed) {
    const TrajectoryResult result = fly_trajectories(planner, forest(poisson_radius_m, seed));
    const Result& flight = result.flight;
    EXPECT_NE(flight.ending, Ending::failed) << flight.reason;
    expect_flyable(result.demands, speed_mps);
    if (flight.ending == Ending::reached_goal) {
      ++reached;
    } else {
      std::cout << "seed " << seed << (flight.ending == Ending::collided ? ": collided" : ": late")
                << " at " << flight.time_s << " s, " << flight.positions.back().transpose() << '\n';
    }
  }
  return reached;
}

void expect_same_in_threads(const std::string& file) {
  constexpr double kTime_s = 4.0;
  constexpr std::size_t kThreads = 3;
  const Course course = forest(3.0, 3);
  PlannerInstance alone = instance_of(file);
  const std::vector<Vector3d> expected = fly_trajectories(alone, course, kTime_s).flight.positions;
  std::array<std::vector<Vector3d>, kThreads> flown;
  {
    std::vector<std::jthread> threads;
    for (std::vector<Vector3d>& positions : flown) {
      threads.emplace_back([&] {
        PlannerInstance planner = instance_of(file);
        positions = fly_trajectories(planner, course, kTime_s).flight.positions;
      });
    }
  }
  for (const std::vector<Vector3d>& positions : flown) EXPECT_EQ(positions, expected);
}

std::size_t resident_bytes() {
  std::ifstream file("/proc/self/statm");
  std::size_t total = 0, resident = 0;
  file >> total >> resident;
  return resident * 4096;
}

void expect_no_plan_to_nowhere(PlannerInstance& planner) {
  using Limits = std::numeric_limits<double>;
  for (const double nowhere : {Limits::quiet_NaN(), Limits::infinity(), 1e300}) {
    PlannerMission mission;
    mission.start_world = {0.0, 0.0, 2.0};
    mission.goal_world = {20.0, nowhere, 2.0};
    mission.goal_radius_m = 0.8;
    mission.time_limit_s = 60.0;
    EXPECT_EQ(planner.reset(mission), "");
    PlannerView view;
    view.position_world = mission.start_world;
    view.velocity_world.setZero();
    view.rates_body.setZero();
    view.q_world_body.setIdentity();
    EXPECT_EQ(planner.plan(view).status, PlanStatus::no_plan) << nowhere;
  }
}

void expect_no_growth(PlannerInstance& planner, int count) {
  std::size_t before = 0;
  for (int i = 0; i < count; ++i) {
    Course course = forest(4.0, 3);
    course.goal_world.z() += i % 3;  // other heights make other maps
    const TrajectoryResult result = fly_trajectories(planner, course, 0.5);
    ASSERT_NE(result.flight.ending, Ending::failed) << result.flight.reason;
    if (i == 10) before = resident_bytes();
  }
  EXPECT_LT(resident_bytes(), before + 4'000'000);
}

}  // namespace avoidbench::kinematic
