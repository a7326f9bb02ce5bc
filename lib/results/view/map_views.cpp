#include "view/map_views.hpp"

#include <algorithm>
#include <initializer_list>
#include <limits>
#include <string_view>

#include "base/input_error.hpp"
#include "render/depth.hpp"
#include "shading/shading.hpp"
#include "view/map_plan.hpp"

namespace avoidbench {
namespace {

/// The world without things of these kinds, so that one sees in from outside.
World without(const World& world, std::initializer_list<std::string_view> kinds,
              double time_s = 0.0) {
  World open = standing_at(world, time_s);
  std::erase_if(open.instances, [&](const Instance& instance) {
    const std::string& kind = world.obstacles[instance.obstacle].kind;
    return std::find(kinds.begin(), kinds.end(), kind) != kinds.end();
  });
  return open;
}

/// Without a limit of range: `view.samples` rays a side of each pixel see up to the world's end.
Picture shaded(const World& world, const Pose& T_world_camera, double fov_x_rad, bool has_haze,
               const MapView& view) {
  const Scene scene(world);
  Light light;
  if (!has_haze) light.haze_range_m = std::numeric_limits<double>::infinity();
  const Pinhole camera = make_pinhole(view.width_px, view.height_px, fov_x_rad,
                                      std::numeric_limits<double>::infinity());
  Picture picture = make_picture(view.width_px, view.height_px);
  render_shaded(scene, camera, T_world_camera, light, view.samples, picture.rgb);
  return picture;
}

/// The flight space from above at a slant, without what would hide it.
Picture bird_view(const World& world, const MapView& view) {
  constexpr double kFov = 40.0 * math::kDegree;
  const Eigen::Vector3d center = world.flight_bounds.center();
  // From above and the lower left of a plan.
  const Eigen::Vector3d away = Eigen::Vector3d(-0.55, -0.8, 0.75).normalized();
  const Pose axes = look_at(center + away, center);
  const double tan_x = math::tan(0.5 * kFov);
  const double tan_y = tan_x * view.height_px / view.width_px;
  // For each corner, the least distance at which the cone of the field of view holds it, 8 % more
  // than that for a margin.
  double distance_m = 0.0;  // at which every corner of the flight space is in the picture
  for (int k = 0; k < 8; ++k) {
    const Eigen::Vector3d corner =
        world.flight_bounds.corner(static_cast<Aabb::CornerType>(k)) - center;
    const Eigen::Vector3d at = axes.linear().transpose() * corner;
    const double beside_m = std::max(std::abs(at.x()) / tan_x, std::abs(at.y()) / tan_y);
    distance_m = std::max(distance_m, 1.08 * beside_m - at.z());
  }
  const Eigen::Vector3d eye = center + away * distance_m;
  return shaded(without(world, {"ceiling", "lamp", "wall"}), look_at(eye, center), kFov, false,
                view);
}

/// The true depth of this sensor's field of view and range, without its errors, at the picture's
/// own size.
Picture depth_view(const World& world, const TrialSpec& trial, const MapView& view) {
  const Scene scene(world);
  const Pinhole camera =
      make_pinhole(view.width_px, view.height_px, trial.sensor.fov_x_deg * math::kDegree,
                   trial.sensor.max_range_m);
  std::vector<float> depth_m(static_cast<std::size_t>(view.width_px) *
                             static_cast<std::size_t>(view.height_px));
  render_depth(scene, camera,
               start_pose(scene, trial, view.mission_index, view.listed_missions) *
                   T_body_camera(trial.sensor.mounting),
               depth_m);
  Picture picture =
      depth_picture(depth_m, view.width_px, view.height_px, 0.0, trial.sensor.max_range_m);
  add_depth_scale(picture, 0.0, trial.sensor.max_range_m);
  return picture;
}

}  // namespace

std::vector<std::string> map_view_names() { return {"top", "bird", "first_person", "depth"}; }

Pose look_at(const Eigen::Vector3d& eye, const Eigen::Vector3d& target) {
  const Eigen::Vector3d forward = (target - eye).normalized();
  const Eigen::Vector3d right = forward.cross(Eigen::Vector3d::UnitZ()).normalized();
  Pose pose = Pose::Identity();
  // Axes of cameras: x to the right, y down, z forward.
  pose.linear().col(0) = right;
  pose.linear().col(1) = forward.cross(right);
  pose.linear().col(2) = forward;
  pose.translation() = eye;
  return pose;
}

Pose start_pose(const Scene& scene, const TrialSpec& trial, std::int64_t mission_index,
                const std::vector<Mission>& listed) {
  const auto mission = the_mission(scene, trial, mission_index, listed);
  if (!mission && !listed.empty()) {
    throw InputError("mission " + std::to_string(mission_index) + ": the map has only " +
                     std::to_string(listed.size()) + ", counted from 0");
  }
  if (!mission) {
    throw InputError("mission " + std::to_string(mission_index) +
                     ": no start or goal with mission.free_radius_m of free space; make the map "
                     "sparser, the radius smaller or the start and goal regions larger");
  }
  return make_pose(mission->start_world, yaw_rotation(mission->start_yaw_rad));
}

World without_roof(const World& world, double time_s) {
  return without(world, {"ceiling", "lamp"}, time_s);
}

Picture render_map(const World& world, const TrialSpec& trial, const MapView& view,
                   std::string& note) {
  if (view.name == "top") return plan_view(world, trial, view, note);
  if (view.name == "bird") return bird_view(world, view);
  if (view.name == "depth") return depth_view(world, trial, view);
  const Pose T_world_camera =
      start_pose(Scene(world), trial, view.mission_index, view.listed_missions) *
      T_body_camera(trial.sensor.mounting);
  return shaded(world, T_world_camera, trial.sensor.fov_x_deg * math::kDegree, true, view);
}

}  // namespace avoidbench
