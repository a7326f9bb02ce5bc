#include "avoidbench/planner.hpp"
#include "avoidbench/planner_eigen.hpp"
#include "avoidbench/portable_math.hpp"

struct Motion {
  double speed_mps = 0.0;
};
struct Settings {
  Motion motion;
  int ray_count = 0;
  std::string mode, label;
};

// Uses every kind of parameter, by members and by name.
class Cpp17Planner {
 public:
  static constexpr const char* name = "cpp17_planner";
  static constexpr std::uint32_t needs = AB_INPUT_STATE | AB_INPUT_DEPTH;
  static constexpr std::uint32_t commands = AB_COMMAND_VELOCITY;
  static constexpr std::array parameters{
      avoidbench::parameter<&Settings::motion, &Motion::speed_mps>("speed_mps", "m/s", 2.0, 0.1,
                                                                   10.0, "Speed."),
      avoidbench::integer_parameter<&Settings::ray_count>("ray_count", "", 3, 1, 9, "Rays."),
      avoidbench::choice_parameter<&Settings::mode>("mode", "safe", "safe|fast", "Mode."),
      avoidbench::text_parameter<&Settings::label>("label", "", "Any text."),
      avoidbench::Setting<Settings>{avoidbench::text_parameter("note", "", "Taken by no member."),
                                    nullptr}};
  static constexpr std::array fast_numbers{ab_named_number{"speed_mps", 4.0}};
  static constexpr std::array profiles{avoidbench::profile("mode", "fast", fast_numbers)};

  Cpp17Planner(const ab_setup& setup, const ab_host& host) : canvas_(host) {
    const Settings settings = avoidbench::settings_from(parameters, setup);
    speed_mps_ = settings.motion.speed_mps * static_cast<double>(settings.ray_count);
    if (settings.mode == "fast") speed_mps_ *= 2.0;
    if (!settings.label.empty()) speed_mps_ += 1.0;
    const avoidbench::Parameters<Cpp17Planner> values(setup);  // the same by name
    if (values.number("speed_mps") != settings.motion.speed_mps ||
        values.integer("ray_count") != settings.ray_count || values.text("mode") != settings.mode ||
        values.text("label") != settings.label) {
      throw std::logic_error("a member has another parameter's value");
    }
  }
  void reset(const ab_mission&) {}
  std::optional<ab_command> plan(const ab_observation& seen) {
    if (avoidbench::newest_depth(seen, 0) == nullptr) return std::nullopt;
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
