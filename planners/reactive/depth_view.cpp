#include "depth_view.hpp"

#include <algorithm>
#include <limits>

#include "avoidbench/planner.hpp"

namespace reactive {
namespace {

constexpr int kColumns = 64;
constexpr double kEdgeRatio = 0.1;
constexpr double kSeenThrough_m = 0.5;
constexpr double kAlikeRatio = 0.1;   // depths of one surface in pixels beside each other
constexpr double kThinnest_m = 0.01;  // what is thinner may be missed from near
constexpr double kLeastAlike_px = 3.0;
// Where an image may show a point that another shows: depth of a stereo pair errs by a tenth at the
// end of the lookahead, and the nearest pixel of a cell is another one in each image.
constexpr double kSame_m = 0.1, kSameRatio = 0.15;

Vector3 axis(const ab_depth_image& image, double x, double y, double z) {
  const avoidbench::Vec3 turned = avoidbench::rotated(image.q_world_camera, {x, y, z});
  return {turned[0], turned[1], turned[2]};
}

/// Whether the pixels around (x, y) show a surface at this depth too: as many as something of
/// `kThinnest_m` would fill, and not fewer than a line of pixels has. A stereo matcher makes up
/// single pixels, and streaks that are a few pixels high close to the camera.
bool has_support(const ab_depth_image& image, int x, int y, double depth_m, int half_px) {
  const int first_x = std::max(0, x - half_px), last_x = std::min(image.width_px - 1, x + half_px);
  const int first_y = std::max(0, y - half_px), last_y = std::min(image.height_px - 1, y + half_px);
  const double nearest_m = (1.0 - kAlikeRatio) * depth_m;
  const double farthest_m = (1.0 + kAlikeRatio) * depth_m;
  const double side_px = 2.0 * half_px + 1.0;
  const double thickness_px = std::min(side_px, kThinnest_m * image.fx_px / depth_m);
  const double needed_px = std::max(kLeastAlike_px, thickness_px * side_px);
  int alike_count = 0;  // with itself
  for (int row = first_y; row <= last_y; ++row) {
    const float* line = image.depth_m + static_cast<std::ptrdiff_t>(row) * image.width_px;
    for (int column = first_x; column <= last_x; ++column) {
      const double other_m = static_cast<double>(line[column]);
      alike_count +=
          static_cast<int>(other_m >= nearest_m) & static_cast<int>(other_m <= farthest_m);
    }
    if (alike_count >= needed_px) return true;  // on most surfaces after a line or two
  }
  return false;
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
      cells_.push_back(cell_of(image, column * cell_px_, row * cell_px_));
    }
  }
}

DepthView::Cell DepthView::cell_of(const ab_depth_image& image, int left_px, int top_px) const {
  const int half_px = std::max(1, cell_px_ / 2);
  int invalid_count = 0;
  // The nearest pixel of those that `counts` takes.
  const auto nearest = [&](const auto& counts) {
    float nearest_m = std::numeric_limits<float>::infinity();
    int column = 0, row = 0;
    invalid_count = 0;
    for (int y = top_px; y < top_px + cell_px_; ++y) {
      const float* line = image.depth_m + static_cast<std::ptrdiff_t>(y) * width_px_;
      for (int x = left_px; x < left_px + cell_px_; ++x) {
        if (!(line[x] > 0.0F)) {
          ++invalid_count;
        } else if (line[x] < nearest_m && counts(x, y, line[x])) {
          nearest_m = line[x];
          column = x;
          row = y;
        }
      }
    }
    const auto depth_m = static_cast<double>(nearest_m);
    return Cell{
        .depth_m = depth_m, .column_px = 1.0 * column, .row_px = 1.0 * row, .least_m = depth_m};
  };
  const auto is_supported = [&](int x, int y, float depth_m) {
    return has_support(image, x, y, static_cast<double>(depth_m), half_px);
  };
  Cell cell = nearest([](int, int, float) { return true; });
  const double least_m = cell.depth_m;
  if (std::isfinite(least_m) && !has_support(image, static_cast<int>(cell.column_px),
                                             static_cast<int>(cell.row_px), least_m, half_px)) {
    cell = nearest(is_supported);
    cell.least_m = least_m;
  }
  const bool nothing_near = !std::isfinite(cell.depth_m);
  if (nothing_near && 2 * invalid_count > cell_px_ * cell_px_) {
    cell.depth_m = std::numeric_limits<double>::quiet_NaN();
  }
  return cell;
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
  const double column = (pixel.column_px + 0.5) / cell_px_;
  const double row = (pixel.row_px + 0.5) / cell_px_;
  if (!(column >= 0.0 && column < column_count_ && row >= 0.0 && row < row_count_)) return nullptr;
  return cells_.data() + static_cast<std::ptrdiff_t>(row) * column_count_ +
         static_cast<std::ptrdiff_t>(column);
}

bool DepthView::has_seen(const Vector3& direction_world) const {
  const Pixel pixel = project(direction_world);
  const Cell* cell = cell_at(pixel);
  if (cell == nullptr || std::isnan(cell->depth_m)) return false;
  const double edge_x = kEdgeRatio * width_px_ * 0.5, edge_y = kEdgeRatio * height_px_ * 0.5;
  return pixel.column_px >= edge_x && pixel.column_px <= width_px_ - 1 - edge_x &&
         pixel.row_px >= edge_y && pixel.row_px <= height_px_ - 1 - edge_y;
}

bool DepthView::shows(const Vector3& point_world) const {
  const Pixel pixel = project(point_world - position_);
  const Cell* middle = cell_at(pixel);
  if (middle == nullptr) return false;
  const double slack_m = kSame_m + kSameRatio * pixel.depth_m;
  if (std::abs(middle->depth_m - pixel.depth_m) <= slack_m) return true;  // as a rule
  const int at = static_cast<int>(middle - cells_.data());
  const int middle_row = at / column_count_, middle_column = at % column_count_;
  for (int row = std::max(0, middle_row - 1); row <= std::min(row_count_ - 1, middle_row + 1);
       ++row) {
    for (int column = std::max(0, middle_column - 1);
         column <= std::min(column_count_ - 1, middle_column + 1); ++column) {
      const double depth_m = cells_.data()[row * column_count_ + column].depth_m;
      if (std::abs(depth_m - pixel.depth_m) <= slack_m) return true;
    }
  }
  return false;
}

bool DepthView::sees_through(const Vector3& point_world) const {
  const Pixel pixel = project(point_world - position_);
  const Cell* cell = cell_at(pixel);
  if (cell == nullptr || std::isnan(cell->depth_m)) return false;
  return cell->least_m > pixel.depth_m + kSeenThrough_m;
}

}  // namespace reactive
