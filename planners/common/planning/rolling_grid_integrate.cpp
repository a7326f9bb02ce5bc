// How RollingGrid takes an image in. Ends of rays are binned into cells; cells before them are not
// found by walking rays but by looking: each cell of the view is projected into the image once.
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>

#include "avoidbench/planner_eigen.hpp"
#include "planning/rolling_grid.hpp"

namespace planning {
namespace {

using Eigen::Vector3d;
using Eigen::Vector3f;

constexpr float kInfinity = std::numeric_limits<float>::infinity();
constexpr int kWindows = 4;
constexpr int kDepthSteps = 64;  ///< of the table that has a window for each depth

/// How many blocks around the one where a cell's centre lies may see part of the cell.
int blocks_around(float half_cell_blocks_m, float depth_m) {
  return static_cast<int>(std::ceil(1.2F * half_cell_blocks_m / depth_m + 0.5F));
}

/// The least of the row's values up to `reach` to both sides, for all rows.
void shrink_rows(const std::vector<float>& from, int width, int reach, std::vector<float>& to) {
  to = from;
  for (std::size_t row = 0; row < from.size(); row += static_cast<std::size_t>(width)) {
    for (int k = 1; k <= std::min(reach, width - 1); ++k) {
      const float* ahead = &from[row] + k;
      float* least = &to[row];
      for (int i = 0; i < width - k; ++i) least[i] = std::min(least[i], ahead[i]);
      for (int i = 0; i < width - k; ++i) least[i + k] = std::min(least[i + k], ahead[i - k]);
    }
  }
}

void shrink_columns(const std::vector<float>& from, int width, int reach, std::vector<float>& to) {
  to = from;
  for (std::size_t k = 1; k <= static_cast<std::size_t>(reach); ++k) {
    const std::size_t shift = k * static_cast<std::size_t>(width);
    if (shift >= from.size()) return;
    const std::size_t count = from.size() - shift;
    for (std::size_t i = 0; i < count; ++i) to[i] = std::min(to[i], from[i + shift]);
    for (std::size_t i = 0; i < count; ++i) to[i + shift] = std::min(to[i + shift], from[i]);
  }
}

}  // namespace

/// The image as blocks of pixel_step by pixel_step pixels, and what cells are to it.
struct RollingGrid::View {
  Vector3d eye_world, eye_cells;  ///< the latter from the least corner of the grid
  Eigen::Matrix3d R_world_camera;
  double fx_px, fy_px, cx_px, cy_px;
  int width_px, height_px, step;
  int width, height;     ///< [blocks]
  float fu, fv, cu, cv;  ///< block u of a point: x / z fu + cu
  float half_u, half_v;  ///< half a cell at 1 m depth [blocks]
  float half_depth_m;    ///< from a cell's centre to its farthest point
  float resolution_m;
  float steps_per_m;                               ///< of window_at
  std::array<std::int8_t, kDepthSteps> window_at;  ///< which windows a cell needs; -1: none has it
};

/// A column of cells and those of it, from..to, that lie in the view.
struct RollingGrid::Column {
  std::size_t start;
  int x, y;  ///< from the least cell
  int from, to;
  Vector3f lowest_in_camera, step_in_camera;
};

bool RollingGrid::look(const ab_depth_image& image, View& view) {
  const Vector3d eye = avoidbench::as_vector(image.position_world_m);
  const Eigen::Quaterniond q = avoidbench::as_quaternion(image.q_world_camera);
  const double norm = q.norm();
  const bool has_lens = std::isfinite(image.fx_px) && image.fx_px > 0.0 &&
                        std::isfinite(image.fy_px) && image.fy_px > 0.0 &&
                        std::isfinite(image.cx_px) && std::isfinite(image.cy_px);
  if (!has_lens || !eye.allFinite() || !(norm > 0.5 && norm < 2.0)) return false;
  if (image.width_px <= 0 || image.height_px <= 0 || image.depth_m == nullptr) return false;
  const double cell_m = spec_.resolution_m;
  view.eye_world = eye;
  view.eye_cells = eye / cell_m - Cell(first_x_, first_y_, lowest_z_).cast<double>();
  const double reach = spec_.longest_ray_m / cell_m + 1.0;
  const Eigen::Array3d size = Cell(side_, side_, height_).cast<double>();
  if ((view.eye_cells.array() < -reach).any()) return false;
  if ((view.eye_cells.array() > size + reach).any()) return false;
  view.R_world_camera = q.normalized().toRotationMatrix();
  view.fx_px = image.fx_px;
  view.fy_px = image.fy_px;
  view.cx_px = image.cx_px;
  view.cy_px = image.cy_px;
  view.width_px = image.width_px;
  view.height_px = image.height_px;
  view.step = std::max(spec_.pixel_step, 1);
  view.width = (image.width_px + view.step - 1) / view.step;
  view.height = (image.height_px + view.step - 1) / view.step;
  view.fu = static_cast<float>(image.fx_px / view.step);
  view.fv = static_cast<float>(image.fy_px / view.step);
  view.cu = static_cast<float>((image.cx_px + 0.5) / view.step);
  view.cv = static_cast<float>((image.cy_px + 0.5) / view.step);
  view.resolution_m = static_cast<float>(cell_m);
  view.half_u = 0.5F * view.resolution_m * view.fu;
  view.half_v = 0.5F * view.resolution_m * view.fv;
  view.half_depth_m = static_cast<float>(0.5 * cell_m * view.R_world_camera.col(2).lpNorm<1>());
  return true;
}

/// Of each block the nearest pixel, whose ray ends in a cell if it is not too long.
void RollingGrid::take_nearest(const ab_depth_image& image, const View& view) {
  nearest_m_.resize(static_cast<std::size_t>(view.width) * static_cast<std::size_t>(view.height));
  const auto least_m = static_cast<float>(spec_.least_ray_m);
  const auto length_of = [&](int u, int v) {
    return Vector3d((u - view.cx_px) / view.fx_px, (v - view.cy_px) / view.fy_px, 1.0).norm();
  };
  std::size_t block = 0;
  for (int top = 0; top < view.height_px; top += view.step) {
    const int bottom = std::min(top + view.step, view.height_px);
    for (int left = 0; left < view.width_px; left += view.step, ++block) {
      const int right = std::min(left + view.step, view.width_px);
      float nearest = kInfinity;
      int at_u = -1, at_v = -1;
      for (int v = top; v < bottom; ++v) {
        const float* depths = image.depth_m + static_cast<std::ptrdiff_t>(v) *
                                                  static_cast<std::ptrdiff_t>(view.width_px);
        for (int u = left; u < right; ++u) {
          const float depth = depths[u];
          if (!(depth > 0.0F) || (at_u >= 0 && depth >= nearest)) continue;
          if (depth < least_m && static_cast<double>(depth) * length_of(u, v) < spec_.least_ray_m) {
            continue;
          }
          nearest = depth;
          at_u = u;
          at_v = v;
        }
      }
      nearest_m_[block] = at_u >= 0 ? nearest : 0.0F;
      if (at_u >= 0 && static_cast<double>(nearest) <= spec_.longest_ray_m) {
        add_end(view, nearest, at_u, at_v);
      }
    }
  }
}

void RollingGrid::add_end(const View& view, float depth_m, int u, int v) {
  const auto depth = static_cast<double>(depth_m);
  const double x = (u - view.cx_px) / view.fx_px, y = (v - view.cy_px) / view.fy_px;
  if (depth * depth * (x * x + y * y + 1.0) > spec_.longest_ray_m * spec_.longest_ray_m) return;
  const Vector3d way = view.R_world_camera * Vector3d(x * depth, y * depth, depth);
  const Vector3d place = view.eye_cells + way / spec_.resolution_m;
  if (!(place.minCoeff() >= 0.0)) return;
  const int cell_x = static_cast<int>(place.x()), cell_y = static_cast<int>(place.y());
  const int cell_z = static_cast<int>(place.z());
  if (cell_x >= side_ || cell_y >= side_ || cell_z >= height_) return;
  const std::size_t index =
      column_start(first_x_ + cell_x, first_y_ + cell_y) + static_cast<std::size_t>(cell_z);
  std::uint8_t& ends = ends_in_[index];
  if (ends == 0) {
    has_ends_[index / 64] |= std::uint64_t{1} << (index % 64);
    ends_.push_back({static_cast<std::uint32_t>(index), static_cast<std::int16_t>(cell_x),
                     static_cast<std::int16_t>(cell_y), static_cast<std::int16_t>(cell_z)});
  }
  if (ends < 255) ++ends;
}

/// For some sizes of windows, the least depth in the window around each block: what is nearer has
/// nothing before or in it. Cells near the camera are larger than all windows.
void RollingGrid::find_windows(View& view) {
  windows_m_.resize(kWindows);
  const float half = std::max(view.half_u, view.half_v);
  const auto longest_m = static_cast<float>(spec_.longest_ray_m);
  const int least = blocks_around(half, longest_m);
  std::array<int, kWindows> reach{least, least + 1, least + 2, least + 4};
  known_m_ = nearest_m_;
  for (float& depth : known_m_) depth = depth > 0.0F ? depth : kInfinity;
  int has = 0;
  for (std::size_t k = 0; k < kWindows; ++k) {
    shrink_rows(k == 0 ? known_m_ : windows_m_[k - 1], view.width, reach[k] - has, shrunk_m_);
    shrink_columns(shrunk_m_, view.width, reach[k] - has, windows_m_[k]);
    has = reach[k];
  }
  view.steps_per_m = kDepthSteps / longest_m;
  for (int i = 0; i < kDepthSteps; ++i) {
    const float depth_m = static_cast<float>(i) / view.steps_per_m;
    std::int8_t window = -1;
    for (int k = kWindows - 1; k >= 0 && i > 0; --k) {
      if (blocks_around(half, depth_m) <= reach[static_cast<std::size_t>(k)]) {
        window = static_cast<std::int8_t>(k);
      }
    }
    view.window_at[static_cast<std::size_t>(i)] = window;
  }
}

/// Whether a cell without ends is missed: the ray through its centre goes on behind it, and it is
/// not part of a surface that other rays graze.
bool RollingGrid::is_passed(const View& view, const Vector3f& in_camera) const {
  const float depth = in_camera.z(), inverse = 1.0F / depth;
  const int u =
      std::clamp(static_cast<int>(in_camera.x() * inverse * view.fu + view.cu), 0, view.width - 1);
  const int v =
      std::clamp(static_cast<int>(in_camera.y() * inverse * view.fv + view.cv), 0, view.height - 1);
  const auto block = static_cast<std::size_t>(v * view.width + u);
  const float behind = depth + view.half_depth_m - 0.01F * view.resolution_m;
  if (!(nearest_m_[block] > behind)) return false;
  const int step = std::min(static_cast<int>(depth * view.steps_per_m), kDepthSteps - 1);
  const int window = view.window_at[static_cast<std::size_t>(step)];
  if (window >= 0 && windows_m_[static_cast<std::size_t>(window)][block] > behind) return true;
  return !is_grazed(view, in_camera);
}

/// Whether of the rays around the cell more than a third end in its depth or a little before, those
/// that end long before it left aside. So do those at a surface that goes through the cell, however
/// flat it is seen.
bool RollingGrid::is_grazed(const View& view, const Vector3f& in_camera) const {
  const float depth = in_camera.z();
  const float u = in_camera.x() / depth * view.fu + view.cu;
  const float v = in_camera.y() / depth * view.fv + view.cv;
  const int reach_u = blocks_around(view.half_u, depth), stride_u = reach_u / 4 + 1;
  const int reach_v = blocks_around(view.half_v, depth), stride_v = reach_v / 4 + 1;
  const float behind = depth + view.half_depth_m - 0.01F * view.resolution_m;
  const float before = depth - std::max(2.0F * view.resolution_m, 0.1F * depth);
  int near = 0, all = 0;
  for (int k = -(reach_v / stride_v) * stride_v; k <= reach_v; k += stride_v) {
    const int row = static_cast<int>(v) + k;
    if (row < 0 || row >= view.height) continue;
    for (int i = -(reach_u / stride_u) * stride_u; i <= reach_u; i += stride_u) {
      const int column = static_cast<int>(u) + i;
      if (column < 0 || column >= view.width) continue;
      const float nearest = nearest_m_[static_cast<std::size_t>(row * view.width + column)];
      if (!(nearest >= before)) continue;
      ++all;
      near += nearest <= behind ? 1 : 0;
    }
  }
  return 3 * near > all;
}

/// Whether a cell with ends is hit: few rays go on behind it, or it is part of a surface. Four rays
/// behind it are as good as more.
bool RollingGrid::is_hit(const View& view, const Vector3f& in_camera, int ends) const {
  constexpr int kEnough = 4;
  if (2 * ends > kEnough) return true;
  const float depth = in_camera.z();
  if (!(depth > view.half_depth_m)) return true;  // too near to look
  const float u = in_camera.x() / depth * view.fu + view.cu - 0.5F;
  const float v = in_camera.y() / depth * view.fv + view.cv - 0.5F;
  const float half_u = view.half_u / depth, half_v = view.half_v / depth;
  const float behind = depth + view.half_depth_m;
  const int from_u = std::max(static_cast<int>(std::ceil(u - half_u)), 0);
  const int from_v = std::max(static_cast<int>(std::ceil(v - half_v)), 0);
  const int to_u = std::min(static_cast<int>(std::floor(u + half_u)), view.width - 1);
  const int to_v = std::min(static_cast<int>(std::floor(v + half_v)), view.height - 1);
  int passes = 0;
  for (int row = from_v; row <= to_v && passes < kEnough; ++row) {
    for (int column = from_u; column <= to_u; ++column) {
      passes += nearest_m_[static_cast<std::size_t>(row * view.width + column)] > behind ? 1 : 0;
    }
  }
  return 2 * ends > std::min(passes, kEnough) || is_grazed(view, in_camera);
}

void RollingGrid::count_ends(const View& view) {
  const Eigen::Matrix3d R_camera_world = view.R_world_camera.transpose();
  for (const End& end : ends_) {
    const Vector3d from_eye = Vector3d(end.x + 0.5, end.y + 0.5, end.z + 0.5) - view.eye_cells;
    const Vector3d in_camera = R_camera_world * from_eye * spec_.resolution_m;
    const bool was_occupied = ((occupied_[end.index / 64] >> (end.index % 64)) & 1U) != 0;
    const int change = is_hit(view, in_camera.cast<float>(), ends_in_[end.index]) ? hit_ : miss_;
    const bool is_occupied = add(end.index, change);
    if (is_occupied != was_occupied) mark_changed(first_x_ + end.x, first_y_ + end.y);
  }
}

/// Adds to the cell's log odds and sets its bits; whether it is occupied then.
bool RollingGrid::add(std::size_t index, int change) {
  const int sum = std::clamp(log_odds_[index] + change, int{lowest_}, int{highest_});
  log_odds_[index] = static_cast<std::int16_t>(sum);
  const std::uint64_t mask = std::uint64_t{1} << (index % 64);
  const std::size_t word = index / 64;
  known_[word] |= mask;
  occupied_[word] = sum > occupied_above_ ? occupied_[word] | mask : occupied_[word] & ~mask;
  settled_[word] = sum == lowest_ ? settled_[word] | mask : settled_[word] & ~mask;
  return sum > occupied_above_;
}

/// Misses what is_passed of the column's cells. Those at the least log odds cannot sink further.
void RollingGrid::miss_column(const View& view, const Column& column) {
  bool is_changed = false;
  for (int word = column.from / 64; word <= column.to / 64; ++word) {
    const std::size_t at = column.start / 64 + static_cast<std::size_t>(word);
    const int low = std::max(column.from - 64 * word, 0);
    const int high = std::min(column.to - 64 * word, 63);
    const std::uint64_t inside = (~std::uint64_t{0} << low) & (~std::uint64_t{0} >> (63 - high));
    std::uint64_t left = inside & ~settled_[at] & ~has_ends_[at];
    std::uint64_t missed = 0;
    for (; left != 0; left &= left - 1) {
      const int z = std::countr_zero(left);
      const auto up = static_cast<float>(64 * word + z);
      if (is_passed(view, column.lowest_in_camera + up * column.step_in_camera)) {
        missed |= left & (~left + 1);
      }
    }
    const std::uint64_t was_occupied = occupied_[at];
    for (; missed != 0; missed &= missed - 1) {
      add(64 * at + static_cast<std::size_t>(std::countr_zero(missed)), miss_);
    }
    is_changed = is_changed || occupied_[at] != was_occupied;
  }
  if (is_changed) mark_changed(first_x_ + column.x, first_y_ + column.y);
}

/// All columns that reach into the view: the pyramid of the image up to the longest ray.
void RollingGrid::miss_cells_in_view(const View& view) {
  const double cell_m = spec_.resolution_m, longest_m = spec_.longest_ray_m;
  const double left = (-0.5 - view.cx_px) / view.fx_px, top = (-0.5 - view.cy_px) / view.fy_px;
  const double right = (view.width_px - 0.5 - view.cx_px) / view.fx_px;
  const double bottom = (view.height_px - 0.5 - view.cy_px) / view.fy_px;
  const Eigen::Matrix3d& R = view.R_world_camera;
  // Inside where the products with all normals are not less than zero, or the least depth.
  const std::array<Vector3d, 5> normals{R * Vector3d(1, 0, -left), R * Vector3d(-1, 0, right),
                                        R * Vector3d(0, 1, -top), R * Vector3d(0, -1, bottom),
                                        R * Vector3d(0, 0, 1)};
  const double least_depth_m = 0.5 * cell_m;
  Vector3d low = Vector3d::Zero(), high = Vector3d::Zero();
  for (const double x : {left, right}) {
    for (const double y : {top, bottom}) {
      const Vector3d corner = R * Vector3d(x, y, 1.0) * longest_m;
      low = low.cwiseMin(corner);
      high = high.cwiseMax(corner);
    }
  }
  low = low.cwiseMax(-longest_m) / cell_m + view.eye_cells;
  high = high.cwiseMin(longest_m) / cell_m + view.eye_cells;
  const int from_x = std::max(static_cast<int>(low.x()), 0);
  const int from_y = std::max(static_cast<int>(low.y()), 0);
  const int to_x = std::min(static_cast<int>(high.x()), side_ - 1);
  const int to_y = std::min(static_cast<int>(high.y()), side_ - 1);
  const Eigen::Matrix3d R_camera_world = R.transpose();
  Column column{};
  column.step_in_camera = (R_camera_world.col(2) * cell_m).cast<float>();
  for (column.x = from_x; column.x <= to_x; ++column.x) {
    for (column.y = from_y; column.y <= to_y; ++column.y) {
      const double x_m = (column.x + 0.5 - view.eye_cells.x()) * cell_m;
      const double y_m = (column.y + 0.5 - view.eye_cells.y()) * cell_m;
      const double above_m2 = longest_m * longest_m - x_m * x_m - y_m * y_m;
      if (above_m2 < 0.0) continue;
      double to_m = std::sqrt(above_m2), from_m = -to_m;
      for (std::size_t k = 0; k < normals.size(); ++k) {
        const Vector3d& n = normals[k];
        const double lacks = (k == 4 ? least_depth_m : 0.0) - n.x() * x_m - n.y() * y_m;
        if (std::abs(n.z()) < 1e-9) {
          if (lacks > 0.0) to_m = -kInfinity;
        } else if (n.z() > 0.0) {
          from_m = std::max(from_m, lacks / n.z());
        } else {
          to_m = std::min(to_m, lacks / n.z());
        }
      }
      const double below = view.eye_cells.z() - 0.5;
      const double from = std::max(std::ceil(from_m / cell_m + below), 0.0);
      const double to = std::min(std::floor(to_m / cell_m + below), height_ - 1.0);
      if (!(from <= to)) continue;
      column.from = static_cast<int>(from);
      column.to = static_cast<int>(to);
      column.start = column_start(first_x_ + column.x, first_y_ + column.y);
      const Vector3d lowest(x_m, y_m, (0.5 - view.eye_cells.z()) * cell_m);
      column.lowest_in_camera = (R_camera_world * lowest).cast<float>();
      miss_column(view, column);
    }
  }
}

void RollingGrid::integrate(const ab_depth_image& image) {
  View view;
  if (!look(image, view)) return;
  take_nearest(image, view);
  find_windows(view);
  miss_cells_in_view(view);
  count_ends(view);
  for (const End& end : ends_) {
    ends_in_[end.index] = 0;
    has_ends_[end.index / 64] = 0;
  }
  ends_.clear();
  inflate_changes();
}

}  // namespace planning
