#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "avoidbench/planner.h"

namespace planning {

/// An occupancy grid that moves with the vehicle, log odds per cell (Moravec and Elfes 1985). The
/// presets are EGO-Planner's, except the weight of a hit.
struct RollingGridSpec {
  double resolution_m = 0.1;
  double half_size_m = 6.0;                 ///< along x and y, around the centre
  double lowest_m = -0.5, highest_m = 6.0;  ///< along z: the grid does not roll up and down
  double hit = 0.85, miss = -0.62;          ///< added to a cell's log odds, once an image
  double lowest_log_odds = -2.0, highest_log_odds = 2.2;
  double unknown_log_odds = 0.0;  ///< from which a cell's first image counts
  double occupied_above = 1.39;   ///< probability 0.8: two images with a hit, from unknown
  double least_ray_m = 0.1;       ///< nearer surfaces are not hit, nor are their cells missed
  double longest_ray_m = 5.0;
  int pixel_step = 2;           ///< of a block of so many by so many pixels, the nearest is taken
  double passes_per_hit = 2.0;  ///< a cell is hit if fewer rays go on behind it for each end in it
  int keeps_grazed = 1;         ///< whether surfaces seen flat are hit and not missed; 0 or 1
  double inflation_m = 0.3;
};

enum class CellState { unknown, free, occupied };

/// The image without this share of its rows at the upper and at the lower edge, where stereo
/// matchers err most. Shares its pixels.
ab_depth_image without_border(const ab_depth_image& image, double share);

/// Whether these are coordinates to plan with: finite, and within 1,000 km of the origin.
inline bool is_place(const Eigen::Vector3d& place_world) {
  constexpr double kFarthest_m = 1e6;
  return place_world.allFinite() && place_world.cwiseAbs().maxCoeff() <= kFarthest_m;
}

/// Cells of the world: floor(position / resolution).
using Cell = Eigen::Vector3i;

/// Depth images and lidar sweeps gathered around the vehicle. x and y roll with the centre: what
/// comes in is unknown, what goes out is forgotten. Beyond the grid everything is unknown. A column
/// (x, y) lies where x and y modulo the side say, wherever the grid is: moving it forgets the
/// columns that go out and copies none. Between calls occupied_ holds the known cells above
/// occupied_above, settled_ those at the least log odds, and inflated_ is occupied_ grown by reach_
/// cells along each axis. All that belongs to an image (ends, kept cells, flags of columns) is
/// empty again. A column's last word may have bits above the grid; contains() comes before every
/// look.
class RollingGrid {
 public:
  explicit RollingGrid(const RollingGridSpec& spec);

  const RollingGridSpec& spec() const { return spec_; }

  /// All unknown, around this place.
  void reset(const Eigen::Vector3d& center_world);

  /// Moves the centre.
  void move_to(const Eigen::Vector3d& center_world);

  /// Takes an image in: cells with surfaces are hit, those before them missed; what is farther than
  /// the longest ray frees its cells up to there, +inf too. NaN and depths that are not positive
  /// say nothing, and an image whose pose or focal lengths are no numbers is left out. A cell
  /// counts once an image: as hit where enough of the rays that touched it ended in it (more than a
  /// third for two passes a hit), and it is not missed where a surface of which it may be part is
  /// grazed, unless the spec says so.
  void integrate(const ab_depth_image& image);

  /// The same for a sweep of a lidar: cells in which points lie are hit, those on the way there,
  /// and on the way of shots that came back with nothing, missed. Of the last cells before a point,
  /// which may be part of the surface that it grazes, only those are missed that are not nearer to
  /// occupied than unknown ones are.
  void integrate(const ab_cloud& cloud);

  /// Marks all cells of this box as free, as the vehicle's own place is.
  void clear_box(const Eigen::Vector3d& center_world, const Eigen::Vector3d& size_m);

  Cell cell_of(const Eigen::Vector3d& position_world) const;
  Eigen::Vector3d center_of(const Cell& cell) const;
  bool contains(const Cell& cell) const;

  CellState state(const Cell& cell) const;

  /// Whether the cell has been seen, be it free or occupied.
  bool is_known(const Cell& cell) const { return contains(cell) && bit(known_, cell); }

  /// Of all cells that this box touches: occupied where any is, else unknown where any is unknown
  /// or beyond the grid, else free.
  CellState box_state(const Eigen::Vector3d& center_world, const Eigen::Vector3d& size_m) const;

  /// Whether an occupied cell lies within inflation_m along each axis; false beyond the grid.
  bool is_inflated(const Cell& cell) const;
  bool is_inflated(const Eigen::Vector3d& position_world) const {
    return is_inflated(cell_of(position_world));
  }

  /// Centres of all occupied cells, in order of x, y, z.
  std::vector<Eigen::Vector3d> occupied_centers() const;

 private:
  struct View;
  struct Column;

  /// A cell in which rays of the image under way end; x, y, z from the least cell.
  struct End {
    std::uint32_t index;
    std::int16_t x, y, z;
  };

  /// One part of the rays of a column or a row of pixels, a metre deep.
  struct Ray {
    Eigen::Vector3d way_cells;
    double length2;  ///< [m²]
  };
  static constexpr std::size_t kWindows = 4;

  /// A number of x or y, counted from the least cell inside, as the ring has it.
  int ringed(int from_first, int ring_start) const {
    const int place = from_first + ring_start;
    return place < side_ ? place : place - side_;
  }
  std::size_t column_of(int x, int y) const {
    const int column = ringed(x - first_x_, ring_x_) * side_ + ringed(y - first_y_, ring_y_);
    return static_cast<std::size_t>(column);
  }
  /// Columns are whole words of 64 cells, so that one index serves cells and bits.
  std::size_t column_start(int x, int y) const {
    return column_of(x, y) * static_cast<std::size_t>(words_) * 64;
  }
  std::size_t index_of(const Cell& cell) const {
    return column_start(cell.x(), cell.y()) + static_cast<std::size_t>(cell.z() - lowest_z_);
  }
  bool bit(const std::vector<std::uint64_t>& bits, const Cell& cell) const {
    const std::size_t index = index_of(cell);
    return ((bits[index / 64] >> (index % 64)) & 1U) != 0;
  }

  void center_at(const Cell& center);
  bool forget_column(int x, int y);
  void mark_changed(int x, int y);
  void inflate_changes();
  void grow_along_z(std::uint64_t* column) const;

  bool look(const ab_depth_image& image, View& view);
  void take_nearest(const ab_depth_image& image, const View& view);
  float nearest_far_enough(const ab_depth_image& image, const View& view, int left, int top);
  double distance_m2(int u, int v, float depth_m) const;
  void end_ray(const ab_depth_image& image, const View& view, int left, int top, float depth_m);
  void find_rays(const View& view);
  Eigen::Vector3d end_of_ray(const View& view, int u, int v, float depth_m) const;
  std::optional<End> end_at(const Eigen::Vector3d& place) const;
  void add_end(const Eigen::Vector3d& place);
  void keep_cell(const Eigen::Vector3d& place);
  void find_windows(View& view);
  void count_ends(const View& view);
  void miss_cells_in_view(const View& view);
  void miss_column(const View& view, const Column& column);
  std::uint64_t passed_cells(const View& view, const Column& column, int word,
                             std::uint64_t cells) const;
  bool is_grazed(const View& view, const Eigen::Vector3f& in_camera, int parts) const;
  bool is_hit(const View& view, const Eigen::Vector3f& in_camera, int ends) const;
  bool add(std::size_t index, int change);
  void pass(const Eigen::Vector3d& from_cells, const Eigen::Vector3d& to_cells, bool has_end);
  void count_sweep();

  RollingGridSpec spec_;
  std::int16_t hit_ = 0, miss_ = 0, lowest_ = 0, highest_ = 0, occupied_above_ = 0;  ///< [1/1000]
  std::int16_t unknown_ = 0;                                                         ///< [1/1000]
  int side_ = 0, height_ = 0, words_ = 0, lowest_z_ = 0, reach_ = 0;
  int first_x_ = 0, first_y_ = 0;                           ///< the least cell inside
  int ring_x_ = 0, ring_y_ = 0;                             ///< where the ring has it
  std::vector<std::int16_t> log_odds_;                      ///< of each cell [1/1000]
  std::vector<std::uint64_t> known_, occupied_, inflated_;  ///< a bit a cell, columns of z
  std::vector<std::uint64_t> settled_;                      ///< at the least log odds

  // Columns whose occupied bits changed, those whose inflation that concerns, and those that were
  // inflated along y for it.
  enum Flag : std::uint8_t { kChanged = 1, kInReach = 2, kSwept = 4 };
  std::vector<Eigen::Vector2i> changed_, in_reach_, swept_;
  std::vector<std::uint8_t> column_flags_;
  std::vector<std::uint64_t> swept_bits_;

  // Of the image under way.
  std::vector<std::uint64_t> not_missed_;  ///< cells with ends, and kept ones
  std::vector<std::uint8_t> ends_in_;      ///< how many rays end in each cell, up to 255
  std::vector<End> ends_;
  std::vector<std::uint32_t> kept_;  ///< cells of pixels nearer than the least ray
  std::vector<float> nearest_m_;     ///< of each block of pixels; 0: says nothing
  std::array<std::vector<float>, kWindows> windows_m_;  ///< the least around each block
  std::vector<Ray> rays_u_, rays_v_;
  std::vector<float> row_m_, known_m_, shrunk_m_, no_window_m_;

  /// Cells that a shot of the sweep under way went through: columns in the order of x and y, not in
  /// that of the ring.
  std::vector<std::uint64_t> passed_;
};

/// What the grid knows of a place, as AB_PLACE_…; beyond it everything is unknown.
std::uint8_t place_of(const RollingGrid& grid, const std::array<double, 3>& place_world);

}  // namespace planning
