#include "avoidbench/planner.hpp"
#include "avoidbench/planner_eigen.hpp"
#include "avoidbench/portable_math.hpp"

// Uses every kind of parameter.
class Cpp17Planner {
 public:
  static constexpr const char* name = "cpp17_planner";
  static constexpr std::uint32_t needs = AB_SEES_STATE | AB_SEES_DEPTH;
  static constexpr std::uint32_t commands = AB_COMMAND_VELOCITY;
  static constexpr std::array parameters{
      avoidbench::parameter("speed_mps", "m/s", 2.0, 0.1, 10.0, "Speed."),
      avoidbench::integer_parameter("ray_count", "", 3, 1, 9, "Rays."),
      avoidbench::choice_parameter("mode", "safe", "safe|fast", "Mode."),
      avoidbench::text_parameter("label", "", "Any text.")};

  Cpp17Planner(const ab_setup& setup, const ab_host& host) : canvas_(host) {
    const avoidbench::Parameters<Cpp17Planner> values(setup);
    speed_mps_ = values.number("speed_mps") * static_cast<double>(values.integer("ray_count"));
    if (values.text("mode") == "fast") speed_mps_ *= 2.0;
    if (!values.text("label").empty()) speed_mps_ += 1.0;
  }
  void reset(const ab_mission&) {}
  std::optional<ab_command> plan(const ab_observation& seen) {
    if (avoidbench::newest_depth(seen) == nullptr) return std::nullopt;
    if (canvas_.is_wanted()) {
      const Eigen::Vector3d place = avoidbench::as_vector(seen.state->position_world_m);
      canvas_.line("up", 0x00ff00, std::vector<Eigen::Vector3d>{place, 2.0 * place});
    }
    return avoidbench::make_velocity_command({speed_mps_, 0.0, 0.0}, 0.0);
  }

 private:
  avoidbench::Canvas canvas_;
  double speed_mps_ = 0.0;
};

AVOIDBENCH_PLANNER(Cpp17Planner)
