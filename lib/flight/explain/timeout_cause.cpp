#include "explain/timeout_cause.hpp"

#include <algorithm>
#include <cmath>

#include "base/math.hpp"
#include "render/scene.hpp"
#include "trial/goals.hpp"

namespace avoidbench {
namespace {

constexpr double kHovering_mps = 0.1;
constexpr double kProgress_m = 0.5;             ///< nearer to the goal by less is none
constexpr double kBack_m = 1.0, kAway_m = 2.0;  ///< of a return

double length_m(const std::vector<Sample>& samples) {
  double sum_m = 0.0;
  for (std::size_t i = 1; i < samples.size(); ++i) {
    sum_m += (samples[i].position_world - samples[i - 1].position_world).norm();
  }
  return sum_m;
}

/// Places at least half a metre apart along the path, so that hovering counts once.
std::vector<Eigen::Vector3d> way_points(const std::vector<Sample>& samples) {
  constexpr double kApart_m = 0.5;
  std::vector<Eigen::Vector3d> points{samples.front().position_world};
  for (const Sample& sample : samples) {
    if ((sample.position_world - points.back()).norm() >= kApart_m) {
      points.push_back(sample.position_world);
    }
  }
  return points;
}

/// How often the path comes back to where it had been, after it was away from there.
double returns(const std::vector<Eigen::Vector3d>& points) {
  double count = 0.0;
  std::size_t from = 0;  // places before it were returned to already
  for (std::size_t i = 0; i < points.size(); ++i) {
    for (std::size_t j = from; j < i; ++j) {
      if ((points[i] - points[j]).norm() > kBack_m) continue;
      const bool was_away = std::any_of(
          points.begin() + static_cast<std::ptrdiff_t>(j),
          points.begin() + static_cast<std::ptrdiff_t>(i),
          [&](const Eigen::Vector3d& between) { return (between - points[j]).norm() > kAway_m; });
      if (!was_away) continue;
      count += 1.0;
      from = i;
      break;
    }
  }
  return count;
}

/// The goal that was not reached.
struct MissedGoal {
  std::size_t index = 0;  ///< of goals_of()
  double since_s = 0.0;   ///< since when it was the one to reach
};

MissedGoal missed_goal(const FailedFlight& flight) {
  const std::vector<double> times_s =
      goal_times_s(flight.spec.mission, flight.mission, flight.record);
  return {.index = times_s.size(), .since_s = times_s.empty() ? 0.0 : times_s.back()};
}

/// The most room that the goal's circle has, at the goal's height.
double goal_clearance_m(const FailedFlight& flight) {
  const Scene scene(flight.world);
  constexpr int kRings = 4, kPlaces = 16;
  const Eigen::Vector3d goal_world =
      goal_place(flight.spec.mission, flight.mission, missed_goal(flight).index, 0.0);
  double most_m = scene.nearest(goal_world, kClearanceLimit_m).distance_m;
  for (int ring = 1; ring <= kRings; ++ring) {
    const double radius_m = flight.spec.mission.goal_radius_m * ring / kRings;
    for (int i = 0; i < kPlaces; ++i) {
      const double angle = math::kTau * i / kPlaces;
      const Eigen::Vector3d place =
          goal_world + radius_m * Eigen::Vector3d(math::cos(angle), math::sin(angle), 0.0);
      most_m = std::max(most_m, scene.nearest(place, kClearanceLimit_m).distance_m);
    }
  }
  return std::min(most_m, kClearanceLimit_m);
}

void add_second_half(const FailedFlight& flight, Facts& facts) {
  const double half_s = 0.5 * flight.record.end_time_s;
  double count = 0.0, hovering = 0.0;
  for (const Sample& sample : flight.record.samples) {
    if (sample.time_s < half_s) continue;
    count += 1.0;
    hovering += sample.velocity_world.norm() < kHovering_mps ? 1.0 : 0.0;
  }
  facts.hover_share = count > 0.0 ? hovering / count : 0.0;
  double calls = 0.0, without = 0.0;
  for (const PlanCall& call : flight.record.plan_calls) {
    if (call.time_s < half_s) continue;
    calls += 1.0;
    without += call.status == AB_NO_PLAN ? 1.0 : 0.0;
  }
  facts.late_no_plan_share = calls > 0.0 ? without / calls : 0.0;
}

void add_progress(const FailedFlight& flight, Facts& facts) {
  const std::vector<Sample>& samples = flight.record.samples;
  const MissedGoal goal = missed_goal(flight);
  const auto to_goal_m = [&](const Sample& sample) {
    return distance_to_goal_m(flight.spec.mission, flight.mission, goal.index,
                              sample.position_world, sample.time_s);
  };
  const auto begin = std::find_if(samples.begin(), samples.end(), [&](const Sample& sample) {
    return sample.time_s >= goal.since_s;
  });
  const auto closest = std::min_element(
      begin, samples.end(),
      [&](const Sample& a, const Sample& b) { return to_goal_m(a) < to_goal_m(b); });
  facts.closest_m = to_goal_m(*closest);
  facts.closest_s = closest->time_s;
  const auto is_near = [&](const Sample& sample) {
    return to_goal_m(sample) <= facts.closest_m + kProgress_m;
  };
  facts.progress_s = std::find_if(begin, samples.end(), is_near)->time_s;
}

}  // namespace

CauseFound timeout_explained(const FailedFlight& flight) {
  CauseFound found;
  Facts& facts = found.facts;
  const std::vector<Sample>& samples = flight.record.samples;
  facts.flown_m = length_m(samples);
  facts.reference_length_m = flight.reference_length_m;
  facts.mean_speed_mps = facts.flown_m / flight.record.end_time_s;
  add_progress(flight, facts);
  add_second_half(flight, facts);
  facts.return_count = returns(way_points(samples));
  facts.goal_clearance_m = goal_clearance_m(flight);
  const auto& body_m = flight.spec.vehicle.body_size_m;
  found.cause = timeout_cause(facts, flight.record.end_time_s, std::max(body_m[0], body_m[1]));
  return found;
}

}  // namespace avoidbench
