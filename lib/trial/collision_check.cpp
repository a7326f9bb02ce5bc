#include "trial/collision_check.hpp"

namespace avoidbench {

std::optional<BodyContact> contact(CollisionCheck& check, const Scene& scene,
                                   const Pose& T_world_body) {
  constexpr double kHorizon_m = 3.0;  // a nearest-point query is cheaper within a radius
  const Eigen::Vector3d centre = T_world_body.translation();
  // Still within the ball that the last query found free.
  if ((centre - check.asked_at_world).norm() < check.free_radius_m) return std::nullopt;
  // Of the ball around the box, whichever way it is turned.
  const double ball_radius_m = 0.5 * check.body_size_m.norm();
  const double distance_m = std::min(scene.nearest(centre, ball_radius_m + kHorizon_m).distance_m,
                                     ball_radius_m + kHorizon_m);
  check.asked_at_world = centre;
  check.free_radius_m = distance_m - ball_radius_m;
  // The ball around the body's box is free, and so is every box whose centre moves less than what
  // is left of it, however it turns.
  if (check.free_radius_m > 0.0) return std::nullopt;
  return scene.touch(check.body_size_m, T_world_body);
}

}  // namespace avoidbench
