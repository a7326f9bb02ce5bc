#include <benchmark/benchmark.h>

#include "control/tracking.hpp"
#include "vehicle/dynamics.hpp"

namespace avoidbench {
namespace {

VehicleSpec vehicle_number(std::int64_t number) {
  return number == 0 ? hummingbird_spec() : firefly_spec();
}

/// One RK4 step of 1 ms under constant commands that keep the vehicle about where it is.
void open_loop_step(benchmark::State& bench) {
  const VehicleModel model = make_model(vehicle_number(bench.range(0)));
  VehicleState state = hovering_at(model.spec, {0, 0, 2}, 0.3);
  const RotorVector command = state.rotor_speed_radps;
  const Environment environment;
  for (auto _ : bench) {
    state = step(model, state, command, environment, kTicksPerMillisecond);
    benchmark::DoNotOptimize(state);
  }
  bench.SetItemsProcessed(bench.iterations());
  bench.SetLabel(model.spec.name);
}

/// One whole physics step of argument 2 [ms]: tracking and dynamics, with a new command ten times a
/// simulated second.
void closed_loop_step(benchmark::State& bench) {
  const VehicleModel model = make_model(vehicle_number(bench.range(0)));
  VehicleState state = hovering_at(model.spec, {0, 0, 2}, 0.3);
  Tracker tracker = make_tracker(model, state);
  const Environment environment;
  Command command;
  command.kind = bench.range(1) == 0 ? CommandKind::position : CommandKind::trajectory;
  for (int i = 0; i <= 20; ++i) {
    TrajectoryPoint point;
    point.time_s = 0.1 * i;
    point.position_world = {0.0, 0.2 * i, 2.0};
    point.velocity_world = {0.0, 2.0, 0.0};
    command.trajectory.push_back(point);
  }
  const std::int64_t step_ms = bench.range(2);
  std::int64_t time_ms = 0;
  for (auto _ : bench) {
    if (time_ms % 100 == 0) {
      command.position_world = {time_ms % 10000 < 5000 ? 10.0 : -10.0, 1.0, 2.0};
      command.start_tick = time_ms % 2000 == 0 ? state.tick : command.start_tick;
      accept(tracker, model, command, state);
    }
    time_ms += step_ms;
    const RotorVector rotors = track(tracker, model, state);
    state = step(model, state, rotors, environment, step_ms * kTicksPerMillisecond);
    benchmark::DoNotOptimize(state);
  }
  bench.SetItemsProcessed(bench.iterations());
  bench.counters["simulated_s_per_s"] =
      benchmark::Counter(1e-3 * static_cast<double>(time_ms), benchmark::Counter::kIsRate);
  bench.SetLabel(model.spec.name + (bench.range(1) == 0 ? " position" : " trajectory"));
}

BENCHMARK(open_loop_step)->Arg(0)->Arg(1);
BENCHMARK(closed_loop_step)
    ->Args({0, 0, 1})
    ->Args({0, 1, 1})
    ->Args({1, 0, 1})
    ->Args({0, 0, 4})
    ->Args({0, 1, 4})
    ->Args({1, 0, 4});

}  // namespace
}  // namespace avoidbench
BENCHMARK_MAIN();
