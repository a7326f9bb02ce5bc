#include "selection.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "avoidbench/portable_math.hpp"

namespace mbplanner {
namespace {

using Eigen::Vector3d;
using planning::CellState;
namespace portable = avoidbench::portable;

constexpr std::size_t kMostCandidates = 12;  ///< that are weighed in full
constexpr int kMostStops = 250;              ///< that are tried
constexpr int kWarpStride = 3;               ///< knots between the points that are compared

double pull_of(const Limits& limits) { return limits.acceleration_mps2; }

/// With what a stop may ask for at its peak.
Limits greatest(const Limits& limits, const Settings& settings) {
  return {limits.speed_mps, settings.greatest_acceleration_mps2, limits.jerk_mps3};
}

/// A constant pull at this angle off the velocity for a second, then a stop.
std::vector<Motion> evasive_arc(const Motion& from, double turn_rad, const Limits& limits,
                                const Settings& settings) {
  constexpr int kArcSteps = 20;
  const double heading = portable::atan2(from.velocity.y(), from.velocity.x()) + turn_rad;
  const Vector3d pull(pull_of(limits) * portable::cos(heading),
                      pull_of(limits) * portable::sin(heading), 0.0);
  std::vector<Motion> knots = rolled_out(from, pull, limits, kArcSteps);
  // A pull against the velocity would in the end fly back: the arc ends where it is slowest.
  const auto slowest =
      std::min_element(knots.begin(), knots.end(), [](const auto& a, const auto& b) {
        return a.velocity.squaredNorm() < b.velocity.squaredNorm();
      });
  knots.erase(slowest + 1, knots.end());
  const std::vector<Motion> stop =
      stop_from(knots.back(), settings.braking_mps2, greatest(limits, settings));
  knots.insert(knots.end(), stop.begin(), stop.end());
  return knots;
}

/// Angles off the velocity: from 135 degrees on in steps of 22.5, the authors' figures.
double arc_turn_rad(int arc) { return (135.0 + 22.5 * arc) / 180.0 * portable::kPi; }

/// How many knots come before the first that touches a known obstacle.
std::size_t free_knots(const std::vector<Motion>& knots, const Space& space) {
  for (std::size_t i = 0; i < knots.size(); ++i) {
    if (space.at(knots[i].position) == CellState::occupied) return i;
  }
  return knots.size();
}

/// Of a vertex: a bound on the gain of the paths that end on its edge.
struct Prospect {
  int vertex = 0;
  double gain_m = 0.0;
};

/// One choice run: what is looked at again and again.
struct Chooser {
  const Tree* tree;
  const Task* task;
  const Potential* potential;
  const Settings* settings;
  const std::vector<Motion>* flown;
  double here_m = 0.0;

  double cost_m(double time_s) const {
    return settings->time_weight * task->limits.speed_mps * time_s;
  }

  std::vector<Prospect> prospects() const {
    std::vector<Prospect> found;
    const std::vector<Vertex>& vertices = tree->vertices();
    for (std::size_t i = 1; i < vertices.size(); ++i) {
      const Vertex& vertex = vertices[i];
      const Vector3d& v = vertex.motion.velocity;
      const Vector3d stop = vertex.motion.position + v * (0.5 * v.norm() / settings->braking_mps2);
      double left_m = std::min(potential->at(vertex.motion.position), potential->at(stop));
      if (vertex.is_at_goal) left_m = 0.0;
      found.push_back({static_cast<int>(i), here_m - left_m - cost_m(vertex.time_s)});
    }
    std::stable_sort(found.begin(), found.end(),
                     [](const Prospect& a, const Prospect& b) { return a.gain_m > b.gain_m; });
    return found;
  }

  /// Fills in the gain.
  void weigh(Choice& choice, bool is_at_goal) const {
    const Vector3d& end = choice.path.back().position;
    const Vector3d& stop = choice.safe_path.back().position;
    double left_m = std::min(potential->at(end), potential->at(stop));
    if (is_at_goal) left_m = 0.0;
    choice.progress_m = here_m - left_m;
    choice.clearance = clearance_of(choice.path, task->space);
    choice.gain_m = choice.progress_m - cost_m(static_cast<double>(choice.path.size()) * kStep_s) +
                    settings->clearance_weight_m * choice.clearance;
    // Two seconds of knots, half a second at least: only near paths can be told from the present
    // one by their distance.
    const std::size_t common = std::min<std::size_t>({flown->size(), choice.path.size(), 40});
    if (common < 10) return;
    double apart_m = 0.0;
    for (std::size_t i = 0; i < common; ++i) {
      apart_m += ((*flown)[i].position - choice.path[i].position).norm();
    }
    choice.gain_m -= settings->deviation_weight * apart_m / static_cast<double>(common);
  }

  /// The longest part of this vertex's edge from whose end it can stop.
  std::optional<Choice> safe_end(int vertex, int& stops_left) const {
    const Vertex& end = tree->vertices()[static_cast<std::size_t>(vertex)];
    const std::vector<Motion> path = tree->path_to(vertex);
    const int substep = tree->substep_steps();
    for (int cut = 0; cut < end.steps && stops_left > 0; cut += substep) {
      const auto size = path.size() - static_cast<std::size_t>(cut);
      --stops_left;
      auto safe = safe_path(path[size - 1], task->space, task->limits, *settings);
      if (!safe) continue;
      Choice choice;
      choice.path.assign(path.begin(), path.begin() + static_cast<std::ptrdiff_t>(size));
      choice.safe_path = std::move(*safe);
      choice.primitives = tree->primitives_to(vertex, cut);
      weigh(choice, end.is_at_goal && cut == 0);
      return choice;
    }
    return std::nullopt;
  }

  /// A quintic to rest at the goal itself.
  std::optional<Choice> straight_to_goal() const {
    const double way_m = (task->goal - task->root.position).norm();
    if (way_m > settings->max_traverse_m) return std::nullopt;
    Choice choice;
    choice.path = stop_at(task->root, task->goal, task->limits);
    if (choice.path.empty() || !are_free(choice.path, task->space)) return std::nullopt;
    choice.safe_path = {choice.path.back()};
    weigh(choice, true);
    return choice;
  }
};

/// Of the choices that are about the same way as the best one, the one with the most room.
std::size_t best_of(const std::vector<Choice>& choices, double similarity_m) {
  std::size_t best = 0;
  for (std::size_t i = 1; i < choices.size(); ++i) {
    if (choices[i].gain_m > choices[best].gain_m) best = i;
  }
  std::size_t roomiest = best;
  for (std::size_t i = 0; i < choices.size(); ++i) {
    if (choices[i].clearance <= choices[roomiest].clearance + 1e-3) continue;
    // Room may cost a little gain, in metres as the similarity, but not more.
    if (choices[i].gain_m < choices[best].gain_m - 2.0 * similarity_m) continue;
    if (dissimilarity_m(choices[i].path, choices[best].path) <= similarity_m) roomiest = i;
  }
  return roomiest;
}

}  // namespace

double Potential::at(const Vector3d& position) const {
  // Half as much again for height: it is to be won on the way, not at the end.
  constexpr double kHeightWeight = 0.5;
  double left_m = (goal - position).norm() + kHeightWeight * std::abs(goal.z() - position.z());
  for (const Trap& trap : traps) {
    const double away = (trap.place - position).head<2>().norm() / trap.radius_m;
    if (away < 1.0) left_m += trap.weight_m * (1.0 - away);
  }
  return left_m;
}

bool are_free(const std::vector<Motion>& knots, const Space& space) {
  const double reach_m = 0.5 * space.box_m.x();
  Vector3d checked = Vector3d::Constant(std::numeric_limits<double>::infinity());
  for (std::size_t i = 0; i < knots.size(); ++i) {
    const Vector3d& position = knots[i].position;
    const std::size_t next = std::min(i + 1, knots.size() - 1);
    const bool is_last = i + 1 == knots.size();
    if (!is_last && (knots[next].position - checked).norm() < reach_m) continue;
    if (!space.is_free(position)) return false;
    checked = position;
  }
  return true;
}

std::optional<std::vector<Motion>> safe_path(const Motion& from, const Space& space,
                                             const Limits& limits, const Settings& settings) {
  std::vector<Motion> brake = stop_from(from, settings.braking_mps2, greatest(limits, settings));
  if (are_free(brake, space)) return brake;
  // At rest an arc has no direction to turn from.
  if (from.velocity.head<2>().norm() < 0.1) return std::nullopt;
  for (int arc = 0; arc < settings.evasive_arcs; ++arc) {
    std::vector<Motion> knots = evasive_arc(from, arc_turn_rad(arc), limits, settings);
    if (are_free(knots, space)) return knots;
  }
  return std::nullopt;
}

std::vector<Motion> least_bad_stop(const Motion& from, const std::vector<Motion>& present,
                                   const Space& space, const Space& body, const Limits& limits,
                                   const Settings& settings) {
  Settings hard = settings;
  // A tenth is left for the controller to correct with.
  hard.braking_mps2 = 0.9 * settings.greatest_acceleration_mps2;
  Limits sharp = limits;
  sharp.acceleration_mps2 = hard.braking_mps2;
  std::vector<std::vector<Motion>> ways;
  ways.push_back(stop_from(from, hard.braking_mps2, greatest(limits, settings)));
  if (from.velocity.head<2>().norm() >= 0.1) {
    for (int arc = 0; arc < settings.evasive_arcs; ++arc) {
      ways.push_back(evasive_arc(from, arc_turn_rad(arc), sharp, hard));
    }
  }
  if (!present.empty()) ways.push_back(present);
  std::size_t best = 0, longest = 0;
  for (std::size_t i = 0; i < ways.size(); ++i) {
    if (are_free(ways[i], space)) return ways[i];
    std::size_t clear = free_knots(ways[i], body);
    if (clear == ways[i].size()) clear = 1000;  // all the same how long, if nothing is known there
    if (clear > longest) {
      best = i;
      longest = clear;
    }
  }
  return ways[best];
}

double clearance_of(const std::vector<Motion>& path, const Space& space) {
  constexpr int kStride = 4, kRings = 2;
  constexpr double kRing_m = 0.4;  // that each ring adds to all sides; half of it up and down
  double sum = 0.0;
  int count = 0;
  for (std::size_t i = 0; i < path.size(); i += kStride) {
    double room = 0.0;
    for (int ring = 1; ring <= kRings; ++ring) {
      const Vector3d box = space.box_m + 2.0 * kRing_m * ring * Vector3d(1.0, 1.0, 0.5);
      if (space.grid->box_state(path[i].position, box) == CellState::occupied) break;
      room += 1.0 / kRings;
    }
    sum += room;
    ++count;
  }
  return count > 0 ? sum / count : 0.0;
}

double dissimilarity_m(const std::vector<Motion>& a, const std::vector<Motion>& b) {
  std::vector<double> row, next;
  int rows = 0;
  for (std::size_t i = 0; i < a.size(); i += kWarpStride, ++rows) {
    next.clear();
    for (std::size_t k = 0; k < b.size(); k += kWarpStride) {
      const std::size_t at = k / kWarpStride;
      const double apart_m = (a[i].position - b[k].position).norm();
      double least = std::numeric_limits<double>::infinity();
      if (at > 0) least = std::min(least, next[at - 1]);
      if (i > 0) least = std::min(least, row[at]);
      if (i > 0 && at > 0) least = std::min(least, row[at - 1]);
      if (i == 0 && at == 0) least = 0.0;
      next.push_back(apart_m + least);
    }
    row.swap(next);
  }
  const auto longer = std::max(static_cast<std::size_t>(rows), row.size());
  return row.empty() ? std::numeric_limits<double>::infinity()
                     : row.back() / static_cast<double>(longer);
}

std::optional<Choice> choose(const Tree& tree, const Task& task, const Potential& potential,
                             const Settings& settings, const std::vector<Motion>& flown,
                             double least_progress_m) {
  const double here_m = potential.at(task.root.position);
  const Chooser chooser{&tree, &task, &potential, &settings, &flown, here_m};
  std::vector<Choice> choices;
  if (auto straight = chooser.straight_to_goal()) choices.push_back(std::move(*straight));
  double best_m = choices.empty() ? -std::numeric_limits<double>::infinity() : choices[0].gain_m;
  int stops_left = kMostStops;
  for (const Prospect& prospect : chooser.prospects()) {
    if (choices.size() >= kMostCandidates || stops_left <= 0) break;
    // Prospects come best first: when the rest can't win with all the room there is, it is not
    // looked at.
    const double most_m = prospect.gain_m + settings.clearance_weight_m;
    if (most_m < best_m) break;
    auto choice = chooser.safe_end(prospect.vertex, stops_left);
    if (!choice || choice->progress_m < least_progress_m) continue;
    best_m = std::max(best_m, choice->gain_m);
    choices.push_back(std::move(*choice));
  }
  if (choices.empty()) return std::nullopt;
  return choices[best_of(choices, settings.similarity_m)];
}

}  // namespace mbplanner
