#include "avoidbench/planner.hpp"
#include "pilot.hpp"

namespace {

/// A tree of motion primitives in known free space (Dharmadhikari et al. 2020); see README.md.
class Mbplanner {
 public:
  static constexpr const char* name = "mbplanner";
  static constexpr const char* version = "1.0";
  static constexpr const char* summary =
      "MBPlanner: a tree of motion primitives in known free space, with a stop at every end.";
  static constexpr std::uint32_t needs =
      AB_INPUT_STATE | AB_INPUT_DEPTH | AB_INPUT_POINTS | AB_INPUT_GOALS;
  static constexpr std::uint32_t commands = AB_COMMAND_TRAJECTORY;
  static constexpr const auto& parameters = mbplanner::kParameters;
  static constexpr std::array profiles{planning::published(mbplanner::kPublished)};

  Mbplanner(const ab_setup& setup, const ab_host& host)
      : canvas_(host), pilot_(mbplanner::settings_from(setup)) {}

  void reset(const ab_mission& mission) { pilot_.reset(mission); }

  std::optional<ab_command> plan(const ab_observation& seen) {
    auto points = pilot_.plan(seen);
    if (!points) return std::nullopt;
    pilot_.draw(canvas_);
    points_ = std::move(*points);
    ab_command command = avoidbench::make_trajectory_command(points_);
    command.horizon_s = points_.back().time_s;
    return command;
  }

  /// For `avoidbench explain`.
  std::uint8_t place_at(const avoidbench::Vec3& point_world_m) const {
    return planning::place_of(pilot_.grid(), point_world_m);
  }

 private:
  avoidbench::Canvas canvas_;
  mbplanner::Pilot pilot_;
  std::vector<ab_point> points_;
};

}  // namespace

AVOIDBENCH_PLANNER(Mbplanner)
