#include <benchmark/benchmark.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <vector>

#include "avoidbench/planner_eigen.hpp"
#include "bare_loop.hpp"
#include "base/math.hpp"
#include "flight.hpp"
#include "maps/map_spec.hpp"
#include "render/depth.hpp"
#include "render/scene.hpp"

// What a call of `ego` costs in flight, its map and its planning apart: across a rendered forest,
// the vehicle being where it was told to be. Beside it, in turns, a Cholesky factorisation of 200 ×
// 200, so that figures of two machines compare.
namespace avoidbench {
namespace {

using Eigen::Vector3d;

constexpr double kPeriod_s = 1.0 / 30.0;

struct Times {
  std::vector<double> map_s, plan_s, planned_s, bare_s;  ///< planned: of calls for a new curve
};

double share(std::vector<double> values, double part) {
  if (values.empty()) return 0.0;
  const auto at = static_cast<std::ptrdiff_t>(part * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), values.begin() + at, values.end());
  return values[static_cast<std::size_t>(at)];
}

void factorise(Times& times) {
  static const Eigen::MatrixXd matrix = [] {
    Eigen::MatrixXd m = Eigen::MatrixXd::Constant(200, 200, 0.5);
    m.diagonal().array() += 200.0;
    return m;
  }();
  const double begin = processor_s();
  benchmark::DoNotOptimize(Eigen::LLT<Eigen::MatrixXd>(matrix).matrixLLT().data());
  times.bare_s.push_back(processor_s() - begin);
}

void look(const Scene& scene, const Vector3d& position, double yaw_rad, std::vector<float>& depth_m,
          ab_depth_image& image) {
  const Pinhole camera = make_pinhole(320, 240, 90.0 * math::kDegree, 15.0);
  Pose pose = Pose::Identity();
  pose.linear().col(2) = Vector3d(math::cos(yaw_rad), math::sin(yaw_rad), 0.0);
  pose.linear().col(1) = -Vector3d::UnitZ();
  pose.linear().col(0) = pose.linear().col(1).cross(pose.linear().col(2));
  pose.translation() = position;
  depth_m.resize(std::size_t{320} * 240);
  render_depth(scene, camera, pose, depth_m);
  image.width_px = 320;
  image.height_px = 240;
  image.fx_px = camera.fx_px;
  image.fy_px = camera.fy_px;
  image.cx_px = camera.cx_px;
  image.cy_px = camera.cy_px;
  const Eigen::Quaterniond q(pose.linear());
  const double wxyz[4] = {q.w(), q.x(), q.y(), q.z()};
  std::copy(wxyz, wxyz + 4, image.q_world_camera);
  as_vector(image.position_world_m) = position;
  image.depth_m = depth_m.data();
}

void fly(const Scene& scene, double start_x_m, Times& times) {
  ego::Settings settings;
  settings.grid.longest_ray_m = 5.5;
  settings.grid.inflation_m = 0.4;
  ego::Flight flight(settings);
  ab_mission mission{};
  const double ground_m = ground_height_m(scene.world(), start_x_m, 2.0);
  as_vector(mission.start_world_m) = Vector3d(start_x_m, 2.0, ground_m + 2.0);
  as_vector(mission.goal_world_m) = Vector3d(start_x_m, 36.0, ground_m + 2.0);
  mission.start_yaw_rad = math::kPi / 2;
  flight.reset(mission);
  ab_state state{};
  as_vector(state.position_world_m) = as_vector(mission.start_world_m);
  double yaw_rad = mission.start_yaw_rad;
  std::vector<float> depth_m;
  ab_depth_image image{};
  for (int i = 0; i < 600; ++i) {
    state.time_s = i * kPeriod_s;
    look(scene, as_vector(state.position_world_m), yaw_rad, depth_m, image);
    const double begin = processor_s();
    flight.see(image);
    const double seen = processor_s();
    const std::vector<ab_point>& points = flight.plan(state);
    const double end = processor_s();
    times.map_s.push_back(seen - begin);
    times.plan_s.push_back(end - seen);
    if (flight.has_planned()) times.planned_s.push_back(end - seen);
    factorise(times);
    // To where it is told to be a period later.
    std::size_t next = 1;
    while (next + 1 < points.size() && points[next].time_s < kPeriod_s) ++next;
    const double part = kPeriod_s / points[next].time_s;
    as_vector(state.position_world_m) +=
        part * (as_vector(points[next].position_world_m) - as_vector(points[0].position_world_m));
    as_vector(state.velocity_world_mps) = as_vector(points[next].velocity_world_mps);
    yaw_rad += part * (points[next].yaw_rad - points[0].yaw_rad);
    const Vector3d left = as_vector(mission.goal_world_m) - as_vector(state.position_world_m);
    if (left.head<2>().norm() < 0.8) break;
  }
}

void calls(benchmark::State& state, double poisson_radius_m) {
  const World world =
      make_world(ForestSpec{.area_m = {40.0, 40.0}, .poisson_radius_m = poisson_radius_m}, 1);
  const Scene scene(world);
  Times times;
  double start_x_m = 10.0;
  for (auto _ : state) fly(scene, start_x_m += 5.0, times);
  state.counters["calls"] = static_cast<double>(times.plan_s.size());
  state.counters["map_ms"] = 1e3 * median(times.map_s);
  state.counters["map_p95_ms"] = 1e3 * share(times.map_s, 0.95);
  state.counters["plan_ms"] = 1e3 * median(times.plan_s);
  state.counters["plan_p95_ms"] = 1e3 * share(times.plan_s, 0.95);
  state.counters["new_curve_ms"] = 1e3 * median(times.planned_s);
  state.counters["new_curve_p95_ms"] = 1e3 * share(times.planned_s, 0.95);
  state.counters["plan_ratio_to_bare"] = median(times.plan_s) / median(times.bare_s);
  state.counters["map_ratio_to_bare"] = median(times.map_s) / median(times.bare_s);
}

BENCHMARK_CAPTURE(calls, dense_forest, 2.3)->Iterations(4)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(calls, sparse_forest, 5.0)->Iterations(4)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace avoidbench

BENCHMARK_MAIN();
