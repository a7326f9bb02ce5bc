#pragma once

#include <Eigen/Core>
#include <cstdint>

#include "world/world.hpp"

namespace avoidbench {

/// A point of a surface as its material sees it. Nothing here depends on the view but
/// `footprint_m`, which only fades what is too fine to be seen.
struct SurfacePoint {
  Material material = Material::soil;
  Eigen::Vector3f position_object;  ///< prototype's frame, scaled to metres
  Eigen::Vector3f normal_object;    ///< unit
  std::uint32_t object_seed = 0;    ///< of the instance: no two look the same
  float texture_opacity = 1.0F;     ///< 0: bland
  float footprint_m = 0.0F;         ///< size of a pixel on the surface
};

/// What light meets there. Colours are linear RGB.
struct SurfaceLook {
  Eigen::Vector3f albedo;
  Eigen::Vector3f normal_tilt =
      Eigen::Vector3f::Zero();  ///< to be added to the unit normal: relief
  float translucency = 0.0F;    ///< part of the sun that shines through from behind
  float glow = 0.0F;            ///< light of its own, times the albedo
  float crevice = 1.0F;         ///< part of the sky that reaches the point
};

SurfaceLook surface_look(const SurfacePoint& point);

}  // namespace avoidbench
