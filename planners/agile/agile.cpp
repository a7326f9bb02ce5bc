#include <dlfcn.h>

#include <filesystem>
#include <stdexcept>

#include "avoidbench/planner_eigen.hpp"
#include "pilot.hpp"

namespace {

using Eigen::Vector3d;

constexpr const char* kWeights = "agile.safetensors";

/// The weights lie beside this library.
std::filesystem::path weights_file() {
  Dl_info info{};
  if (dladdr(reinterpret_cast<const void*>(&kWeights), &info) == 0 || info.dli_fname == nullptr) {
    throw std::runtime_error("can't tell where this library lies");
  }
  return std::filesystem::path(info.dli_fname).parent_path() / kWeights;
}

/// A net that maps a depth image to three trajectories and what each would cost.
class Agile {
 public:
  static constexpr const char* name = "agile";
  static constexpr const char* version = "1.0";
  static constexpr const char* summary =
      "Flies what a net makes of each depth image, after Agile-Autonomy.";
  static constexpr std::uint32_t needs =
      AB_INPUT_STATE | AB_INPUT_DEPTH | AB_INPUT_ONE_CAMERA | AB_INPUT_GOALS;
  /// What a camera does not cover is free space to the net.
  static constexpr std::array least_fov_rad{agile::kFovX_rad, agile::kFovY_rad};
  static constexpr std::uint32_t commands = AB_COMMAND_TRAJECTORY;
  static constexpr const auto& parameters = agile::kParameters;
  static constexpr std::array profiles{planning::published(agile::kPublished)};
  static constexpr std::array files{kWeights};

  /// Weights that are missing or damaged are an error before the first trial.
  static void check() { agile::Network{weights_file()}; }

  Agile(const ab_setup& setup, const ab_host& host)
      : network_(weights_file()),
        pilot_(agile::settings_from(setup),
               [this](const agile::Situation& situation, const agile::Image& image) {
                 return network_.run(image, agile::net_inputs(situation));
               }),
        canvas_(host) {}

  void reset(const ab_mission& mission) {
    goal_.reset(mission);
    pilot_.reset(mission);
  }

  std::optional<ab_command> plan(const ab_observation& seen) {
    const agile::Seen now = agile::seen_of(seen);
    if (goal_.update(seen)) pilot_.fly_to(avoidbench::as_vector(goal_.place_world_m()));
    if (!pilot_.has_mission() || !now.position_world.allFinite() ||
        !now.velocity_world.allFinite() || !std::isfinite(now.time_s)) {
      return std::nullopt;
    }
    const std::vector<ab_point>& points = pilot_.plan(now);
    if (canvas_.is_wanted()) draw();
    return avoidbench::make_trajectory_command(points);
  }

 private:
  /// For `avoidbench replay`: the three modes with their costs, and what is flown.
  void draw() const {
    for (const agile::Candidate& mode : pilot_.candidates()) {
      const planning::Quintic& curve = mode.curve;
      const auto at = [&](double time_s) { return motion_at(curve, time_s).position; };
      canvas_.line("mode", mode.is_flyable ? 0xe0a040 : 0xa0a0a0, places(at, curve.duration_s),
                   1.0);
      const Vector3d end = at(curve.duration_s);
      char cost[16];
      std::snprintf(cost, sizeof cost, "%.2f", mode.cost);
      canvas_.text(cost, 0xe0a040, {end.x(), end.y(), end.z()});
    }
    const planning::TimedMotion& motion = pilot_.motion();
    canvas_.line(
        "trajectory", 0xe02080,
        places([&](double time_s) { return motion.at(time_s).position; }, motion.duration_s), 2.0);
  }

  template <class At>
  static std::vector<Vector3d> places(const At& at, double duration_s) {
    constexpr int kSteps = 40;
    std::vector<Vector3d> places;
    for (int i = 0; i <= kSteps; ++i) places.push_back(at(duration_s * i / kSteps));
    return places;
  }

  avoidbench::CurrentGoal goal_;
  agile::Network network_;
  agile::Pilot pilot_;
  avoidbench::Canvas canvas_;
};

}  // namespace

AVOIDBENCH_PLANNER(Agile)
