#include "view/seen_points.hpp"

#include <algorithm>
#include <string>

namespace avoidbench {

void SeenPoints::see(const PlannerView& view) {
  // Newest first: from the last one on, newer sweeps overwrite older ones of a lidar.
  for (auto cloud = view.clouds.rbegin(); cloud != view.clouds.rend(); ++cloud) {
    while (drawings_.size() <= cloud->lidar) {
      const std::string number = drawings_.empty() ? "" : " " + std::to_string(drawings_.size());
      drawings_.push_back({.kind = DrawingKind::points,
                           .color_rgb = 0x3070c0,
                           .label = "lidar" + number,
                           .size_px = 1.5,
                           .points_world = {}});
    }
    std::vector<Eigen::Vector3d>& points = drawings_[cloud->lidar].points_world;
    points.clear();
    const std::size_t step = std::max<std::size_t>(1, cloud->points.size() / most_points_);
    for (std::size_t i = 0; i < cloud->points.size(); i += step) {
      const float* const p = cloud->points[i].position_lidar_m;
      points.emplace_back(cloud->T_world_lidar * Eigen::Vector3f(p[0], p[1], p[2]).cast<double>());
    }
  }
}

}  // namespace avoidbench
