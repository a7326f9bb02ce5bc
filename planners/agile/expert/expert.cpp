#include "expert.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "avoidbench/portable_math.hpp"

namespace agile {
namespace {

using avoidbench::RandomStream;
using Eigen::Vector3d;
using planning::Motion;
using planning::Quintic;
namespace portable = avoidbench::portable;

constexpr double kDegree = 3.14159265358979323846 / 180.0;

struct Tried {
  Motion end;
  Label label;
};

Tried tried(const ClearanceField& field, const Situation& situation, const Motion& end) {
  Tried made{end, {}};
  made.label.curve = quintic_between(situation.start, end, kHorizon_s);
  made.label.cost = trajectory_cost(field, situation, made.label.curve).total();
  return made;
}

/// Ends ahead, to the sides, higher and lower, at full speed, slower and at rest.
std::vector<Tried> first_tries(const ClearanceField& field, const Situation& situation) {
  std::vector<Tried> tries;
  const double reach = reach_m(situation);
  const Vector3d to_goal = goal_direction_world(situation);
  const Vector3d level = Vector3d(to_goal.x(), to_goal.y(), 0.0);
  const Vector3d ahead = level.norm() > 1e-3 ? Vector3d(level.normalized())
                                             : turned_to_world(situation.frame, Vector3d::UnitX());
  const auto turned = [&](double angle) {
    return Vector3d(portable::cos(angle) * ahead.x() - portable::sin(angle) * ahead.y(),
                    portable::sin(angle) * ahead.x() + portable::cos(angle) * ahead.y(), 0.0);
  };
  for (const double part : {1.0, 0.75, 0.5, 0.25}) {
    for (int i = -6; i <= 6; ++i) {
      const Vector3d way = turned(10.0 * kDegree * i);
      for (const double climb : {0.0, -0.7, 0.7}) {
        Motion end;
        end.position = situation.start.position + part * reach * way;
        end.position.z() += part * reach * to_goal.z() + climb;
        for (const double back : {0.0, 0.7}) {  // along the way, or turning back to the goal
          end.velocity =
              part * situation.desired_speed_mps * turned(10.0 * kDegree * i * (1.0 - 1.7 * back));
          tries.push_back(tried(field, situation, end));
          if (i == 0) break;
        }
      }
    }
  }
  // To rest, sooner and later.
  for (const double part : {0.15, 0.3, 0.5}) {
    Motion end;
    end.position = situation.start.position + part * kHorizon_s * situation.start.velocity;
    tries.push_back(tried(field, situation, end));
  }
  return tries;
}

double difference_m(const Quintic& a, const Quintic& b) {
  double most_m = 0.0;
  for (const double part : {0.4, 0.7, 1.0}) {
    const double time_s = part * kHorizon_s;
    most_m =
        std::max(most_m, (motion_at(a, time_s).position - motion_at(b, time_s).position).norm());
  }
  return most_m;
}

/// Changes the end at random, ever less, and keeps what is better.
Tried improved(const ClearanceField& field, const Situation& situation, Tried best,
               RandomStream& random) {
  constexpr int kRounds = 5, kDraws = 24;
  double width_m = 0.12 * reach_m(situation);
  for (int round = 0; round < kRounds; ++round, width_m *= 0.6) {
    const Motion center = best.end;
    for (int draw = 0; draw < kDraws; ++draw) {
      Motion end = center;
      const auto shift = [&](Vector3d& v, double scale) {
        for (int axis = 0; axis < 3; ++axis) {
          v[axis] += scale * width_m * (axis == 2 ? 0.5 : 1.0) * random.normal();
        }
      };
      shift(end.position, 1.0);
      shift(end.velocity, 1.0);
      shift(end.acceleration, 1.0);
      Tried next = tried(field, situation, end);
      if (next.label.cost < best.label.cost) best = next;
    }
  }
  return best;
}

}  // namespace

std::array<Label, kModes> expert_labels(const ClearanceField& field, const Situation& situation,
                                        RandomStream& random) {
  std::vector<Tried> tries = first_tries(field, situation);
  std::stable_sort(tries.begin(), tries.end(),
                   [](const Tried& a, const Tried& b) { return a.label.cost < b.label.cost; });
  const double apart_m = 0.15 * reach_m(situation);
  std::vector<Label> found;
  const auto is_new = [&](const Quintic& curve) {
    return std::all_of(found.begin(), found.end(), [&](const Label& other) {
      return difference_m(curve, other.curve) >= apart_m;
    });
  };
  std::vector<Quintic> begun;
  for (const Tried& start : tries) {
    if (found.size() == kModes || begun.size() == 6) break;
    const bool is_begun = std::any_of(begun.begin(), begun.end(), [&](const Quintic& other) {
      return difference_m(start.label.curve, other) < apart_m;
    });
    if (is_begun || !is_new(start.label.curve)) continue;
    begun.push_back(start.label.curve);
    const Tried best = improved(field, situation, start, random);
    if (is_new(best.label.curve)) found.push_back(best.label);
  }
  std::stable_sort(found.begin(), found.end(),
                   [](const Label& a, const Label& b) { return a.cost < b.cost; });
  constexpr double kMuchWorse = 0.5;
  std::array<Label, kModes> labels;
  for (std::size_t i = 0; i < labels.size(); ++i) {
    const bool is_good = i < found.size() && found[i].cost <= found[0].cost + kMuchWorse;
    labels[i] = is_good ? found[i] : found[0];
  }
  return labels;
}

}  // namespace agile
