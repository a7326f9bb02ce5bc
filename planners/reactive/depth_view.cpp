#include "depth_view.hpp"

#include <algorithm>
#include <limits>

#include "avoidbench/planner.hpp"

namespace reactive {
namespace {

constexpr int kColumns = 64;
constexpr double kEdgeRatio = 0.1;
constexpr double kSeenThrough_m = 0.5;

Vector3 axis(const ab_depth_image& image, double x, double y, double z) {
  const avoidbench::Vec3 turned = avoidbench::rotated(image.q_world_camera, {x, y, z});
  return {turned[0], turned[1], turned[2]};
}

}  // namespace

void DepthView::take(const ab_depth_image& image) {
  width_px_ = image.width_px;
  height_px_ = image.height_px;
  cell_px_ = std::max(1, (width_px_ + kColumns - 1) / kColumns);
  column_count_ = width_px_ / cell_px_;
  row_count_ = height_px_ / cell_px_;
  fx_px_ = image.fx_px;
  fy_px_ = image.fy_px;
  cx_px_ = image.cx_px;
  cy_px_ = image.cy_px;
  position_ = vector3(image.position_world_m);
  right_ = axis(image, 1.0, 0.0, 0.0);
  down_ = axis(image, 0.0, 1.0, 0.0);
  forward_ = axis(image, 0.0, 0.0, 1.0);
  cells_.clear();
  for (int row = 0; row < row_count_; ++row) {
    for (int column = 0; column < column_count_; ++column) {
      Cell cell{std::numeric_limits<double>::infinity(), 0.0, 0.0};
      int invalid_count = 0;
      for (int y = row * cell_px_; y < (row + 1) * cell_px_; ++y) {
        const float* line = image.depth_m + static_cast<std::ptrdiff_t>(y) * width_px_;
        for (int x = column * cell_px_; x < (column + 1) * cell_px_; ++x) {
          const double depth_m = static_cast<double>(line[x]);
          if (!(depth_m > 0.0)) {
            ++invalid_count;
          } else if (depth_m < cell.depth_m) {
            cell = {depth_m, static_cast<double>(x), static_cast<double>(y)};
          }
        }
      }
      const bool nothing_near = !std::isfinite(cell.depth_m);
      if (nothing_near && 2 * invalid_count > cell_px_ * cell_px_) {
        cell.depth_m = std::numeric_limits<double>::quiet_NaN();
      }
      cells_.push_back(cell);
    }
  }
}

void DepthView::append_points(double range_m, std::vector<Vector3>& points_world) const {
  for (const Cell& cell : cells_) {
    if (!(cell.depth_m <= range_m)) continue;
    const double x = (cell.column_px - cx_px_) / fx_px_, y = (cell.row_px - cy_px_) / fy_px_;
    points_world.push_back(position_ + cell.depth_m * (x * right_ + (y * down_ + forward_)));
  }
}

DepthView::Pixel DepthView::project(const Vector3& offset_world) const {
  const double depth_m = dot(offset_world, forward_);
  if (depth_m <= 1e-6) return {-1.0, -1.0, -1.0};
  return {cx_px_ + fx_px_ * dot(offset_world, right_) / depth_m,
          cy_px_ + fy_px_ * dot(offset_world, down_) / depth_m, depth_m};
}

const DepthView::Cell* DepthView::cell_at(const Pixel& pixel) const {
  if (is_empty() || pixel.depth_m <= 0.0) return nullptr;
  const double column = std::floor((pixel.column_px + 0.5) / cell_px_);
  const double row = std::floor((pixel.row_px + 0.5) / cell_px_);
  if (!(column >= 0.0 && column < column_count_ && row >= 0.0 && row < row_count_)) return nullptr;
  return &cells_[static_cast<std::size_t>(row) * static_cast<std::size_t>(column_count_) +
                 static_cast<std::size_t>(column)];
}

bool DepthView::has_seen(const Vector3& direction_world) const {
  const Pixel pixel = project(direction_world);
  const Cell* cell = cell_at(pixel);
  if (cell == nullptr || std::isnan(cell->depth_m)) return false;
  const double edge_x = kEdgeRatio * width_px_ * 0.5, edge_y = kEdgeRatio * height_px_ * 0.5;
  return pixel.column_px >= edge_x && pixel.column_px <= width_px_ - 1 - edge_x &&
         pixel.row_px >= edge_y && pixel.row_px <= height_px_ - 1 - edge_y;
}

bool DepthView::sees_through(const Vector3& point_world) const {
  const Pixel pixel = project(point_world - position_);
  const Cell* cell = cell_at(pixel);
  return cell != nullptr && cell->depth_m > pixel.depth_m + kSeenThrough_m;
}

}  // namespace reactive
