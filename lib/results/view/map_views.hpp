#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "drawing/picture.hpp"
#include "render/scene.hpp"
#include "trial/mission.hpp"
#include "trial/trial_spec.hpp"
#include "world/world.hpp"

namespace avoidbench {

/// What a picture of a map shows.
struct MapView {
  std::string name = "bird";  ///< one of map_view_names()
  int width_px = 960, height_px = 720;
  int samples = 2;  ///< rays a side of each pixel
  std::int64_t mission_index = 0;
  std::vector<Mission> listed_missions = {};  ///< of the map where they are not made
};

/// top (a plan coloured by height, +y up, with a mission), bird (from outside, without roof and
/// walls), first_person and depth (from a mission's start toward its goal).
std::vector<std::string> map_view_names();

/// The world without its ceiling; what moves stands where it is at `time_s`.
World without_roof(const World& world, double time_s = 0.0);

/// A camera at `eye` that looks at `target`; its image's up is as near to the world's as can be.
Pose look_at(const Eigen::Vector3d& eye, const Eigen::Vector3d& target);

/// The body's pose at the start of a mission of the trial. Throws InputError where it can't be laid
/// out.
Pose start_pose(const Scene& scene, const TrialSpec& trial, std::int64_t mission_index,
                const std::vector<Mission>& listed = {});

/// The picture of `world`, the map of `trial`; what else its caption should say goes to `note`.
/// Throws InputError where the mission of first_person and depth can't be laid out.
Picture render_map(const World& world, const TrialSpec& trial, const MapView& view,
                   std::string& note);

}  // namespace avoidbench
