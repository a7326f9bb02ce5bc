#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <map>
#include <vector>

#include "avoidbench/planner.hpp"

namespace stopping_distance {

/// The surfaces that cameras and lidars saw during the last second or so, as points in the world,
/// one a cell of a grid.
class Surfaces {
 public:
  /// Points farther than `reach_m` from the vehicle are left out.
  Surfaces(double memory_s, double reach_m) : memory_s_(memory_s), reach_m_(reach_m) {}

  void clear() { points_.clear(); }
  void add(const ab_observation& seen);

  /// Those within this distance.
  std::vector<Eigen::Vector3d> near(const Eigen::Vector3d& place_world, double distance_m) const;

 private:
  struct Point {
    Eigen::Vector3d place_world;
    double time_s, range_m;
  };
  void add_image(const ab_depth_image& image);
  void add_cloud(const ab_cloud& cloud);
  void add_point(const Eigen::Vector3d& place_world, double time_s, double range_m);

  double memory_s_, reach_m_;
  std::map<std::uint64_t, Point> points_;             ///< by cell
  std::vector<std::pair<float, std::int32_t>> cell_;  ///< depths and pixels of one part of an image
};

/// How far a ball can fly from here along the unit vector until it touches one of the points;
/// `most_m` where it touches none before. Of what is inside the ball already, only what it would
/// come nearer to counts.
double free_way_m(const std::vector<Eigen::Vector3d>& points_world,
                  const Eigen::Vector3d& from_world, const Eigen::Vector3d& along, double radius_m,
                  double most_m);

}  // namespace stopping_distance
