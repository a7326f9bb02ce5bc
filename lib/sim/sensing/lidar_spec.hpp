#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <variant>
#include <vector>

#include "base/fields.hpp"
#include "geometry/pose.hpp"
#include "sensing/mounting_spec.hpp"

namespace avoidbench {

/// Rings of beams that turn about the sensor's z axis. A sweep is one turn, counter-clockwise seen
/// from above, that begins and ends behind: its columns follow one another, and the beams of one
/// column, from the lowest ring to the highest, too.
struct LidarSpinningSpec {
  static constexpr std::string_view kind = "lidar_spinning";
  std::int64_t rings = 16;
  double lowest_elevation_deg = -15.0, highest_elevation_deg = 15.0;
  std::int64_t columns = 1800;
};

template <class Visitor, ConstOr<LidarSpinningSpec> Spec>
void visit(Visitor& v, Spec& s) {
  v.field("rings", s.rings, Range{1, 256}, "Beams above one another, evenly spaced.");
  v.field("lowest_elevation_deg", s.lowest_elevation_deg, Range{-90, 90},
          "Of the lowest ring, above the horizon.");
  v.field("highest_elevation_deg", s.highest_elevation_deg, Range{-90, 90},
          "Of the highest ring, above the horizon.");
  v.field("columns", s.columns, Range{4, 8192}, "Directions around, a turn.");
}

/// A few beams on a curve that does not close, so that each sweep falls between the last ones: a
/// mirror turns about the sensor's z axis while another moves the beams up and down, both evenly.
/// The line of beam k of n leads by k / n of a turn, and by as much of the way up and down.
struct LidarPatternSpec {
  static constexpr std::string_view kind = "lidar_pattern";
  std::int64_t beams = 4;
  double points_per_s = 200'000.0;
  double turns_hz = 24.67, nods_hz = 850.7;
  double lowest_elevation_deg = -7.0, highest_elevation_deg = 52.0;
};

template <class Visitor, ConstOr<LidarPatternSpec> Spec>
void visit(Visitor& v, Spec& s) {
  v.field("beams", s.beams, Range{1, 64}, "Beams that fire in turn.");
  v.field("points_per_s", s.points_per_s, Range{100, 2e6},
          "Shots per second, including those without a return.");
  v.field("turns_hz", s.turns_hz, Range{0.1, 1000}, "Turns about the sensor's z axis per second.");
  v.field("nods_hz", s.nods_hz, Range{0, 5000},
          "Up-and-down cycles per second; not a multiple of rate_hz, else sweeps are alike.");
  v.field("lowest_elevation_deg", s.lowest_elevation_deg, Range{-90, 90},
          "Least elevation above the horizon.");
  v.field("highest_elevation_deg", s.highest_elevation_deg, Range{-90, 90},
          "Greatest elevation above the horizon.");
}

using LidarScan = std::variant<LidarSpinningSpec, LidarPatternSpec>;

/// A lidar: what it fires, and what comes back. Its frame: FLU, x forward.
struct LidarSpec {
  std::string name = "velodyne_16";
  LidarScan scan;
  double rate_hz = 10.0;
  double delay_ms = 0.0;
  double min_range_m = 0.5, max_range_m = 100.0;
  double range_at_10_percent_m = 50.0;
  double range_sigma_m = 0.0;
  double angle_sigma_deg = 0.0;
  double dropout_ratio = 0.0;
  double divergence_mrad = 0.0;
  std::int64_t rays_per_beam = 1;
  bool deskewed = true;
  MountingSpec mounting{.position_body_m = {0.0, 0.0, 0.1}};
};

template <class Visitor, ConstOr<LidarSpec> Spec>
void visit(Visitor& v, Spec& s) {
  v.field("name", s.name, "Name in reports.");
  v.variant("kind", s.scan, "Where it fires.");
  v.field("rate_hz", s.rate_hz, Range{1, 100},
          "Sweeps per second; a whole number of 1/36000 s ticks each.");
  v.field("delay_ms", s.delay_ms, Range{0, 1000}, "From a sweep's end until the planner gets it.");
  v.field("min_range_m", s.min_range_m, Range{0, 10}, "Nearer surfaces give no return.");
  v.field("max_range_m", s.max_range_m, Range{0.5, 1000}, "Farther surfaces give no return.");
  v.field("range_at_10_percent_m", s.range_at_10_percent_m, Range{0.5, 1000},
          "Range to a surface that reflects a tenth of the light and is hit head-on; the range to "
          "others grows with the square root of reflectance times cosine of incidence.");
  v.field("range_sigma_m", s.range_sigma_m, Range{0, 1}, "Standard deviation of ranges.");
  v.field("angle_sigma_deg", s.angle_sigma_deg, Range{0, 5},
          "Standard deviation of a beam's direction against the reported one, along each of "
          "both axes across it.");
  v.field("dropout_ratio", s.dropout_ratio, Range{0, 1},
          "Share of the beams without a return, whatever they meet.");
  v.field("divergence_mrad", s.divergence_mrad, Range{0, 100},
          "Full angle of the cone in which a beam's rays lie; with rays_per_beam.");
  v.field("rays_per_beam", s.rays_per_beam, Range{1, 16},
          "Rays of each beam, spread over its cone: the strongest echo counts. 1: along its axis.");
  v.field("deskewed", s.deskewed,
          "Whether points are brought to where the sensor is at the sweep's end, by the odometry. "
          "Else each is given as seen from where the sensor was at the point's own time.");
  visit(v, s.mounting);
}

/// The ready-made lidars; the first is the default.
std::vector<LidarSpec> lidar_presets();

/// Lidar (FLU) to body (FLU): turned by yaw, pitch, roll in this order; a positive pitch looks
/// down.
Pose T_body_lidar(const MountingSpec& mounting);

/// Shots of one sweep, those that come back with nothing included.
std::int64_t shots_per_sweep(const LidarSpec& lidar);

/// The least and the greatest elevation of its beams in its own frame, rad.
std::array<double, 2> elevations_rad(const LidarSpec& lidar);

}  // namespace avoidbench
