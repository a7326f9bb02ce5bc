#pragma once

#include <limits>
#include <optional>

#include "render/scene.hpp"

namespace avoidbench {

/// Tests the body against the scene at each step and costs next to nothing in free space: the ball
/// around the body is known to be free within some distance of the last exact query, and until the
/// body's centre has moved that far there is nothing to ask.
struct CollisionCheck {
  Eigen::Vector3d body_size_m = Eigen::Vector3d::Zero();
  Eigen::Vector3d asked_at_world = Eigen::Vector3d::Zero();
  /// The centre may move this far from asked_at_world without a contact; < 0: unknown. Less what
  /// obstacles may have moved since.
  double free_radius_m = -1.0;
  /// From asked_at_world to the nearest surface; infinite: unknown. More by what obstacles may have
  /// moved since.
  double nearest_m = std::numeric_limits<double>::infinity();
};

/// Of the body's centre, within `limit_m`. The check knows it from now on.
NearestPoint nearest_surface(CollisionCheck& check, const Scene& scene,
                             const Eigen::Vector3d& centre_world, double limit_m);

/// From the body's box to the nearest surface, at most `limit_m`. As nearest_surface().
double body_clearance(CollisionCheck& check, const Scene& scene, const Pose& T_world_body,
                      double limit_m);

/// Obstacles moved, none by more than `way_m`.
void move_obstacles(CollisionCheck& check, double way_m);

/// The triangle that the body at `T_world_body` touches, exactly, or nothing.
std::optional<BodyContact> contact(CollisionCheck& check, const Scene& scene,
                                   const Pose& T_world_body);

}  // namespace avoidbench
