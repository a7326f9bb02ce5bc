#pragma once

#include <vector>

#include "planning/random.hpp"
#include "primitive.hpp"
#include "settings.hpp"
#include "space.hpp"

namespace mbplanner {

/// One constant pull, held for some steps.
struct Primitive {
  Eigen::Vector3d pull = Eigen::Vector3d::Zero();
  int steps = 0;
};

/// Where a primitive ends, or is cut; its own edge comes from the parent.
struct Vertex {
  int parent = -1;  ///< the root's
  int level = -1;   ///< of its edge; the root's is -1
  int steps = 0;    ///< of its edge
  int children = 0;
  bool is_at_goal = false;
  Eigen::Vector3d pull = Eigen::Vector3d::Zero();
  Motion motion;
  double time_s = 0.0, length_m = 0.0;  ///< from the root
};

/// From where, and to where, a tree grows.
struct Task {
  Motion root;
  Eigen::Vector3d goal = Eigen::Vector3d::Zero();
  double goal_radius_m = 0.0;
  Limits limits;
  Space space;
  std::vector<Primitive> chain;  ///< the rest of the path that is flown now: one branch more
};

/// Motion primitives in known free space, level by level (Dharmadhikari et al. 2020).
class Tree {
 public:
  explicit Tree(const Settings& settings) : settings_(settings) {}

  /// Forgets the old tree.
  void grow(const Task& task, planning::Random& random);

  /// The root first, then level by level.
  const std::vector<Vertex>& vertices() const { return vertices_; }

  /// Knots after the root to this vertex, without the last `cut_steps` of its edge.
  std::vector<Motion> path_to(int vertex, int cut_steps = 0) const;

  /// The primitives of that path.
  std::vector<Primitive> primitives_to(int vertex, int cut_steps = 0) const;

  /// Steps between two checks.
  int substep_steps() const;

 private:
  bool add(int parent, const Eigen::Vector3d& pull, int steps);
  void add_chain();
  void branch(int parent, planning::Random& random);
  Eigen::Vector3d sample(const Vertex& parent, int child, planning::Random& random) const;
  Eigen::Vector3d steering(const Motion& from, double turn_rad) const;
  double holding_height(const Motion& from) const;
  bool is_crowded(const Eigen::Vector3d& position) const;

  Settings settings_;
  Task task_;
  std::vector<Vertex> vertices_;
  int tries_left_ = 0;
};

}  // namespace mbplanner
