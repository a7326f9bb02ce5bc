#pragma once

#include <Eigen/Core>
#include <span>

#include "render/scene.hpp"

namespace avoidbench {

struct Ray {
  Eigen::Vector3d origin_world = Eigen::Vector3d::Zero();
  Eigen::Vector3d direction_world = Eigen::Vector3d::UnitX();  ///< unit
};

/// Scene::first_hit() of many rays, several times as fast: `hits` has the size of `rays`. Rays that
/// follow one another should point about the same way.
void first_hits(const Scene& scene, std::span<const Ray> rays, double limit_m,
                std::span<RayHit> hits);

}  // namespace avoidbench
