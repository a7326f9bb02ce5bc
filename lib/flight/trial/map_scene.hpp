#pragma once

#include <string>

#include "render/scene.hpp"
#include "trial/trial_spec.hpp"

namespace avoidbench {

/// A trial's map with its hierarchy of bounding volumes. It keeps its address, since the scene
/// keeps the world's.
struct MapScene {
  explicit MapScene(const TrialSpec& spec);
  MapScene(const MapScene&) = delete;
  MapScene& operator=(const MapScene&) = delete;

  World world;
  Scene scene;
};

/// What it is made from, as text: equal texts, equal maps.
std::string map_scene_key(const TrialSpec& spec);

}  // namespace avoidbench
