#include "plugin/world_door.hpp"

#include <cmath>

namespace avoidbench {

WorldDoor::WorldDoor(bool is_open) : is_open_(is_open) {
  table_.struct_size = static_cast<std::uint32_t>(sizeof table_);
  table_.context = this;
  table_.distances = [](void* context, const double* points_world_m, std::uint32_t point_count,
                        double* distances_m) -> ab_status {
    const WorldDoor& self = *static_cast<WorldDoor*>(context);
    if (!self.world.distance_m) return AB_ERROR;
    for (std::size_t i = 0; i < point_count; ++i) {
      const Eigen::Map<const Eigen::Vector3d> point(points_world_m + 3 * i);
      if (!point.allFinite()) return AB_ERROR;
      distances_m[i] = self.world.distance_m(point);
    }
    return AB_OK;
  };
  table_.shortest_path = [](void* context, double radius_m, const double** points_world_m,
                            std::uint32_t* point_count) -> ab_status {
    WorldDoor& self = *static_cast<WorldDoor*>(context);
    const ab_status status = self.answer_path(radius_m);
    *points_world_m = self.path_world_m_.data();
    *point_count = static_cast<std::uint32_t>(self.path_world_m_.size() / 3);
    return status;
  };
}

ab_status WorldDoor::answer_path(double radius_m) {
  path_world_m_.clear();
  const bool is_radius = std::isfinite(radius_m) && radius_m > 0.0;
  if (!is_radius || !world.shortest_path_world) return AB_ERROR;
  for (const Eigen::Vector3d& point : world.shortest_path_world(radius_m)) {
    path_world_m_.insert(path_world_m_.end(), {point.x(), point.y(), point.z()});
  }
  return path_world_m_.empty() ? AB_NO_PLAN : AB_OK;
}

}  // namespace avoidbench
