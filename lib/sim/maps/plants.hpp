#pragma once

#include <vector>

#include "world/world.hpp"

namespace avoidbench {

/// A plant to be placed many times; its foot is at the origin, z up, metres at scale 1.
struct PlantModel {
  Prototype prototype;
  std::vector<double> trunk_heights_m,
      trunk_radii_m;  ///< a trunk's profile, rising; empty for a bush
};

/// Six trees, the same for every map: broad crown, slender, conifer, forked, crooked with low
/// boughs, half dead. Trunks are mostly clear up to 2–3 m; boughs, twigs and foliage reach
/// below 4.5 m, some below 2 m.
std::vector<PlantModel> tree_models();

/// Four bushes of overlapping shells of foliage, 0.8–1.9 m high.
std::vector<PlantModel> bush_models();

/// What stands in the way at `height_m` of a plant of this scale: the trunk's diameter there
/// (boughs and foliage don't count), or a bush's greatest horizontal diameter below that height.
double obstacle_width_m(const PlantModel& model, double scale, double height_m);

}  // namespace avoidbench
