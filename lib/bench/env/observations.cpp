#include "env/observations.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/check.hpp"
#include "base/input_error.hpp"
#include "base/ticks.hpp"
#include "env/actions.hpp"

namespace avoidbench {
namespace {

template <class T>
T* offset(T* array, std::size_t count) {
  return array == nullptr ? nullptr : array + count;
}

/// `range` is the cameras' or the lidars'.
template <class Range>
float encoded(float depth_m, const Range& range, DepthEncoding encoding) {
  if (std::isnan(depth_m)) return 0.0F;
  const auto near_m = static_cast<float>(range.min_range_m);
  // No return is +inf and becomes the range's end.
  const float seen_m = std::min(depth_m, static_cast<float>(range.max_range_m));
  return encoding == DepthEncoding::metric ? seen_m : near_m / std::max(seen_m, near_m);
}

template <class Number>
void write(Number*& to, const Eigen::Vector3d& from) {
  for (const double number : from) *to++ = static_cast<Number>(number);
}

void write_imu(const std::vector<ImuView>& samples, const ViewShape& shape, float* to) {
  const std::size_t shown = std::min(samples.size(), shape.imu_samples);
  // Empty places come first: the newest sample is always in the last one.
  to = std::fill_n(to, (shape.imu_samples - shown) * kImuWidth, 0.0F);
  for (std::size_t i = samples.size() - shown; i < samples.size(); ++i) {
    *to++ = static_cast<float>(samples[i].time_s);
    write(to, samples[i].rates_body);
    write(to, samples[i].specific_force_body_mps2);
  }
}

/// Offers `write` the newest image of each camera that has a new one.
template <class View, class Write>
void for_newest(const std::vector<View>& views, const ViewShape& shape, const Write& write) {
  for (std::uint32_t camera = 0; camera < shape.cameras; ++camera) {
    // Views come newest first, so the first of a camera is its newest.
    const auto newest = std::find_if(views.begin(), views.end(),
                                     [camera](const View& view) { return view.camera == camera; });
    if (newest != views.end()) write(*newest);
  }
}

void write_images(const PlannerView& view, const ViewShape& shape, DepthEncoding encoding,
                  const ViewArrays& to) {
  const std::size_t area = shape.height_px * shape.width_px;
  if (to.depth != nullptr) {
    for_newest(view.depth, shape, [&](const DepthView& image) {
      std::transform(image.depth_m.begin(), image.depth_m.end(), to.depth + image.camera * area,
                     [&](float depth_m) { return encoded(depth_m, shape, encoding); });
    });
  }
  if (to.stereo != nullptr) {
    for_newest(view.stereo, shape, [&](const StereoView& pair) {
      std::uint8_t* pixels = to.stereo + std::size_t{2} * pair.camera * area;
      pixels = std::copy(pair.left.begin(), pair.left.end(), pixels);
      std::copy(pair.right.begin(), pair.right.end(), pixels);
    });
  }
  if (to.color != nullptr) {
    for_newest(view.color, shape, [&](const ColorView& image) {
      std::copy(image.rgb.begin(), image.rgb.end(),
                to.color + std::size_t{3} * image.camera * area);
    });
  }
}

/// Which shot of its sweep a point is of: shot i of n is fired (i + 1) / n of the period after the
/// start.
std::size_t shot_of(const ab_lidar_point& point, const LidarShape& lidar) {
  const double share = 1.0 + static_cast<double>(point.time_s) / lidar.period_s;
  const auto shot =
      static_cast<std::size_t>(std::llround(share * static_cast<double>(lidar.shots)) - 1);
  AB_CHECK(shot < lidar.shots, shot, lidar.shots);
  return shot;
}

void write_sweep(const CloudView& sweep, const ViewShape& shape, DepthEncoding encoding,
                 const ViewArrays& to) {
  const LidarShape& lidar = shape.lidars[sweep.lidar];
  const std::size_t first = sweep.lidar * shape.widest_lidar.shots;
  if (to.points != nullptr) std::fill_n(to.points + 3 * first, 3 * lidar.shots, 0.0F);
  if (to.ranges != nullptr) {
    const float nothing =
        encoded(std::numeric_limits<float>::infinity(), shape.widest_lidar, encoding);
    std::fill_n(to.ranges + first, lidar.shots, nothing);
  }
  for (const ab_lidar_point& point : sweep.points) {
    const std::size_t at = first + shot_of(point, lidar);
    const float* place = point.position_lidar_m;
    if (to.points != nullptr) std::copy(place, place + 3, to.points + 3 * at);
    if (to.ranges != nullptr) {
      const float range_m = Eigen::Map<const Eigen::Vector3f>(place).norm();
      to.ranges[at] = encoded(range_m, shape.widest_lidar, encoding);
    }
  }
}

void write_sweeps(const PlannerView& view, const ViewShape& shape, DepthEncoding encoding,
                  const ViewArrays& to) {
  if (to.points == nullptr && to.ranges == nullptr) return;
  for (std::uint32_t lidar = 0; lidar < shape.lidars.size(); ++lidar) {
    // As of cameras: the first is the newest.
    const auto newest =
        std::find_if(view.clouds.begin(), view.clouds.end(),
                     [lidar](const CloudView& sweep) { return sweep.lidar == lidar; });
    if (newest != view.clouds.end()) write_sweep(*newest, shape, encoding, to);
  }
}

void add_lidars(const SensorSpec& sensor, ViewShape& shape) {
  for (const LidarSpec& spec : sensor.lidars) {
    const LidarShape lidar{.shots = static_cast<std::size_t>(shots_per_sweep(spec)),
                           .period_s = seconds(required_period(spec.rate_hz)),
                           .min_range_m = spec.min_range_m,
                           .max_range_m = spec.max_range_m};
    LidarShape& widest = shape.widest_lidar;
    if (shape.lidars.empty()) widest = lidar;
    widest.shots = std::max(widest.shots, lidar.shots);
    widest.min_range_m = std::min(widest.min_range_m, lidar.min_range_m);
    widest.max_range_m = std::max(widest.max_range_m, lidar.max_range_m);
    shape.lidars.push_back(lidar);
  }
}

}  // namespace

ViewShape view_shape(const TrialSpec& spec) {
  ViewShape shape;
  for (const auto& [kind, mounting] : rig_cameras(spec.sensor)) {
    const auto height_px = static_cast<std::size_t>(kind.height_px);
    const auto width_px = static_cast<std::size_t>(kind.width_px);
    const bool is_first = shape.cameras == 0;
    if (!is_first && (height_px != shape.height_px || width_px != shape.width_px)) {
      throw InputError("the cameras' pictures differ in size: an array needs one size");
    }
    shape.height_px = height_px;
    shape.width_px = width_px;
    // Of several kinds the widest range, so that what is encoded means the same for all.
    shape.min_range_m = is_first ? kind.min_range_m : std::min(shape.min_range_m, kind.min_range_m);
    shape.max_range_m = is_first ? kind.max_range_m : std::max(shape.max_range_m, kind.max_range_m);
    ++shape.cameras;
  }
  add_lidars(spec.sensor, shape);
  // Rounded up: where the rates do not divide each other, some periods hold one sample more.
  shape.imu_samples = static_cast<std::size_t>(std::ceil(spec.imu.rate_hz / spec.rates.plan_hz));
  return shape;
}

ViewArrays at(const ViewArrays& arrays, const ViewShape& shape, std::size_t index) {
  return {.depth = offset(arrays.depth, index * shape.pixels()),
          .stereo = offset(arrays.stereo, 2 * index * shape.pixels()),
          .color = offset(arrays.color, 3 * index * shape.pixels()),
          .points = offset(arrays.points, 3 * index * shape.shots()),
          .ranges = offset(arrays.ranges, index * shape.shots()),
          .imu = offset(arrays.imu, index * shape.imu_samples * kImuWidth),
          .state = offset(arrays.state, index * kStateWidth),
          .goal = offset(arrays.goal, index * kGoalWidth),
          .pose = offset(arrays.pose, index * kPoseWidth)};
}

void write_view(const PlannerView& view, const Eigen::Vector3d& goal_world, const ViewShape& shape,
                DepthEncoding encoding, const ViewArrays& to) {
  write_images(view, shape, encoding, to);
  write_sweeps(view, shape, encoding, to);
  if (to.imu != nullptr) write_imu(view.imu, shape, to.imu);
  const Eigen::Matrix3d R_heading_world = rotation_world_heading(view.q_world_body).transpose();
  if (float* state = to.state; state != nullptr) {
    write(state, R_heading_world * view.velocity_world);
    // Up in the body frame is roll and pitch without the heading, which tells a policy nothing.
    write(state, view.q_world_body.conjugate() * Eigen::Vector3d::UnitZ());
    write(state, view.rates_body);
  }
  if (float* goal = to.goal; goal != nullptr) {
    write(goal, R_heading_world * (goal_world - view.position_world));
  }
  if (double* pose = to.pose; pose != nullptr) {
    *pose++ = view.time_s;
    write(pose, view.position_world);
    write(pose, view.velocity_world);
    *pose++ = view.q_world_body.w();
    write(pose, Eigen::Vector3d(view.q_world_body.vec()));
    write(pose, view.rates_body);
  }
}

void clear_images(const ViewShape& shape, const ViewArrays& to) {
  if (to.depth != nullptr) std::fill_n(to.depth, shape.pixels(), 0.0F);
  if (to.stereo != nullptr) std::fill_n(to.stereo, 2 * shape.pixels(), std::uint8_t{0});
  if (to.color != nullptr) std::fill_n(to.color, 3 * shape.pixels(), std::uint8_t{0});
  if (to.points != nullptr) std::fill_n(to.points, 3 * shape.shots(), 0.0F);
  if (to.ranges != nullptr) std::fill_n(to.ranges, shape.shots(), 0.0F);
}

}  // namespace avoidbench
