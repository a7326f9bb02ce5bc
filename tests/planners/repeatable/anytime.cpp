// An anytime planner as one is written without a benchmark in mind: it samples until a budget of
// its own clock is spent, seeds from std::random_device, and rests between looks.
#include <unistd.h>

#include <array>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <optional>
#include <random>

#include "avoidbench/planner.hpp"
#include "avoidbench/repeatable.hpp"

namespace {

class Anytime {
 public:
  static constexpr const char* name = "anytime";
  static constexpr const char* summary = "Samples headings until its time is up.";
  static constexpr std::uint32_t needs = AB_INPUT_STATE;
  static constexpr std::uint32_t commands = AB_COMMAND_VELOCITY;
  static constexpr std::array parameters{
      avoidbench::compute_clock_parameter(),
      avoidbench::parameter("budget_ms", "ms", 0.02, 0.001, 100.0, "How long it may sample.")};

  explicit Anytime(const ab_setup& setup)
      : step_us_(avoidbench::Parameters<Anytime>(setup).number("compute_clock_us")),
        budget_(avoidbench::Parameters<Anytime>(setup).number("budget_ms")) {}

  void reset(const ab_mission& mission) {
    const auto in_use = repeatable_.begin(mission, step_us_);
    generator_.seed(std::random_device{}());
    goal_ = {mission.goal_world_m[0], mission.goal_world_m[1], mission.goal_world_m[2]};
  }

  std::optional<ab_command> plan(const ab_observation& seen) {
    const auto in_use = repeatable_.go_on(seen);
    const double* at = seen.state->position_world_m;
    const double bearing_rad = std::atan2(goal_[1] - at[1], goal_[0] - at[0]);
    using Clock = std::chrono::steady_clock;
    const Clock::time_point begin = Clock::now();
    double best_rad = 2.0;
    do {
      // Of the generator and of the C library by turns.
      const double share = std::rand() % 2 == 0
                               ? std::uniform_real_distribution<double>(-1.0, 1.0)(generator_)
                               : 2.0 * std::rand() / RAND_MAX - 1.0;
      if (std::abs(share) < std::abs(best_rad)) best_rad = share;
      ::usleep(1);
    } while (Clock::now() - begin < budget_);
    const double heading_rad = bearing_rad + best_rad;
    return avoidbench::make_velocity_command(
        {1.5 * std::cos(heading_rad), 1.5 * std::sin(heading_rad), goal_[2] - at[2]}, bearing_rad);
  }

 private:
  avoidbench::Repeatable repeatable_;
  double step_us_;
  std::chrono::duration<double, std::milli> budget_;
  std::mt19937 generator_;
  avoidbench::Vec3 goal_{};
};

}  // namespace

AVOIDBENCH_PLANNER(Anytime)
