#include <string>
#include <utility>

#include "sensing/sensor_spec.hpp"

namespace avoidbench {
namespace {

/// Puts the middle between the eyes where the body's mounting is.
SensorSpec with_centered_eyes(SensorSpec sensor) {
  // The mounting is the left eye's, and body y is to the left.
  sensor.mounting.position_body_m[1] += 0.5 * sensor.baseline_m;
  return sensor;
}

SensorSpec depth_noisy() {
  SensorSpec sensor;
  sensor.name = "depth_noisy";
  sensor.method = DepthNoisySpec{};
  sensor.baseline_m = 0.12;
  return with_centered_eyes(sensor);
}

/// Without shadows, which cost a forest's trial half of its speed and change hardly what is
/// matched.
SensorSpec plain_stereo(std::string name, const DepthMethod& method) {
  SensorSpec sensor;
  sensor.name = std::move(name);
  sensor.method = method;
  sensor.baseline_m = 0.12;
  sensor.image.shadows = false;
  return with_centered_eyes(sensor);
}

/// Penalties and uniqueness were chosen by errors in hall and forest: see docs/sensors.md.
SensorSpec stereo_sgm() {
  return plain_stereo("stereo_sgm", StereoSgmSpec{.window = CensusWindow::five_by_five,
                                                  .disparities = 64,
                                                  .paths = 4,
                                                  .p1 = 5,
                                                  .p2 = 32,
                                                  .subpixel = true,
                                                  .uniqueness_percent = 10,
                                                  .speckle_window_px = 100,
                                                  .depth_step_m = 0.0});
}

/// The outdoor camera of AvoidBench (task_outdoor.yaml; the indoor one has 91°): 640 × 480, 0.12 m,
/// 128 whole disparities, eyes 0.3 m above the body, 50 Hz, no image noise.
SensorSpec stereo_original() {
  SensorSpec sensor;
  sensor.name = "stereo_original";
  sensor.method = StereoSgmSpec{};
  sensor.width_px = 640;
  sensor.height_px = 480;
  sensor.fov_x_deg = 100.0;
  sensor.rate_hz = 50.0;
  sensor.exposure_ms = 0.0;
  sensor.min_range_m = 0.0;
  sensor.max_range_m = 65.0;
  sensor.baseline_m = 0.12;
  sensor.mounting.position_body_m = {0.2, 0.0, 0.3};
  sensor.image.full_well_e = 0.0;
  sensor.image.read_noise_e = 0.0;
  sensor.image.vignetting = 0.0;
  return with_centered_eyes(sensor);
}

/// Intel RealSense D435 (data sheet, revision 009 and later): baseline 50 mm, depth field of view
/// 87° × 58°, global shutter, range to 10 m; its mode of 424 × 240. Disparity noise 0.08 px is the
/// maker's own figure for good texture (tuning guide); the projector puts texture on bland
/// surfaces, so that few holes stay.
SensorSpec d435_like() {
  SensorSpec sensor;
  sensor.name = "d435_like";
  DepthNoisySpec noise;
  noise.disparity_sigma_px = 0.08;
  noise.bland_disparity_sigma_px = 0.12;
  noise.disparity_step_px = 1.0 / 32.0;
  noise.outlier_ratio = 0.003;
  noise.bland_outlier_ratio = 0.01;
  noise.bland_hole_ratio = 0.03;
  sensor.method = noise;
  sensor.width_px = 424;
  sensor.height_px = 240;
  sensor.fov_x_deg = 87.0;
  sensor.delay_ms = 25.0;
  sensor.min_range_m = 0.175;
  sensor.max_range_m = 10.0;
  sensor.baseline_m = 0.05;
  return with_centered_eyes(sensor);
}

/// Luxonis OAK-D (product data sheet): baseline 75 mm, OV9282 pair of 72° horizontally, depth of
/// 640 × 400 pixels at 30 Hz by census and SGM with 96 disparities, sub-pixel and left-right check;
/// no projector.
SensorSpec oak_d_like() {
  SensorSpec sensor;
  sensor.name = "oak_d_like";
  StereoSgmSpec census;
  census.disparities = 96;
  census.subpixel = true;
  sensor.method = census;
  sensor.width_px = 640;
  sensor.height_px = 400;
  sensor.fov_x_deg = 72.0;
  sensor.delay_ms = 40.0;
  sensor.min_range_m = 0.35;
  sensor.max_range_m = 19.0;
  sensor.baseline_m = 0.075;
  return with_centered_eyes(sensor);
}

/// Four cameras that see all around.
SensorSpec surround() {
  SensorSpec sensor = depth_noisy();
  sensor.name = "surround";
  sensor.width_px = 160;
  sensor.height_px = 120;
  const auto looking = [&](double yaw_deg, double x_m, double y_m) {
    MountingSpec mounting = sensor.mounting;
    mounting.position_body_m[0] = x_m;
    mounting.position_body_m[1] = y_m;
    mounting.yaw_deg = yaw_deg;
    return mounting;
  };
  sensor.mounting = looking(0.0, 0.2, 0.06);
  sensor.more_mountings = {looking(90.0, -0.06, 0.2), looking(180.0, -0.2, -0.06),
                           looking(-90.0, 0.06, -0.2)};
  return sensor;
}

/// A lidar and no camera.
SensorSpec lidar_alone(const LidarSpec& lidar) {
  SensorSpec sensor;
  sensor.name = lidar.name;
  sensor.method = NoCameraSpec{};
  sensor.lidars = {lidar};
  return sensor;
}

}  // namespace

std::vector<SensorSpec> sensor_presets() {
  std::vector<SensorSpec> presets{
      SensorSpec{},      depth_noisy(), stereo_sgm(), plain_stereo("stereo_sgbm", StereoSgbmSpec{}),
      stereo_original(), d435_like(),   oak_d_like(), surround()};
  for (const LidarSpec& lidar : lidar_presets()) presets.push_back(lidar_alone(lidar));
  return presets;
}

}  // namespace avoidbench
