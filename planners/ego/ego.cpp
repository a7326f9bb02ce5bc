#include <cmath>
#include <cstddef>

#include "avoidbench/planner_eigen.hpp"
#include "flight.hpp"
#include "settings.hpp"

namespace {

/// Gradient-based local planning without a distance field, after EGO-Planner; see README.md.
class Ego {
 public:
  static constexpr const char* name = "ego";
  static constexpr const char* version = "1.0";
  static constexpr const char* summary =
      "Optimises B-splines against anchors on obstacles, after EGO-Planner.";
  static constexpr std::uint32_t needs = AB_SEES_STATE | AB_SEES_DEPTH;
  static constexpr std::uint32_t commands = AB_COMMAND_TRAJECTORY;
  static constexpr auto parameters = ego::Declared::parameters;

  explicit Ego(const ab_setup& setup) : flight_(ego::settings_from(setup)) {}

  void reset(const ab_mission& mission) { flight_.reset(mission); }

  std::optional<ab_command> plan(const ab_observation& seen) {
    const ab_state& state = *seen.state;
    if (!avoidbench::as_vector(state.position_world_m).allFinite() ||
        !avoidbench::as_vector(state.velocity_world_mps).allFinite() ||
        !std::isfinite(state.time_s)) {
      return std::nullopt;
    }
    for (std::uint32_t i = seen.depth_count; i-- > 0;) flight_.see(*seen.depth[i]);  // oldest first
    return avoidbench::make_trajectory_command(flight_.plan(state));
  }

 private:
  ego::Flight flight_;
};

}  // namespace

AVOIDBENCH_PLANNER(Ego)
