#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>

#include "world/world.hpp"

/// Closed triangle shells added to a prototype, corners counter-clockwise seen from outside.
namespace avoidbench {

/// One ring of a tube: `lobe_ratio` makes it wavy (root flare): radius × (1 + lobe_ratio cos(5
/// angle)).
struct TubeRing {
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();
  double radius_m = 0.0;
  double lobe_ratio = 0.0;
};

/// A tube through the rings, of `sides` flat sides; both ends are closed, the far one by a point
/// where its radius is 0.
void add_tube(Prototype& prototype, std::span<const TubeRing> rings, int sides, Material material);

/// What a tuft of foliage looks like: an icosphere with lumps, each of its faces drawn out to a
/// leaf's tip.
struct TuftShape {
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();
  Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();  ///< columns: half axes; right-handed
  int subdivisions = 0;                                ///< 60 · 4^subdivisions triangles
  double lumps_ratio = 0.3;                            ///< height of the lumps, of the radius
  double tips_ratio = 0.4;  ///< greatest height of the tips above the shell, of the radius
  std::uint64_t seed = 0;
};

/// A closed, ragged shell.
void add_tuft(Prototype& prototype, const TuftShape& shape, Material material);

/// An upright box, 12 triangles.
void add_box(Prototype& prototype, const Eigen::Vector3d& lowest, const Eigen::Vector3d& highest,
             Material material);

}  // namespace avoidbench
