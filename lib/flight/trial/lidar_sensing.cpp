#include "trial/lidar_sensing.hpp"

#include <algorithm>
#include <iterator>
#include <limits>

#include "base/random.hpp"

namespace avoidbench {
namespace {

/// By number, not drawn one after the other: a sweep's noise depends on no other sweep.
std::uint64_t sweep_seed(const LidarSensing& sensing, std::size_t lidar) {
  const std::uint64_t own = stream_seed(sensing.seed, std::uint64_t{lidar});
  return stream_seed(own, static_cast<std::uint64_t>(sensing.lidars[lidar].sweep));
}

void end_sweep(LidarSensing& sensing, std::size_t index, Tick end) {
  MountedLidar& mounted = sensing.lidars[index];
  SeenSweep sweep{.end = end,
                  .ready = end + mounted.delay,
                  .lidar = static_cast<std::uint32_t>(index),
                  .T_world_lidar = sensing.T_believed_body * mounted.T_body_lidar,
                  .points = {},
                  .misses_lidar = {}};
  mounted.lidar->end_sweep(sweep.T_world_lidar, sensing.buffer);
  sweep.points.reserve(sensing.buffer.points.size());
  for (const LidarPoint& point : sensing.buffer.points) {
    const Eigen::Vector3f& p = point.position_lidar;
    sweep.points.push_back({{p.x(), p.y(), p.z()}, point.time_s, point.intensity});
  }
  sweep.misses_lidar = sensing.buffer.misses;
  sensing.sweeps.push_back(std::move(sweep));
  ++mounted.sweep;
  mounted.lidar->begin_sweep(mounted.sweep, sweep_seed(sensing, index));
}

}  // namespace

LidarSensing make_lidar_sensing(const SensorSpec& sensor, std::uint32_t needs, std::uint64_t seed,
                                const VehicleState& truth, const VehicleState& believed) {
  LidarSensing sensing{.is_seen = (needs & AB_INPUT_POINTS) != 0 && !sensor.lidars.empty(),
                       .seed = stream_seed(seed, "lidar"),
                       .lidars = {},
                       .T_world_body = pose_of(truth),
                       .T_believed_body = pose_of(believed),
                       .tick = truth.tick,
                       .sweeps = {},
                       .buffer = {}};
  for (const LidarSpec& lidar : sensor.lidars) {
    sensing.lidars.push_back({.lidar = {},
                              .T_body_lidar = T_body_lidar(lidar.mounting),
                              .period = required_period(lidar.rate_hz),
                              .delay = ticks(1e-3 * lidar.delay_ms)});
    if (!sensing.is_seen) continue;
    sensing.lidars.back().lidar.emplace(lidar);
    sensing.lidars.back().lidar->begin_sweep(0, sweep_seed(sensing, sensing.lidars.size() - 1));
  }
  return sensing;
}

Tick next_sweep_end(const LidarSensing& sensing, Tick now) {
  Tick next = std::numeric_limits<Tick>::max();
  for (const MountedLidar& mounted : sensing.lidars) {
    next = std::min(next, (now / mounted.period + 1) * mounted.period);
  }
  return next;
}

void sense_points(LidarSensing& sensing, const Scene& scene, const VehicleState& truth,
                  const VehicleState& believed) {
  if (!sensing.is_seen || truth.tick == sensing.tick) return;
  const Pose T_world_from = sensing.T_world_body, T_believed_from = sensing.T_believed_body;
  const Tick from = sensing.tick;
  sensing.T_world_body = pose_of(truth);
  sensing.T_believed_body = pose_of(believed);
  sensing.tick = truth.tick;
  for (std::size_t i = 0; i < sensing.lidars.size(); ++i) {
    MountedLidar& mounted = sensing.lidars[i];
    const Tick begin = mounted.sweep * mounted.period;
    // A flight has a tick at each sweep's end: no step reaches beyond it.
    mounted.lidar->fire(scene, {.from = from - begin,
                                .to = truth.tick - begin,
                                .T_world_from = T_world_from * mounted.T_body_lidar,
                                .T_world_to = sensing.T_world_body * mounted.T_body_lidar,
                                .T_believed_from = T_believed_from * mounted.T_body_lidar,
                                .T_believed_to = sensing.T_believed_body * mounted.T_body_lidar});
    if (truth.tick == begin + mounted.period) end_sweep(sensing, i, truth.tick);
  }
}

std::vector<CloudView> cloud_views(const LidarSensing& sensing, Tick now) {
  std::vector<CloudView> views;
  for (auto sweep = sensing.sweeps.rbegin(); sweep != sensing.sweeps.rend(); ++sweep) {
    if (sweep->ready > now) continue;
    views.push_back({.time_s = seconds(sweep->end),
                     .T_world_lidar = sweep->T_world_lidar,
                     .lidar = sweep->lidar,
                     .points = sweep->points,
                     .misses_lidar = sweep->misses_lidar});
  }
  return views;
}

void forget_sweeps(LidarSensing& sensing, Tick now) {
  std::erase_if(sensing.sweeps, [now](const SeenSweep& sweep) { return sweep.ready <= now; });
}

std::vector<LidarSetup> lidar_setups(const SensorSpec& sensor) {
  std::vector<LidarSetup> setups;
  for (const LidarSpec& lidar : sensor.lidars) {
    const auto [lowest_rad, highest_rad] = elevations_rad(lidar);
    setups.push_back({.is_deskewed = lidar.deskewed,
                      .T_body_lidar = T_body_lidar(lidar.mounting),
                      .rate_hz = lidar.rate_hz,
                      .min_range_m = lidar.min_range_m,
                      .max_range_m = lidar.max_range_m,
                      .lowest_elevation_rad = lowest_rad,
                      .highest_elevation_rad = highest_rad,
                      .shots = static_cast<std::uint32_t>(shots_per_sweep(lidar))});
  }
  return setups;
}

}  // namespace avoidbench
