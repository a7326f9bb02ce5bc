#include <benchmark/benchmark.h>

#include <array>

#include "metrics/environment.hpp"
#include "metrics/map_record.hpp"
#include "metrics/reference_path.hpp"

namespace avoidbench {
namespace {

/// Bench argument 0: kind of map; argument 1: the longer side of its area [m].
TrialSpec trial_on(std::int64_t map, double side_m) {
  TrialSpec trial;
  if (map == 0) trial.map = ForestSpec{.area_m = {side_m, side_m}, .poisson_radius_m = 3.5};
  if (map == 1) trial.map = ForestSpec{.area_m = {side_m, side_m}, .poisson_radius_m = 2.1};
  if (map == 2) trial.map = HallSpec{.area_m = {side_m, side_m}};
  if (map == 3) trial.map = MazeSpec{.area_m = {side_m, side_m}};
  if (map == 4) trial.map = DeadEndsSpec{.area_m = {side_m, side_m}};
  return trial;
}

std::string label(std::int64_t map) {
  static constexpr std::array kNames{"forest 3.5 m", "forest 2.1 m", "hall", "maze", "dead_ends"};
  return kNames[static_cast<std::size_t>(map)];
}

/// Making the world from its seed: meshes, instances and digest.
void make_world_of(benchmark::State& bench) {
  const TrialSpec trial = trial_on(bench.range(0), static_cast<double>(bench.range(1)));
  for (auto _ : bench) {
    World world = make_world(trial.map, trial.map_seed);
    benchmark::DoNotOptimize(world.digest);
    bench.counters["instances"] = static_cast<double>(world.instances.size());
    bench.counters["MB"] = static_cast<double>(memory_bytes(world)) / 1e6;
  }
  bench.SetLabel(label(bench.range(0)));
}

/// Embree's scene over a world that is there.
void make_scene_of(benchmark::State& bench) {
  const TrialSpec trial = trial_on(bench.range(0), static_cast<double>(bench.range(1)));
  const World world = make_world(trial.map, trial.map_seed);
  for (auto _ : bench) benchmark::DoNotOptimize(Scene(world));
  bench.SetLabel(label(bench.range(0)));
}

/// Traversability of a map by itself, its grid of clearances included.
void traversability_of(benchmark::State& bench) {
  const TrialSpec trial = trial_on(bench.range(0), static_cast<double>(bench.range(1)));
  const World world = make_world(trial.map, trial.map_seed);
  const Scene scene(world);
  const BodyMeasure body = body_measure(to_eigen(trial.vehicle.body_size_m));
  for (auto _ : bench) {
    ClearanceGrid grid(scene, world.bounds, kMapCell_m);
    const Traversability measured = traversability(scene, grid, body);
    bench.counters["ratio"] = measured.normalized_ratio;
  }
  bench.SetLabel(label(bench.range(0)));
}

/// Reference paths of ten missions on one map, after its traversability, as in a sweep.
void reference_paths_of(benchmark::State& bench) {
  constexpr std::int64_t kMissions = 10;
  const TrialSpec trial = trial_on(bench.range(0), static_cast<double>(bench.range(1)));
  const World world = make_world(trial.map, trial.map_seed);
  const Scene scene(world);
  const BodyMeasure body = body_measure(to_eigen(trial.vehicle.body_size_m));
  std::vector<Mission> missions;
  for (std::int64_t i = 0; i < kMissions; ++i) {
    if (const auto made = make_mission(scene, trial.mission, trial.seed, i)) {
      missions.push_back(*made);
    }
  }
  for (auto _ : bench) {
    bench.PauseTiming();
    ClearanceGrid grid(scene, world.bounds, kMapCell_m);
    benchmark::DoNotOptimize(traversability(scene, grid, body));
    bench.ResumeTiming();
    double sum_m = 0.0;
    for (const Mission& mission : missions) {
      const auto path = reference_path(grid, mission, trial.mission.goal_radius_m, body.radius_m);
      if (path) sum_m += path_length_m(*path);
    }
    bench.counters["mean_m"] = sum_m / static_cast<double>(missions.size());
  }
  bench.counters["ms_a_mission"] = benchmark::Counter(
      1e-3 * static_cast<double>(missions.size()),
      benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
  bench.SetLabel(label(bench.range(0)));
}

void sizes_of_maps(benchmark::internal::Benchmark* bench) {
  for (const int side_m : {20, 40, 80, 160}) bench->Args({0, side_m});
  bench->Args({1, 40})->Args({1, 160});
  for (const int map : {2, 3, 4}) bench->Args({map, 20})->Args({map, 40});
  bench->Unit(benchmark::kMillisecond);
}

BENCHMARK(make_world_of)->Apply(sizes_of_maps);
BENCHMARK(make_scene_of)->Apply(sizes_of_maps);
BENCHMARK(traversability_of)->Apply(sizes_of_maps)->Iterations(1);
BENCHMARK(reference_paths_of)->Apply(sizes_of_maps)->Iterations(1);

}  // namespace
}  // namespace avoidbench
BENCHMARK_MAIN();
