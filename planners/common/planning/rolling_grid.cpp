#include "planning/rolling_grid.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "avoidbench/planner_eigen.hpp"

namespace planning {
namespace {

using Eigen::Vector3d;

constexpr float kUnknown = -std::numeric_limits<float>::infinity();

int floored(double value) { return static_cast<int>(std::floor(value)); }

int wrapped(int value, int size) {
  const int rest = value % size;
  return rest < 0 ? rest + size : rest;
}

}  // namespace

/// The rays of one image start here.
struct RollingGrid::RayFan {
  Vector3d eye_world;
  Cell eye;
};

RollingGrid::RollingGrid(const RollingGridSpec& spec) : spec_(spec) {
  side_ = 2 * static_cast<int>(std::ceil(spec.half_size_m / spec.resolution_m));
  lowest_z_ = floored(spec.lowest_m / spec.resolution_m);
  height_ = floored(spec.highest_m / spec.resolution_m) - lowest_z_ + 1;
  words_ = (height_ + 63) / 64;
  reach_ = static_cast<int>(std::ceil(spec.inflation_m / spec.resolution_m - 1e-9));
  const auto columns = static_cast<std::size_t>(side_) * static_cast<std::size_t>(side_);
  const std::size_t cells = columns * static_cast<std::size_t>(height_);
  log_odds_.assign(cells, kUnknown);
  hits_.assign(cells, 0);
  touches_.assign(cells, 0);
  occupied_.assign(columns * static_cast<std::size_t>(words_), 0);
  inflated_.assign(occupied_.size(), 0);
  is_dirty_.assign(columns, false);
}

void RollingGrid::reset(const Vector3d& center_world) {
  std::fill(log_odds_.begin(), log_odds_.end(), kUnknown);
  std::fill(occupied_.begin(), occupied_.end(), 0);
  std::fill(inflated_.begin(), inflated_.end(), 0);
  const Cell center = cell_of(center_world);
  first_x_ = center.x() - side_ / 2;
  first_y_ = center.y() - side_ / 2;
}

void RollingGrid::move_to(const Vector3d& center_world) {
  const Cell center = cell_of(center_world);
  const int new_x = center.x() - side_ / 2, new_y = center.y() - side_ / 2;
  if (std::abs(new_x - first_x_) >= side_ || std::abs(new_y - first_y_) >= side_) {
    reset(center_world);
    return;
  }
  const int old_x = first_x_, old_y = first_y_;
  first_x_ = new_x;
  first_y_ = new_y;
  for (int x = new_x; x < new_x + side_; ++x) {
    const bool is_new_row = x < old_x || x >= old_x + side_;
    for (int y = new_y; y < new_y + side_; ++y) {
      if (is_new_row || y < old_y || y >= old_y + side_) forget_column(x, y);
    }
  }
  inflate_dirty_columns();
}

Cell RollingGrid::cell_of(const Vector3d& position_world) const {
  return {floored(position_world.x() / spec_.resolution_m),
          floored(position_world.y() / spec_.resolution_m),
          floored(position_world.z() / spec_.resolution_m)};
}

Vector3d RollingGrid::center_of(const Cell& cell) const {
  return (cell.cast<double>() + Vector3d::Constant(0.5)) * spec_.resolution_m;
}

bool RollingGrid::contains(const Cell& cell) const {
  return cell.x() >= first_x_ && cell.x() < first_x_ + side_ && cell.y() >= first_y_ &&
         cell.y() < first_y_ + side_ && cell.z() >= lowest_z_ && cell.z() < lowest_z_ + height_;
}

std::size_t RollingGrid::column_of(int x, int y) const {
  return static_cast<std::size_t>(wrapped(x, side_)) * static_cast<std::size_t>(side_) +
         static_cast<std::size_t>(wrapped(y, side_));
}

std::size_t RollingGrid::index_of(const Cell& cell) const {
  return column_of(cell.x(), cell.y()) * static_cast<std::size_t>(height_) +
         static_cast<std::size_t>(cell.z() - lowest_z_);
}

bool RollingGrid::bit(const std::vector<std::uint64_t>& bits, const Cell& cell) const {
  const auto z = static_cast<std::size_t>(cell.z() - lowest_z_);
  const std::size_t word =
      column_of(cell.x(), cell.y()) * static_cast<std::size_t>(words_) + z / 64;
  return ((bits[word] >> (z % 64)) & 1U) != 0;
}

CellState RollingGrid::state(const Cell& cell) const {
  if (!contains(cell)) return CellState::unknown;
  if (log_odds_[index_of(cell)] == kUnknown) return CellState::unknown;
  return bit(occupied_, cell) ? CellState::occupied : CellState::free;
}

bool RollingGrid::is_inflated(const Cell& cell) const {
  return contains(cell) && bit(inflated_, cell);
}

std::vector<Vector3d> RollingGrid::occupied_centers() const {
  std::vector<Vector3d> centers;
  for (int x = first_x_; x < first_x_ + side_; ++x) {
    for (int y = first_y_; y < first_y_ + side_; ++y) {
      for (int z = lowest_z_; z < lowest_z_ + height_; ++z) {
        if (bit(occupied_, {x, y, z})) centers.push_back(center_of({x, y, z}));
      }
    }
  }
  return centers;
}

void RollingGrid::forget_column(int x, int y) {
  const std::size_t column = column_of(x, y);
  const auto cells = static_cast<std::size_t>(height_);
  const auto words = static_cast<std::size_t>(words_);
  std::fill_n(&log_odds_[column * cells], cells, kUnknown);
  std::fill_n(&occupied_[column * words], words, 0);
  mark_dirty(x, y);
}

/// The inflation of this column and its neighbours is to be found anew.
void RollingGrid::mark_dirty(int x, int y) {
  const int to_x = std::min(x + reach_, first_x_ + side_ - 1);
  const int to_y = std::min(y + reach_, first_y_ + side_ - 1);
  for (int i = std::max(x - reach_, first_x_); i <= to_x; ++i) {
    for (int k = std::max(y - reach_, first_y_); k <= to_y; ++k) {
      const std::size_t column = column_of(i, k);
      if (is_dirty_[column]) continue;
      is_dirty_[column] = true;
      dirty_.emplace_back(i, k);
    }
  }
}

void RollingGrid::inflate_dirty_columns() {
  const auto words = static_cast<std::size_t>(words_);
  std::vector<std::uint64_t> flat(words), grown(words);
  for (const Eigen::Vector2i& place : dirty_) {
    std::fill(flat.begin(), flat.end(), 0);
    const int to_x = std::min(place.x() + reach_, first_x_ + side_ - 1);
    const int to_y = std::min(place.y() + reach_, first_y_ + side_ - 1);
    for (int x = std::max(place.x() - reach_, first_x_); x <= to_x; ++x) {
      for (int y = std::max(place.y() - reach_, first_y_); y <= to_y; ++y) {
        const std::uint64_t* column = &occupied_[column_of(x, y) * words];
        for (std::size_t w = 0; w < words; ++w) flat[w] |= column[w];
      }
    }
    for (int step = 0; step < reach_; ++step) {  // one cell up and down at a time
      for (std::size_t w = 0; w < words; ++w) {
        const std::uint64_t from_below = w > 0 ? flat[w - 1] >> 63U : 0;
        const std::uint64_t from_above = w + 1 < words ? flat[w + 1] << 63U : 0;
        grown[w] = flat[w] | flat[w] << 1U | flat[w] >> 1U | from_below | from_above;
      }
      flat.swap(grown);
    }
    const std::size_t column = column_of(place.x(), place.y());
    std::copy(flat.begin(), flat.end(),
              inflated_.begin() + static_cast<std::ptrdiff_t>(column * words));
    is_dirty_[column] = false;
  }
  dirty_.clear();
}

void RollingGrid::touch(const Cell& cell, bool is_hit) {
  const std::size_t index = index_of(cell);
  constexpr std::uint16_t kMost = std::numeric_limits<std::uint16_t>::max();
  if (touches_[index] == 0) touched_.push_back(static_cast<std::uint32_t>(index));
  if (touches_[index] == kMost) return;
  ++touches_[index];
  if (is_hit) ++hits_[index];
}

/// Touches the cells from the eye to the end, the end first. Rays lie close together near the eye:
/// a ray ends where others of this image have passed before often enough for the cell's vote.
void RollingGrid::cast(const RayFan& fan, const Vector3d& end_world, bool is_hit) {
  constexpr std::uint16_t kEnough = 4;
  Cell cell = cell_of(end_world);
  if (contains(cell)) touch(cell, is_hit);
  const Vector3d way = fan.eye_world - end_world;  // the walk of Amanatides and Woo (1987)
  Eigen::Vector3i step;
  Vector3d next, pace;
  for (int k = 0; k < 3; ++k) {
    step[k] = way[k] > 0.0 ? 1 : -1;
    const double border = (cell[k] + (way[k] > 0.0 ? 1 : 0)) * spec_.resolution_m;
    const bool is_flat = std::abs(way[k]) < 1e-12;
    next[k] = is_flat ? std::numeric_limits<double>::infinity() : (border - end_world[k]) / way[k];
    pace[k] =
        is_flat ? std::numeric_limits<double>::infinity() : spec_.resolution_m / std::abs(way[k]);
  }
  while (cell != fan.eye) {
    int axis = next.x() < next.y() ? 0 : 1;
    if (next.z() < next[axis]) axis = 2;
    if (next[axis] > 1.0) return;
    cell[axis] += step[axis];
    next[axis] += pace[axis];
    if (!contains(cell)) continue;
    if (touches_[index_of(cell)] >= kEnough) return;
    touch(cell, false);
  }
}

void RollingGrid::add(std::size_t index, double log_odds) {
  const double before = log_odds_[index] == kUnknown ? 0.0 : static_cast<double>(log_odds_[index]);
  log_odds_[index] = static_cast<float>(
      std::clamp(before + log_odds, spec_.lowest_log_odds, spec_.highest_log_odds));
}

void RollingGrid::integrate(const ab_depth_image& image) {
  const Eigen::Isometry3d T_world_camera = avoidbench::pose_of(image);
  const Eigen::Matrix3d R_world_camera = T_world_camera.linear();
  const RayFan fan{T_world_camera.translation(), cell_of(T_world_camera.translation())};
  for (std::int32_t v = 0; v < image.height_px; v += spec_.pixel_step) {
    const double down = (v - image.cy_px) / image.fy_px;
    const Vector3d row = R_world_camera.col(1) * down + R_world_camera.col(2);
    const float* depths = image.depth_m + static_cast<std::ptrdiff_t>(v) * image.width_px;
    for (std::int32_t u = 0; u < image.width_px; u += spec_.pixel_step) {
      const auto depth = static_cast<double>(depths[u]);
      if (std::isnan(depth)) continue;
      const Vector3d ray = R_world_camera.col(0) * ((u - image.cx_px) / image.fx_px) + row;
      const double length = ray.norm();
      const double distance = depth * length;
      if (distance < spec_.least_ray_m) continue;
      const bool is_hit = distance <= spec_.longest_ray_m;
      const double reach = is_hit ? depth : spec_.longest_ray_m / length;
      cast(fan, fan.eye_world + ray * reach, is_hit);
    }
  }
  const auto height = static_cast<std::uint32_t>(height_);
  const auto side = static_cast<std::uint32_t>(side_);
  for (const std::uint32_t index : touched_) {
    const bool is_hit = 3 * hits_[index] > touches_[index];
    add(index, is_hit ? spec_.hit : spec_.miss);
    hits_[index] = touches_[index] = 0;
    const std::uint32_t column = index / height, z = index % height;
    std::uint64_t& word = occupied_[column * static_cast<std::uint32_t>(words_) + z / 64];
    const std::uint64_t mask = std::uint64_t{1} << (z % 64);
    const bool is_occupied = static_cast<double>(log_odds_[index]) > spec_.occupied_above;
    if (is_occupied == ((word & mask) != 0)) continue;
    word ^= mask;
    const int x =
        first_x_ + wrapped(static_cast<int>(column / side) - wrapped(first_x_, side_), side_);
    const int y =
        first_y_ + wrapped(static_cast<int>(column % side) - wrapped(first_y_, side_), side_);
    mark_dirty(x, y);
  }
  touched_.clear();
  inflate_dirty_columns();
}

void RollingGrid::clear_box(const Vector3d& center_world, const Vector3d& size_m) {
  const Cell from = cell_of(center_world - 0.5 * size_m), to = cell_of(center_world + 0.5 * size_m);
  for (int x = from.x(); x <= to.x(); ++x) {
    for (int y = from.y(); y <= to.y(); ++y) {
      for (int z = from.z(); z <= to.z(); ++z) {
        const Cell cell(x, y, z);
        if (!contains(cell)) continue;
        log_odds_[index_of(cell)] = static_cast<float>(spec_.lowest_log_odds);
        const auto up = static_cast<std::size_t>(z - lowest_z_);
        occupied_[column_of(x, y) * static_cast<std::size_t>(words_) + up / 64] &=
            ~(std::uint64_t{1} << (up % 64));
        mark_dirty(x, y);
      }
    }
  }
  inflate_dirty_columns();
}

}  // namespace planning
