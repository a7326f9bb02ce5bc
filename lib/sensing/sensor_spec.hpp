#pragma once

#include <array>
#include <cstdint>

#include "base/enum_text.hpp"
#include "base/fields.hpp"
#include "base/math.hpp"
#include "geometry/pose.hpp"
#include "render/camera.hpp"

namespace avoidbench {

enum class SensorKind { depth_ideal };

template <>
struct EnumText<SensorKind> {
  static constexpr std::pair<SensorKind, std::string_view> entries[] = {
      {SensorKind::depth_ideal, "depth_ideal"}};
};

/// The camera a planner sees through.
struct SensorSpec {
  SensorKind kind = SensorKind::depth_ideal;
  std::int64_t width_px = 320, height_px = 240;
  double fov_x_deg = 90.0;
  double rate_hz = 30.0;
  double min_range_m = 0.1, max_range_m = 15.0;
  std::array<double, 3> position_body_m{0.2, 0.0, 0.05};
  double pitch_deg = 0.0;
};

template <class Visitor>
void visit(Visitor& v, SensorSpec& s) {
  v.field("kind", s.kind,
          "What the camera measures: depth_ideal is the true depth along camera z.");
  v.field("width_px", s.width_px, Range{8, 4096}, "Image width.");
  v.field("height_px", s.height_px, Range{8, 4096}, "Image height.");
  v.field("fov_x_deg", s.fov_x_deg, Range{10, 170}, "Horizontal field of view; pixels are square.");
  v.field("rate_hz", s.rate_hz, Range{1, 1000},
          "Images a second; a whole number of 1/36000 s ticks each.");
  v.field("min_range_m", s.min_range_m, Range{0, 10}, "Nearer depth is invalid (NaN).");
  v.field("max_range_m", s.max_range_m, Range{0.5, 1000}, "Farther depth is no return (+inf).");
  v.field("position_body_m", s.position_body_m, Range{-5, 5},
          "Camera centre in the body frame (FLU).");
  v.field("pitch_deg", s.pitch_deg, Range{-90, 90}, "Camera tilt, positive looks down.");
}

/// The sensor's pinhole model.
Pinhole sensor_camera(const SensorSpec& sensor);

/// Camera (RDF) to body (FLU): looks along body x, pitched down by pitch_deg.
Pose T_body_camera(const SensorSpec& sensor);

}  // namespace avoidbench
