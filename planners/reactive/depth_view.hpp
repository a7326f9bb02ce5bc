#pragma once

#include <vector>

#include "avoidbench/planner.h"
#include "vector3.hpp"

namespace reactive {

/// A depth image brought down to cells of a few pixels, each with the nearest surface in it that
/// the pixels around confirm: thin branches stay, single wrong pixels go.
class DepthView {
 public:
  /// Copies what is needed. About 64 cells across, whatever the image's size.
  void take(const ab_depth_image& image);
  bool is_empty() const { return column_count_ == 0; }

  /// World points of the nearest surface in each cell, up to `range_m` along camera z.
  void append_points(double range_m, std::vector<Vector3>& points_world) const;

  /// Whether the camera looked along this world direction and measured something there: NaN is not
  /// seen. Directions within a tenth of the image's edge count as unseen, for a body is wider than
  /// a ray.
  bool has_seen(const Vector3& direction_world) const;

  /// Whether there is a surface at this world point, as far as stereo can tell.
  bool shows(const Vector3& point_world) const;

  /// Whether the camera saw past this world point, with each pixel of the cell.
  bool sees_through(const Vector3& point_world) const;

  /// The camera's forward axis in the world.
  Vector3 forward_world() const { return forward_; }

 private:
  struct Cell {
    /// Of the nearest surface; +inf: none in range; NaN: most of the cell is invalid.
    double depth_m;
    double column_px, row_px;
    double least_m;  ///< of any pixel, also of those that nothing confirms
  };
  struct Pixel {
    double column_px, row_px, depth_m;
  };
  Cell cell_of(const ab_depth_image& image, int left_px, int top_px) const;
  Pixel project(const Vector3& offset_world) const;
  const Cell* cell_at(const Pixel& pixel) const;

  int width_px_ = 0, height_px_ = 0, cell_px_ = 1;
  int column_count_ = 0, row_count_ = 0;
  double fx_px_ = 1.0, fy_px_ = 1.0, cx_px_ = 0.0, cy_px_ = 0.0;
  Vector3 position_, right_, down_, forward_;  // the camera's axes in the world
  std::vector<Cell> cells_;
};

}  // namespace reactive
