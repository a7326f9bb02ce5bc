#include <benchmark/benchmark.h>

#include <chrono>
#include <functional>
#include <thread>

#include "bare_loop.hpp"
#include "env/vector_env.hpp"

// Steps of a vector of flights, each 1/30 s of simulated time: how many a second, and with pictures
// what Embree alone takes for as many of them; what two threads gain, beside what they could. And
// the first reset, which makes the maps and searches the missions' reference paths.
namespace avoidbench {
namespace {

constexpr std::int64_t kSlots = 64;

EnvSpec env_spec(const MapSpec& map, bool has_depth, std::int64_t threads) {
  EnvSpec spec;
  spec.sweep.name = "bench";
  spec.sweep.base.map = map;
  spec.sweep.base.sensor.width_px = 64;
  spec.sweep.base.sensor.height_px = 48;
  spec.sweep.axes = {{.path = "map_seed", .values = {1, 2, 3, 4}}};
  spec.sweep.trials = 4;  // few missions: all are known after the first reset
  spec.slots = kSlots;
  spec.threads = threads;
  spec.needs = has_depth ? AB_INPUT_DEPTH : 0U;
  return spec;
}

/// The arrays of a vector, and a pilot that flies toward the goal at 3 m/s.
struct Learner {
  explicit Learner(const EnvSpec& spec)
      : env(spec),
        depth(spec.needs != 0 ? kSlots * env.shape().pixels() : 0),
        state(kSlots * kStateWidth),
        goal(kSlots * kGoalWidth),
        pose(kSlots * kPoseWidth),
        reward(kSlots),
        terminated(kSlots),
        truncated(kSlots),
        actions(kSlots * 4) {
    arrays.view.depth = depth.empty() ? nullptr : depth.data();
    arrays.view.state = state.data();
    arrays.view.goal = goal.data();
    arrays.view.pose = pose.data();
    arrays.reward = reward.data();
    arrays.terminated = terminated.data();
    arrays.truncated = truncated.data();
    env.reset(1, {}, arrays);
  }

  void step() {
    for (std::size_t i = 0; i < kSlots; ++i) {
      const Eigen::Map<const Eigen::Vector3f> to_goal(&goal[i * kGoalWidth]);
      const Eigen::Vector3d velocity = 3.0 * to_goal.cast<double>().normalized();
      std::copy(velocity.begin(), velocity.end(), actions.begin() + static_cast<long>(4 * i));
    }
    env.step(actions, true, arrays);
  }

  VectorEnv env;
  std::vector<float> depth, state, goal;
  std::vector<double> pose, reward;
  std::vector<std::uint8_t> terminated, truncated;
  std::vector<double> actions;
  EnvArrays arrays;
};

/// Embree's own time for what the slots see now, s.
double bare_s(const Learner& learner) {
  double sum_s = 0.0;
  const SensorSpec& sensor = learner.env.trial(0).sensor;
  const Pinhole camera = sensor_camera(sensor);
  for (std::size_t i = 0; i < kSlots; i += 8) {
    const double* pose = &learner.pose[i * kPoseWidth];
    const Pose T_world_body = make_pose(Eigen::Vector3d(pose[1], pose[2], pose[3]),
                                        Eigen::Quaterniond(pose[7], pose[8], pose[9], pose[10]));
    const Pose T_world_camera = T_world_body * T_body_camera(sensor.mounting);
    const std::vector<Block> rays = prepared_rays(camera, T_world_camera);
    const embree::SceneHandle bare = bare_scene(learner.env.scene(i).world());
    const double before = processor_s();
    trace_bare(bare.get(), rays, T_world_camera, sensor.max_range_m);
    sum_s += 8.0 * (processor_s() - before);
  }
  return sum_s;
}

void env_steps(benchmark::State& state, const MapSpec& map, bool has_depth) {
  const std::int64_t threads = state.range(0);
  Learner learner(env_spec(map, has_depth, threads));
  for (int i = 0; i < 30; ++i) learner.step();
  std::vector<double> rates, ratios;
  for (auto _ : state) {
    const double bare = has_depth ? bare_s(learner) : 0.0;
    const auto began = std::chrono::steady_clock::now();
    const double cpu = processor_s();
    learner.step();
    const std::chrono::duration<double> wall = std::chrono::steady_clock::now() - began;
    const double took_s = threads == 1 ? processor_s() - cpu : wall.count();
    state.SetIterationTime(took_s);
    rates.push_back(static_cast<double>(kSlots) / took_s);
    if (has_depth) ratios.push_back(took_s / bare);
  }
  state.counters["steps_per_s"] = median(rates);
  if (has_depth) state.counters["times_bare_loop"] = median(ratios);
}

double wall_s(const std::function<void()>& work) {
  const auto began = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count();
}

/// How much faster two threads are than one, and beside it what the machine can give: two vectors
/// of one thread each that share nothing, at the same time. All in turns, wall times of ten steps.
void env_scaling(benchmark::State& state, const MapSpec& map, bool has_depth) {
  Learner one(env_spec(map, has_depth, 1)), two(env_spec(map, has_depth, 2));
  Learner apart(env_spec(map, has_depth, 1));
  const auto steps = [](Learner& learner) {
    for (int i = 0; i < 10; ++i) learner.step();
  };
  std::vector<double> shared, separate;
  for (auto _ : state) {
    const double one_s = wall_s([&] { steps(one); });
    shared.push_back(one_s / wall_s([&] { steps(two); }));
    separate.push_back(2.0 * one_s / wall_s([&] {
                         const std::jthread other([&] { steps(apart); });
                         steps(one);
                       }));
  }
  state.counters["two_threads"] = median(shared);
  state.counters["two_apart"] = median(separate);
}

/// Every slot's first mission is one that nobody flew yet.
void env_first_reset(benchmark::State& state, const MapSpec& map) {
  for (auto _ : state) {
    EnvSpec spec = env_spec(map, false, state.range(0));
    spec.sweep.trials = 100;
    const Learner learner(spec);
    benchmark::DoNotOptimize(learner.pose.data());
  }
}

const MapSpec kHall = HallSpec{};
const MapSpec kForest = ForestSpec{.area_m = {40.0, 40.0}, .poisson_radius_m = 3.5};
BENCHMARK_CAPTURE(env_steps, hall_depth, kHall, true)
    ->Arg(1)
    ->Arg(2)
    ->UseManualTime()
    ->Iterations(60);
BENCHMARK_CAPTURE(env_steps, forest_depth, kForest, true)
    ->Arg(1)
    ->Arg(2)
    ->UseManualTime()
    ->Iterations(60);
BENCHMARK_CAPTURE(env_steps, hall_state, kHall, false)
    ->Arg(1)
    ->Arg(2)
    ->UseManualTime()
    ->Iterations(200);
BENCHMARK_CAPTURE(env_steps, forest_state, kForest, false)
    ->Arg(1)
    ->Arg(2)
    ->UseManualTime()
    ->Iterations(200);
BENCHMARK_CAPTURE(env_scaling, hall_state, kHall, false)->Iterations(40);
BENCHMARK_CAPTURE(env_scaling, forest_state, kForest, false)->Iterations(40);
BENCHMARK_CAPTURE(env_first_reset, hall, kHall)->Arg(1)->Arg(2)->UseRealTime()->Iterations(1);
BENCHMARK_CAPTURE(env_first_reset, forest, kForest)->Arg(1)->Arg(2)->UseRealTime()->Iterations(1);

}  // namespace
}  // namespace avoidbench

BENCHMARK_MAIN();
