#include "planners/support/kinematic_flight.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

#include "base/math.hpp"
#include "base/random.hpp"
#include "geometry/pose.hpp"

namespace avoidbench::kinematic {
namespace {

constexpr double kLag_s = 0.25, kAcceleration_mps2 = 6.0, kYawRate_radps = 2.5;
constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// Least t > 0 with a t² + 2 b t + c = 0, or infinity.
double first_root(double a, double b, double c) {
  const double discriminant = b * b - a * c;
  if (a < 1e-12 || discriminant < 0.0) return kInfinity;
  const double root = std::sqrt(discriminant);
  const double near = (-b - root) / a;
  return near > 0.0 ? near : kInfinity;
}

/// Where eye + t·ray first meets a surface.
double hit(const Course& course, const Eigen::Vector3d& eye, const Eigen::Vector3d& ray) {
  double t = ray.z() < 0.0 ? -eye.z() / ray.z() : kInfinity;
  for (const Cylinder& tree : course.cylinders) {
    const Eigen::Vector2d offset = eye.head<2>() - tree.centre;
    const Eigen::Vector2d level = ray.head<2>();
    t = std::min(t, first_root(level.squaredNorm(), offset.dot(level),
                               offset.squaredNorm() - tree.radius_m * tree.radius_m));
  }
  for (const Ball& bush : course.balls) {
    const Eigen::Vector3d offset = eye - bush.centre;
    t = std::min(t, first_root(ray.squaredNorm(), offset.dot(ray),
                               offset.squaredNorm() - bush.radius_m * bush.radius_m));
  }
  return t;
}

/// The attitude that gives this acceleration with body x toward `yaw_rad`.
Eigen::Quaterniond attitude(const Eigen::Vector3d& acceleration, double yaw_rad) {
  const Eigen::Vector3d up = (acceleration + Eigen::Vector3d(0.0, 0.0, 9.81)).normalized();
  const Eigen::Vector3d heading(math::cos(yaw_rad), math::sin(yaw_rad), 0.0);
  Eigen::Matrix3d axes;
  axes.col(2) = up;
  axes.col(1) = up.cross(heading).normalized();
  axes.col(0) = axes.col(1).cross(up);
  return Eigen::Quaterniond(axes);
}

struct Vehicle {
  Eigen::Vector3d position, velocity = Eigen::Vector3d::Zero();
  Eigen::Vector3d acceleration = Eigen::Vector3d::Zero();
  double yaw_rad = 0.0;

  void step(const Eigen::Vector3d& wanted_mps, double wanted_yaw_rad, double dt_s) {
    acceleration = (wanted_mps - velocity) / kLag_s;
    if (acceleration.norm() > kAcceleration_mps2)
      acceleration *= kAcceleration_mps2 / acceleration.norm();
    velocity += dt_s * acceleration;
    position += dt_s * velocity;
    const double turn = math::wrapped_angle(wanted_yaw_rad - yaw_rad);
    yaw_rad += std::clamp(turn, -kYawRate_radps * dt_s, kYawRate_radps * dt_s);
  }
};

/// As a stereo matcher makes them up: other pixels in each image.
void add_ghosts(int count, RandomStream& random, std::vector<float>& pixels) {
  for (int i = 0; i < count; ++i) {
    const double place = random.uniform(0.0, static_cast<double>(pixels.size()));
    pixels[static_cast<std::size_t>(place)] = static_cast<float>(random.uniform(0.7, 5.0));
  }
}

PlannerView seen_by(const Vehicle& vehicle, const Course& near,
                    const std::vector<CameraSetup>& cameras, double time_s, RandomStream& random,
                    std::vector<std::vector<float>>& pixels) {
  PlannerView view;
  view.time_s = time_s;
  view.position_world = vehicle.position;
  view.velocity_world = vehicle.velocity;
  view.rates_body.setZero();
  view.q_world_body = attitude(vehicle.acceleration, vehicle.yaw_rad);
  pixels.resize(cameras.size());
  // As the host has it: of one moment the last camera's image comes first.
  for (std::size_t i = cameras.size(); i-- > 0;) {
    DepthView depth;
    depth.time_s = time_s;
    depth.camera = static_cast<std::uint32_t>(i);
    depth.T_world_camera =
        make_pose(vehicle.position, view.q_world_body) * cameras[i].T_body_camera;
    pixels[i] = depth_image(near, cameras[i], depth.T_world_camera);
    add_ghosts(near.ghost_count, random, pixels[i]);
    depth.depth_m = pixels[i];
    view.depth.push_back(depth);
  }
  return view;
}

}  // namespace

Course nearby(const Course& course, const Eigen::Vector3d& position, double range_m) {
  Course near = course;
  std::erase_if(near.cylinders, [&](const Cylinder& tree) {
    return (tree.centre - position.head<2>()).norm() > 1.5 * range_m;
  });
  std::erase_if(near.balls,
                [&](const Ball& bush) { return (bush.centre - position).norm() > 1.5 * range_m; });
  return near;
}

Course meadow() {
  Course course;
  course.start_world = {0.0, 2.0, 2.0};
  course.goal_world = {0.0, 38.0, 2.0};
  return course;
}

Course forest(double poisson_radius_m, std::uint64_t seed) {
  Course course = meadow();
  RandomStream random = stream(seed, "kinematic_forest");
  course.start_world.x() = random.uniform(-15.0, 15.0);
  course.goal_world.x() = random.uniform(-15.0, 15.0);
  std::vector<Eigen::Vector2d> feet;
  for (int i = 0; i < 20000; ++i) {  // dart throwing fills the area as densely as Bridson's sampler
    const double x = random.uniform(-20.0, 20.0);
    const double y = random.uniform(0.0, 40.0);
    const Eigen::Vector2d foot(x, y);
    const bool apart = std::all_of(feet.begin(), feet.end(), [&](const Eigen::Vector2d& other) {
      return (other - foot).norm() >= poisson_radius_m;
    });
    if (!apart) continue;
    feet.push_back(foot);
    const double kind = random.uniform();
    const double size = random.uniform();
    const double free_m = std::min((foot - course.start_world.head<2>()).norm(),
                                   (foot - course.goal_world.head<2>()).norm());
    if (free_m < 2.5) continue;
    if (kind < 0.4) {
      const double radius_m = 0.7 + 0.9 * size;
      course.balls.push_back({{x, y, 0.8}, radius_m});
    } else {
      course.cylinders.push_back({foot, 0.15 + 0.35 * size});
    }
  }
  return course;
}

void add_hedge(Course& course, const Eigen::Vector2d& from, const Eigen::Vector2d& to) {
  constexpr double kSpacing_m = 0.5;
  const double length_m = (to - from).norm();
  const int last = static_cast<int>(length_m / kSpacing_m);
  for (int i = 0; i <= last; ++i) {
    course.cylinders.push_back({from + kSpacing_m * i / length_m * (to - from), 0.25});
  }
}

PlannerSetup vehicle_setup() {
  PlannerSetup setup;
  setup.max_speed_mps = 8.0;
  setup.max_acceleration_mps2 = kAcceleration_mps2;
  setup.max_yaw_rate_radps = kYawRate_radps;
  setup.body_size_m = {0.5, 0.5, 0.12};
  setup.plan_period_s = 1.0 / 30.0;
  setup.gravity_mps2 = 9.81;
  CameraSetup& camera = setup.cameras.emplace_back();
  camera.width_px = 64;
  camera.height_px = 48;
  camera.fx_px = camera.fy_px = 32.0;
  camera.cx_px = 31.5;
  camera.cy_px = 23.5;
  camera.T_body_camera.linear() << 0, 0, 1, -1, 0, 0, 0, -1, 0;
  camera.T_body_camera.translation() << 0.2, 0.0, 0.05;
  camera.rate_hz = 30.0;
  camera.min_range_m = 0.1;
  camera.max_range_m = 10.0;
  return setup;
}

PlannerSetup rig_setup() {
  PlannerSetup setup = vehicle_setup();
  CameraSetup& down = setup.cameras.emplace_back(setup.cameras.front());
  down.T_body_camera.linear() << 0, -1, 0, -1, 0, 0, 0, 0, -1;
  down.T_body_camera.translation() << 0.0, 0.0, -0.05;
  return setup;
}

std::vector<float> depth_image(const Course& course, const CameraSetup& camera,
                               const Eigen::Isometry3d& T_world_camera) {
  std::vector<float> depth_m;
  for (int row = 0; row < camera.height_px; ++row) {
    for (int column = 0; column < camera.width_px; ++column) {
      const Eigen::Vector3d ray((column - camera.cx_px) / camera.fx_px,
                                (row - camera.cy_px) / camera.fy_px, 1.0);
      const double depth = hit(course, T_world_camera.translation(), T_world_camera.linear() * ray);
      float pixel = static_cast<float>(depth);
      if (depth > camera.max_range_m) pixel = std::numeric_limits<float>::infinity();
      if (depth < camera.min_range_m) pixel = std::numeric_limits<float>::quiet_NaN();
      depth_m.push_back(pixel);
    }
  }
  return depth_m;
}

double clearance_m(const Course& course, const Eigen::Vector3d& point_world) {
  double nearest = point_world.z();
  for (const Cylinder& tree : course.cylinders) {
    nearest = std::min(nearest, (point_world.head<2>() - tree.centre).norm() - tree.radius_m);
  }
  for (const Ball& bush : course.balls) {
    nearest = std::min(nearest, (point_world - bush.centre).norm() - bush.radius_m);
  }
  return nearest;
}

Result fly(const Pilot& pilot, const Course& course, double time_limit_s,
           const PlannerSetup& setup) {
  const Eigen::Vector3d way = course.goal_world - course.start_world;
  PlannerMission mission;
  mission.seed = 1;
  mission.start_world = course.start_world;
  mission.goal_world = course.goal_world;
  mission.start_yaw_rad = math::atan2(way.y(), way.x());
  mission.goal_radius_m = 0.8;
  mission.time_limit_s = time_limit_s;

  Result result;
  result.reason = reset(pilot, mission);
  result.lowest_m = result.highest_m = course.start_world.z();
  Vehicle vehicle;
  vehicle.position = course.start_world;
  vehicle.yaw_rad = mission.start_yaw_rad;
  Eigen::Vector3d wanted = Eigen::Vector3d::Zero(), next = wanted;
  double wanted_yaw_rad = vehicle.yaw_rad, next_yaw_rad = wanted_yaw_rad;
  std::vector<std::vector<float>> pixels;
  RandomStream random = stream(1, "kinematic_ghosts");
  if (!result.reason.empty()) result.ending = Ending::failed;

  while (result.reason.empty() && result.time_s < time_limit_s) {
    // A command takes effect one plan period after what it answers.
    wanted = next;
    wanted_yaw_rad = next_yaw_rad;
    const Course near = nearby(course, vehicle.position, setup.cameras.front().max_range_m);
    const PlanResult plan = avoidbench::plan(
        pilot, seen_by(vehicle, near, setup.cameras, result.time_s, random, pixels));
    result.positions.push_back(vehicle.position);
    next = Eigen::Vector3d::Zero();
    if (plan.status == PlanStatus::command) {
      next = Eigen::Map<const Eigen::Vector3d>(plan.command.velocity_world_mps);
      next_yaw_rad = plan.command.yaw_rad;
    } else if (plan.status != PlanStatus::no_plan) {
      result.ending = Ending::failed;
      result.reason = "planner: " + plan.reason;
      return result;
    }
    constexpr int kSteps = 10;
    for (int i = 0; i < kSteps; ++i) {
      const Eigen::Vector3d before = vehicle.position;
      vehicle.step(wanted, wanted_yaw_rad, setup.plan_period_s / kSteps);
      result.path_m += (vehicle.position - before).norm();
      if (clearance_m(near, vehicle.position) < kBody_m) {
        result.ending = Ending::collided;
        return result;
      }
    }
    result.time_s += setup.plan_period_s;
    result.lowest_m = std::min(result.lowest_m, vehicle.position.z());
    result.highest_m = std::max(result.highest_m, vehicle.position.z());
    if ((vehicle.position - course.goal_world).head<2>().norm() < mission.goal_radius_m) {
      result.ending = Ending::reached_goal;
      return result;
    }
  }
  return result;
}

PlannerInstance instance_of(const std::string& file, const ParameterValues& parameters,
                            const PlannerSetup& setup) {
  const PlannerLibrary library = PlannerLibrary::load(file);
  return {library, setup, resolve_parameters(library.description(), parameters)};
}

}  // namespace avoidbench::kinematic
