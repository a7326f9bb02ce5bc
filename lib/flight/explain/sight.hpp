#pragma once

#include <vector>

#include "explain/struck_patch.hpp"
#include "render/scene.hpp"
#include "trial/trial_spec.hpp"

namespace avoidbench {

/// One exposure of a rig, or sweep of a lidar, and whether a tenth of the patch was before it.
struct PatchExposure {
  double time_s = 0.0;
  bool is_near = false;     ///< no farther than a camera measures, in any direction
  bool in_cone = false;     ///< in a camera's field of view, at any distance
  bool unoccluded = false;  ///< in_cone, and nothing between
  bool in_range = false;    ///< unoccluded, and not nearer or farther than that camera measures
};

/// All exposures of the sensor's cameras, and sweeps of its lidars, up to the contact, in order of
/// time: from the true poses
/// of `samples`. By geometry alone, whatever the planner asked for.
std::vector<PatchExposure> patch_exposures(const SensorSpec& sensor, const World& world,
                                           const StruckPatch& patch,
                                           const std::vector<Sample>& samples);

/// A share of the patch that counts as the patch.
inline constexpr double kEnoughOfPatch = 0.1;
/// What a planner can be asked to react to: maps want more than one image, and so do people.
inline constexpr std::size_t kEnoughImages = 3;

}  // namespace avoidbench
