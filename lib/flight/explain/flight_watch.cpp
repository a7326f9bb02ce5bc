#include "explain/flight_watch.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <span>

#include "explain/sight.hpp"
#include "trial/planner_view.hpp"

namespace avoidbench {
namespace {

/// A patch is on an image if so many pixels have it at its depth, to within this share of it or
/// this much; on a sweep, if so many points are that near to it.
constexpr std::size_t kLeastPixels = 3;
constexpr double kDepthShare = 0.1, kDepth_m = 0.15;

/// A surface lies at the edge of a cell: the one that is occupied may be the next.
constexpr double kBeside_m = 0.15;
const std::array<Eigen::Vector3d, 7> kAround{Eigen::Vector3d::Zero(),
                                             kBeside_m* Eigen::Vector3d::UnitX(),
                                             -kBeside_m* Eigen::Vector3d::UnitX(),
                                             kBeside_m* Eigen::Vector3d::UnitY(),
                                             -kBeside_m* Eigen::Vector3d::UnitY(),
                                             kBeside_m* Eigen::Vector3d::UnitZ(),
                                             -kBeside_m* Eigen::Vector3d::UnitZ()};

std::optional<double> mapped_share(const PlaceLookUp& look_up,
                                   const std::vector<Eigen::Vector3d>& places) {
  std::vector<Eigen::Vector3d> asked;
  asked.reserve(places.size() * kAround.size());
  for (const Eigen::Vector3d& place : places) {
    for (const Eigen::Vector3d& beside : kAround) asked.emplace_back(place + beside);
  }
  const auto known = look_up(asked);
  if (!known) return std::nullopt;
  std::size_t occupied = 0;
  for (std::size_t i = 0; i < places.size(); ++i) {
    const auto around = std::span(*known).subspan(i * kAround.size(), kAround.size());
    if (std::find(around.begin(), around.end(), PlaceKnown::occupied) != around.end()) ++occupied;
  }
  return static_cast<double>(occupied) / static_cast<double>(places.size());
}

}  // namespace

FlightWatch::FlightWatch(const TrialSpec& spec, const std::vector<Sample>& samples,
                         const StruckPatch& patch)
    : samples_(&samples),
      patch_(&patch),
      cameras_(planner_setup(spec).cameras),
      lidars_(planner_setup(spec).lidars) {}

bool FlightWatch::shows_patch(const DepthView& image) const {
  const CameraSetup& camera = cameras_[image.camera];
  // By the true pose: the one that the planner was told has the odometry's error.
  const Eigen::Isometry3d T_camera_world =
      (body_pose_at(*samples_, image.time_s) * camera.T_body_camera).inverse();
  std::set<std::int32_t> pixels;
  for (const Eigen::Vector3d& place : places_at(*patch_, image.time_s)) {
    const Eigen::Vector3d p = T_camera_world * place;
    if (p.z() <= 0.0) continue;
    const double x = std::round(camera.fx_px * p.x() / p.z() + camera.cx_px);
    const double y = std::round(camera.fy_px * p.y() / p.z() + camera.cy_px);
    if (!(x >= 0.0 && y >= 0.0 && x < camera.width_px && y < camera.height_px)) continue;
    const auto pixel =
        static_cast<std::int32_t>(y) * camera.width_px + static_cast<std::int32_t>(x);
    const auto depth_m = static_cast<double>(image.depth_m[static_cast<std::size_t>(pixel)]);
    // False for NaN and +inf.
    if (std::abs(depth_m - p.z()) <= std::max(kDepth_m, kDepthShare * p.z())) pixels.insert(pixel);
    if (pixels.size() == kLeastPixels) return true;
  }
  return false;
}

/// By points beside its places, whatever the direction: a lidar errs along its beam.
bool FlightWatch::shows_patch(const CloudView& cloud) const {
  const Eigen::Isometry3d T_world_lidar =
      body_pose_at(*samples_, cloud.time_s) * lidars_[cloud.lidar].T_body_lidar;
  const std::vector<Eigen::Vector3d> places = places_at(*patch_, cloud.time_s);
  Eigen::AlignedBox3d around;
  for (const Eigen::Vector3d& place : places) around.extend(place);
  around.min().array() -= kDepth_m;
  around.max().array() += kDepth_m;
  std::size_t points = 0;
  for (const ab_lidar_point& point : cloud.points) {
    const Eigen::Vector3f in_lidar(point.position_lidar_m);
    const Eigen::Vector3d seen = T_world_lidar * in_lidar.cast<double>();
    if (!around.contains(seen)) continue;
    const bool is_beside = std::any_of(places.begin(), places.end(), [&](const auto& place) {
      return (place - seen).squaredNorm() <= kDepth_m * kDepth_m;
    });
    if (is_beside && ++points == kLeastPixels) return true;
  }
  return false;
}

void FlightWatch::planned(const PlanStep& step) {
  has_pictures_ = has_pictures_ || !step.view.stereo.empty() || !step.view.color.empty();
  sweep_count_ += step.view.clouds.size();
  depth_image_count_ += step.view.depth.size() + step.view.clouds.size();
  // Views come newest first.
  for (auto image = step.view.depth.rbegin(); image != step.view.depth.rend(); ++image) {
    if (shows_patch(*image)) sensed_s_.push_back(image->time_s);
  }
  for (auto cloud = step.view.clouds.rbegin(); cloud != step.view.clouds.rend(); ++cloud) {
    if (shows_patch(*cloud)) sensed_s_.push_back(cloud->time_s);
  }
  std::sort(sensed_s_.begin(), sensed_s_.end());
  calls_.push_back({.time_s = step.time_s,
                    .mapped_share = mapped_share(step.look_up, places_at(*patch_, step.time_s))});
}

}  // namespace avoidbench
