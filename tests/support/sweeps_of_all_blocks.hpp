#pragma once

#include <string>
#include <vector>

namespace avoidbench::test {

/// Good sweeps of the planner `tunable` that together have every block: texts to change at random.
inline std::vector<std::string> sweeps_of_all_blocks() {
  const std::string good =
      "sweep: all\nseed: 24\ntrials: 3\nplanners:\n- {plugin: tunable, label: m, parameters: "
      "{horizon_m: [5, 7]}}\n"
      "maps:\n  generator: hall\n  area_m: [20, 25]\n  poisson_radius_m: {from: 2.3, to: 5.8, "
      "count: 8}\n"
      "  seeds: [3, 9]\nvehicle: {preset: firefly, mass_kg: 1.6}\nsensor: {fov_x_deg: 80}\n"
      "rates: {plan_hz: 20}\naxes: {\"wind.mean_world_mps\": [[0, 0, 0], [4, 0, 0]]}\n";
  const std::string of_movers =
      "sweep: all\nplanners: [tunable]\nmovers:\n  count: [0, 40]\n  kind: mixed\n  motion: "
      "[walk, cross]\n  speed_mps: [0.5, 2]\n  size_m: [0.4, 0.8]\n"
      "tracks: {rate_hz: 20, range_m: 10, fov_deg: 90, miss_ratio: 0.1, false_count: 2}\n"
      "sensor:\n  preset: depth_ideal\n  lidars:\n  - velodyne_16\n  - {preset: mid360_like, "
      "rate_hz: 15, pitch_deg: 20, position_body_m: [0, 0, 0.1]}\n  - {kind: lidar_pattern, beams: "
      "4, nods_hz: 800.7, range_sigma_m: 0.02}\n";
  const std::string of_goals =
      "sweep: all\nplanners: [tunable]\nsensor: {name: l, kind: none, lidars: [mid360_like]}\n"
      "mission:\n  waypoints: [0, 3]\n  goal_radius_m: 0.9\n  goal_motion: {path: circle, "
      "speed_mps: [1, 2], extent_m: 4}\n"
      "axes: {movers.density_1pm2: [0, 0.1], tracks.delay_ms: [0, 50]}\n";
  const std::string of_lists =
      "sweep: all\nplanners: [tunable]\nmission: {list: [{start: [1, 2, 3], goals: [[1, 9, 3], [4, "
      "9, 3]], yaw_deg: 90}, {start: [1, 2, 3], goal: [1, 9, 3]}], return_to_start: true}\n"
      "movers: {density_1pm2: 0.05, motion: trefoil, trefoil_reach_m: [1, 3], height_m: [1, 3]}\n";
  return {good, of_movers, of_goals, of_lists};
}

}  // namespace avoidbench::test
