// What it costs that a planner is a program: a call with a depth image of 320 × 240 pixels, of the
// same planner in this process and behind the door. Medians of single calls, since a mean tells of
// the machine's other work.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <filesystem>

#include "conformance/conformance_flight.hpp"
#include "plugin/planner_instance.hpp"

namespace avoidbench {
namespace {

constexpr int kWidth_px = 320, kHeight_px = 240;

PlannerSetup bench_setup() {
  PlannerSetup setup = conformance_setup();
  CameraSetup& camera = setup.cameras.front();
  camera.width_px = kWidth_px;
  camera.height_px = kHeight_px;
  camera.fx_px = camera.fy_px = 160.0;
  camera.cx_px = 159.5;
  camera.cy_px = 119.5;
  return setup;
}

/// One call of a planner that takes the image and gives a velocity.
void plan(benchmark::State& state, const std::filesystem::path& file) {
  const PlannerLibrary library = PlannerLibrary::load(file);
  const PlannerSetup setup = bench_setup();
  PlannerInstance planner(library, setup, resolve_parameters(library.description(), {}));
  PlannerMission mission;
  mission.start_world = {0.0, 0.0, 2.0};
  mission.goal_world = {10.0, 0.0, 2.0};
  mission.goal_radius_m = 0.8;
  mission.time_limit_s = 60.0;
  if (const std::string error = planner.reset(mission); !error.empty()) {
    state.SkipWithError(error.c_str());
    return;
  }
  const std::vector<float> depth(kWidth_px * kHeight_px, 5.0F);
  PlannerView view;
  view.position_world = {0.0, 0.0, 2.0};
  view.velocity_world.setZero();
  view.rates_body.setZero();
  view.q_world_body.setIdentity();
  view.depth.push_back({.time_s = 0.0,
                        .T_world_camera = setup.cameras.front().T_body_camera,
                        .camera = 0,
                        .depth_m = depth});
  std::vector<double> wall_s;
  for (auto _ : state) {
    view.time_s += 1.0 / 30.0;
    const PlanResult result = planner.plan(view);
    if (result.status == PlanStatus::error) state.SkipWithError(result.reason.c_str());
    wall_s.push_back(result.wall_time_s);
  }
  std::sort(wall_s.begin(), wall_s.end());
  state.counters["median_us"] = 1e6 * wall_s[wall_s.size() / 2];
  state.counters["p99_us"] = 1e6 * wall_s[wall_s.size() * 99 / 100];
}

void register_all() {
  const std::filesystem::path built = AVOIDBENCH_BINARY_DIR;
  const auto add = [](const char* name, std::filesystem::path file) {
    benchmark::RegisterBenchmark(name, [file](benchmark::State& state) { plan(state, file); })
        ->Unit(benchmark::kMicrosecond)
        ->UseRealTime();
  };
  add("takes_depth/library", built / "bench" / "takes_depth.so");
  add("takes_depth/program_in_c", built / "bench" / "takes_depth");
  add("takes_depth/program_in_python",
      std::filesystem::path(AVOIDBENCH_SOURCE_DIR) / "tests/bench/takes_depth.py");
}

}  // namespace
}  // namespace avoidbench

int main(int argc, char** argv) {
  benchmark::Initialize(&argc, argv);
  avoidbench::register_all();
  benchmark::RunSpecifiedBenchmarks();
  benchmark::Shutdown();
}
