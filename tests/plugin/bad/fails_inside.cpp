#include <limits>

#include "avoidbench/planner.hpp"

// A class whose every way to fail is chosen by a parameter; planner.hpp keeps the exceptions
// inside.
class FailsInside {
 public:
  static constexpr const char* name = "fails_inside";
  static constexpr std::uint32_t needs = AB_INPUT_STATE;
  static constexpr std::uint32_t commands = AB_COMMAND_TRAJECTORY | AB_COMMAND_VELOCITY;
  static constexpr std::array parameters{avoidbench::choice_parameter(
      "how", "no_plan",
      "create|reset|plan|odd|unknown_name|wrong_kind|give_up|no_plan|trajectory|one_point|late_"
      "start|falling_times|nan_point|too_many",
      "What goes wrong.")};

  FailsInside(const ab_setup& setup, const ab_host& host) {
    const avoidbench::Parameters<FailsInside> values(setup);
    how_ = values.text("how");
    host.log(host.context, AB_LOG_WARNING, ("how " + how_).c_str());
    if (how_ == "create") throw std::runtime_error("no engine");
    if (how_ == "unknown_name") values.number("speed_mps");
    if (how_ == "wrong_kind") values.number("how");
  }

  void reset(const ab_mission&) {
    if (how_ == "reset") throw std::runtime_error("no way");
  }

  std::optional<ab_command> plan(const ab_observation&) {
    if (how_ == "plan") throw std::runtime_error("no idea");
    if (how_ == "odd") throw 7;
    if (how_ == "give_up") avoidbench::give_up("walled in");
    if (how_ == "no_plan") return std::nullopt;
    points_.assign(how_ == "one_point" ? 1 : (how_ == "too_many" ? 10001 : 3), ab_point{});
    for (std::size_t i = 0; i < points_.size(); ++i) {
      const auto step = static_cast<double>(i);
      points_[i].time_s = how_ == "falling_times" ? -step : 0.5 * step;
      points_[i].position_world_m[0] = step;
    }
    if (how_ == "late_start") points_[0].time_s = 0.1;
    if (how_ == "nan_point")
      points_[2].jerk_world_mps3[1] = std::numeric_limits<double>::quiet_NaN();
    return avoidbench::make_trajectory_command(points_);
  }

 private:
  std::string how_;
  std::vector<ab_point> points_;
};

AVOIDBENCH_PLANNER(FailsInside)
