#include <benchmark/benchmark.h>

#include "bare_loop.hpp"
#include "base/math.hpp"
#include "metrics/map_record.hpp"
#include "metrics/metric_table.hpp"
#include "support/planner_files.hpp"
#include "trial/planner_view.hpp"
#include "trial/run_trial.hpp"

// Whole trials with 320×240 depth at 30 Hz to 15 m on one core: how much faster than real time, and
// what share of the time is not Embree's.
namespace avoidbench {
namespace {

/// Embree's own time for the frames of this flight: the bare loop from where the vehicle was.
double traversal_s(const Scene& scene, const TrialSpec& spec, const TrialRecord& record) {
  const Pinhole camera = sensor_camera(spec.sensor);
  double sum_s = 0.0;
  for (const PlanCall& call : record.plan_calls) {
    const auto index = std::min(static_cast<std::size_t>(call.time_s * spec.rates.sample_hz),
                                record.samples.size() - 1);
    const Sample& sample = record.samples[index];
    const Pose pose =
        make_pose(sample.position_world, sample.q_world_body) * T_body_camera(spec.sensor.mounting);
    const std::vector<Block> rays = prepared_rays(camera, pose);
    const double before = processor_s();
    trace_bare(scene.internals().top.get(), rays, pose, spec.sensor.max_range_m);
    sum_s += processor_s() - before;
  }
  return sum_s;
}

void whole_trial(benchmark::State& state, const MapSpec& map) {
  TrialSpec spec;
  spec.map = map;
  spec.planner = test::preset_choice("reactive");
  const World world = make_world(spec.map, spec.map_seed);
  const Scene scene(world);
  const PlannerLibrary library = PlannerLibrary::load(spec.planner.file);
  PlannerInstance planner(library, planner_setup(spec), parameter_values(spec.planner));
  std::vector<double> factors, shares;
  double flown_s = 0.0;
  for (auto _ : state) {
    spec.mission_index = static_cast<std::int64_t>(factors.size()) % 5;
    const auto mission = make_mission(scene, spec.mission, spec.seed, spec.mission_index);
    const double before = processor_s();
    const TrialRecord record = run_trial(spec, scene, *mission, planner);
    const double trial_s = processor_s() - before;
    double planner_s = 0.0;
    for (const PlanCall& call : record.plan_calls) planner_s += call.cpu_time_s;
    factors.push_back(record.end_time_s / trial_s);
    shares.push_back(1.0 - traversal_s(scene, spec, record) / (trial_s - planner_s));
    flown_s += record.end_time_s;
    state.SetIterationTime(trial_s);
  }
  state.counters["real_time_factor"] = median(factors);
  state.counters["not_traversal_ratio"] = median(shares);
  state.counters["flown_s"] = flown_s;
}

BENCHMARK_CAPTURE(whole_trial, hall, HallSpec{})
    ->UseManualTime()
    ->Iterations(10)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(whole_trial, hall_40m, HallSpec{.area_m = {40.0, 40.0}})
    ->UseManualTime()
    ->Iterations(10)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(whole_trial, forest, ForestSpec{.area_m = {40.0, 40.0}, .poisson_radius_m = 3.5})
    ->UseManualTime()
    ->Iterations(10)
    ->Unit(benchmark::kMillisecond);

/// The first seconds of flights with one of the built-in sensors.
void trial_with(benchmark::State& state, const SensorSpec& sensor, const MapSpec& map) {
  TrialSpec spec;
  spec.map = map;
  spec.sensor = sensor;
  spec.mission.time_limit_s = 4.0;
  spec.planner = test::preset_choice("reactive");
  const World world = make_world(spec.map, spec.map_seed);
  const Scene scene(world);
  const PlannerLibrary library = PlannerLibrary::load(spec.planner.file);
  PlannerInstance planner(library, planner_setup(spec), parameter_values(spec.planner));
  std::vector<double> factors;
  for (auto _ : state) {
    spec.mission_index = static_cast<std::int64_t>(factors.size()) % 5;
    const auto mission = make_mission(scene, spec.mission, spec.seed, spec.mission_index);
    const double before = processor_s();
    const TrialRecord record = run_trial(spec, scene, *mission, planner);
    const double trial_s = processor_s() - before;
    factors.push_back(record.end_time_s / trial_s);
    state.SetIterationTime(trial_s);
  }
  state.counters["real_time_factor"] = median(factors);
}

void register_sensors() {
  const std::pair<const char*, MapSpec> maps[] = {
      {"hall", HallSpec{}},
      {"forest", ForestSpec{.area_m = {40.0, 40.0}, .poisson_radius_m = 3.5}}};
  for (const SensorSpec& sensor : sensor_presets()) {
    for (const auto& [name, map] : maps) {
      const std::string label = "sensor/" + sensor.name + "/" + name;
      benchmark::RegisterBenchmark(label.c_str(), trial_with, sensor, map)
          ->UseManualTime()
          ->Iterations(3)
          ->Unit(benchmark::kMillisecond);
    }
  }
}

/// Environment metrics and five missions with their reference paths.
void measure_map(benchmark::State& state, const MapSpec& map, std::int64_t mission_count) {
  TrialSpec spec;
  spec.map = map;
  const World world = make_world(spec.map, spec.map_seed);
  const Scene scene(world);
  for (auto _ : state) benchmark::DoNotOptimize(make_map_record(spec, scene, mission_count));
}

BENCHMARK_CAPTURE(measure_map, forest_without_missions, ForestSpec{}, 0)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(measure_map, forest_with_10_missions, ForestSpec{}, 10)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(measure_map, hall_with_10_missions, HallSpec{}, 10)
    ->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace avoidbench

int main(int argc, char** argv) {
  avoidbench::register_sensors();
  benchmark::Initialize(&argc, argv);
  benchmark::RunSpecifiedBenchmarks();
}
