#include "sensing/camera.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "base/check.hpp"
#include "base/random.hpp"
#include "render/depth.hpp"
#include "sensing/depth_noise.hpp"
#include "sensing/image_model.hpp"
#include "sensing/stereo_matcher.hpp"
#include "shading/shading.hpp"

namespace avoidbench {
namespace {

using Eigen::Vector3d;

constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();
constexpr float kInfinity = std::numeric_limits<float>::infinity();

/// The pose `time_s` later, at constant velocity and rates.
Pose moved(const Pose& pose, const CameraMotion& motion, double time_s) {
  Pose later = pose;
  later.translation() += motion.velocity_world * time_s;
  const double angle = motion.rates_world_radps.norm() * time_s;
  if (angle != 0.0) {
    const Vector3d imaginary = motion.rates_world_radps.normalized() * math::sin(0.5 * angle);
    const Eigen::Quaterniond turn(math::cos(0.5 * angle), imaginary.x(), imaginary.y(),
                                  imaginary.z());
    // On the left, since rates are in the world's frame.
    later.linear() = turn * pose.linear();
  }
  return later;
}

}  // namespace

struct Camera::Internals {
  explicit Internals(const CameraSpec& spec)
      : sensor(spec),
        pinhole(sensor_camera(spec)),
        at_1m_px(disparity_at_1m_px(spec)),
        matcher(make_stereo_matcher(spec)),
        shares(vignette(spec.image, pinhole)) {
    if (const auto* noisy = std::get_if<DepthNoisySpec>(&spec.method)) noise.emplace(*noisy);
  }

  CameraSpec sensor;
  Pinhole pinhole;
  double at_1m_px;
  std::unique_ptr<StereoMatcher> matcher;
  std::optional<DepthNoise> noise;
  std::vector<float> shares;  ///< of light, by the lens
  std::vector<float> light, slice;
  std::vector<std::uint32_t> instances;
  std::vector<float> instance_opacity;

  std::size_t pixel_count() const { return shares.size(); }

  const std::vector<float>& gather_light(const Scene& scene, const Pose& pose,
                                         const CameraMotion& motion, Channels channels);
  void expose_pair(const Scene& scene, const Pose& pose, const CameraMotion& motion,
                   std::uint64_t seed, CameraImages& images);
  void expose_color(const Scene& scene, const Pose& pose, const CameraMotion& motion,
                    std::uint64_t seed, CameraImages& images);
  void match(CameraImages& images);
  void render_noisy_depth(const Scene& scene, const Pose& pose, std::uint64_t seed,
                          CameraImages& images);
};

/// Linear light of the exposure: the mean of its moments.
const std::vector<float>& Camera::Internals::gather_light(const Scene& scene, const Pose& pose,
                                                          const CameraMotion& motion,
                                                          Channels channels) {
  Pinhole shaded = pinhole;  // the light of what is beyond the range is seen all the same
  shaded.max_range_m = std::numeric_limits<double>::infinity();
  Light sun;
  sun.shadows = sensor.image.shadows;
  const std::size_t size = pixel_count() * static_cast<std::size_t>(channels);
  const auto moments = static_cast<int>(sensor.image.blur_samples);
  const int samples = static_cast<int>(sensor.image.samples);
  light.resize(size);
  if (moments == 1) {
    render_radiance(scene, shaded, pose, sun, samples, channels, light);
    return light;
  }
  std::fill(light.begin(), light.end(), 0.0F);
  slice.resize(size);
  const float share = 1.0F / static_cast<float>(moments);
  for (int i = 0; i < moments; ++i) {
    // Middles of equal parts of the exposure, about the image's own time.
    const double part = (i + 0.5) / moments - 0.5;
    const Pose now = moved(pose, motion, part * 1e-3 * sensor.exposure_ms);
    render_radiance(scene, shaded, now, sun, samples, channels, slice);
    for (std::size_t k = 0; k < size; ++k) light[k] += share * slice[k];
  }
  return light;
}

/// Both eyes with the exposure that suits the left one.
void Camera::Internals::expose_pair(const Scene& scene, const Pose& pose,
                                    const CameraMotion& motion, std::uint64_t seed,
                                    CameraImages& images) {
  gather_light(scene, pose, motion, Channels::grey);
  const double gain = exposure_gain(sensor.image, mean_light(light));
  RandomStream left_random = stream(seed, "left");
  images.left.resize(pixel_count());
  // One gain for both eyes, as in real rigs: a matcher compares grey values.
  develop(sensor.image, light, shares, gain, left_random, images.left);

  // The camera's x axis is to the right: from the left eye to the right one.
  const Vector3d to_right = pose.linear().col(0) * sensor.baseline_m;
  const Pose right = Eigen::Translation3d(to_right) * pose;
  // The right eye swings with the turn: v + ω × r.
  const CameraMotion right_motion{motion.velocity_world + motion.rates_world_radps.cross(to_right),
                                  motion.rates_world_radps};
  gather_light(scene, right, right_motion, Channels::grey);
  RandomStream right_random = stream(seed, "right");
  images.right.resize(pixel_count());
  develop(sensor.image, light, shares, gain, right_random, images.right);
}

void Camera::Internals::expose_color(const Scene& scene, const Pose& pose,
                                     const CameraMotion& motion, std::uint64_t seed,
                                     CameraImages& images) {
  gather_light(scene, pose, motion, Channels::rgb);
  RandomStream random = stream(seed, "color");
  images.color.resize(light.size());
  develop(sensor.image, light, shares, exposure_gain(sensor.image, mean_light(light)), random,
          images.color);
}

void Camera::Internals::match(CameraImages& images) {
  images.disparity_px.resize(pixel_count());
  matcher->match(images.left, images.right, images.disparity_px);
  const auto at_1m = static_cast<float>(at_1m_px);
  const auto nearest = static_cast<float>(sensor.min_range_m);
  const auto farthest = static_cast<float>(sensor.max_range_m);
  const auto* census = std::get_if<StereoSgmSpec>(&sensor.method);
  const auto step = static_cast<float>(census != nullptr ? census->depth_step_m : 0.0);
  for (std::size_t i = 0; i < images.depth_m.size(); ++i) {
    float depth = at_1m / images.disparity_px[i];
    // Depth of disparity 0 is infinite and has no whole number of steps.
    if (step > 0.0F && depth < 1e6F) {
      depth = static_cast<float>(static_cast<std::int64_t>(depth / step)) * step;
    }
    // NaN, where nothing matched, is neither farther nor nearer: it stays.
    const float in_range = depth > farthest ? kInfinity : depth;
    images.depth_m[i] = depth < nearest ? kNaN : in_range;
  }
}

void Camera::Internals::render_noisy_depth(const Scene& scene, const Pose& pose, std::uint64_t seed,
                                           CameraImages& images) {
  Pinhole ideal = pinhole;
  // A near thing must hide what is behind it before it becomes invalid itself.
  ideal.min_range_m = 0.0;
  instances.resize(pixel_count());
  render_depth(scene, ideal, pose, images.depth_m, instances);
  const World& world = scene.world();
  instance_opacity.resize(world.instances.size());
  for (std::size_t i = 0; i < instance_opacity.size(); ++i) {
    const std::uint32_t obstacle = world.instances[i].obstacle;
    const bool is_known = obstacle < world.obstacles.size();
    instance_opacity[i] =
        is_known ? static_cast<float>(world.obstacles[obstacle].texture_opacity) : 1.0F;
  }
  // A stream for each product: asking for colour, too, leaves the depth as it is.
  RandomStream random = stream(seed, "depth");
  noise->apply({.width_px = static_cast<std::size_t>(pinhole.width_px),
                .height_px = static_cast<std::size_t>(pinhole.height_px),
                .disparity_at_1m_px = at_1m_px,
                .min_range_m = sensor.min_range_m,
                .max_range_m = sensor.max_range_m},
               {instances, instance_opacity}, random, images.depth_m);
}

Camera::Camera(const CameraSpec& spec) : internals_(std::make_unique<Internals>(spec)) {}
Camera::~Camera() = default;
Camera::Camera(Camera&&) noexcept = default;
Camera& Camera::operator=(Camera&&) noexcept = default;

void Camera::expose(const Scene& scene, const Pose& T_world_camera, const CameraMotion& motion,
                    const ImageNeeds& needs, std::uint64_t seed, CameraImages& images) {
  Internals& self = *internals_;
  // A matcher needs both images, whether the planner sees them or not.
  const bool matches = needs.depth && self.matcher != nullptr;
  if (needs.stereo || matches) self.expose_pair(scene, T_world_camera, motion, seed, images);
  if (needs.color) self.expose_color(scene, T_world_camera, motion, seed, images);
  if (!needs.depth) return;
  images.depth_m.resize(self.pixel_count());
  if (matches) {
    self.match(images);
  } else if (self.noise) {
    self.render_noisy_depth(scene, T_world_camera, seed, images);
  } else {
    render_depth(scene, self.pinhole, T_world_camera, images.depth_m);
  }
}

}  // namespace avoidbench
