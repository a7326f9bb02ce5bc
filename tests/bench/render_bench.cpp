#include <benchmark/benchmark.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <ctime>
#include <limits>
#include <map>
#include <memory>
#include <vector>

#include "bare_loop.hpp"
#include "base/math.hpp"
#include "base/random.hpp"
#include "maps/map_spec.hpp"
#include "render/depth.hpp"
#include "render/flush_to_zero.hpp"
#include "render/primary_rays.hpp"
#include "render/scene.hpp"
#include "render/scene_internals.hpp"
#include "shading/shading.hpp"

// Each figure stands beside the same work by a bare Embree loop, measured in turns with it.
namespace avoidbench {
namespace {

constexpr double kDepthRange_m = 15.0;
constexpr int kPoseCount = 6;

enum MapKind { hall, forest, forest_160, dense_forest, dense_forest_160 };

struct Place {
  World world;
  std::unique_ptr<Scene> scene;
};

World bench_world(MapKind kind) {
  if (kind == hall) return make_world(HallSpec{.area_m = {40.0, 40.0}}, 1);
  const double side_m = kind == forest_160 || kind == dense_forest_160 ? 160.0 : 40.0;
  const double radius_m = kind == dense_forest || kind == dense_forest_160 ? 2.1 : 3.5;
  return make_world(ForestSpec{.area_m = {side_m, side_m}, .poisson_radius_m = radius_m}, 1);
}

const Place& place(MapKind kind) {
  static std::map<MapKind, Place> places;
  Place& found = places[kind];
  if (!found.scene) {
    found.world = bench_world(kind);
    found.scene = std::make_unique<Scene>(found.world);
  }
  return found;
}

/// Along a crossing of the map, looking ahead, moved aside where something is nearer than 0.5 m.
std::vector<Pose> crossing(const Place& place) {
  std::vector<Pose> poses;
  for (int i = 0; i < kPoseCount; ++i) {
    Pose pose = Pose::Identity();
    pose.linear().col(0) = Eigen::Vector3d::UnitX();
    pose.linear().col(1) = -Eigen::Vector3d::UnitZ();
    pose.linear().col(2) = Eigen::Vector3d::UnitY();
    Eigen::Vector3d position(20.0, 2.0 + 30.0 * i / (kPoseCount - 1), 0.0);
    do {
      position.x() += 0.3;
      position.z() = ground_height_m(place.world, position.x(), position.y()) + 2.0;
    } while (place.scene->nearest(position, 0.5).distance_m < 0.5);
    pose.translation() = position;
    poses.push_back(pose);
  }
  return poses;
}

void depth(benchmark::State& state, MapKind kind) {
  const Place& in = place(kind);
  const auto width = static_cast<std::int32_t>(state.range(0));
  const std::int32_t height = width * 3 / 4;
  const Pinhole camera = make_pinhole(width, height, 90.0 * math::kDegree, kDepthRange_m);
  const auto pixels = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  std::vector<float> image(pixels);
  const std::vector<Pose> poses = crossing(in);
  std::vector<std::vector<Block>> prepared;
  for (const Pose& pose : poses) prepared.push_back(prepared_rays(camera, pose));
  std::vector<double> ours_s;
  std::vector<double> bare_s;
  for (auto _ : state) {
    // One after the other over all places, so that neither finds the caches warm with the other's
    // work from the same place.
    std::vector<double> frame_s;
    for (const Pose& pose : poses) {
      const double start = processor_s();
      render_depth(*in.scene, camera, pose, image);
      frame_s.push_back(processor_s() - start);
      benchmark::DoNotOptimize(image.data());
    }
    for (std::size_t i = 0; i < poses.size(); ++i) {
      const double start = processor_s();
      trace_bare(in.scene->internals().top.get(), prepared[i], poses[i], kDepthRange_m);
      bare_s.push_back(processor_s() - start);
    }
    ours_s.insert(ours_s.end(), frame_s.begin(), frame_s.end());
    state.SetIterationTime(median(frame_s));
  }
  const double rays = static_cast<double>(pixels) * 1e-6;
  state.counters["ms"] = 1e3 * median(ours_s);
  state.counters["Mray_per_s"] = rays / median(ours_s);
  state.counters["bare_Mray_per_s"] = rays / median(bare_s);
  state.counters["ratio"] = median(bare_s) / median(ours_s);
}

/// Positions along crossings, a centimetre or so apart.
std::vector<Eigen::Vector3d> flown_positions(const Place& in) {
  RandomStream random(5);
  std::vector<Eigen::Vector3d> positions;
  for (int line = 0; line < 4; ++line) {
    const double x = random.uniform(5.0, 35.0);
    for (int i = 0; i < 1024; ++i) {
      const double y = 2.0 + 36.0 * i / 1024.0;
      positions.emplace_back(x, y, ground_height_m(in.world, x, y) + 2.0);
    }
  }
  return positions;
}

template <class Query>
void point_query(benchmark::State& state, MapKind kind, Query query) {
  const Place& in = place(kind);
  const std::vector<Eigen::Vector3d> positions = flown_positions(in);
  std::size_t i = 0;
  for (auto _ : state) {
    benchmark::DoNotOptimize(query(*in.scene, positions[i]));
    i = (i + 1) % positions.size();
  }
}

const Eigen::Vector3d kBody_m(0.5, 0.5, 0.12);

Pose level_at(const Eigen::Vector3d& position) {
  return make_pose(position, Eigen::Quaterniond::Identity());
}

void nearest(benchmark::State& state, MapKind kind) {
  point_query(state, kind, [](const Scene& scene, const Eigen::Vector3d& position) {
    return scene.nearest(position).distance_m;
  });
}

void nearest_within_1m(benchmark::State& state, MapKind kind) {
  point_query(state, kind, [](const Scene& scene, const Eigen::Vector3d& position) {
    return scene.nearest(position, 1.0).distance_m;
  });
}

void touch(benchmark::State& state, MapKind kind) {
  point_query(state, kind, [](const Scene& scene, const Eigen::Vector3d& position) {
    return scene.touch(kBody_m, level_at(position)).has_value();
  });
}

void body_clearance(benchmark::State& state, MapKind kind) {
  point_query(state, kind, [](const Scene& scene, const Eigen::Vector3d& position) {
    return scene.body_clearance(kBody_m, level_at(position), 5.0);
  });
}

void occluded_5m(benchmark::State& state, MapKind kind) {
  point_query(state, kind, [](const Scene& scene, const Eigen::Vector3d& position) {
    return scene.occluded(position, position + Eigen::Vector3d(0.6, 4.9, 0.1));
  });
}

/// A pair of grey shaded images in linear light, one ray a pixel, beside the depth images of the
/// same two cameras. Shaded images see as far as there is anything, depth images kDepthRange_m.
void shaded_pair(benchmark::State& state, MapKind kind, bool has_shadows) {
  constexpr double kBaseline_m = 0.1;
  const Place& in = place(kind);
  const auto width = static_cast<std::int32_t>(state.range(0));
  const std::int32_t height = width * 3 / 4;
  const Pinhole depth_camera = make_pinhole(width, height, 90.0 * math::kDegree, kDepthRange_m);
  Pinhole camera = depth_camera;
  camera.max_range_m = std::numeric_limits<double>::infinity();
  const Light light{.shadows = has_shadows};
  std::vector<float> image(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  const std::vector<Pose> left_poses = crossing(in);
  std::vector<double> shaded_s;
  std::vector<double> depth_s;
  for (auto _ : state) {
    std::vector<double> pair_s;
    for (const Pose& left : left_poses) {
      Pose right = left;
      right.translation() += kBaseline_m * left.linear().col(0);
      const double first = processor_s();
      for (const Pose& pose : {left, right}) {
        render_radiance(*in.scene, camera, pose, light, 1, Channels::grey, image);
        benchmark::DoNotOptimize(image.data());
      }
      pair_s.push_back(processor_s() - first);
      const double second = processor_s();
      for (const Pose& pose : {left, right}) {
        render_depth(*in.scene, depth_camera, pose, image);
        benchmark::DoNotOptimize(image.data());
      }
      depth_s.push_back(processor_s() - second);
    }
    shaded_s.insert(shaded_s.end(), pair_s.begin(), pair_s.end());
    state.SetIterationTime(median(pair_s));
  }
  state.counters["ms"] = 1e3 * median(shaded_s);
  state.counters["depth_pair_ms"] = 1e3 * median(depth_s);
  state.counters["ratio_to_depth_pair"] = median(shaded_s) / median(depth_s);
}

void build(benchmark::State& state, MapKind kind, bool flattened) {
  const World& world = place(kind).world;
  for (auto _ : state) {
    const Scene scene(world, flattened ? kFlattenTriangles : 0);
    benchmark::DoNotOptimize(&scene.internals());
  }
  state.counters["triangles"] = static_cast<double>(triangle_count(world));
}

BENCHMARK_CAPTURE(depth, hall, hall)
    ->Arg(640)
    ->Arg(320)
    ->Arg(64)
    ->UseManualTime()
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(depth, forest, forest)
    ->Arg(640)
    ->Arg(320)
    ->Arg(64)
    ->UseManualTime()
    ->Unit(benchmark::kMillisecond);
// What a frame costs where the map is larger and denser: what is seen counts, not the map.
BENCHMARK_CAPTURE(depth, forest_160, forest_160)->Arg(320)->UseManualTime();
BENCHMARK_CAPTURE(depth, dense_forest, dense_forest)->Arg(320)->UseManualTime();
BENCHMARK_CAPTURE(depth, dense_forest_160, dense_forest_160)->Arg(320)->UseManualTime();
BENCHMARK_CAPTURE(nearest, hall, hall);
BENCHMARK_CAPTURE(nearest, forest, forest);
BENCHMARK_CAPTURE(nearest_within_1m, hall, hall);
BENCHMARK_CAPTURE(nearest_within_1m, forest, forest);
BENCHMARK_CAPTURE(touch, hall, hall);
BENCHMARK_CAPTURE(touch, forest, forest);
BENCHMARK_CAPTURE(body_clearance, hall, hall);
BENCHMARK_CAPTURE(body_clearance, forest, forest);
BENCHMARK_CAPTURE(occluded_5m, hall, hall);
BENCHMARK_CAPTURE(occluded_5m, forest, forest);
BENCHMARK_CAPTURE(shaded_pair, hall, hall, false)->Arg(640)->Arg(320)->UseManualTime();
BENCHMARK_CAPTURE(shaded_pair, hall_shadows, hall, true)->Arg(640)->Arg(320)->UseManualTime();
BENCHMARK_CAPTURE(shaded_pair, forest, forest, false)->Arg(640)->Arg(320)->UseManualTime();
BENCHMARK_CAPTURE(shaded_pair, forest_shadows, forest, true)->Arg(640)->Arg(320)->UseManualTime();
BENCHMARK_CAPTURE(build, hall_flattened, hall, true)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(build, forest_flattened, forest, true)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(build, forest_instanced, forest, false)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace avoidbench

BENCHMARK_MAIN();
