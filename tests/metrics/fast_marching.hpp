#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <queue>
#include <vector>

#include "base/random.hpp"
#include "render/scene.hpp"
#include "trial/mission.hpp"

/// A second search for the shortest path of a ball, by other means than lib/flight/metrics: the
/// Eikonal equation on a grid (fast marching, Sethian 1996), a descent of its times, then exact
/// shortcuts and small moves of the corners. It shares with the library the scene's nearest point
/// only.
namespace avoidbench::test {

using Line = std::vector<Eigen::Vector3d>;

struct SecondSearch {
  const Scene& scene;
  Mission mission;
  double goal_radius_m = 0.8, radius_m = 0.25;
  double limit_m = 0.0;  ///< paths longer than this are of no interest
  double cell_m = 0.2;
};

inline double length_m(const Line& line) {
  double sum_m = 0.0;
  for (std::size_t i = 1; i < line.size(); ++i) sum_m += (line[i] - line[i - 1]).norm();
  return sum_m;
}

/// Whether the ball fits all along, except for a millimetre of its radius.
inline bool fits_along(const SecondSearch& s, const Eigen::Vector3d& from,
                       const Eigen::Vector3d& to) {
  constexpr double kSpare_m = 0.001, kFar_m = 3.0;
  const double way_m = (to - from).norm(), least_m = s.radius_m - kSpare_m;
  for (double done_m = 0.0;;) {
    const Eigen::Vector3d place =
        done_m >= way_m ? to : Eigen::Vector3d(from + (to - from) * (done_m / way_m));
    const double clear_m = std::min(kFar_m, s.scene.nearest(place, kFar_m).distance_m);
    if (clear_m < s.radius_m - 1e-9) return false;
    if (done_m >= way_m) return true;
    done_m += clear_m - least_m;
  }
}

inline bool is_in_goal(const SecondSearch& s, const Eigen::Vector3d& place) {
  return (place - s.mission.goal_world).head<2>().norm() <= s.goal_radius_m;
}

/// Where the segment first enters the goal's circle; `to` if it does not.
inline Eigen::Vector3d entry(const SecondSearch& s, const Eigen::Vector3d& from,
                             const Eigen::Vector3d& to) {
  if (!is_in_goal(s, to)) return to;
  double outside = 0.0, inside = 1.0;
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (outside + inside);
    (is_in_goal(s, from + middle * (to - from)) ? inside : outside) = middle;
  }
  return from + inside * (to - from);
}

/// Times of arrival on a grid over the ellipsoid in which a path of the limit's length can lie.
class FastMarching {
 public:
  explicit FastMarching(const SecondSearch& search) : s_(search) {
    const Aabb& box = s_.scene.world().bounds;
    low_ = box.min();
    for (int axis = 0; axis < 3; ++axis) {
      size_[axis] = static_cast<int>(std::floor(box.sizes()[axis] / s_.cell_m)) + 1;
    }
    const auto count = static_cast<std::size_t>(size_.cast<std::int64_t>().prod());
    time_m_.assign(count, kInfinity);
    state_.assign(count, kUnknown);
  }

  /// Marches from the start until every node of the goal's circle has its time, or `from_goal` the
  /// other way.
  void march(bool from_goal) {
    std::fill(time_m_.begin(), time_m_.end(), kInfinity);
    for (auto& state : state_) state = state == kDone ? kFree : state;
    seed(from_goal);
    while (!queue_.empty()) {
      const auto [time, node] = queue_.top();
      queue_.pop();
      if (state_[node] == kDone || time > time_m_[node]) continue;
      state_[node] = kDone;
      for (int axis = 0; axis < 3; ++axis) {
        for (const int side : {-1, 1}) {
          const auto next = beside(node, axis, side);
          if (next && state_[*next] != kDone && is_open(*next)) update(*next);
        }
      }
    }
  }

  /// From the node of least time in the goal's circle down to the start, or from the node next to
  /// the start down to the goal's circle; from start to goal.
  std::optional<Line> descent(bool from_goal) const {
    std::optional<std::size_t> node;
    for (std::size_t i = 0; i < time_m_.size(); ++i) {
      if (time_m_[i] == kInfinity) continue;
      const Eigen::Vector3d here = place(i);
      const bool is_end = from_goal ? (here - s_.mission.start_world).norm() < 2.0 * s_.cell_m
                                    : is_in_goal(s_, here);
      const double extra_m = from_goal ? (here - s_.mission.start_world).norm() : 0.0;
      if (is_end && (!node || time_m_[i] + extra_m < best_m(*node, from_goal))) node = i;
    }
    if (!node) return std::nullopt;
    Line line{place(*node)};
    while (time_m_[*node] > 0.0) {
      const auto next = steepest(*node);
      if (!next && !is_seed(*node, from_goal)) return std::nullopt;
      if (!next) break;
      node = next;
      line.push_back(place(*node));
    }
    if (from_goal) {
      line.insert(line.begin(), s_.mission.start_world);
    } else {
      line.push_back(s_.mission.start_world);
      std::reverse(line.begin(), line.end());
    }
    return line;
  }

 private:
  static constexpr double kInfinity = std::numeric_limits<double>::infinity();
  static constexpr std::uint8_t kUnknown = 0, kFree = 1, kDone = 2, kBlocked = 3;

  Eigen::Vector3i cell(std::size_t node) const {
    const auto index = static_cast<std::int64_t>(node);
    return {static_cast<int>(index % size_.x()), static_cast<int>(index / size_.x() % size_.y()),
            static_cast<int>(index / size_.x() / size_.y())};
  }
  Eigen::Vector3d place(std::size_t node) const {
    return low_ + s_.cell_m * cell(node).cast<double>();
  }
  std::optional<std::size_t> at(const Eigen::Vector3i& c) const {
    if ((c.array() < 0).any() || (c.array() >= size_.array()).any()) return std::nullopt;
    return static_cast<std::size_t>((std::int64_t{c.z()} * size_.y() + c.y()) * size_.x() + c.x());
  }
  std::optional<std::size_t> beside(std::size_t node, int axis, int side) const {
    Eigen::Vector3i c = cell(node);
    c[axis] += side;
    return at(c);
  }
  double best_m(std::size_t node, bool from_goal) const {
    return time_m_[node] + (from_goal ? (place(node) - s_.mission.start_world).norm() : 0.0);
  }

  /// Whether the ball fits at a node that matters; asked of the scene once.
  bool is_open(std::size_t node) {
    if (state_[node] == kUnknown) {
      const Eigen::Vector3d here = place(node);
      const double left_m =
          std::max(0.0, (here - s_.mission.goal_world).head<2>().norm() - s_.goal_radius_m);
      const bool matters = (here - s_.mission.start_world).norm() + left_m <= s_.limit_m;
      const bool fits = matters && s_.scene.nearest(here, s_.radius_m).distance_m >= s_.radius_m;
      state_[node] = fits ? kFree : kBlocked;
    }
    return state_[node] != kBlocked;
  }

  double from_start_m(std::size_t node) const {
    return (place(node) - s_.mission.start_world).norm();
  }
  bool is_seed(std::size_t node, bool from_goal) const {
    return from_goal ? is_in_goal(s_, place(node)) : from_start_m(node) <= 1.0;
  }
  void seed(bool from_goal) {
    for (std::size_t i = 0; i < time_m_.size(); ++i) {
      if (!is_seed(i, from_goal) || !is_open(i)) continue;
      time_m_[i] = from_goal ? 0.0 : from_start_m(i);
      queue_.push({time_m_[i], i});
    }
  }

  /// The least time by the upwind differences of first order.
  void update(std::size_t node) {
    std::array<double, 3> least{kInfinity, kInfinity, kInfinity};
    for (int axis = 0; axis < 3; ++axis) {
      for (const int side : {-1, 1}) {
        const auto next = beside(node, axis, side);
        if (next && state_[*next] == kDone) {
          auto& kept = least[static_cast<std::size_t>(axis)];
          kept = std::min(kept, time_m_[*next]);
        }
      }
    }
    std::sort(least.begin(), least.end());
    double time = least[0] + s_.cell_m;
    double sum = least[0], squares = least[0] * least[0];
    for (std::size_t n = 1; n < 3 && time > least[n]; ++n) {
      sum += least[n];
      squares += least[n] * least[n];
      const double count = static_cast<double>(n) + 1.0;
      const double root = sum * sum - count * (squares - s_.cell_m * s_.cell_m);
      if (root < 0.0) break;
      time = (sum + std::sqrt(root)) / count;
    }
    if (time < time_m_[node]) {
      time_m_[node] = time;
      queue_.push({time, node});
    }
  }

  std::optional<std::size_t> steepest(std::size_t node) const {
    std::optional<std::size_t> best;
    double slope = 0.0;
    for (int dz = -1; dz <= 1; ++dz) {
      for (int dy = -1; dy <= 1; ++dy) {
        for (int dx = -1; dx <= 1; ++dx) {
          const Eigen::Vector3i step(dx, dy, dz);
          const auto next = at(cell(node) + step);
          if (!next || step.isZero() || state_[*next] != kDone) continue;
          const double found = (time_m_[node] - time_m_[*next]) / step.cast<double>().norm();
          if (found > slope && fits_along(s_, place(node), place(*next))) {
            slope = found;
            best = next;
          }
        }
      }
    }
    return best;
  }

  struct Entry {
    double time;
    std::size_t node;
    bool operator<(const Entry& other) const { return time > other.time; }
  };

  const SecondSearch& s_;
  Eigen::Vector3d low_;
  Eigen::Vector3i size_;
  std::vector<double> time_m_;
  std::vector<std::uint8_t> state_;
  std::priority_queue<Entry> queue_;
};

/// The shortest way over the line's own points by free segments.
inline Line shortcut(const SecondSearch& s, const Line& line) {
  const std::size_t count = line.size();
  std::vector<double> cost(count, std::numeric_limits<double>::infinity());
  std::vector<std::size_t> from(count, 0);
  cost[0] = 0.0;
  for (std::size_t i = 1; i < count; ++i) {
    for (std::size_t k = 0; k < i; ++k) {
      const double found = cost[k] + (line[i] - line[k]).norm();
      if (found < cost[i] - 1e-12 && (k + 1 == i || fits_along(s, line[k], line[i]))) {
        cost[i] = found;
        from[i] = k;
      }
    }
  }
  Line kept{line.back()};
  for (std::size_t i = count - 1; i != 0; i = from[i]) kept.push_back(line[from[i]]);
  std::reverse(kept.begin(), kept.end());
  return kept;
}

/// Points at most `step_m` apart.
inline Line divided(const Line& line, double step_m) {
  Line fine{line.front()};
  for (std::size_t i = 1; i < line.size(); ++i) {
    const int parts =
        std::max(1, static_cast<int>(std::ceil((line[i] - line[i - 1]).norm() / step_m)));
    for (int k = 1; k <= parts; ++k) {
      fine.push_back(line[i - 1] + (line[i] - line[i - 1]) * (static_cast<double>(k) / parts));
    }
  }
  return fine;
}

/// Moves corners and the end at random as long as the line gets shorter and stays free.
inline Line jiggled(const SecondSearch& s, Line line, RandomStream& draws) {
  const Aabb& box = s.scene.world().bounds;
  for (int round = 0; round < 300; ++round) {
    for (std::size_t i = 1; i < line.size(); ++i) {
      const double reach_m = 0.3 * std::pow(0.5, draws.uniform(0.0, 9.0));
      const Eigen::Vector3d step(draws.normal(), draws.normal(), draws.normal());
      Eigen::Vector3d moved = line[i] + reach_m * step;
      const bool is_end = i + 1 == line.size();
      if (is_end && !is_in_goal(s, moved)) {
        const Eigen::Vector2d goal = s.mission.goal_world.head<2>();
        moved.head<2>() =
            goal + (moved.head<2>() - goal).normalized() * s.goal_radius_m * (1.0 - 1e-12);
      }
      if (is_end) moved = entry(s, line[i - 1], moved);
      const auto around = [&](const Eigen::Vector3d& middle) {
        return (middle - line[i - 1]).norm() + (is_end ? 0.0 : (line[i + 1] - middle).norm());
      };
      if (around(moved) >= around(line[i]) || !box.contains(moved)) continue;
      if (!fits_along(s, line[i - 1], moved)) continue;
      if (!is_end && !fits_along(s, moved, line[i + 1])) continue;
      line[i] = moved;
    }
  }
  return line;
}

/// A free path from the start to the goal's circle, shorter than the limit if the search finds one.
inline std::optional<Line> second_path(const SecondSearch& search) {
  std::optional<Line> best;
  FastMarching field(search);
  RandomStream draws = stream(1, "second_path");
  for (const bool from_goal : {false, true}) {
    field.march(from_goal);
    auto line = field.descent(from_goal);
    if (!line) continue;
    Line way = shortcut(search, *line);
    for (const double step_m : {1.0, 0.4}) {
      way = shortcut(search, divided(way, step_m));
      way = jiggled(search, way, draws);
    }
    for (std::size_t i = 1; i < way.size(); ++i) {  // ends where it first enters the circle
      if (!is_in_goal(search, way[i])) continue;
      way[i] = entry(search, way[i - 1], way[i]);
      way.resize(i + 1);
    }
    way = shortcut(search, way);
    if (!best || length_m(way) < length_m(*best)) best = way;
  }
  return best;
}

}  // namespace avoidbench::test
