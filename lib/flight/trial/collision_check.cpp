#include "trial/collision_check.hpp"

#include <algorithm>
#include <cmath>

namespace avoidbench {

NearestPoint nearest_surface(CollisionCheck& check, const Scene& scene,
                             const Eigen::Vector3d& centre_world, double limit_m) {
  // What was nearest is now no farther than it was and the centre came: a small sphere is searched
  // faster. The margin is far more than rounding.
  constexpr double kMargin_m = 1e-6;
  const double moved_m = (centre_world - check.asked_at_world).norm();
  const double within_m = std::min(limit_m, check.nearest_m + moved_m + kMargin_m);
  const NearestPoint nearest = scene.nearest(centre_world, within_m);
  check.nearest_m = nearest.distance_m;
  check.asked_at_world = centre_world;
  check.free_radius_m = std::min(nearest.distance_m, limit_m) - 0.5 * check.body_size_m.norm();
  return nearest;
}

double body_clearance(CollisionCheck& check, const Scene& scene, const Pose& T_world_body,
                      double limit_m) {
  const Eigen::Vector3d centre = T_world_body.translation();
  const NearestPoint nearest = nearest_surface(check, scene, centre, limit_m);
  if (std::isinf(nearest.distance_m)) return limit_m;
  // The surface point that is nearest to the centre bounds the box's clearance: a small search.
  constexpr double kMargin_m = 1e-9;
  const Eigen::Vector3d half = 0.5 * check.body_size_m;
  const Eigen::Vector3d point_body =
      T_world_body.linear().transpose() * (nearest.point_world - centre);
  const double to_point_m = (point_body.cwiseAbs() - half).cwiseMax(0.0).norm();
  const double clearance_m =
      scene.body_clearance(check.body_size_m, T_world_body, to_point_m + kMargin_m);
  return std::min(clearance_m, nearest.distance_m);  // the body holds its own centre
}

void move_obstacles(CollisionCheck& check, double way_m) {
  check.free_radius_m -= way_m;
  check.nearest_m += way_m;
}

std::optional<BodyContact> contact(CollisionCheck& check, const Scene& scene,
                                   const Pose& T_world_body) {
  constexpr double kHorizon_m = 3.0;  // a nearest-point query is cheaper within a radius
  const Eigen::Vector3d centre = T_world_body.translation();
  // Still within the ball that the last query found free.
  if ((centre - check.asked_at_world).norm() < check.free_radius_m) return std::nullopt;
  nearest_surface(check, scene, centre, 0.5 * check.body_size_m.norm() + kHorizon_m);
  // The ball around the body's box is free, and so is every box whose centre moves less than what
  // is left of it, however it turns.
  if (check.free_radius_m > 0.0) return std::nullopt;
  return scene.touch(check.body_size_m, T_world_body);
}

}  // namespace avoidbench
