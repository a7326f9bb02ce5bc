#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "bare_loop.hpp"
#include "base/math.hpp"
#include "base/random.hpp"
#include "maps/map_spec.hpp"
#include "planning/rolling_grid.hpp"
#include "render/depth.hpp"
#include "render/scene.hpp"

// The planners' occupancy grid over rendered images of a forest. Beside integrate(), in turns with
// it, stands the textbook's way: every ray walked to its end, one count a cell in a flat array.
namespace avoidbench {
namespace {

using Eigen::Vector3d;
using planning::RollingGrid;
using planning::RollingGridSpec;

constexpr double kDepthRange_m = 15.0;

struct Frame {
  std::vector<float> depth_m;
  ab_depth_image image{};
};

/// Images of a flight across a forest, 0.3 m apart, level, looking ahead.
std::vector<Frame> flown_frames(int count) {
  const World world = make_world(ForestSpec{.area_m = {40.0, 40.0}, .poisson_radius_m = 2.1}, 1);
  const Scene scene(world);
  const Pinhole camera = make_pinhole(320, 240, 90.0 * math::kDegree, kDepthRange_m);
  std::vector<Frame> frames(static_cast<std::size_t>(count));
  Pose pose = Pose::Identity();
  pose.linear().col(0) = Vector3d::UnitX();
  pose.linear().col(1) = -Vector3d::UnitZ();
  pose.linear().col(2) = Vector3d::UnitY();
  for (int i = 0; i < count; ++i) {
    Vector3d position(20.0, 2.0 + 0.3 * i, 0.0);
    do {
      position.x() += 0.3;
      position.z() = ground_height_m(world, position.x(), position.y()) + 2.0;
    } while (scene.nearest(position, 0.5).distance_m < 0.5);
    pose.translation() = position;
    Frame& frame = frames[static_cast<std::size_t>(i)];
    frame.depth_m.resize(std::size_t{320} * 240);
    render_depth(scene, camera, pose, frame.depth_m);
    frame.image.width_px = 320;
    frame.image.height_px = 240;
    frame.image.fx_px = camera.fx_px;
    frame.image.fy_px = camera.fy_px;
    frame.image.cx_px = camera.cx_px;
    frame.image.cy_px = camera.cy_px;
    const Eigen::Quaterniond q(pose.linear());
    const double wxyz[4] = {q.w(), q.x(), q.y(), q.z()};
    std::copy(wxyz, wxyz + 4, frame.image.q_world_camera);
    for (int k = 0; k < 3; ++k) frame.image.position_world_m[k] = position[k];
    frame.image.depth_m = frame.depth_m.data();
  }
  return frames;
}

Vector3d eye_of(const Frame& frame) { return Vector3d(frame.image.position_world_m); }

/// Walks all rays of the image (Amanatides and Woo) through a flat array around the eye.
void walk_bare(const Frame& frame, const RollingGridSpec& spec, std::vector<std::uint16_t>& seen) {
  constexpr int kSide = 128;
  seen.assign(std::size_t{kSide} * kSide * kSide, 0);
  const ab_depth_image& image = frame.image;
  for (int v = 0; v < image.height_px; v += spec.pixel_step) {
    for (int u = 0; u < image.width_px; u += spec.pixel_step) {
      const Vector3d ray((u - image.cx_px) / image.fx_px, 1.0, (image.cy_px - v) / image.fy_px);
      const double depth_m =
          static_cast<double>(frame.depth_m[static_cast<std::size_t>(v * image.width_px + u)]);
      const Vector3d way =
          ray * std::min(depth_m, spec.longest_ray_m / ray.norm()) / spec.resolution_m;
      int at[3] = {kSide / 2, kSide / 2, kSide / 2};
      int left = 0;
      double next[3], pace[3];
      for (int k = 0; k < 3; ++k) {
        pace[k] = 1.0 / std::max(std::abs(way[k]), 1e-9);
        next[k] = 0.5 * pace[k];
        left += static_cast<int>(std::abs(way[k]) + 0.5);
      }
      for (; left >= 0; --left) {
        ++seen[static_cast<std::size_t>((at[0] * kSide + at[1]) * kSide + at[2])];
        int axis = next[0] < next[1] ? 0 : 1;
        if (next[2] < next[axis]) axis = 2;
        at[axis] += way[axis] > 0.0 ? 1 : -1;
        next[axis] += pace[axis];
      }
    }
  }
}

/// `from_unknown`: the grid is emptied before each image, outside of what is measured; otherwise
/// it goes along, as in flight.
void integrate(benchmark::State& state, bool from_unknown) {
  const std::vector<Frame> frames = flown_frames(40);
  RollingGrid grid{RollingGridSpec{}};
  grid.reset(eye_of(frames.front()));
  std::vector<std::uint16_t> seen;
  std::vector<double> ours_s, bare_s;
  std::size_t i = 0;
  for (auto _ : state) {
    const Frame& frame = frames[i++ % frames.size()];
    if (from_unknown) grid.reset(eye_of(frame));
    const double first = processor_s();
    grid.move_to(eye_of(frame));
    grid.integrate(frame.image);
    const double second = processor_s();
    walk_bare(frame, grid.spec(), seen);
    bare_s.push_back(processor_s() - second);
    benchmark::DoNotOptimize(seen.data());
    ours_s.push_back(second - first);
    state.SetIterationTime(second - first);
  }
  state.counters["occupied"] = static_cast<double>(grid.occupied_centers().size());
  state.counters["ms"] = 1e3 * median(ours_s);
  state.counters["bare_ms"] = 1e3 * median(bare_s);
  state.counters["ratio_to_bare"] = median(ours_s) / median(bare_s);
}

/// One question after another along the images' way.
template <class Query>
void query(benchmark::State& state, Query ask) {
  const std::vector<Frame> frames = flown_frames(10);
  RollingGrid grid{RollingGridSpec{}};
  grid.reset(eye_of(frames.front()));
  for (const Frame& frame : frames) {
    grid.move_to(eye_of(frame));
    grid.integrate(frame.image);
  }
  RandomStream random(5);
  std::vector<Vector3d> places;
  for (int i = 0; i < 1024; ++i) {
    const double x = random.uniform(-4.0, 4.0);
    const double y = random.uniform(-4.0, 4.0);
    places.push_back(eye_of(frames.back()) + Vector3d(x, y, 0.0));
  }
  std::size_t i = 0;
  for (auto _ : state) {
    benchmark::DoNotOptimize(ask(grid, places[i]));
    i = (i + 1) % places.size();
  }
}

void is_inflated(benchmark::State& state) {
  query(state, [](const RollingGrid& grid, const Vector3d& at) { return grid.is_inflated(at); });
}

void box_state(benchmark::State& state) {
  query(state, [](const RollingGrid& grid, const Vector3d& at) {
    return grid.box_state(at, {0.7, 0.7, 0.4});
  });
}

BENCHMARK_CAPTURE(integrate, forest, false)
    ->UseManualTime()
    ->Iterations(200)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(integrate, forest_from_unknown, true)
    ->UseManualTime()
    ->Iterations(200)
    ->Unit(benchmark::kMillisecond);
BENCHMARK(is_inflated);
BENCHMARK(box_state);

}  // namespace
}  // namespace avoidbench

BENCHMARK_MAIN();
