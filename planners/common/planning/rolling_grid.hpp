#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "avoidbench/planner.h"

namespace planning {

/// An occupancy grid that goes with the vehicle, log odds a cell (Moravec and Elfes 1985). The
/// presets are EGO-Planner's, but for the weight of a hit.
struct RollingGridSpec {
  double resolution_m = 0.1;
  double half_size_m = 6.0;                 ///< along x and y, around the centre
  double lowest_m = -0.5, highest_m = 6.0;  ///< along z: the grid does not roll up and down
  double hit = 0.85, miss = -0.62;          ///< added to a cell's log odds, once an image
  double lowest_log_odds = -2.0, highest_log_odds = 2.2;
  double occupied_above = 1.39;  ///< probability 0.8: two images with a hit, from unknown
  double least_ray_m = 0.1, longest_ray_m = 5.0;
  int pixel_step = 2;  ///< every so many-th pixel of an image is taken
  double inflation_m = 0.3;
};

enum class CellState { unknown, free, occupied };

/// Cells of the world: floor(position / resolution).
using Cell = Eigen::Vector3i;

/// Depth images gathered around the vehicle. x and y roll with the centre: what comes in is
/// unknown, what goes out is forgotten. Beyond the grid everything is unknown.
class RollingGrid {
 public:
  explicit RollingGrid(const RollingGridSpec& spec);

  const RollingGridSpec& spec() const { return spec_; }

  /// All unknown, around this place.
  void reset(const Eigen::Vector3d& center_world);

  /// Moves the centre.
  void move_to(const Eigen::Vector3d& center_world);

  /// Takes an image in: cells with surfaces are hit, those before them missed; NaN says nothing,
  /// and what is farther than the longest ray frees its cells up to there. A cell counts once an
  /// image: as hit where it was hit by more than a third of the rays that touched it.
  void integrate(const ab_depth_image& image);

  /// Marks all cells of this box as free, as the vehicle's own place is.
  void clear_box(const Eigen::Vector3d& center_world, const Eigen::Vector3d& size_m);

  Cell cell_of(const Eigen::Vector3d& position_world) const;
  Eigen::Vector3d center_of(const Cell& cell) const;
  bool contains(const Cell& cell) const;

  CellState state(const Cell& cell) const;

  /// Whether an occupied cell lies within inflation_m along each axis; false beyond the grid.
  bool is_inflated(const Cell& cell) const;
  bool is_inflated(const Eigen::Vector3d& position_world) const {
    return is_inflated(cell_of(position_world));
  }

  /// Centres of all occupied cells, in order of x, y, z.
  std::vector<Eigen::Vector3d> occupied_centers() const;

 private:
  struct RayFan;

  std::size_t column_of(int x, int y) const;
  std::size_t index_of(const Cell& cell) const;
  bool bit(const std::vector<std::uint64_t>& bits, const Cell& cell) const;
  void forget_column(int x, int y);
  void touch(const Cell& cell, bool is_hit);
  void cast(const RayFan& fan, const Eigen::Vector3d& end_world, bool is_hit);
  void add(std::size_t index, double log_odds);
  void mark_dirty(int x, int y);
  void inflate_dirty_columns();

  RollingGridSpec spec_;
  int side_ = 0, height_ = 0, words_ = 0, lowest_z_ = 0, reach_ = 0;
  int first_x_ = 0, first_y_ = 0;                   ///< the least cell inside
  std::vector<float> log_odds_;                     ///< of each cell; unknown: kUnknown
  std::vector<std::uint64_t> occupied_, inflated_;  ///< a bit a cell, columns of z
  std::vector<std::uint16_t> hits_, touches_;       ///< of the image under way
  std::vector<std::uint32_t> touched_;              ///< indices of cells with touches
  std::vector<Eigen::Vector2i> dirty_;              ///< columns whose inflation may have changed
  std::vector<bool> is_dirty_;
};

}  // namespace planning
