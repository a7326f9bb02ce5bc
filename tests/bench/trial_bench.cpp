#include <benchmark/benchmark.h>

#include <optional>

#include "bare_loop.hpp"
#include "base/math.hpp"
#include "metrics/map_record.hpp"
#include "metrics/metric_table.hpp"
#include "render/depth.hpp"
#include "support/planner_files.hpp"
#include "trial/planner_view.hpp"
#include "trial/run_trial.hpp"

// Whole trials by the default camera, 320×240 depth at 30 Hz to 15 m, and by one of 64×48 pixels,
// on one core: how much faster than real time, and where the time goes.
namespace avoidbench {
namespace {

/// One pass over the images of a flight, from where the vehicle was.
struct ImageTimes {
  double bare_s = 0.0;    ///< the bare loop
  double render_s = 0.0;  ///< render_depth()
};

ImageTimes image_times(const Scene& scene, const TrialSpec& spec, const TrialRecord& record) {
  const Pinhole camera = sensor_camera(spec.sensor);
  std::vector<float> image(static_cast<std::size_t>(camera.width_px) *
                           static_cast<std::size_t>(camera.height_px));
  const embree::SceneHandle bare = bare_scene(scene.world());
  ImageTimes times;
  for (const PlanCall& call : record.plan_calls) {
    const auto index = std::min(static_cast<std::size_t>(call.time_s * spec.rates.sample_hz),
                                record.samples.size() - 1);
    const Sample& sample = record.samples[index];
    const Pose pose =
        make_pose(sample.position_world, sample.q_world_body) * T_body_camera(spec.sensor.mounting);
    const std::vector<Block> rays = prepared_rays(camera, pose);
    const double first = processor_s();
    trace_bare(bare.get(), rays, pose, spec.sensor.max_range_m);
    const double second = processor_s();
    render_depth(scene, camera, pose, image);
    times.bare_s += second - first;
    times.render_s += processor_s() - second;
    benchmark::DoNotOptimize(image.data());
  }
  return times;
}

/// A world with all that flies in it.
struct Flights {
  explicit Flights(TrialSpec of) : spec(std::move(of)) {
    spec.planner = test::preset_choice("reactive");
    world = make_world(spec.map, spec.map_seed);
    scene.emplace(world);
    library.emplace(PlannerLibrary::load(spec.planner.file));
    planner.emplace(*library, planner_setup(spec), parameter_values(spec.planner));
  }
  Flights(const Flights&) = delete;
  Flights& operator=(const Flights&) = delete;

  /// The next of five missions; `cpu_s` is the whole trial's.
  TrialRecord fly(double& cpu_s) {
    spec.mission_index = count++ % 5;
    const auto mission = make_mission(*scene, spec.mission, spec.seed, spec.mission_index);
    const double before = processor_s();
    TrialRecord record = run_trial(spec, *scene, *mission, *planner);
    cpu_s = processor_s() - before;
    return record;
  }

  TrialSpec spec;
  World world;
  std::optional<Scene> scene;
  std::optional<PlannerLibrary> library;
  std::optional<PlannerInstance> planner;
  std::int64_t count = 0;
};

void whole_trial(benchmark::State& state, const MapSpec& map, std::int64_t width_px) {
  TrialSpec spec;
  spec.map = map;
  spec.sensor.width_px = width_px;
  spec.sensor.height_px = width_px * 3 / 4;
  Flights flights(std::move(spec));
  std::vector<double> factors, bare, render, planner, rest, rest_ms;
  for (auto _ : state) {
    double trial_s = 0.0;
    const TrialRecord record = flights.fly(trial_s);
    double planner_s = 0.0;
    for (const PlanCall& call : record.plan_calls) planner_s += call.cpu_time_s;
    const ImageTimes images = image_times(*flights.scene, flights.spec, record);
    const double rest_s = trial_s - images.render_s - planner_s;
    factors.push_back(record.end_time_s / trial_s);
    bare.push_back(images.bare_s / trial_s);
    render.push_back(images.render_s / trial_s);
    planner.push_back(planner_s / trial_s);
    rest.push_back(rest_s / trial_s);
    rest_ms.push_back(1e3 * rest_s / static_cast<double>(record.plan_calls.size()));
    state.SetIterationTime(trial_s);
  }
  state.counters["real_time_factor"] = median(factors);
  state.counters["bare_ratio"] = median(bare);
  state.counters["render_ratio"] = median(render);
  state.counters["planner_ratio"] = median(planner);
  state.counters["rest_ratio"] = median(rest);
  state.counters["rest_ms_per_image"] = median(rest_ms);
}

const MapSpec kHall = HallSpec{};
const MapSpec kForest = ForestSpec{.area_m = {40.0, 40.0}, .poisson_radius_m = 3.5};

BENCHMARK_CAPTURE(whole_trial, hall, kHall, 320)
    ->UseManualTime()
    ->Iterations(3)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(whole_trial, forest, kForest, 320)
    ->UseManualTime()
    ->Iterations(3)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(whole_trial, hall_64x48, kHall, 64)
    ->UseManualTime()
    ->Iterations(3)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(whole_trial, forest_64x48, kForest, 64)
    ->UseManualTime()
    ->Iterations(3)
    ->Unit(benchmark::kMillisecond);

/// The first seconds of flights with one of the built-in sensors.
void trial_with(benchmark::State& state, const SensorSpec& sensor, const MapSpec& map) {
  TrialSpec spec;
  spec.map = map;
  spec.sensor = sensor;
  spec.mission.time_limit_s = 4.0;
  Flights flights(std::move(spec));
  std::vector<double> factors, bare_images;
  for (auto _ : state) {
    double trial_s = 0.0;
    const TrialRecord record = flights.fly(trial_s);
    factors.push_back(record.end_time_s / trial_s);
    // Of the sensor's size: what the trial costs in bare loops, one a plan call.
    bare_images.push_back(trial_s / image_times(*flights.scene, flights.spec, record).bare_s);
    state.SetIterationTime(trial_s);
  }
  state.counters["real_time_factor"] = median(factors);
  state.counters["in_bare_loops"] = median(bare_images);
}

void register_sensors() {
  const std::pair<const char*, MapSpec> maps[] = {{"hall", kHall}, {"forest", kForest}};
  for (const SensorSpec& sensor : sensor_presets()) {
    for (const auto& [name, map] : maps) {
      const std::string label = "sensor/" + sensor.name + "/" + name;
      benchmark::RegisterBenchmark(label.c_str(), trial_with, sensor, map)
          ->UseManualTime()
          ->Iterations(1)
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
