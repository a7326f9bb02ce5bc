#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "render/scene.hpp"
#include "sensing/sensor_spec.hpp"

namespace avoidbench {

/// What is wanted of a camera.
struct ImageNeeds {
  bool depth = false;
  bool stereo = false;  ///< the grey pair
  bool color = false;   ///< the left eye's
};

/// How the camera moves while it exposes.
struct CameraMotion {
  Eigen::Vector3d velocity_world = Eigen::Vector3d::Zero();     ///< of the left eye, m/s
  Eigen::Vector3d rates_world_radps = Eigen::Vector3d::Zero();  ///< rad/s
};

/// The images of one moment, each height × width (× 3), row-major. What was not asked for may be
/// empty.
struct CameraImages {
  std::vector<float>
      depth_m;  ///< along the left eye's z; +inf: no return within range; NaN: invalid
  std::vector<float> disparity_px;  ///< of sensors that match; NaN: invalid
  std::vector<std::uint8_t> left, right;
  std::vector<std::uint8_t> color;  ///< RGB
};

/// A sensor's camera with its buffers and matcher. Not for two threads at once.
class Camera {
 public:
  explicit Camera(const CameraSpec& spec);
  ~Camera();
  Camera(Camera&&) noexcept;
  Camera& operator=(Camera&&) noexcept;

  /// Fills `images` with what is asked for, seen from `T_world_camera` (the left eye's pose at the
  /// middle of the exposure). All noise follows from `seed`: the same call gives the same bytes,
  /// whatever was asked of the camera before.
  void expose(const Scene& scene, const Pose& T_world_camera, const CameraMotion& motion,
              const ImageNeeds& needs, std::uint64_t seed, CameraImages& images);

 private:
  struct Internals;
  std::unique_ptr<Internals> internals_;
};

}  // namespace avoidbench
