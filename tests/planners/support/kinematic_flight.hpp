#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <string>
#include <vector>

#include "plugin/pilot.hpp"

/// A small world of closed forms to fly planners in: upright cylinders, balls and level ground, a
/// vehicle that follows a velocity command with a lag, and a depth camera by exact ray casting. No
/// dynamics, no meshes: what is tested is the planner.
namespace avoidbench::kinematic {

struct Cylinder {
  Eigen::Vector2d centre;
  double radius_m;
};
struct Ball {
  Eigen::Vector3d centre;
  double radius_m;
};
struct Course {
  std::vector<Cylinder> cylinders;  ///< endless upward
  std::vector<Ball> balls;
  Eigen::Vector3d start_world, goal_world;
  int ghost_count = 0;  ///< pixels of each depth image that show a thing 0.7 to 5 m away: none is
};

inline constexpr double kBody_m = 0.3;  ///< the flown body's radius

/// What lies within the camera's range.
Course nearby(const Course& course, const Eigen::Vector3d& position, double range_m);

/// Trees (cylinders) and bushes (balls on the ground) at least `poisson_radius_m` apart on 40 × 40
/// m, flown along y at 2 m.
Course forest(double poisson_radius_m, std::uint64_t seed);

/// The course without obstacles.
Course meadow();

/// Adds a row of trees so near each other that nothing passes between.
void add_hedge(Course& course, const Eigen::Vector2d& from, const Eigen::Vector2d& to);

enum class Ending { reached_goal, collided, timed_out, failed };

struct Result {
  Ending ending = Ending::timed_out;
  std::string reason;
  double time_s = 0.0;
  double path_m = 0.0;
  double lowest_m = 0.0, highest_m = 0.0;  ///< height of the flight
  std::vector<Eigen::Vector3d> positions;  ///< at each plan call
};

/// What the vehicle is: body 0.5 × 0.5 × 0.12 m, camera of 64 × 48 pixels, 90° and 10 m.
PlannerSetup vehicle_setup();

/// The same with a second camera that looks straight down.
PlannerSetup rig_setup();

/// Flies until the goal is within 0.8 m, a surface within 0.3 m of the body's centre, or
/// `time_limit_s`.
Result fly(const Pilot& planner, const Course& course, double time_limit_s = 60.0,
           const PlannerSetup& setup = vehicle_setup());

/// Depth seen by `camera` at this pose.
std::vector<float> depth_image(const Course& course, const CameraSetup& camera,
                               const Eigen::Isometry3d& T_world_camera);

/// Distance from a point to the nearest surface; negative inside.
double clearance_m(const Course& course, const Eigen::Vector3d& point_world);

/// A new instance of the planner at `file` with these parameters besides the presets.
PlannerInstance instance_of(const std::string& file, const ParameterValues& parameters = {},
                            const PlannerSetup& setup = vehicle_setup());

}  // namespace avoidbench::kinematic
