#include "conformance/rig_rule.hpp"

#include <algorithm>
#include <limits>

#include "conformance/conformance_flight.hpp"
#include "conformance/own_process.hpp"
#include "plugin/planner_table.hpp"

namespace avoidbench {
namespace {

/// The vehicle without a lidar, by which a planner might fly as well.
PlannerSetup camera_setup() {
  PlannerSetup setup = conformance_setup();
  setup.lidars.clear();
  return setup;
}

/// The same with a second camera below it that looks straight down.
PlannerSetup rig_setup() {
  PlannerSetup setup = camera_setup();
  CameraSetup down = setup.cameras.front();
  // From RDF (right, down, forward) to FLU (forward, left, up).
  down.T_body_camera.linear() << 0, -1, 0, -1, 0, 0, 0, 0, -1;
  down.T_body_camera.translation() << 0.0, 0.0, -0.05;
  setup.cameras.push_back(down);
  return setup;
}

/// The same flight with that camera's images of level ground, each before the first camera's.
ConformanceFlight with_ground(ConformanceFlight flight, const PlannerSetup& setup) {
  const CameraSetup& down = setup.cameras.back();
  const auto pixels =
      static_cast<std::size_t>(down.width_px) * static_cast<std::size_t>(down.height_px);
  for (Frame& frame : flight.frames) {
    // Depth is along camera z: level ground is everywhere as deep as the camera is high.
    const double height_m = frame.position_world.z() + down.T_body_camera.translation().z();
    frame.images.insert(frame.images.begin(),
                        std::vector<float>(pixels, static_cast<float>(height_m)));
    frame.cameras = {1, 0};
  }
  return flight;
}

bool are_alike(const PlannerLibrary& library, const PlannerSetup& setup,
               const ConformanceFlight& one, const ConformanceFlight& other) {
  const auto flown = [&](const ConformanceFlight& flight) {
    return replies_in_own_process(library, [&] {
      Probe probe(library.table(), resolve_parameters(library.description(), {}), false,
                  Looking::nobody, setup);
      return probe.is_created() ? probe.fly(flight) : std::vector<Reply>{};
    });
  };
  const std::vector<Reply> a = flown(one), b = flown(other);
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), equal);
}

}  // namespace

std::string tells_cameras_apart(const PlannerLibrary& library) {
  const std::uint32_t needs = library.description().needs;
  if (!sees_images(needs) || (needs & AB_INPUT_ONE_CAMERA) != 0) return "";
  const ConformanceFlight wall = wall_flight();
  const ConformanceFlight free = uniform_flight(std::numeric_limits<float>::infinity());
  // Twenty calls may be too few for a planner to answer what it sees.
  if (are_alike(library, camera_setup(), wall, free)) return "";
  const PlannerSetup rig = rig_setup();
  if (!are_alike(library, rig, with_ground(wall, rig), with_ground(free, rig))) return "";
  return "with a second camera, which looks down, its commands no longer depend on what the first "
         "one sees: look at each image's `camera`, as newest_depth(seen, camera) does, or declare "
         "AB_INPUT_ONE_CAMERA";
}

}  // namespace avoidbench
