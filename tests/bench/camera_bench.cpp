#include <benchmark/benchmark.h>

#include <memory>
#include <variant>
#include <vector>

#include "bare_loop.hpp"
#include "maps/map_spec.hpp"
#include "render/depth.hpp"
#include "render/scene.hpp"
#include "sensing/camera.hpp"

// One image of each built-in sensor beside the true depth of the same view, measured in turns.
namespace avoidbench {
namespace {

struct Place {
  explicit Place(const MapSpec& map) : world(make_world(map, 1)), scene(world) {}
  World world;
  Scene scene;
};

/// Looks along the map from six places across it.
std::vector<Pose> views(const World& world) {
  std::vector<Pose> poses;
  for (int i = 0; i < 6; ++i) {
    Pose pose = Pose::Identity();
    pose.linear().col(0) = Eigen::Vector3d::UnitX();
    pose.linear().col(1) = -Eigen::Vector3d::UnitZ();
    pose.linear().col(2) = Eigen::Vector3d::UnitY();
    pose.translation() = world.flight_bounds.center();
    pose.translation().x() += 2.0 * (i - 2.5);
    pose.translation().y() = world.flight_bounds.min().y() + 3.0;
    poses.push_back(pose);
  }
  return poses;
}

void exposure(benchmark::State& state, const SensorSpec& sensor, const MapSpec& map) {
  const Place place(map);
  const std::vector<Pose> poses = views(place.world);
  Camera camera(sensor);
  CameraImages images;
  const Pinhole pinhole = sensor_camera(sensor);
  std::vector<float> depth_m(static_cast<std::size_t>(sensor.width_px * sensor.height_px));
  std::vector<double> ratios;
  std::size_t i = 0;
  for (auto _ : state) {
    const Pose& pose = poses[i++ % poses.size()];
    const double start = processor_s();
    render_depth(place.scene, pinhole, pose, depth_m);
    const double middle = processor_s();
    camera.expose(place.scene, pose, {}, {.depth = true}, i, images);
    const double end = processor_s();
    ratios.push_back((end - middle) / (middle - start));
    state.SetIterationTime(end - middle);
  }
  state.counters["ratio_to_true_depth"] = median(ratios);
}

}  // namespace
}  // namespace avoidbench

int main(int argc, char** argv) {
  using namespace avoidbench;
  const std::pair<const char*, MapSpec> maps[] = {
      {"hall", HallSpec{.area_m = {40.0, 40.0}}},
      {"forest", ForestSpec{.area_m = {40.0, 40.0}, .poisson_radius_m = 3.5}}};
  for (const SensorSpec& sensor : sensor_presets()) {
    if (std::holds_alternative<NoCameraSpec>(sensor.method)) continue;  // lidar_bench has these
    for (const auto& [name, map] : maps) {
      benchmark::RegisterBenchmark((sensor.name + "/" + name).c_str(), exposure, sensor, map)
          ->UseManualTime()
          ->Unit(benchmark::kMillisecond);
    }
  }
  benchmark::Initialize(&argc, argv);
  benchmark::RunSpecifiedBenchmarks();
}
