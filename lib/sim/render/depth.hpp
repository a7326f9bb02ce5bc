#pragma once

#include <cstdint>
#include <span>

#include "render/camera.hpp"
#include "render/scene.hpp"

namespace avoidbench {

struct DepthKernel;  // depth_kernel.hpp

/// The depth image seen from `T_world_camera`: for each pixel, distance along camera z to the
/// nearest surface, metres. `depth_m` is height × width, row-major, filled whole; +inf where
/// nothing is hit within `camera.max_range_m`, NaN where it is nearer than `camera.min_range_m`.
/// The pixel's ray goes through its centre; the first pixel's centre is (0, 0). Noise-free. The
/// same bits on every processor (tracing.hpp).
void render_depth(const Scene& scene, const Pinhole& camera, const Pose& T_world_camera,
                  std::span<float> depth_m);

/// The same depth, and what each pixel shows: an index into World::instances, kNoInstance where
/// nothing is hit. `instances` has the size of `depth_m`.
inline constexpr std::uint32_t kNoInstance = ~0U;
void render_depth(const Scene& scene, const Pinhole& camera, const Pose& T_world_camera,
                  std::span<float> depth_m, std::span<std::uint32_t> instances);

/// The faster kernel that this processor has. All give the same bits, so nobody needs to choose;
/// for tests and benchmarks.
const DepthKernel& depth_kernel();
void render_depth_by(const DepthKernel& kernel, const Scene& scene, const Pinhole& camera,
                     const Pose& T_world_camera, std::span<float> depth_m,
                     std::span<std::uint32_t> instances);

}  // namespace avoidbench
