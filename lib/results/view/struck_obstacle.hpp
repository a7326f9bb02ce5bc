#pragma once

#include <memory>
#include <string>

#include "plugin/planner_instance.hpp"
#include "render/scene.hpp"
#include "trial/trial_record.hpp"
#include "view/replay_panel.hpp"

namespace avoidbench {

/// What a flight touched last, alone in a world of its own. Stays at its address.
struct StruckObstacle {
  explicit StruckObstacle(World struck) : world(std::move(struck)), scene(world) {}
  StruckObstacle(const StruckObstacle&) = delete;
  StruckObstacle& operator=(const StruckObstacle&) = delete;

  World world;  ///< with this obstacle's instances only, where they stood at the contact
  Scene scene;
  double time_s = 0.0;
  Eigen::Vector3d contact_world;
  bool is_shown = true;  ///< ground and ceiling are everywhere
  std::string label;     ///< "touched tree 17 at 3.21 s, 2.1 m/s"
};

/// Null where the flight touched nothing that the world has.
std::unique_ptr<StruckObstacle> struck_obstacle(const World& world, const TrialRecord& record);

/// Reddens the obstacle near the contact, crosses the contact and says what it was.
void draw_struck(const StruckObstacle& struck, Panel& panel);

/// Rings the contact where an image of this camera shows it, the image drawn `scale` times as
/// large: as wide as the patch that `explain` looks at. What is behind something is ringed all the
/// same.
bool ring_struck(const StruckObstacle& struck, const CameraSetup& camera, const Pose& T_world_body,
                 double scale, Picture& image);

}  // namespace avoidbench
