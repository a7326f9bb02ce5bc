#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <limits>

#include "avoidbench/planner_eigen.hpp"
#include "planning/rolling_grid.hpp"

namespace planning {
namespace {

using Eigen::Vector3d;

/// Of a shot's way, the cells before its point that may belong to the surface it grazes.
constexpr double kGrazed_cells = 4.0;

constexpr double kNever = std::numeric_limits<double>::infinity();

}  // namespace

/// Marks the cells on the way (Amanatides and Woo 1987), from one that is inside. Places in cells
/// from the least corner; `has_end` says that a point lies at `to_cells`, whose cell is not passed.
void RollingGrid::pass(const Vector3d& from_cells, const Vector3d& to_cells, bool has_end) {
  const std::array<int, 3> size{side_, side_, height_};
  const std::array<std::ptrdiff_t, 3> stride{std::ptrdiff_t{64} * words_ * side_,
                                             std::ptrdiff_t{64} * words_, 1};
  std::array<int, 3> cell{}, step{};
  std::array<double, 3> next{}, per_cell{};  // shares of the way: where each axis is crossed
  int left = 0;                              // cells to go
  std::ptrdiff_t index = 0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto k = static_cast<Eigen::Index>(axis);
    const double way = to_cells[k] - from_cells[k];
    cell[axis] = static_cast<int>(from_cells[k]);
    const int cells = static_cast<int>(std::floor(to_cells[k])) - cell[axis];
    step[axis] = cells > 0 ? 1 : -1;
    next[axis] = cells == 0 ? kNever : (cell[axis] + (cells > 0 ? 1 : 0) - from_cells[k]) / way;
    per_cell[axis] = cells == 0 ? kNever : 1.0 / std::abs(way);
    left += std::abs(cells);
    index += cell[axis] * stride[axis];
  }
  const double length_cells = (to_cells - from_cells).norm();
  const double grazes = has_end ? 1.0 - kGrazed_cells / std::max(length_cells, kGrazed_cells) : 2.0;
  for (; left >= (has_end ? 1 : 0); --left) {
    const std::size_t axis =
        next[0] < next[1] ? (next[0] < next[2] ? 0 : 2) : (next[1] < next[2] ? 1 : 2);
    const bool is_grazed = next[axis] > grazes && left > 0;
    if (!is_grazed || !is_known({first_x_ + cell[0], first_y_ + cell[1], lowest_z_ + cell[2]})) {
      const auto at = static_cast<std::size_t>(index);
      passed_[at / 64] |= std::uint64_t{1} << (at % 64);
    }
    if (left == 0) return;
    cell[axis] += step[axis];
    if (static_cast<unsigned>(cell[axis]) >= static_cast<unsigned>(size[axis])) return;
    index += step[axis] * stride[axis];
    next[axis] += per_cell[axis];
  }
}

void RollingGrid::integrate(const ab_cloud& cloud) {
  const Vector3d eye = avoidbench::as_vector(cloud.position_world_m);
  const Eigen::Quaterniond q = avoidbench::as_quaternion(cloud.q_world_lidar);
  const double norm = q.norm();
  // As with images, what can't be says nothing.
  if (!eye.allFinite() || !(norm > 0.5 && norm < 2.0)) return;
  const double cell_m = spec_.resolution_m;
  const Vector3d eye_cells = eye / cell_m - Cell(first_x_, first_y_, lowest_z_).cast<double>();
  const double reach = spec_.longest_ray_m / cell_m + 1.0;
  const Eigen::Array3d size = Cell(side_, side_, height_).cast<double>();
  if ((eye_cells.array() < -reach).any() || (eye_cells.array() > size + reach).any()) return;
  const Eigen::Matrix3d R_world_lidar = q.normalized().toRotationMatrix();
  const bool is_inside = end_at(eye_cells).has_value();

  for (std::uint32_t i = 0; i < cloud.point_count; ++i) {
    const float* const point = cloud.points[i].position_lidar_m;
    const Vector3d way =
        R_world_lidar * Eigen::Vector3f(point[0], point[1], point[2]).cast<double>();
    const double length_m = way.norm();
    if (!(length_m >= spec_.least_ray_m && length_m < 1e6)) continue;
    const bool is_far = length_m > spec_.longest_ray_m;
    const double share = is_far ? spec_.longest_ray_m / length_m : 1.0;
    const Vector3d to_cells = eye_cells + way * (share / cell_m);
    if (!is_far) add_end(to_cells);
    if (is_inside) pass(eye_cells, to_cells, !is_far);
  }
  for (std::uint32_t i = 0; is_inside && i < cloud.miss_count; ++i) {
    const float* const miss = cloud.misses_lidar + 3 * static_cast<std::size_t>(i);
    const Vector3d way = R_world_lidar * Eigen::Vector3f(miss[0], miss[1], miss[2]).cast<double>();
    const double length = way.norm();
    if (!(length > 0.5 && length < 2.0)) continue;
    pass(eye_cells, eye_cells + way * (spec_.longest_ray_m / (cell_m * length)), false);
  }

  count_sweep();
  inflate_changes();
}

/// Each cell once, whatever the number of its shots.
void RollingGrid::count_sweep() {
  const auto count_once = [this](std::size_t index, int x, int y, int change) {
    const bool was_occupied = ((occupied_[index / 64] >> (index % 64)) & 1U) != 0;
    if (add(index, change) != was_occupied) mark_changed(first_x_ + x, first_y_ + y);
  };
  std::uint64_t* passed = passed_.data();
  for (int x = 0; x < side_; ++x) {
    for (int y = 0; y < side_; ++y) {
      const std::size_t start = column_start(first_x_ + x, first_y_ + y) / 64;
      for (std::size_t word = start; word < start + static_cast<std::size_t>(words_); ++word) {
        if (*passed != 0) {
          // Cells at the least log odds stay there.
          std::uint64_t missed = *passed & ~not_missed_[word] & ~settled_[word];
          for (; missed != 0; missed &= missed - 1) {
            count_once(64 * word + static_cast<std::size_t>(std::countr_zero(missed)), x, y, miss_);
          }
          *passed = 0;
        }
        ++passed;
      }
    }
  }
  for (const End& end : ends_) {
    count_once(end.index, end.x, end.y, hit_);
    ends_in_[end.index] = 0;
    not_missed_[end.index / 64] = 0;
  }
  ends_.clear();
}

}  // namespace planning
