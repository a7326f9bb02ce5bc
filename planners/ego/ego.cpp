#include <cmath>
#include <cstddef>
#include <vector>

#include "avoidbench/planner_eigen.hpp"
#include "flight.hpp"
#include "settings.hpp"

namespace {

/// Gradient-based local planning without a distance field, after EGO-Planner; see README.md.
class Ego {
 public:
  static constexpr const char* name = "ego";
  static constexpr const char* version = "1.1";
  static constexpr const char* summary =
      "Optimises B-splines against anchors on obstacles, after EGO-Planner.";
  static constexpr std::uint32_t needs =
      AB_INPUT_STATE | AB_INPUT_DEPTH | AB_INPUT_POINTS | AB_INPUT_GOALS;
  static constexpr std::uint32_t commands = AB_COMMAND_TRAJECTORY;
  static constexpr const auto& parameters = ego::kParameters;
  static constexpr std::array profiles{planning::published(ego::kPublished)};

  Ego(const ab_setup& setup, const ab_host& host)
      : flight_(ego::settings_from(setup)), canvas_(host) {}

  void reset(const ab_mission& mission) {
    goal_.reset(mission);
    flight_.reset(mission);
  }

  std::optional<ab_command> plan(const ab_observation& seen) {
    const ab_state& state = *seen.state;
    if (!flight_.has_mission() ||
        !planning::is_place(avoidbench::as_vector(state.position_world_m)) ||
        !avoidbench::as_vector(state.velocity_world_mps).allFinite() ||
        !std::isfinite(state.time_s)) {
      return std::nullopt;
    }
    if (goal_.update(seen)) flight_.fly_to(goal_);
    // The oldest first.
    for (std::uint32_t i = seen.depth_count; i-- > 0;) flight_.see(*seen.depth[i]);
    for (std::uint32_t i = seen.cloud_count; i-- > 0;) flight_.see(*seen.clouds[i]);
    const std::vector<ab_point>& points = flight_.plan(state);
    if (canvas_.is_wanted()) draw(state);
    return avoidbench::make_trajectory_command(points);
  }

  /// For `avoidbench explain`.
  std::uint8_t place_at(const avoidbench::Vec3& point_world_m) const {
    return planning::place_of(flight_.surroundings().grid, point_world_m);
  }

 private:
  /// For `avoidbench replay`: the map about the vehicle's height, what was tried and what is flown.
  void draw(const ab_state& state) const {
    constexpr double kSlice_m = 0.35;
    std::vector<Eigen::Vector3d> occupied;
    for (const Eigen::Vector3d& center : flight_.surroundings().grid.occupied_centers()) {
      if (std::abs(center.z() - state.position_world_m[2]) < kSlice_m) occupied.push_back(center);
    }
    canvas_.points("occupied", 0x305080, occupied, 2.0);
    for (const planning::Bspline& curve : flight_.candidates()) {
      canvas_.line("candidate", 0xe0a040, places_of(curve), 1.0);
    }
    if (flight_.curve()) canvas_.line("trajectory", 0xe02080, places_of(*flight_.curve()), 2.0);
    canvas_.points("local target", 0x20a040, std::vector{flight_.target().position}, 7.0);
  }

  static std::vector<Eigen::Vector3d> places_of(const planning::Bspline& curve) {
    constexpr int kSteps = 60;
    std::vector<Eigen::Vector3d> places;
    for (int i = 0; i <= kSteps; ++i) {
      places.push_back(position_at(curve, curve.duration_s() * i / kSteps));
    }
    return places;
  }

  avoidbench::CurrentGoal goal_;
  ego::Flight flight_;
  avoidbench::Canvas canvas_;
};

}  // namespace

AVOIDBENCH_PLANNER(Ego)
