#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <variant>
#include <vector>

#include "base/enum_text.hpp"
#include "base/fields.hpp"
#include "base/math.hpp"
#include "geometry/pose.hpp"
#include "render/camera.hpp"
#include "sensing/census_matcher.hpp"
#include "sensing/lidar_spec.hpp"
#include "sensing/mounting_spec.hpp"

namespace avoidbench {

/// The true depth along camera z.
struct DepthIdealSpec {
  static constexpr std::string_view kind = "depth_ideal";
};

template <class Visitor, ConstOr<DepthIdealSpec> Spec>
void visit(Visitor&, Spec&) {}

/// True depth made as wrong as that of a stereo pair matched by SGM, for a tenth of its cost. The
/// defaults are fitted to stereo_sgbm; see docs/sensors.md and `avoidbench sensors measure`. What
/// differs between fully textured and bland surfaces grows with the square of the lack of opacity.
struct DepthNoisySpec {
  static constexpr std::string_view kind = "depth_noisy";
  double disparity_sigma_px = 0.26, bland_disparity_sigma_px = 0.36;
  double noise_size_px = 6.0;
  double disparity_step_px = 0.0625;
  double outlier_ratio = 0.012, bland_outlier_ratio = 0.11;
  double outlier_sigma_px = 3.0;
  double hole_ratio = 0.006, bland_hole_ratio = 0.11;
  double hole_size_px = 12.0;
  double dropout_ratio = 0.001;
  std::int64_t fattening_px = 2;
  double half_occlusion_ratio = 0.5;
};

template <class Visitor, ConstOr<DepthNoisySpec> Spec>
void visit(Visitor& v, Spec& s) {
  v.field("disparity_sigma_px", s.disparity_sigma_px, Range{0, 5},
          "Standard deviation of the disparity; depth errs by Z²/(baseline · focal length) of it.");
  v.field("bland_disparity_sigma_px", s.bland_disparity_sigma_px, Range{0, 5},
          "The same on surfaces without texture (opacity 0).");
  v.field("noise_size_px", s.noise_size_px, Range{1, 100},
          "Errors of pixels closer than this are alike, as a matcher's are; 1: each its own.");
  v.field("disparity_step_px", s.disparity_step_px, Range{0, 4},
          "Disparity is a whole multiple of this; 0: not rounded.");
  v.field("outlier_ratio", s.outlier_ratio, Range{0, 1}, "Share of patches with large errors.");
  v.field("bland_outlier_ratio", s.bland_outlier_ratio, Range{0, 1},
          "The same on surfaces without texture.");
  v.field("outlier_sigma_px", s.outlier_sigma_px, Range{0, 100},
          "Standard deviation of the disparity in such patches.");
  v.field("hole_ratio", s.hole_ratio, Range{0, 1}, "Share of invalid patches.");
  v.field("bland_hole_ratio", s.bland_hole_ratio, Range{0, 1},
          "The same on surfaces without texture, and if nothing is in range.");
  v.field("hole_size_px", s.hole_size_px, Range{1, 200}, "About the size of patches.");
  v.field("dropout_ratio", s.dropout_ratio, Range{0, 1}, "Share of single invalid pixels.");
  v.field("fattening_px", s.fattening_px, Range{0, 16},
          "Near things look wider by this much on each side.");
  v.field("half_occlusion_ratio", s.half_occlusion_ratio, Range{0, 1},
          "Share that is invalid of what the right eye can't see, left of near things.");
}

/// Variants of OpenCV's matcher: SGBM 5 paths, 3WAY 3, HH 8, HH4 4.
enum class SgbmMode { sgbm, three_way, hh, hh4 };

template <>
struct EnumText<SgbmMode> {
  static constexpr std::pair<SgbmMode, std::string_view> entries[] = {{SgbmMode::sgbm, "sgbm"},
                                                                      {SgbmMode::three_way, "3way"},
                                                                      {SgbmMode::hh, "hh"},
                                                                      {SgbmMode::hh4, "hh4"}};
};

/// A shaded stereo pair matched by OpenCV's StereoSGBM (Hirschmüller 2008, with block costs).
struct StereoSgbmSpec {
  static constexpr std::string_view kind = "stereo_sgbm";
  SgbmMode mode = SgbmMode::three_way;
  std::int64_t disparities = 64;
  std::int64_t block_px = 5;
  double p1_factor = 8.0, p2_factor = 32.0;
  std::int64_t uniqueness_percent = 10;
  std::int64_t speckle_window_px = 100, speckle_range_px = 2;
  std::int64_t left_right_px = 1;
};

template <class Visitor, ConstOr<StereoSgbmSpec> Spec>
void visit(Visitor& v, Spec& s) {
  v.field("mode", s.mode, "The matcher's paths: 5, 3, 8 or 4 of them.");
  v.field("disparities", s.disparities, Range{16, 512},
          "Disparities that are tried, from 0; a multiple of 16.");
  v.field("block_px", s.block_px, Range{1, 21}, "Side of the matched block n; odd.");
  v.field("p1_factor", s.p1_factor, Range{0, 100}, "Penalty for a disparity step of 1, times n².");
  v.field("p2_factor", s.p2_factor, Range{0, 400},
          "Penalty for a larger step, times n²; above p1_factor.");
  v.field("uniqueness_percent", s.uniqueness_percent, Range{0, 100},
          "By how much the best cost must beat the second.");
  v.field("speckle_window_px", s.speckle_window_px, Range{0, 10000},
          "Patches up to this many pixels are invalid; 0: all stay.");
  v.field("speckle_range_px", s.speckle_range_px, Range{1, 64},
          "Disparity step at which a patch ends.");
  v.field("left_right_px", s.left_right_px, Range{-1, 64},
          "Greatest difference between left-right and right-left disparity; -1: not checked.");
}

template <>
struct EnumText<CensusWindow> {
  static constexpr std::pair<CensusWindow, std::string_view> entries[] = {
      {CensusWindow::nine_by_seven, "9x7"}, {CensusWindow::five_by_five, "5x5"}};
};

/// A shaded stereo pair matched over a census cost by match_census(). The defaults are the original
/// AvoidBench's matcher (preset stereo_original).
struct StereoSgmSpec {
  static constexpr std::string_view kind = "stereo_sgm";
  CensusWindow window = CensusWindow::nine_by_seven;
  std::int64_t disparities = 128;
  std::int64_t paths = 8;
  std::int64_t p1 = 6, p2 = 96;
  bool subpixel = false;
  std::int64_t uniqueness_percent = 0;
  std::int64_t speckle_window_px = 0, speckle_range_px = 2;
  std::int64_t left_right_px = 1;
  double depth_step_m = 0.001;
};

template <class Visitor, ConstOr<StereoSgmSpec> Spec>
void visit(Visitor& v, Spec& s) {
  v.field("window", s.window,
          "Pixels that are compared with each other; the smaller window blurs edges less.");
  v.field("disparities", s.disparities, Range{16, 256},
          "Disparities that are tried, from 0; a multiple of 16.");
  v.field("paths", s.paths, Range{4, 8}, "Aggregated paths: 4 or 8.");
  v.field("p1", s.p1, Range{0, 96}, "Penalty for a disparity step of 1.");
  v.field("p2", s.p2, Range{0, 96}, "Penalty for a larger step; not below p1.");
  v.field("subpixel", s.subpixel, "Disparities of 1/16 px instead of whole ones.");
  v.field("uniqueness_percent", s.uniqueness_percent, Range{0, 99},
          "By how much the best sum must beat all but its neighbours.");
  v.field("speckle_window_px", s.speckle_window_px, Range{0, 10000},
          "Patches up to this many pixels are invalid; 0: all stay.");
  v.field("speckle_range_px", s.speckle_range_px, Range{1, 64},
          "Disparity step at which a patch ends.");
  v.field("left_right_px", s.left_right_px, Range{-1, 64},
          "Greatest difference between left-right and right-left disparity; -1: not checked.");
  v.field("depth_step_m", s.depth_step_m, Range{0, 1},
          "Depth is cut down to a whole multiple of this; 0: not cut.");
}

/// No camera: what the sensor's lidars see is all.
struct NoCameraSpec {
  static constexpr std::string_view kind = "none";
};

template <class Visitor, ConstOr<NoCameraSpec> Spec>
void visit(Visitor&, Spec&) {}

using DepthMethod =
    std::variant<DepthIdealSpec, DepthNoisySpec, StereoSgbmSpec, StereoSgmSpec, NoCameraSpec>;

/// How light becomes an 8-bit picture.
struct ImageSpec {
  double brightness = 0.22;
  double full_well_e = 10000.0;
  double read_noise_e = 10.0;
  double vignetting = 0.3;
  std::int64_t samples = 1;
  std::int64_t blur_samples = 1;
  bool shadows = true;
};

template <class Visitor, ConstOr<ImageSpec> Spec>
void visit(Visitor& v, Spec& s) {
  v.field("brightness", s.brightness, Range{0, 1},
          "Mean of the left image that automatic exposure aims at, as a share of white in linear "
          "light; 0: fixed exposure.");
  v.field("full_well_e", s.full_well_e, Range{0, 1e9},
          "Photo-electrons of white: shot noise is the square root of the electrons; 0: none.");
  v.field("read_noise_e", s.read_noise_e, Range{0, 1e6},
          "Standard deviation of the read-out, in electrons.");
  v.field("vignetting", s.vignetting, Range{0, 1},
          "Share of the lens's cos⁴ loss of light toward the corners that is left; 0: none.");
  v.field("samples", s.samples, Range{1, 8},
          "Rays per side of each pixel. Textures are filtered for one; more smooth the outlines.");
  v.field("blur_samples", s.blur_samples, Range{1, 64},
          "Pictures averaged over the exposure; 1: no motion blur.");
  v.field("shadows", s.shadows, "Whether the sun casts shadows.");
}

/// A camera or stereo camera, or several of one kind.
struct CameraSpec {
  std::string name = "depth_ideal";
  DepthMethod method;
  std::int64_t width_px = 320, height_px = 240;
  double fov_x_deg = 90.0;
  double rate_hz = 30.0;
  double exposure_ms = 5.0, delay_ms = 0.0, jitter_ms = 0.0;
  double min_range_m = 0.1, max_range_m = 15.0;
  double baseline_m = 0.1;
  MountingSpec mounting;
  std::vector<MountingSpec> more_mountings;
  ImageSpec image;
};

template <class Visitor, class Spec>
void visit_camera(Visitor& v, Spec& s) {
  v.field("name", s.name, "Name in reports.");
  v.variant("kind", s.method, "How depth is computed.");
  v.field("width_px", s.width_px, Range{8, 4096}, "Image width.");
  v.field("height_px", s.height_px, Range{8, 4096}, "Image height.");
  v.field("fov_x_deg", s.fov_x_deg, Range{10, 170},
          "Horizontal field of view of the pinhole, below 180; pixels are square.");
  v.field("rate_hz", s.rate_hz, Range{1, 1000},
          "Images per second; a whole number of 1/36000 s ticks each.");
  v.field("exposure_ms", s.exposure_ms, Range{0, 1000},
          "Exposure time, around the image's time; blurs where image.blur_samples > 1.");
  v.field("delay_ms", s.delay_ms, Range{0, 1000},
          "From the image's time until the planner gets it.");
  v.field("jitter_ms", s.jitter_ms, Range{0, 1000},
          "Each image is late by up to this much, evenly distributed.");
  v.field("min_range_m", s.min_range_m, Range{0, 10}, "Nearer depth is invalid (NaN).");
  v.field("max_range_m", s.max_range_m, Range{0.5, 1000}, "Farther depth is no return (+inf).");
  v.field("baseline_m", s.baseline_m, Range{0.001, 10},
          "From the left eye to the right one, along the image's rows.");
  visit(v, s.mounting);
  v.field("more_mountings", s.more_mountings,
          "Further cameras of the same kind, as [{position_body_m: …, yaw_deg: …}, …].");
  v.field("image", s.image, "How light becomes a picture.");
}

template <class Visitor, ConstOr<CameraSpec> Spec>
void visit(Visitor& v, Spec& s) {
  visit_camera(v, s);
}

/// What a planner sees through: a camera, a stereo camera, a lidar, or a rig of several. The
/// presets below are ready-made ones.
struct SensorSpec : CameraSpec {
  std::vector<CameraSpec> more_cameras;
  std::vector<LidarSpec> lidars;
};

template <class Visitor, ConstOr<SensorSpec> Spec>
void visit(Visitor& v, Spec& s) {
  visit_camera(v, s);
  v.field("more_cameras", s.more_cameras,
          "Further cameras of other kinds, as [NAME, {preset: NAME, yaw_deg: …}, …], each with its "
          "own size, rate and delay.");
  v.field("lidars", s.lidars,
          "Lidars, as [NAME, {preset: NAME, pitch_deg: 30}, …]; with kind `none` they are the only "
          "sensors.");
}

/// The ready-made sensors; the first is the default of a trial.
std::vector<SensorSpec> sensor_presets();

/// The kinds of cameras of a rig: the sensor's own, then more_cameras; without those of kind
/// `none`.
std::vector<CameraSpec> camera_kinds(const SensorSpec& sensor);

/// The pinhole model of each camera of this kind.
Pinhole sensor_camera(const CameraSpec& camera);

/// Camera (RDF) to body (FLU): looks along body x, turned by yaw, pitch, roll in this order.
Pose T_body_camera(const MountingSpec& mounting);

/// All mountings of this kind, `mounting` first.
std::vector<MountingSpec> mountings(const CameraSpec& camera);

/// A camera of a rig: cameras of the first kind come first.
struct RigCamera {
  CameraSpec kind;
  MountingSpec mounting;
};
std::vector<RigCamera> rig_cameras(const SensorSpec& sensor);

/// The rig with this camera alone, and its lidars.
SensorSpec one_camera(const SensorSpec& rig, std::size_t index);

/// Whether depth is matched from shaded images.
bool is_stereo(const CameraSpec& camera);

/// Focal length times baseline: disparity in pixels = this / depth in metres.
double disparity_at_1m_px(const CameraSpec& camera);

}  // namespace avoidbench
