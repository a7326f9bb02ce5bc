#pragma once

#include <optional>
#include <vector>

#include "geometry/pose.hpp"
#include "trial/trial_record.hpp"
#include "world/world.hpp"

namespace avoidbench {

/// The obstacle's instances alone, where they stand at a moment.
World alone(const World& world, std::int64_t obstacle, double time_s);

/// The body's pose between two samples; before the first and after the last, that one's.
Pose body_pose_at(const std::vector<Sample>& samples, double time_s);

/// How an instance with some of the patch's places moves.
struct PatchMotion {
  Eigen::Vector3d rest_world = Eigen::Vector3d::Zero();  ///< its transform's place
  Motion motion;
};

/// The surface that a flight touched last, near where it did.
struct StruckPatch {
  std::int64_t obstacle = -1;
  double contact_s = 0.0;
  Eigen::Vector3d contact_world = Eigen::Vector3d::Zero();  ///< nearest to the body's centre
  std::vector<Eigen::Vector3d> places_world;                ///< over the patch, at the contact
  std::vector<std::int32_t> motion;  ///< of each place: index into `motions`; -1: none
  std::vector<PatchMotion> motions;

  bool is_moving() const { return !motions.empty(); }
};

/// Patches reach so far from the contact.
inline constexpr double kPatchRadius_m = 0.25;

/// Nothing where the flight touched nothing that the world has.
std::optional<StruckPatch> struck_patch(const World& world, const TrialRecord& record);

/// Where the patch's places are at a moment.
std::vector<Eigen::Vector3d> places_at(const StruckPatch& patch, double time_s);

}  // namespace avoidbench
