#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "base/random.hpp"
#include "sensing/sensor_spec.hpp"

namespace avoidbench {

/// What each pixel of an image shows.
struct SeenSurfaces {
  std::span<const std::uint32_t>
      surface;                     ///< height × width; an index into `opacity`, else nothing
  std::span<const float> opacity;  ///< of each surface's texture, 0 to 1
};

/// A true depth image and the stereo pair that is to have measured it.
struct NoisyDepthView {
  std::size_t width_px = 0, height_px = 0;
  double disparity_at_1m_px = 0;  ///< focal length × baseline
  double min_range_m = 0, max_range_m = 0;
};

/// An image of normals of variance 1 in which neighbours are alike: a lattice of independent ones,
/// one each `size_px`, linear between. Read row by row.
class NormalField {
 public:
  explicit NormalField(double size_px) : size_px_(size_px) {}

  void draw(std::size_t width_px, std::size_t height_px, RandomStream& random);
  const std::vector<float>& row(std::size_t y);  ///< valid until the next call

 private:
  double size_px_;
  std::size_t cells_across_ = 0;
  std::vector<float> lattice_, row_cells_, row_;
  std::vector<float> left_, right_;       ///< weights of the lattice's columns beside a pixel
  std::vector<std::size_t> first_pixel_;  ///< of each cell, and the width
};

/// Makes true depth as wrong as a stereo camera's. `depth_m` is height × width, row-major, and must
/// reach beyond the range (+inf: nothing); afterwards it is NaN where invalid and nearer than the
/// range, +inf beyond it. Buffers are kept for the next image.
class DepthNoise {
 public:
  explicit DepthNoise(const DepthNoisySpec& spec);

  void apply(const NoisyDepthView& view, const SeenSurfaces& seen, RandomStream& random,
             std::span<float> depth_m);

 private:
  void fatten(std::size_t width, std::size_t height);
  void occlude_row(const std::vector<float>& patches, float* disparity) const;
  void find_textures(std::span<const float> opacity);
  void drop_pixels(RandomStream& random);
  void finish_row(const NoisyDepthView& view, std::size_t y,
                  std::span<const std::uint32_t> surfaces, std::span<float> depth_m);

  DepthNoisySpec spec_;
  NormalField holes_, errors_;
  std::vector<float> disparity_, rows_max_, max_;
  struct Texture {
    float opacity = 0.0F;
    float hole_below = 0.0F, outlier_above = 0.0F;  ///< of the patches' numbers
    float sigma_px = 0.0F;
  };
  Texture texture_of(float opacity) const;
  float covered_below_ = 0.0F;     ///< half-occluded patches below this are invalid
  std::vector<Texture> textures_;  ///< of the surfaces, and at the end of where there is none
};

}  // namespace avoidbench
