#include "metrics/mover_difficulty.hpp"

#include <algorithm>
#include <optional>

#include "base/random.hpp"
#include "metrics/environment.hpp"
#include "movers/movers.hpp"
#include "trial/flown_world.hpp"
#include "trial/noise_seed.hpp"

namespace avoidbench {
namespace {

using Eigen::Vector3d;

constexpr int kFlights = 100, kTries = 200;
constexpr double kLength_m = 10.0, kLatestStart_s = 30.0;

/// A straight flight of kLength_m.
struct StraightFlight {
  Vector3d from_world = Vector3d::Zero(), direction = Vector3d::UnitX();
  double begin_s = 0.0;
};

/// From a free place, with its end within the flight box too.
std::optional<StraightFlight> drawn_flight(Scene& scene, const Vector3d& start_world,
                                           double radius_m, double latest_s, RandomStream& draws) {
  const World& world = scene.world();
  const Aabb& box = world.flight_bounds;
  const double above_ground_m =
      start_world.z() - ground_height_m(world, start_world.x(), start_world.y());
  for (int i = 0; i < kTries; ++i) {
    const double x = draws.uniform(box.min().x(), box.max().x());
    const double y = draws.uniform(box.min().y(), box.max().y());
    const double heading_rad = draws.uniform(0.0, math::kTau);
    const double begin_s = draws.uniform(0.0, latest_s);
    const StraightFlight flight{.from_world = {x, y, ground_height_m(world, x, y) + above_ground_m},
                                .direction = {math::cos(heading_rad), math::sin(heading_rad), 0.0},
                                .begin_s = begin_s};
    if (!box.contains(flight.from_world)) continue;
    if (!box.contains(Vector3d(flight.from_world + kLength_m * flight.direction))) continue;
    scene.set_time(begin_s);
    if (scene.nearest(flight.from_world, radius_m).distance_m > radius_m) return flight;
  }
  return std::nullopt;
}

/// As long as nothing can have come near, nothing is asked: each step is as long as the free
/// distance lasts for the vehicle and the fastest mover.
bool meets_something(Scene& scene, const StraightFlight& flight, double radius_m, double speed_mps,
                     double greatest_mover_mps) {
  constexpr double kLook_m = 5.0, kLeastStep_s = 0.005;
  const double length_s = kLength_m / speed_mps;
  double time_s = 0.0;
  while (true) {
    scene.set_time(flight.begin_s + time_s);
    const Vector3d place = flight.from_world + speed_mps * time_s * flight.direction;
    const double distance_m = scene.nearest(place, kLook_m).distance_m;
    if (distance_m <= radius_m) return true;
    if (time_s >= length_s) return false;
    const double free_m = std::min(distance_m, kLook_m) - radius_m;
    const double step_s = std::max(free_m / (speed_mps + greatest_mover_mps), kLeastStep_s);
    time_s = std::min(length_s, time_s + step_s);
  }
}

}  // namespace

double mean_mover_speed_mps(std::span<const Motion> motions, std::int64_t mover_count,
                            double time_limit_s) {
  const int seconds = static_cast<int>(std::min(60.0, time_limit_s));
  double sum_mps = 0.0;
  for (const Motion& motion : motions) {
    for (int i = 0; i <= seconds; ++i) {
      sum_mps += state_at(motion, static_cast<double>(i)).velocity_world.norm();
    }
  }
  return sum_mps / static_cast<double>(mover_count) / (seconds + 1.0);
}

double dynamic_traversability(Scene& scene, const Vector3d& start_world, double radius_m,
                              double speed_mps, double time_limit_s, std::uint64_t seed) {
  const World& world = scene.world();
  double greatest_mps = 0.0;
  for (const Motion& motion : world.motions) {
    greatest_mps = std::max(greatest_mps, greatest_surface_speed_mps(world, motion));
  }
  RandomStream draws = stream(seed, "straight flights");
  const double latest_s = std::min(kLatestStart_s, time_limit_s);
  int free_count = 0;
  for (int i = 0; i < kFlights; ++i) {
    const auto flight = drawn_flight(scene, start_world, radius_m, latest_s, draws);
    if (!flight) return math::kNaN;
    if (!meets_something(scene, *flight, radius_m, speed_mps, greatest_mps)) ++free_count;
  }
  return static_cast<double>(free_count) / kFlights;
}

MoverDifficulty mover_difficulty(const TrialSpec& spec, const Scene& map, const Mission& mission) {
  const std::optional<World> made = world_with_movers(spec, map, mission);
  if (!made) return {};
  const World& world = *made;
  Scene scene(world, map);
  const std::int64_t count = mover_count(spec.movers, map.world());
  const Vector3d size_m = world.flight_bounds.sizes();
  // What moves of the map itself is no mover.
  const std::span own = std::span(world.motions).subspan(map.world().motions.size());
  return {.density_1pm2 = static_cast<double>(count) / (size_m.x() * size_m.y()),
          .speed_mps = mean_mover_speed_mps(own, count, spec.mission.time_limit_s),
          .dynamic_traversability = dynamic_traversability(
              scene, mission.start_world, body_measure(to_eigen(spec.vehicle.body_size_m)).radius_m,
              spec.vehicle.max_speed_mps, spec.mission.time_limit_s,
              noise_seed(spec, "mover difficulty"))};
}

}  // namespace avoidbench
