#include "situation.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "avoidbench/planner_eigen.hpp"
#include "avoidbench/portable_math.hpp"

namespace agile {
namespace {

using Eigen::Vector3d;
namespace portable = avoidbench::portable;

/// Pixels [first, last) of a row or column of the source that fall into pixel `index` of the net's;
/// none where the source does not reach so far.
struct Range {
  int first = 0, last = 0;
};
Range source_pixels(int index, double center_px, double focal_px, double source_center_px,
                    int source_size) {
  const double scale = focal_px / kFocal_px;
  const double middle = (index - center_px) * scale + source_center_px;
  // A coarser source than the net's image: the one that is hit.
  int first = static_cast<int>(std::ceil(middle - 0.5 * scale));
  int last = static_cast<int>(std::ceil(middle + 0.5 * scale));
  if (first >= last) {
    first = static_cast<int>(std::floor(middle + 0.5));
    last = first + 1;
  }
  return {std::max(first, 0), std::min(last, source_size)};
}

std::uint8_t net_value(float depth_m) {
  if (!(depth_m < std::numeric_limits<float>::infinity())) return 0;
  if (!(depth_m > 1.0F)) return 255;
  return static_cast<std::uint8_t>(std::floor(255.0F / depth_m + 0.5F));
}

/// How far it is from `from` along the horizontal unit `direction` to the box's side.
double way_to_side_m(const Situation& situation, const Vector3d& direction) {
  double way_m = std::numeric_limits<double>::infinity();
  for (int axis = 0; axis < 2; ++axis) {
    const double along = direction[axis];
    if (std::abs(along) < 1e-9) continue;
    const double side = along > 0.0 ? situation.highest_world[axis] : situation.lowest_world[axis];
    way_m = std::min(way_m, (side - situation.start.position[axis]) / along);
  }
  return std::max(way_m, 0.0);
}

}  // namespace

Image net_image(const ab_depth_image& depth) {
  constexpr double kCenterX_px = 0.5 * (kImageWidth - 1), kCenterY_px = 0.5 * (kImageHeight - 1);
  std::array<Range, kImageWidth> columns;
  for (int x = 0; x < kImageWidth; ++x) {
    columns[static_cast<std::size_t>(x)] =
        source_pixels(x, kCenterX_px, depth.fx_px, depth.cx_px, depth.width_px);
  }
  Image image{};
  std::size_t at = 0;
  for (int y = 0; y < kImageHeight; ++y) {
    const Range rows = source_pixels(y, kCenterY_px, depth.fy_px, depth.cy_px, depth.height_px);
    for (const Range& range : columns) {
      float nearest_m = std::numeric_limits<float>::infinity();
      for (int row = rows.first; row < rows.last; ++row) {
        const float* pixels = depth.depth_m + std::size_t(row) * std::size_t(depth.width_px);
        for (int column = range.first; column < range.last; ++column) {
          const float depth_m = pixels[column];
          nearest_m = depth_m < nearest_m ? depth_m : nearest_m;  // NaN is never less
        }
      }
      image[at++] = net_value(nearest_m);
    }
  }
  return image;
}

ImageFrame image_frame(const ab_depth_image& depth) {
  ImageFrame frame;
  const Eigen::Isometry3d pose = avoidbench::pose_of(depth);
  frame.origin_world = pose.translation();
  const Vector3d ahead = pose.linear().col(2);
  // One that looks straight up or down has the heading of its upper edge.
  const Vector3d heading = ahead.head<2>().norm() > 1e-3 ? ahead : Vector3d(-pose.linear().col(1));
  frame.yaw_rad = portable::atan2(heading.y(), heading.x());
  frame.up_camera = pose.linear().row(2).transpose();
  return frame;
}

Vector3d turned_to_world(const ImageFrame& frame, const Vector3d& in_frame) {
  const double c = portable::cos(frame.yaw_rad), s = portable::sin(frame.yaw_rad);
  return {c * in_frame.x() - s * in_frame.y(), s * in_frame.x() + c * in_frame.y(), in_frame.z()};
}

Vector3d turned_to_frame(const ImageFrame& frame, const Vector3d& in_world) {
  const double c = portable::cos(frame.yaw_rad), s = portable::sin(frame.yaw_rad);
  return {c * in_world.x() + s * in_world.y(), c * in_world.y() - s * in_world.x(), in_world.z()};
}

Vector3d goal_direction_world(const Situation& situation) {
  const Vector3d way = situation.goal_world - situation.start.position;
  const double way_m = way.norm();
  return way_m > 1e-6 ? Vector3d(way / way_m) : turned_to_world(situation.frame, Vector3d::UnitX());
}

Inputs net_inputs(const Situation& situation) {
  const ImageFrame& frame = situation.frame;
  const planning::Motion& start = situation.start;
  const double reach = reach_m(situation);
  Inputs inputs{};
  std::size_t count = 0;
  const auto add = [&](double value) { inputs[count++] = static_cast<float>(value); };
  const auto add_vector = [&](const Vector3d& v) {
    for (int axis = 0; axis < 3; ++axis) add(v[axis]);
  };
  add_vector(turned_to_frame(frame, start.position - frame.origin_world));
  add_vector(turned_to_frame(frame, start.velocity) / situation.desired_speed_mps);
  add_vector(turned_to_frame(frame, start.acceleration) / 10.0);
  add_vector(frame.up_camera);
  add_vector(turned_to_frame(frame, goal_direction_world(situation)));
  add(std::min(1.0, (situation.goal_world - start.position).norm() / reach));
  add(situation.desired_speed_mps / 5.0);
  constexpr double kHeight_m = 3.0, kMost = 2.0;
  const auto height = [&](double way_m) { return std::clamp(way_m / kHeight_m, 0.0, kMost); };
  add(height(start.position.z() - situation.lowest_world.z()));
  add(height(situation.highest_world.z() - start.position.z()));
  for (const Vector3d& side :
       {Vector3d(Vector3d::UnitX()), Vector3d(Vector3d::UnitY()), Vector3d(-Vector3d::UnitY())}) {
    add(std::min(1.0, way_to_side_m(situation, turned_to_world(frame, side)) / reach));
  }
  return inputs;
}

}  // namespace agile
