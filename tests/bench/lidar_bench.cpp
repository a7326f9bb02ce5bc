#include <benchmark/benchmark.h>

#include "bare_loop.hpp"
#include "maps/map_spec.hpp"
#include "render/rays.hpp"
#include "sensing/lidar.hpp"
#include "sensing/lidar_scan.hpp"

// A sweep's rays, and whole sweeps, beside a bare Embree loop over the same rays in the same
// packets, measured in turns with it.
namespace avoidbench {
namespace {

/// Rays as Embree wants them.
struct PreparedPacket {
  float origins[3][8], directions[3][8];
};

std::vector<PreparedPacket> prepared(const std::vector<Ray>& rays) {
  std::vector<PreparedPacket> packets(rays.size() / 8);
  for (std::size_t i = 0; i < 8 * packets.size(); ++i) {
    for (int k = 0; k < 3; ++k) {
      packets[i / 8].origins[k][i % 8] = static_cast<float>(rays[i].origin_world[k]);
      packets[i / 8].directions[k][i % 8] = static_cast<float>(rays[i].direction_world[k]);
    }
  }
  return packets;
}

/// Rays copied in, traced, nothing out.
void trace_rays_bare(RTCScene scene, const std::vector<PreparedPacket>& prepared, float range_m) {
  const ScopedFlushToZero flush;
  RTCRayHit8 packets[embree::kStreamPackets] = {};
  for (RTCRayHit8& packet : packets) std::fill_n(packet.ray.mask, 8, ~0U);
  for (std::size_t at = 0; at + embree::kStreamPackets <= prepared.size();
       at += embree::kStreamPackets) {
    for (std::size_t i = 0; i < embree::kStreamPackets; ++i) {
      const PreparedPacket& from = prepared[at + i];
      RTCRayHit8& packet = packets[i];
      std::memcpy(packet.ray.org_x, from.origins[0], sizeof(packet.ray.org_x));
      std::memcpy(packet.ray.org_y, from.origins[1], sizeof(packet.ray.org_y));
      std::memcpy(packet.ray.org_z, from.origins[2], sizeof(packet.ray.org_z));
      std::memcpy(packet.ray.dir_x, from.directions[0], sizeof(packet.ray.dir_x));
      std::memcpy(packet.ray.dir_y, from.directions[1], sizeof(packet.ray.dir_y));
      std::memcpy(packet.ray.dir_z, from.directions[2], sizeof(packet.ray.dir_z));
      std::fill_n(packet.ray.tfar, 8, range_m);
      std::fill_n(packet.hit.geomID, 8, RTC_INVALID_GEOMETRY_ID);
    }
    trace_bare(scene, packets);
  }
}

/// Two metres above the middle of the map, or beside it where something is near.
Pose free_place(const Scene& scene) {
  Eigen::Vector3d place(20.0, 20.0, 0.0);
  do {
    place.x() += 0.3;
    place.z() = ground_height_m(scene.world(), place.x(), place.y()) + 2.0;
  } while (scene.nearest(place, 1.0).distance_m < 1.0);
  return make_pose(place, Eigen::Quaterniond::Identity());
}

std::vector<Ray> rays_of(const LidarSpec& lidar, const Pose& pose) {
  std::vector<Ray> rays;
  const std::int64_t whole = shots_per_sweep(lidar) / 32 * 32;  // whole streams of packets
  for (std::int64_t i = 0; i < whole; ++i) {
    rays.push_back({pose.translation(), pose.linear() * shot_direction(lidar, 0, i)});
  }
  return rays;
}

void sweep(benchmark::State& state, const LidarSpec& spec, const MapSpec& map) {
  const World world = make_world(map, 1);
  const Scene scene(world);
  const embree::SceneHandle bare = bare_scene(world);
  const Pose pose = free_place(scene);
  const std::vector<Ray> rays = rays_of(spec, pose);
  const std::vector<PreparedPacket> packets = prepared(rays);
  std::vector<RayHit> hits(512);  // in the cache, as those of a step of a flight
  Lidar lidar(spec);
  LidarSweep seen;
  std::vector<double> rays_s, bare_s, sweep_s;
  std::int64_t index = 0;
  for (auto _ : state) {
    const double start = processor_s();
    trace_rays_bare(bare.get(), packets, static_cast<float>(spec.max_range_m));
    const double first = processor_s();
    for (std::size_t at = 0; at < rays.size(); at += hits.size()) {
      const std::size_t count = std::min(hits.size(), rays.size() - at);
      first_hits(scene, {rays.data() + at, count}, spec.max_range_m, {hits.data(), count});
    }
    const double second = processor_s();
    lidar.begin_sweep(index, 1);
    // As a flight does, a millisecond at a time.
    for (Tick tick = 0; tick < required_period(spec.rate_hz); tick += 36) {
      lidar.fire(scene, {tick, tick + 36, pose, pose, pose, pose});
    }
    lidar.end_sweep(pose, seen);
    const double third = processor_s();
    benchmark::DoNotOptimize(hits.data());
    bare_s.push_back(first - start);
    rays_s.push_back(second - first);
    sweep_s.push_back(third - second);
    state.SetIterationTime(third - second);
    ++index;
  }
  state.counters["Mray_per_s"] = 1e-6 * static_cast<double>(rays.size()) / median(rays_s);
  state.counters["rays_ratio"] = median(bare_s) / median(rays_s);
  state.counters["sweep_ratio"] = median(bare_s) / median(sweep_s);
  state.counters["cpu_share"] = median(sweep_s) * spec.rate_hz;
}

}  // namespace
}  // namespace avoidbench

int main(int argc, char** argv) {
  using namespace avoidbench;
  const std::pair<const char*, MapSpec> maps[] = {
      {"hall", HallSpec{.area_m = {40.0, 40.0}}},
      {"forest", ForestSpec{.area_m = {40.0, 40.0}, .poisson_radius_m = 3.5}}};
  for (const LidarSpec& lidar : lidar_presets()) {
    for (const auto& [name, map] : maps) {
      benchmark::RegisterBenchmark((lidar.name + "/" + name).c_str(), sweep, lidar, map)
          ->UseManualTime()
          ->Unit(benchmark::kMillisecond);
    }
  }
  benchmark::Initialize(&argc, argv);
  benchmark::RunSpecifiedBenchmarks();
}
