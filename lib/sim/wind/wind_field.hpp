#pragma once

#include <Eigen/Core>
#include <string>
#include <string_view>
#include <vector>

namespace avoidbench {

/// A steady wind on a grid: columns at equal steps in x and y, in each the same number of layers
/// between the column's own bottom and top, which may follow the ground.
struct WindField {
  double min_x_m = 0.0, min_y_m = 0.0;
  double step_x_m = 1.0, step_y_m = 1.0;
  std::size_t count_x = 0, count_y = 0;
  std::vector<double> layers;             ///< 0: bottom, 1: top; ascending
  std::vector<double> bottom_m, top_m;    ///< of column ix + iy count_x
  std::vector<Eigen::Vector3d> wind_mps;  ///< of ix + iy count_x + iz count_x count_y

  bool is_empty() const { return wind_mps.empty(); }
};

/// Reads the format of RotorS' custom wind fields (gazebo_wind_plugin.cpp): keys with a colon, each
/// followed by its numbers, in any order:
///
///     min_x: 0  min_y: 0  n_x: 2  n_y: 2  res_x: 10  res_y: 10
///     vertical_spacing_factors: 0 1
///     bottom_z: 0 0 0 0        (n_x n_y numbers, x fastest)
///     top_z: 10 10 10 10
///     u: …  v: …  w: …         (n_x n_y n_z numbers each, x fastest, then y, then z)
///
/// # begins a comment. Throws InputError with file, line and column of what is wrong.
WindField parse_wind_field(std::string_view text, const std::string& file);

/// The field in the file. Throws InputError too where it has another SHA-256 than `digest`, if that
/// is not "".
WindField read_wind_field(const std::string& file, const std::string& digest);

/// The wind at a place: linear between layers in each of the four columns around it, then between
/// these. Outside the grid it is that of the grid's nearest place in x and y, and in the column's
/// height.
Eigen::Vector3d wind_at(const WindField& field, const Eigen::Vector3d& position_world);

}  // namespace avoidbench
