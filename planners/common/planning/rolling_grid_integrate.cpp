// How RollingGrid takes an image in. Ends of rays are binned into cells; cells before them are not
// found by walking rays but by looking: each cell of the view is projected into the image once.
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <numeric>

#include "avoidbench/planner_eigen.hpp"
#include "planning/rolling_grid.hpp"

namespace planning {
namespace {

using Eigen::Vector3d;
using Eigen::Vector3f;

constexpr float kInfinity = std::numeric_limits<float>::infinity();
constexpr float kNothing = kInfinity;                           ///< no pixel says anything
constexpr float kFarthest = std::numeric_limits<float>::max();  ///< stands for +inf
constexpr int kGrazedParts = 5;  ///< a cell is not missed where more than one ray in five grazes it
// Floats that one loop compares at once: two SSE vectors or one of AVX.
constexpr int kLanes = 8;
constexpr int kDepthSteps = 64;  ///< of the table that has a window for each depth

/// How many blocks around the one where a cell's centre lies may see part of the cell.
int blocks_around(float half_cell_blocks_m, float depth_m) {
  // Half a cell in blocks, a fifth more since a cell seen askew is wider, and half a block since
  // its centre lies anywhere in a block.
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

struct Counts {
  int near, all;
};

struct Strides {
  int count, stride;
};

/// How many of the depths in this window are not before, and how many of these not behind. Reads up
/// to kLanes beyond the last.
Counts count_row_by_row(const float* depths_m, Strides along, Strides down, float before_m,
                        float behind_m) {
  std::array<std::int32_t, kLanes> near{}, all{}, is_inside{};
  // Large windows are thinned out by a stride and counted one by one; the usual small ones in
  // lanes, where those beyond the window are masked instead of left out.
  if (along.stride != 1 || along.count > kLanes) {
    Counts counts{0, 0};
    for (int row = 0; row < down.count; ++row, depths_m += down.stride) {
      for (int i = 0; i < along.count; ++i) {
        const float depth_m = depths_m[i * along.stride];
        counts.all += depth_m >= before_m ? 1 : 0;
        counts.near += depth_m >= before_m && depth_m <= behind_m ? 1 : 0;
      }
    }
    return counts;
  }
  for (int i = 0; i < along.count; ++i) is_inside[static_cast<std::size_t>(i)] = 1;
  for (int row = 0; row < down.count; ++row, depths_m += down.stride) {
    for (std::size_t i = 0; i < kLanes; ++i) {  // as vectors
      const std::int32_t counts = (depths_m[i] >= before_m ? 1 : 0) & is_inside[i];
      all[i] += counts;
      near[i] += counts & (depths_m[i] <= behind_m ? 1 : 0);
    }
  }
  return {std::accumulate(near.begin(), near.end(), 0), std::accumulate(all.begin(), all.end(), 0)};
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
  float steps_per_m;                                  ///< of window_at_m
  std::array<const float*, kDepthSteps> window_at_m;  ///< what a cell needs at each depth
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
  // A planner may be shown anything by the conformance suite: such an image says nothing.
  const auto is_focal = [](double length_px) { return length_px > 1e-2 && length_px < 1e6; };
  const bool has_lens = is_focal(image.fx_px) && is_focal(image.fy_px) &&
                        std::abs(image.cx_px) < 1e6 && std::abs(image.cy_px) < 1e6;
  // A quaternion that is only badly normalised is taken; one far from unit length is no rotation.
  if (!has_lens || !eye.allFinite() || !(norm > 0.5 && norm < 2.0)) return false;
  if (image.width_px <= 0 || image.height_px <= 0 || image.depth_m == nullptr) return false;
  const double cell_m = spec_.resolution_m;
  view.eye_world = eye;
  view.eye_cells = eye / cell_m - Cell(first_x_, first_y_, lowest_z_).cast<double>();
  const double reach = spec_.longest_ray_m / cell_m + 1.0;
  const Eigen::Array3d size = Cell(side_, side_, height_).cast<double>();
  // From so far outside no ray reaches the grid.
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
  // A pixel's centre is at its whole number, a block's edge is too: hence the half.
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
  const auto width_px = static_cast<std::size_t>(view.width_px);
  const auto blocks = static_cast<std::size_t>(view.width) * static_cast<std::size_t>(view.height);
  nearest_m_.assign(blocks + kLanes, 0.0F);  // see count_row_by_row
  find_rays(view);
  row_m_.resize(width_px);
  std::size_t block = 0;
  for (int top = 0; top < view.height_px; top += view.step) {
    const int bottom = std::min(top + view.step, view.height_px);
    std::fill(row_m_.begin(), row_m_.end(), kNothing);
    for (int v = top; v < bottom; ++v) {
      const float* depths = image.depth_m + static_cast<std::size_t>(v) * width_px;
      float* row = row_m_.data();
      for (std::size_t u = 0; u < width_px; ++u) {
        // +inf is a ray that frees its cells, while kNothing, also +inf, is a block without any: so
        // the former becomes the greatest finite number. NaN fails the comparison and says nothing.
        const float far = std::min(depths[u], kFarthest);
        row[u] = std::min(row[u], depths[u] > 0.0F ? far : kNothing);
      }
    }
    for (int left = 0; left < view.width_px; left += view.step, ++block) {
      const int right = std::min(left + view.step, view.width_px);
      float nearest = kNothing;
      for (int u = left; u < right; ++u)
        nearest = std::min(nearest, row_m_[static_cast<std::size_t>(u)]);
      if (nearest < static_cast<float>(spec_.least_ray_m)) {
        nearest = nearest_far_enough(image, view, left, top);
      }
      nearest_m_[block] = nearest < kNothing ? nearest : 0.0F;
      if (static_cast<double>(nearest) <= spec_.longest_ray_m) {
        end_ray(image, view, left, top, nearest);
      }
    }
  }
}

/// The nearest of the block at these pixels, except those nearer than the least ray: they only
/// keep the cells that they end in from being missed by rays beside them.
float RollingGrid::nearest_far_enough(const ab_depth_image& image, const View& view, int left,
                                      int top) {
  float nearest = kNothing;
  for (int v = top; v < std::min(top + view.step, view.height_px); ++v) {
    for (int u = left; u < std::min(left + view.step, view.width_px); ++u) {
      const float depth =
          image.depth_m[static_cast<std::size_t>(v) * static_cast<std::size_t>(view.width_px) +
                        static_cast<std::size_t>(u)];
      if (!(depth > 0.0F)) continue;
      if (distance_m2(u, v, depth) < spec_.least_ray_m * spec_.least_ray_m) {
        keep_cell(end_of_ray(view, u, v, depth));
      } else {
        nearest = std::min({nearest, depth, kFarthest});
      }
    }
  }
  return nearest;
}

double RollingGrid::distance_m2(int u, int v, float depth_m) const {
  const auto depth = static_cast<double>(depth_m);
  return depth * depth *
         (rays_u_[static_cast<std::size_t>(u)].length2 +
          rays_v_[static_cast<std::size_t>(v)].length2);
}

/// Ends the ray of the first pixel of the block that has this depth.
void RollingGrid::end_ray(const ab_depth_image& image, const View& view, int left, int top,
                          float depth_m) {
  for (int v = top; v < std::min(top + view.step, view.height_px); ++v) {
    const float* depths =
        image.depth_m + static_cast<std::size_t>(v) * static_cast<std::size_t>(view.width_px);
    for (int u = left; u < std::min(left + view.step, view.width_px); ++u) {
      // The value was copied, so that equality finds the very pixel.
      if (depths[u] != depth_m) continue;
      if (distance_m2(u, v, depth_m) > spec_.longest_ray_m * spec_.longest_ray_m) return;
      add_end(end_of_ray(view, u, v, depth_m));
      return;
    }
  }
}

/// The ray of a pixel is the sum of its column's and its row's.
void RollingGrid::find_rays(const View& view) {
  const Eigen::Matrix3d cells = view.R_world_camera / spec_.resolution_m;
  rays_u_.resize(static_cast<std::size_t>(view.width_px));
  rays_v_.resize(static_cast<std::size_t>(view.height_px));
  for (int u = 0; u < view.width_px; ++u) {
    const double x = (u - view.cx_px) / view.fx_px;
    rays_u_[static_cast<std::size_t>(u)] = {cells.col(0) * x, x * x};
  }
  for (int v = 0; v < view.height_px; ++v) {
    const double y = (v - view.cy_px) / view.fy_px;
    rays_v_[static_cast<std::size_t>(v)] = {cells.col(1) * y + cells.col(2), y * y + 1.0};
  }
}

/// Where a pixel of this depth lies, in cells from the least corner of the grid.
Vector3d RollingGrid::end_of_ray(const View& view, int u, int v, float depth_m) const {
  const Vector3d way = rays_u_[static_cast<std::size_t>(u)].way_cells +
                       rays_v_[static_cast<std::size_t>(v)].way_cells;
  return view.eye_cells + static_cast<double>(depth_m) * way;
}

/// The cell of a place that is given in cells from the least corner of the grid.
std::optional<RollingGrid::End> RollingGrid::end_at(const Vector3d& place) const {
  if (!(place.x() >= 0.0 && place.y() >= 0.0 && place.z() >= 0.0)) return std::nullopt;
  const int x = static_cast<int>(place.x()), y = static_cast<int>(place.y());
  const int z = static_cast<int>(place.z());
  if (x >= side_ || y >= side_ || z >= height_) return std::nullopt;
  const std::size_t index = column_start(first_x_ + x, first_y_ + y) + static_cast<std::size_t>(z);
  return End{static_cast<std::uint32_t>(index), static_cast<std::int16_t>(x),
             static_cast<std::int16_t>(y), static_cast<std::int16_t>(z)};
}

void RollingGrid::add_end(const Vector3d& place) {
  const std::optional<End> end = end_at(place);
  if (!end) return;
  std::uint8_t& ends = ends_in_[end->index];
  if (ends == 0) {
    not_missed_[end->index / 64] |= std::uint64_t{1} << (end->index % 64);
    ends_.push_back(*end);
  }
  // Full bytes stay full: is_hit() asks about far fewer.
  if (ends < 255) ++ends;
}

void RollingGrid::keep_cell(const Vector3d& place) {
  const std::optional<End> end = end_at(place);
  if (!end) return;
  std::uint64_t& word = not_missed_[end->index / 64];
  const std::uint64_t mask = std::uint64_t{1} << (end->index % 64);
  if ((word & mask) == 0) kept_.push_back(end->index);
  word |= mask;
}

/// For some sizes of windows, the least depth in the window around each block: what is nearer has
/// nothing before or in it. Cells near the camera are larger than all windows.
void RollingGrid::find_windows(View& view) {
  const float half = std::max(view.half_u, view.half_v);
  const auto longest_m = static_cast<float>(spec_.longest_ray_m);
  const int least = blocks_around(half, longest_m);
  // Windows of the far cells, which are most, differ by one block; each is made from the one
  // before.
  std::array<int, kWindows> reach{least, least + 1, least + 2, least + 4};
  known_m_.assign(nearest_m_.begin(), nearest_m_.end() - kLanes);
  for (float& depth : known_m_) depth = depth > 0.0F ? depth : kInfinity;
  int has = 0;
  for (std::size_t k = 0; k < kWindows; ++k) {
    shrink_rows(k == 0 ? known_m_ : windows_m_[k - 1], view.width, reach[k] - has, shrunk_m_);
    shrink_columns(shrunk_m_, view.width, reach[k] - has, windows_m_[k]);
    has = reach[k];
  }
  no_window_m_.assign(known_m_.size(), 0.0F);
  view.steps_per_m = kDepthSteps / longest_m;
  for (int i = 0; i < kDepthSteps; ++i) {
    const float depth_m = static_cast<float>(i) / view.steps_per_m;
    const float* window_m = no_window_m_.data();
    for (std::size_t k = kWindows; i > 0 && k-- > 0;) {
      if (blocks_around(half, depth_m) <= reach[k]) window_m = windows_m_[k].data();
    }
    view.window_at_m[static_cast<std::size_t>(i)] = window_m;
  }
}

/// Whether of the rays around the cell more than one in `parts` ends in its depth or a little
/// before, those that end long before it left aside. So do those at a surface that goes through the
/// cell, however flat it is seen. At the image's edge, where half of the surface may be out of
/// sight, one ray is enough.
bool RollingGrid::is_grazed(const View& view, const Vector3f& in_camera, int parts) const {
  const float depth = in_camera.z();
  const float u = in_camera.x() / depth * view.fu + view.cu;
  const float v = in_camera.y() / depth * view.fv + view.cv;
  // With this stride at most eight places a side are looked at, however near the cell.
  const int reach_u = blocks_around(view.half_u, depth), stride_u = reach_u / 4 + 1;
  const int reach_v = blocks_around(view.half_v, depth), stride_v = reach_v / 4 + 1;
  // A hundredth of a cell against rounding: a surface on the far face is still in the cell. Two
  // cells before it, or a tenth of the depth, count as the same surface, so that a floor seen flat
  // is one.
  const float behind = depth + view.half_depth_m - 0.01F * view.resolution_m;
  const float before = depth - std::max(2.0F * view.resolution_m, 0.1F * depth);
  const int middle_u = static_cast<int>(u), middle_v = static_cast<int>(v);
  const int from_u = std::max(middle_u - reach_u, 0), from_v = std::max(middle_v - reach_v, 0);
  const int to_u = std::min(middle_u + reach_u, view.width - 1);
  const int to_v = std::min(middle_v + reach_v, view.height - 1);
  const int first = from_v * view.width + from_u;
  const Counts counts = count_row_by_row(
      &nearest_m_[static_cast<std::size_t>(first)], {(to_u - from_u) / stride_u + 1, stride_u},
      {(to_v - from_v) / stride_v + 1, stride_v * view.width}, before, behind);
  const bool is_cut = from_u > middle_u - reach_u || from_v > middle_v - reach_v ||
                      to_u < middle_u + reach_u || to_v < middle_v + reach_v;
  return is_cut ? counts.near > 0 : parts * counts.near > counts.all;
}

/// Whether a cell with ends is hit: few rays go on behind it, or it is part of a surface. Four rays
/// behind it are as good as more.
bool RollingGrid::is_hit(const View& view, const Vector3f& in_camera, int ends) const {
  constexpr int kEnough = 4;
  // Enough rays end here, even if all four behind were found.
  const double hits = spec_.passes_per_hit * ends;
  if (hits > kEnough) return true;
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
      const int block = row * view.width + column;
      passes += nearest_m_[static_cast<std::size_t>(block)] > behind ? 1 : 0;
    }
  }
  return hits > std::min(passes, kEnough) ||
         (spec_.keeps_grazed != 0 && is_grazed(view, in_camera, 3));
}

void RollingGrid::count_ends(const View& view) {
  const Eigen::Matrix3d R_camera_world = view.R_world_camera.transpose();
  for (const End& end : ends_) {
    const Vector3d from_eye = Vector3d(end.x + 0.5, end.y + 0.5, end.z + 0.5) - view.eye_cells;
    const Vector3f in_camera = (R_camera_world * from_eye * spec_.resolution_m).cast<float>();
    // A cell counts once an image, whatever the number of its rays: log odds then measure images,
    // which differ, not pixels, which err together.
    const bool hits = is_hit(view, in_camera, ends_in_[end.index]);
    if (!hits && spec_.keeps_grazed != 0 && is_grazed(view, in_camera, kGrazedParts)) continue;
    const bool was_occupied = ((occupied_[end.index / 64] >> (end.index % 64)) & 1U) != 0;
    const bool is_occupied = add(end.index, hits ? hit_ : miss_);
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

/// Of these cells without ends, one bit each, those that are missed: the ray through the centre
/// goes on behind the cell, and the cell is not part of a surface that other rays graze.
std::uint64_t RollingGrid::passed_cells(const View& view, const Column& column, int word,
                                        std::uint64_t cells) const {
  const Vector3f step = column.step_in_camera;
  const Vector3f lowest = column.lowest_in_camera + static_cast<float>(64 * word) * step;
  const float fu = view.fu, fv = view.fv, cu = view.cu, cv = view.cv;
  const float half_depth_m = view.half_depth_m - 0.01F * view.resolution_m;
  const float steps_per_m = view.steps_per_m;
  const int last_u = view.width - 1, last_v = view.height - 1;
  const int width = view.width;
  const float* nearest_m = nearest_m_.data();
  const float* const* window_at_m = view.window_at_m.data();
  std::uint64_t passed = 0, unclear = 0;
  for (; cells != 0; cells &= cells - 1) {  // without branches that are hard to foretell
    const int z = std::countr_zero(cells);
    const auto up = static_cast<float>(z);
    const float depth = lowest.z() + up * step.z(), inverse = 1.0F / depth;
    const float x = (lowest.x() + up * step.x()) * inverse;
    const float y = (lowest.y() + up * step.y()) * inverse;
    const int u = std::clamp(static_cast<int>(x * fu + cu), 0, last_u);
    const int v = std::clamp(static_cast<int>(y * fv + cv), 0, last_v);
    const int place = v * width + u;
    const auto block = static_cast<std::size_t>(place);
    const float behind = depth + half_depth_m;
    const int at = std::min(static_cast<int>(depth * steps_per_m), kDepthSteps - 1);
    // Most free cells have nothing before or in them over the whole window: one look into a table.
    // Only the rest are counted.
    const std::uint64_t is_clear = window_at_m[at][block] > behind ? 1 : 0;
    const std::uint64_t is_passed = nearest_m[block] > behind ? 1 : 0;
    passed |= (is_passed & is_clear) << z;
    unclear |= (is_passed & (is_clear ^ 1U)) << z;
  }
  if (spec_.keeps_grazed == 0) return passed | unclear;
  for (; unclear != 0; unclear &= unclear - 1) {
    const int z = std::countr_zero(unclear);
    if (!is_grazed(view, lowest + static_cast<float>(z) * step, kGrazedParts)) {
      passed |= std::uint64_t{1} << z;
    }
  }
  return passed;
}

/// Cells at the least log odds cannot sink further and are not looked at.
void RollingGrid::miss_column(const View& view, const Column& column) {
  bool is_changed = false;
  for (int word = column.from / 64; word <= column.to / 64; ++word) {
    const std::size_t at = column.start / 64 + static_cast<std::size_t>(word);
    const int low = std::max(column.from - 64 * word, 0);
    const int high = std::min(column.to - 64 * word, 63);
    const std::uint64_t inside = (~std::uint64_t{0} << low) & (~std::uint64_t{0} >> (63 - high));
    const std::uint64_t cells = inside & ~settled_[at] & ~not_missed_[at];
    const std::uint64_t missed = passed_cells(view, column, word, cells);
    std::uint64_t settled = 0, freed = 0;
    std::int16_t* log_odds = &log_odds_[64 * at];
    for (std::uint64_t left = missed; left != 0; left &= left - 1) {
      const std::uint64_t cell = left & (~left + 1);
      std::int16_t& here = log_odds[std::countr_zero(left)];
      const int sum = std::max(here + miss_, int{lowest_});
      here = static_cast<std::int16_t>(sum);
      settled |= sum == lowest_ ? cell : 0;
      freed |= sum > occupied_above_ ? 0 : cell;
    }
    known_[at] |= missed;
    settled_[at] |= settled;
    is_changed = is_changed || (occupied_[at] & freed) != 0;
    occupied_[at] &= ~freed;
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
  // A cell around the eye itself has no direction.
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
          // The side is upright: all of the column is inside it, or nothing.
          if (lacks > 0.0) to_m = -static_cast<double>(kInfinity);
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
    not_missed_[end.index / 64] = 0;
  }
  for (const std::uint32_t index : kept_) not_missed_[index / 64] = 0;
  ends_.clear();
  kept_.clear();
  inflate_changes();
}

}  // namespace planning
