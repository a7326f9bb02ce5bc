#include "trial/map_scene.hpp"

#include "base/spec_json.hpp"

namespace avoidbench {

MapScene::MapScene(const TrialSpec& spec)
    : world(make_world(spec.map, spec.map_seed)), scene(world) {}

std::string map_scene_key(const TrialSpec& spec) {
  return spec_to_json(spec.map).dump() + std::to_string(spec.map_seed);
}

}  // namespace avoidbench
