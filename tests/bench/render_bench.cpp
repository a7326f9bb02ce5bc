#include <benchmark/benchmark.h>

#include <map>
#include <memory>
#include <vector>

#include "bare_loop.hpp"
#include "base/math.hpp"
#include "maps/map_spec.hpp"
#include "render/depth.hpp"
#include "render/scene.hpp"
#include "render/scene_internals.hpp"

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
  const embree::SceneHandle bare = bare_scene(in.scene->world());
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
      trace_bare(bare.get(), prepared[i], poses[i], kDepthRange_m);
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

}  // namespace
}  // namespace avoidbench

BENCHMARK_MAIN();
