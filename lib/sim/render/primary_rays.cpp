#include "render/primary_rays.hpp"

#include <emmintrin.h>

#include <algorithm>
#include <cmath>
#include <cstring>

#include "base/check.hpp"

namespace avoidbench {
namespace {

std::size_t padded(std::size_t count, int step) {
  const auto whole = static_cast<std::size_t>(step);
  return (count + whole - 1) / whole * whole;
}

/// (pixel − principal point) / focal length for each sample of a row or a column.
std::vector<double> ray_slopes(std::int32_t size_px, int samples, int step, double c, double f) {
  // Whole blocks: rays beyond the image's border are traced and not used.
  std::vector<double> slopes(
      padded(static_cast<std::size_t>(size_px) * static_cast<std::size_t>(samples), step));
  for (std::size_t i = 0; i < slopes.size(); ++i) {
    // Samples are in the middles of equal parts of a pixel.
    const double pixel = (static_cast<double>(i) + 0.5) / samples - 0.5;
    slopes[i] = (pixel - c) / f;
  }
  return slopes;
}

/// Blocks of a row or a column of them.
struct Blocks {
  std::size_t begin = 0, end = 0;
};

/// The blocks whose rays, of these slopes, may meet a ball: `across` and `ahead` are its centre's
/// places along the image's axis and forward.
Blocks blocks_of(const std::vector<double>& slopes, double across, double ahead, double radius_m,
                 int step) {
  // More than rounding: which blocks are traced must not decide what is seen.
  const double radius = radius_m * 1.001 + 1e-3;
  if (ahead + radius <= 0.0) return {};
  const auto block = static_cast<std::size_t>(step);
  // A ball that reaches behind the camera may be seen anywhere.
  if (ahead <= radius) return {0, slopes.size() / block};
  // The two lines through the camera that touch the ball's outline.
  const double over = ahead * ahead - radius * radius;
  const double spread = radius * std::sqrt(across * across + over);
  const double low = (across * ahead - spread) / over, high = (across * ahead + spread) / over;
  const auto first = std::lower_bound(slopes.begin(), slopes.end(), low) - slopes.begin();
  const auto last = std::upper_bound(slopes.begin(), slopes.end(), high) - slopes.begin();
  if (first == last) return {};
  return {static_cast<std::size_t>(first) / block,
          (static_cast<std::size_t>(last) + block - 1) / block};
}

}  // namespace

PrimaryRays::PrimaryRays(const Scene::Internals& scene, const Pinhole& camera,
                         const Pose& T_world_camera, int samples)
    : scene_(scene), range_m_(static_cast<float>(camera.max_range_m)) {
  AB_CHECK(camera.width_px > 0 && camera.height_px > 0, camera.width_px, camera.height_px);
  AB_CHECK(samples >= 1, samples);
  AB_CHECK(T_world_camera.matrix().allFinite());
  u_ = ray_slopes(camera.width_px, samples, kBlockWidth, camera.cx_px, camera.fx_px);
  v_ = ray_slopes(camera.height_px, samples, kBlockHeight, camera.cy_px, camera.fy_px);
  const Eigen::Matrix3d axes = T_world_camera.linear();
  const Eigen::Vector3d position = T_world_camera.translation();
  for (int k = 0; k < 3; ++k) {
    columns_[k].resize(u_.size());
    rows_[k].resize(v_.size());
    for (std::size_t i = 0; i < u_.size(); ++i) {
      // A ray's direction is the sum of its column's part and its row's: two tables instead of a
      // product for each pixel. They are not unit vectors: with z = 1 in the camera's frame,
      // a distance is the depth.
      columns_[k][i] = static_cast<float>(axes(k, 0) * u_[i]);
    }
    for (std::size_t i = 0; i < v_.size(); ++i) {
      rows_[k][i] = static_cast<float>(axes(k, 1) * v_[i] + axes(k, 2));
    }
  }

  const auto camera_axes = [&](const Eigen::Matrix3d& linear, const Eigen::Vector3d& origin) {
    // The camera in each instance's frame, so that depths need no triangle in the world's frame.
    const Eigen::Matrix3d turned = linear * axes;
    const Eigen::Vector3d moved = linear * (position - origin);
    CameraAxes result{};
    double* const rows[] = {result.x, result.y, result.z};
    for (int k = 0; k < 3; ++k) {
      for (int axis = 0; axis < 3; ++axis) rows[k][axis] = turned(k, axis);
      rows[k][3] = -moved[k];
    }
    return result;
  };
  cameras_.reserve(1 + scene.placements.size() - scene.flattened_count);
  cameras_.push_back(camera_axes(Eigen::Matrix3d::Identity(), Eigen::Vector3d::Zero()));
  for (std::size_t i = scene.flattened_count; i < scene.placements.size(); ++i) {
    const Placement& placement = scene.placements[i];
    cameras_.push_back(camera_axes(placement.linear_prototype_world, placement.position_world));
  }
  if (scene.has_movers()) find_mover_blocks(T_world_camera);

  // What never changes between blocks is written once.
  std::memset(static_cast<void*>(packets_), 0, sizeof(packets_));
  for (RTCRayHit8& packet : packets_) {
    std::fill_n(packet.ray.org_x, 8, static_cast<float>(position.x()));
    std::fill_n(packet.ray.org_y, 8, static_cast<float>(position.y()));
    std::fill_n(packet.ray.org_z, 8, static_cast<float>(position.z()));
    std::fill_n(packet.ray.mask, 8, ~0U);
  }
}

void PrimaryRays::trace(int block_x, int block_y) {
  const std::size_t x = static_cast<std::size_t>(block_x) * kBlockWidth;
  std::size_t y = static_cast<std::size_t>(block_y) * kBlockHeight;
  const __m128 column_x = _mm_loadu_ps(&columns_[0][x]);
  const __m128 column_y = _mm_loadu_ps(&columns_[1][x]);
  const __m128 column_z = _mm_loadu_ps(&columns_[2][x]);
  const __m128 range = _mm_set1_ps(range_m_);
  const __m128i nothing = _mm_set1_epi32(-1);
  static_assert(RTC_INVALID_GEOMETRY_ID == ~0U);
  for (RTCRayHit8& packet : packets_) {
    for (int row = 0; row < kPacketHeight; ++row, ++y) {
      const int lane = row * kBlockWidth;
      _mm_store_ps(packet.ray.dir_x + lane, _mm_add_ps(column_x, _mm_set1_ps(rows_[0][y])));
      _mm_store_ps(packet.ray.dir_y + lane, _mm_add_ps(column_y, _mm_set1_ps(rows_[1][y])));
      _mm_store_ps(packet.ray.dir_z + lane, _mm_add_ps(column_z, _mm_set1_ps(rows_[2][y])));
      // Tracing writes over length and hit: both are set again for each block.
      _mm_store_ps(packet.ray.tfar + lane, range);
      _mm_store_si128(reinterpret_cast<__m128i*>(packet.hit.geomID + lane), nothing);
    }
  }
  avoidbench::trace(scene_.map->top.get(), scene_.placements.data(), packets_);
  if (mover_blocks_.empty()) return;
  const auto across = static_cast<std::size_t>(blocks_across());
  const std::size_t block =
      static_cast<std::size_t>(block_y) * across + static_cast<std::size_t>(block_x);
  if (mover_blocks_[block] != 0) trace_movers();
}

/// Most of a picture shows no mover: those rays are not traced a second time.
void PrimaryRays::find_mover_blocks(const Pose& T_world_camera) {
  const auto across = static_cast<std::size_t>(blocks_across());
  mover_blocks_.assign(across * static_cast<std::size_t>(blocks_down()), 0);
  for (const MoverBall& ball : scene_.balls) {
    const Eigen::Vector3d center =
        T_world_camera.linear().transpose() * (ball.center_world - T_world_camera.translation());
    const Blocks columns = blocks_of(u_, center.x(), center.z(), ball.radius_m, kBlockWidth);
    const Blocks rows = blocks_of(v_, center.y(), center.z(), ball.radius_m, kBlockHeight);
    for (std::size_t row = rows.begin; row < rows.end; ++row) {
      const auto line = mover_blocks_.begin() + static_cast<std::ptrdiff_t>(row * across);
      std::fill(line + static_cast<std::ptrdiff_t>(columns.begin),
                line + static_cast<std::ptrdiff_t>(columns.end), std::uint8_t{1});
    }
  }
}

/// Rays end where they have met the map: what is met now is nearer.
void PrimaryRays::trace_movers() {
  avoidbench::trace(scene_.movers.top.get(), scene_.placements.data(), packets_);
  if (!scene_.map->flattened) return;
  // instances() reads one list: that of a flattened map's.
  for (RTCRayHit8& packet : packets_) {
    for (int lane = 0; lane < 8; ++lane) {
      // A ray that has met nothing keeps what an earlier block left as its instance.
      const bool has_met = packet.hit.geomID[lane] != RTC_INVALID_GEOMETRY_ID;
      const unsigned mover = packet.hit.instID[0][lane];
      if (has_met && mover != RTC_INVALID_GEOMETRY_ID) packet.hit.geomID[lane] = mover;
    }
  }
}

}  // namespace avoidbench
