#include "metrics/taut_path.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/math.hpp"
#include "metrics/reference_path.hpp"

namespace avoidbench {
namespace {

using Eigen::Vector3d;
using Path = std::vector<Vector3d>;

// Steps shrink by 0.4 from about the body's radius, beyond which a straight step would leave the
// surface, to 3 mm: a corner 3 mm off changes a path's length by its square only, far below the
// 0.01 % that a round must win.
constexpr std::array<double, 6> kSteps_m = [] {
  std::array<double, 6> steps{0.3};
  for (std::size_t i = 1; i < steps.size(); ++i) steps[i] = 0.4 * steps[i - 1];
  return steps;
}();

/// What the ball can't pass, from `before` by `place` to `after`.
std::optional<Vector3d> obstruction(ClearanceGrid& grid, double radius_m, const Vector3d& before,
                                    const Vector3d& place, const Vector3d& after) {
  const auto found = grid.obstruction(before, place, radius_m);
  return found ? found : grid.obstruction(place, after, radius_m);
}

double way_m(const Vector3d& before, const Vector3d& place, const Vector3d& after) {
  return (place - before).norm() + (after - place).norm();
}

/// Moves `vertex` toward the line between its neighbours as far as both segments stay free.
Vector3d pulled(ClearanceGrid& grid, double radius_m, const Vector3d& before,
                const Vector3d& vertex, const Vector3d& after) {
  const Vector3d line = after - before;
  const double length = line.squaredNorm();
  const double along =
      length > 0.0 ? std::clamp((vertex - before).dot(line) / length, 0.0, 1.0) : 0.0;
  const Vector3d target = before + along * line;
  double kept = 0.0, refused = 1.0;
  // Seven halvings settle the place to 1/128 of the way to the chord. Later rounds start from there
  // and win the rest; more halvings would ask the scene without shortening the path.
  for (int i = 0; i < 7; ++i) {
    const double tried = 0.5 * (kept + refused);
    const Vector3d place = vertex + tried * (target - vertex);
    (obstruction(grid, radius_m, before, place, after) ? refused : kept) = tried;
  }
  return vertex + kept * (target - vertex);
}

/// `pull` without what presses against the surfaces: along one, or along the line where two meet.
Vector3d along_surfaces(const Vector3d& pull, const std::vector<Vector3d>& normals) {
  if (normals.size() == 1) return pull - std::min(0.0, pull.dot(normals[0])) * normals[0];
  const Vector3d line = normals[0].cross(normals[1]);
  return line.squaredNorm() > 1e-6 ? Vector3d(line * (pull.dot(line) / line.squaredNorm()))
                                   : Vector3d(Vector3d::Zero());
}

/// Slides `vertex` along the surfaces that it is pulled against.
Vector3d slid(ClearanceGrid& grid, double radius_m, const Vector3d& before, Vector3d vertex,
              const Vector3d& after) {
  for (const double step_m : kSteps_m) {
    // The way shortens fastest along the sum of the unit vectors to both neighbours.
    const Vector3d pull = (before - vertex).normalized() + (after - vertex).normalized();
    std::vector<Vector3d> normals;
    Vector3d direction = pull;
    // Less is left of the pull where surfaces stand square to it: the vertex is at rest.
    while (direction.norm() > 1e-3 * pull.norm()) {
      const Vector3d place = vertex + step_m * direction.normalized();
      const bool is_shorter = way_m(before, place, after) < way_m(before, vertex, after);
      // A first step that is longer is tried all the same: it may meet the surface along which the
      // way down leads.
      if (!grid.region().contains(place) || (!is_shorter && !normals.empty())) break;
      const auto blocked = obstruction(grid, radius_m, before, place, after);
      if (!blocked) {
        if (is_shorter) vertex = place;
        break;
      }
      // Two surfaces leave a line to move along, a third none.
      if (normals.size() == 2) break;
      // The surface's normal, toward the ball.
      normals.push_back((*blocked - grid.nearest_surface(*blocked)).normalized());
      direction = along_surfaces(pull, normals);
    }
  }
  return vertex;
}

/// Moves the path's end along the rim of the region to where it is nearest to the point before it.
void pull_end(ClearanceGrid& grid, double radius_m, const GoalRegion& goal, Path& path) {
  const Vector3d& before = path[path.size() - 2];
  Vector3d& end = path.back();
  const auto offer = [&](const Vector3d& place) {
    // The way there may enter the region before.
    const Vector3d entered = first_entry(goal, before, place).value_or(place);
    const bool is_shorter = (entered - before).norm() < (end - before).norm();
    if (!is_shorter || !goal.contains(entered) || !grid.region().contains(entered)) return;
    if (!grid.obstruction(before, entered, radius_m)) end = entered;
  };
  // The nearest point of all first; if the way there is blocked, the end slides on along the rim.
  offer(nearest_of(goal, before));
  for (const double step_m : kSteps_m) {
    for (const double side : {-1.0, 1.0}) {
      const Vector3d out = end - goal.center_world;
      // At most half a radian, so that a small goal is not stepped around.
      const double turn = side * std::min(0.5, step_m / goal.radius_m);
      const double c = math::cos(turn), s = math::sin(turn);
      Vector3d turned(c * out.x() - s * out.y(), s * out.x() + c * out.y(), 0.0);
      turned *= goal.radius_m / std::max(1e-9, turned.norm());
      offer({goal.center_world.x() + turned.x(), goal.center_world.y() + turned.y(), end.z()});
      // Up and down too: the region is reached at any height.
      offer(end + side * step_m * Vector3d::UnitZ());
    }
  }
}

/// Drops each vertex whose neighbours see each other.
void drop_idle_vertices(ClearanceGrid& grid, double radius_m, Path& path) {
  for (std::size_t i = 1; i + 1 < path.size();) {
    if (!grid.obstruction(path[i - 1], path[i + 1], radius_m)) {
      path.erase(path.begin() + static_cast<std::ptrdiff_t>(i));
    } else {
      ++i;
    }
  }
}

/// Adds a vertex on both sides of each bend, so that the path can lie against a round surface.
Path with_bends_split(const Path& path) {
  // Vertices that far from a bend let the path lie against a trunk's round in the next rounds.
  constexpr double kReach_m = 0.6;
  Path split{path.front()};
  for (std::size_t i = 1; i + 1 < path.size(); ++i) {
    for (const std::size_t other : {i - 1, i + 1}) {
      const Vector3d toward = path[other] - path[i];
      const double length = toward.norm();
      const Vector3d beside =
          // At most 0.4 of a segment: the new vertices of its two ends stay apart and in order.
          path[i] + toward * (std::min(kReach_m, 0.4 * length) / std::max(length, 1e-9));
      if (other > i) split.push_back(path[i]);
      split.push_back(beside);
    }
  }
  split.push_back(path.back());
  return split;
}

/// Adds a vertex beside what stands between the last one and the nearest point of the region, so
/// that the path can bend there and its end slide on.
void split_before_goal(ClearanceGrid& grid, double radius_m, const GoalRegion& goal, Path& path) {
  const Vector3d before = path[path.size() - 2], end = path.back();
  const auto blocked = grid.obstruction(before, nearest_of(goal, before), radius_m);
  if (!blocked || (end - before).squaredNorm() < 1e-6) return;
  const double along = (*blocked - before).dot(end - before) / (end - before).squaredNorm();
  // Off both ends, so that no segment has length 0.
  path.back() = before + std::clamp(along, 0.05, 0.95) * (end - before);
  path.push_back(end);
}

}  // namespace

Vector3d nearest_of(const GoalRegion& goal, const Vector3d& from) {
  const Eigen::Vector2d out = (from - goal.center_world).head<2>();
  const double distance_m = out.norm();
  // A hair inside the rim, so that rounding does not leave the point outside.
  const double kept = distance_m > goal.radius_m ? goal.radius_m * (1.0 - 1e-12) / distance_m : 1.0;
  return {goal.center_world.x() + kept * out.x(), goal.center_world.y() + kept * out.y(), from.z()};
}

std::optional<Vector3d> first_entry(const GoalRegion& goal, const Vector3d& from,
                                    const Vector3d& to) {
  if (goal.contains(from)) return from;
  const Eigen::Vector2d start = (from - goal.center_world).head<2>();
  const Eigen::Vector2d way = (to - from).head<2>();
  const double radius_m = goal.radius_m * (1.0 - 1e-12);
  // |start + s way| = radius: the lesser root s of a s² + 2 b s + c, without cancellation.
  const double a = way.squaredNorm(), b = start.dot(way);
  const double c = start.squaredNorm() - radius_m * radius_m;
  const double root = b * b - a * c;
  if (a <= 0.0 || b >= 0.0 || root < 0.0) return std::nullopt;
  const double share = c / (-b + std::sqrt(root));
  if (share > 1.0) return std::nullopt;
  return from + share * (to - from);
}

void cut_at_goal(const GoalRegion& goal, Path& path) {
  for (std::size_t i = 1; i < path.size(); ++i) {
    const auto entered = first_entry(goal, path[i - 1], path[i]);
    if (!entered) continue;
    path[i] = *entered;
    path.resize(i + 1);
  }
}

void pull_taut(ClearanceGrid& grid, double radius_m, const GoalRegion& goal, Path& path) {
  // Each further pass puts a vertex on both sides of every bend, so that the path follows round
  // surfaces: with three it is within 0.3 % of the closed form around a cylinder. The rounds only
  // bound what does not settle; a pass ends as soon as a round wins less than 0.01 %.
  constexpr int kSplits = 3, kMostRounds = 20;
  constexpr double kWorthARound = 1e-4;
  cut_at_goal(goal, path);
  for (int split = 0; split <= kSplits; ++split) {
    drop_idle_vertices(grid, radius_m, path);
    if (split > 0) path = with_bends_split(path);
    split_before_goal(grid, radius_m, goal, path);
    for (int round = 0; round < kMostRounds; ++round) {
      const double before_m = path_length_m(path);
      // Each vertex against its neighbours as they are now.
      for (std::size_t i = 1; i + 1 < path.size(); ++i) {
        path[i] = pulled(grid, radius_m, path[i - 1], path[i], path[i + 1]);
        path[i] = slid(grid, radius_m, path[i - 1], path[i], path[i + 1]);
      }
      pull_end(grid, radius_m, goal, path);
      cut_at_goal(goal, path);
      if (before_m - path_length_m(path) < kWorthARound * before_m) break;
    }
  }
  drop_idle_vertices(grid, radius_m, path);
}

}  // namespace avoidbench
