#include "tree.hpp"

#include <algorithm>
#include <cmath>

#include "avoidbench/portable_math.hpp"

namespace mbplanner {
namespace {

using Eigen::Vector3d;
using planning::CellState;
namespace portable = avoidbench::portable;

constexpr int kMostTries = 4000;  ///< samples a tree, so that no clutter takes for ever

int steps_in(double duration_s) {
  return std::max(1, static_cast<int>(std::lround(duration_s / kStep_s)));
}

Vector3d level_pull(double direction_rad, double size_mps2, double climb_mps2) {
  return {size_mps2 * portable::cos(direction_rad), size_mps2 * portable::sin(direction_rad),
          climb_mps2};
}

}  // namespace

int Tree::substep_steps() const { return steps_in(settings_.substep_s); }

void Tree::grow(const Task& task, planning::Random& random) {
  task_ = task;
  vertices_.clear();
  Vertex root;
  root.motion = task.root;
  vertices_.push_back(root);
  tries_left_ = kMostTries;
  add_chain();
  for (std::size_t i = 0; i < vertices_.size(); ++i) {
    const Vertex& vertex = vertices_[i];
    if (vertex.level + 1 >= settings_.levels || vertex.is_at_goal) continue;
    if (vertex.length_m >= settings_.max_traverse_m) continue;
    branch(static_cast<int>(i), random);
  }
}

void Tree::add_chain() {
  int parent = 0;
  for (const Primitive& primitive : task_.chain) {
    if (vertices_[static_cast<std::size_t>(parent)].level + 1 >= settings_.levels) return;
    if (!add(parent, primitive.pull, primitive.steps)) return;
    parent = static_cast<int>(vertices_.size()) - 1;
  }
}

/// Children of one vertex.
void Tree::branch(int parent, planning::Random& random) {
  const Vertex from = vertices_[static_cast<std::size_t>(parent)];
  const int level = from.level + 1;
  int wanted = settings_.root_samples;
  if (level > 0) wanted = level <= settings_.branch_levels ? settings_.child_samples : 1;
  int tries = settings_.max_tries * (level == 0 ? 4 : 1);
  const int steps = steps_in(settings_.primitive_s);
  int children = level == 0 ? 0 : from.children;
  for (int child = children; children < wanted && tries > 0 && tries_left_ > 0; ++child) {
    --tries;
    --tries_left_;
    const Vector3d pull = sample(from, child, random);
    if (add(parent, pull, steps)) ++children;
  }
}

/// The acceleration that a child of this number tries.
Vector3d Tree::sample(const Vertex& parent, int child, planning::Random& random) const {
  const double greatest = task_.limits.acceleration_mps2, climb = settings_.climb_mps2;
  const int level = parent.level + 1;
  constexpr double kFan_rad = 10.0 / 180.0 * portable::kPi;
  // One in five of the root's children flies at the goal: straight and 10° to each side. Random
  // ones alone leave it out now and then.
  if (level == 0 && child < settings_.root_samples / 5) {
    return steering(parent.motion, kFan_rad * (child - 1));
  }
  // A first child goes on as its parent, so that long even curves are among the paths.
  if (level > 0 && level <= settings_.branch_levels && child == 0) return parent.pull;
  // All four are drawn, whatever becomes of them: the sequence of numbers must not depend on what
  // is chosen.
  const double lot = random.uniform();
  const bool steers = lot < settings_.goal_bias;
  const double turn = random.uniform(-1.0, 1.0);
  const double part = random.uniform();
  const double rise = random.uniform(-1.0, 1.0);
  if (steers) return steering(parent.motion, turn * settings_.cone_rad);
  if (level == 0) {
    return level_pull(turn * portable::kPi, part * greatest, rise * climb);
  }
  const double direction =
      portable::atan2(parent.pull.y(), parent.pull.x()) + turn * settings_.cone_rad;
  constexpr double kRise_mps2 = 0.8;  // of a child's vertical pull from its parent's
  return level_pull(direction, part * greatest,
                    std::clamp(parent.pull.z() + kRise_mps2 * rise, -climb, climb));
}

/// The pull that turns the velocity to full speed along a direction off the goal's.
Vector3d Tree::steering(const Motion& from, double turn_rad) const {
  const Vector3d way = task_.goal - from.position;
  double direction = turn_rad;
  if (way.head<2>().norm() > 1e-6) direction += portable::atan2(way.y(), way.x());
  const Vector3d wanted = level_pull(direction, task_.limits.speed_mps, 0.0);
  // Full speed in half a second, as far as the greatest pull allows.
  Vector3d pull = (wanted - from.velocity) / 0.5;
  pull.z() = 0.0;
  const double size = pull.norm(), greatest = task_.limits.acceleration_mps2;
  if (size > greatest) pull *= greatest / size;
  // What is left of the greatest pull at full speed only keeps the direction.
  if (size < 0.5 * greatest) pull += level_pull(direction, 0.5 * greatest, 0.0);
  pull.z() = holding_height(from);
  return pull;
}

/// The vertical pull back to the goal's height.
double Tree::holding_height(const Motion& from) const {
  const double error_m = task_.goal.z() - from.position.z();
  // Back to the goal's height at half a metre a second at most: climbing is slow and costs room to
  // the sides.
  const double wanted = std::clamp(0.8 * error_m, -0.5, 0.5) - from.velocity.z();
  return std::clamp(1.5 * wanted, -settings_.climb_mps2, settings_.climb_mps2);
}

/// Rolls a primitive out and keeps what of it is in known free space, if that is enough.
bool Tree::add(int parent, const Vector3d& pull, int steps) {
  const Vertex from = vertices_[static_cast<std::size_t>(parent)];
  const int substep = substep_steps();
  const double reach_m = 0.5 * task_.space.box_m.x();
  Vertex kept = from, now = from;
  kept.steps = now.steps = 0;
  bool is_unknown = false;
  Vector3d checked = from.motion.position;
  for (int i = 1; i <= steps; ++i) {
    const Motion next = stepped(now.motion, pull, task_.limits);
    now.length_m += (next.position - now.motion.position).norm();
    now.motion = next;
    now.steps = i;
    const bool is_check = i % substep == 0 || i == steps;
    if (!is_check && (now.motion.position - checked).norm() < reach_m) continue;
    const CellState state = task_.space.at(now.motion.position);
    if (state != CellState::free) {
      is_unknown = state == CellState::unknown;
      break;
    }
    checked = now.motion.position;
    if (is_check) kept = now;
    const bool is_near =
        // Well inside the goal's circle: the vehicle follows its path with an error.
        (now.motion.position - task_.goal).head<2>().norm() < 0.8 * task_.goal_radius_m;
    if (is_near) {
      kept = now;
      kept.is_at_goal = true;
      break;
    }
  }
  const bool is_last = from.level + 2 >= settings_.levels;
  const bool is_whole = kept.steps == steps || kept.is_at_goal;
  const bool may_be_short = is_last && is_unknown && kept.steps > 0;
  if (!is_whole && !may_be_short && kept.steps < settings_.min_edge_substeps * substep) {
    return false;
  }
  if (from.level >= 1 && is_crowded(kept.motion.position)) return false;
  kept.parent = parent;
  kept.level = from.level + 1;
  kept.children = 0;
  kept.pull = pull;
  kept.time_s = from.time_s + kept.steps * kStep_s;
  vertices_.push_back(kept);
  ++vertices_[static_cast<std::size_t>(parent)].children;
  return true;
}

bool Tree::is_crowded(const Vector3d& position) const {
  const double least = settings_.vertex_separation_m * settings_.vertex_separation_m;
  return std::any_of(vertices_.begin(), vertices_.end(), [&](const Vertex& other) {
    return (other.motion.position - position).squaredNorm() < least;
  });
}

std::vector<Primitive> Tree::primitives_to(int vertex, int cut_steps) const {
  std::vector<Primitive> primitives;
  for (int i = vertex; i > 0; i = vertices_[static_cast<std::size_t>(i)].parent) {
    const Vertex& at = vertices_[static_cast<std::size_t>(i)];
    primitives.push_back({at.pull, i == vertex ? at.steps - cut_steps : at.steps});
  }
  std::reverse(primitives.begin(), primitives.end());
  return primitives;
}

std::vector<Motion> Tree::path_to(int vertex, int cut_steps) const {
  std::vector<Motion> knots;
  for (const Primitive& primitive : primitives_to(vertex, cut_steps)) {
    for (int i = 0; i < primitive.steps; ++i) {
      const Motion from = knots.empty() ? task_.root : knots.back();
      knots.push_back(stepped(from, primitive.pull, task_.limits));
    }
  }
  return knots;
}

}  // namespace mbplanner
