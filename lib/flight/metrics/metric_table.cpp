#include "metrics/metric_table.hpp"

#include <algorithm>
#include <cmath>

#include "avoidbench/planner.h"
#include "base/math.hpp"
#include "metrics/flight_measures.hpp"
#include "trial/goals.hpp"

namespace avoidbench {
namespace {

using math::kNaN;
using In = const MetricInput&;

bool finished(In in) { return in.record.outcome == Outcome::reached_goal; }

double over(double numerator, double denominator) {
  // No value where there is nothing to divide by: means leave NaN out.
  return denominator > 0.0 ? numerator / denominator : kNaN;
}

const Eigen::Vector3d& end_position(In in) {
  return in.record.samples.empty() ? in.mission.mission.start_world
                                   : in.record.samples.back().position_world;
}

/// Where a flight stands among its mission's goals. They count where they are at the start.
struct GoalsLeft {
  double reached = 0.0, count = 0.0;
  Eigen::Vector3d before_world, next_world;  ///< the ends of the leg that was being flown
  double later_m = 0.0, all_m = 0.0;         ///< straight legs: those behind this one, all
};

/// Of a flight that did not reach the last one.
GoalsLeft goals_left(In in) {
  const Mission& mission = in.mission.mission;
  std::vector<Eigen::Vector3d> places = goals_of(mission);
  places.insert(places.begin(), mission.start_world);
  const std::size_t reached = goal_times_s(in.spec.mission, mission, in.record).size();
  GoalsLeft left{.reached = static_cast<double>(reached),
                 .count = static_cast<double>(places.size() - 1),
                 .before_world = places[reached],
                 .next_world = places[reached + 1]};
  for (std::size_t i = 1; i < places.size(); ++i) {
    const double leg_m = (places[i] - places[i - 1]).norm();
    left.all_m += leg_m;
    if (i > reached + 1) left.later_m += leg_m;
  }
  return left;
}

/// The planner's measured times, ms, in rising order.
std::vector<double> sorted_times_ms(In in, double PlanCall::*time_s) {
  std::vector<double> times;
  for (const PlanCall& call : in.record.plan_calls) times.push_back(1000.0 * call.*time_s);
  std::sort(times.begin(), times.end());
  return times;
}

double mean(const std::vector<double>& values) {
  double sum = 0.0;
  for (const double value : values) sum += value;
  return values.empty() ? kNaN : sum / static_cast<double>(values.size());
}

/// Of a sample: with n - 1.
double standard_deviation(const std::vector<double>& values) {
  if (values.size() < 2) return kNaN;
  const double centre = mean(values);
  double sum = 0.0;
  for (const double value : values) sum += (value - centre) * (value - centre);
  return std::sqrt(sum / static_cast<double>(values.size() - 1));
}

/// The value below which this share of the sorted values lies, between neighbours by proportion.
double quantile(const std::vector<double>& sorted, double share) {
  if (sorted.empty()) return kNaN;
  const double place = share * static_cast<double>(sorted.size() - 1);
  const auto below = static_cast<std::size_t>(std::floor(place));
  const std::size_t above = std::min(below + 1, sorted.size() - 1);
  return sorted[below] + (place - static_cast<double>(below)) * (sorted[above] - sorted[below]);
}

/// NaN where a real flight's calls were not logged.
double count_calls(In in, bool (*matches)(const PlanCall&, const TrialSpec&)) {
  if (in.spec.recording && in.record.plan_calls.empty()) return kNaN;
  return static_cast<double>(
      std::count_if(in.record.plan_calls.begin(), in.record.plan_calls.end(),
                    [&](const PlanCall& call) { return matches(call, in.spec); }));
}

constexpr auto kAll = Population::all;
constexpr auto kFinished = Population::finished;
constexpr auto kLess = Better::less;
constexpr auto kMore = Better::more;
constexpr auto kNeither = Better::neither;
constexpr std::string_view kPaper = "AvoidBench, arXiv 2301.07430";
constexpr std::string_view kFlightBench = "FlightBench, arXiv 2406.05687";

// name, version, unit, doc, formula, source, better, population, measured, function
constexpr MetricDef kTable[] = {
    {"finished", 1, "",
     "1 when the goal was reached in time without a collision; its mean is the success rate",
     "outcome = reached_goal", kPaper, kMore, kAll, false,
     [](In in) { return finished(in) ? 1.0 : 0.0; }},
    {"path_optimality_pct", 2, "%", "Excess of the flown path over the shortest possible one",
     "(L - d_min)/d_min * 100",
     "AvoidBench eq. (4); d_min ends at the goal region, see reference_path.hpp", kLess, kFinished,
     false,
     [](In in) {
       const double d_min = in.mission.reference_length_m;
       return over(100.0 * (flown_length_m(in.record.samples) - d_min), d_min);
     }},
    {"energy_optimality", 2, "m/s^2", "Integral of the jerk: how rough the flight was",
     "integral |jerk| dt = sum |a(i+1) - a(i)| at 50 Hz whatever the sample rate; none below it",
     "AvoidBench eq. (5), at the rate of its code", kLess, kFinished, false,
     [](In in) { return jerk_integral_mps2(in.record.samples); }},
    {"energy_optimality_per_m", 2, "1/s^2",
     "Energy optimality over the length of the shortest path",
     "integral |jerk| dt / d_min, as energy_optimality", "after AvoidBench eq. (5)", kLess,
     kFinished, false,
     [](In in) {
       return over(jerk_integral_mps2(in.record.samples), in.mission.reference_length_m);
     }},
    {"average_goal_velocity_mps", 2, "m/s", "Speed of approach to the goal along the shortest path",
     "d_min / T", "AvoidBench eq. (6), over finished flights only", kMore, kFinished, false,
     [](In in) { return over(in.mission.reference_length_m, in.record.end_time_s); }},
    {"average_goal_velocity_mps_all", 2, "m/s",
     "The same over all trials, as in the original's code: an early crash scores high", "d_min / T",
     "AvoidBench eq. (6)", kNeither, kAll, false,
     [](In in) { return over(in.mission.reference_length_m, in.record.end_time_s); }},
    {"mission_progress_pct", 1, "%", "Share of the way from start to goal; 100 when finished",
     "(1 - |a.c/|a|^2|) * 100, a = goal - start, c = goal - end; of several goals: the mean of the "
     "legs, 100 for one that is flown, 0 for one not begun",
     "AvoidBench eq. (7)", kMore, kAll, false,
     [](In in) {
       // Who enters the goal's circle is still short of its middle: the formula stays below 100.
       if (finished(in)) return 100.0;
       const GoalsLeft left = goals_left(in);
       const double of_leg_pct = progress_pct(left.before_world, left.next_world, end_position(in));
       return (100.0 * left.reached + of_leg_pct) / left.count;
     }},
    {"processing_time_ms", 1, "ms",
     "Mean CPU time of a plan call, of all threads of the planner, measured by the host",
     "mean of the calling thread's CPU time in the call plus that of the planner's other threads "
     "since the last call",
     kPaper, kLess, kAll, true,
     [](In in) { return mean(sorted_times_ms(in, &PlanCall::cpu_time_s)); }},
    {"processing_time_std_ms", 1, "ms", "Standard deviation of the plan calls' CPU time",
     "standard deviation", "", kLess, kAll, true,
     [](In in) { return standard_deviation(sorted_times_ms(in, &PlanCall::cpu_time_s)); }},
    {"processing_time_p50_ms", 1, "ms", "Median CPU time of a plan call", "50 % quantile", "",
     kLess, kAll, true,
     [](In in) { return quantile(sorted_times_ms(in, &PlanCall::cpu_time_s), 0.5); }},
    {"processing_time_p95_ms", 1, "ms", "CPU time that one plan call in twenty exceeds",
     "95 % quantile", "", kLess, kAll, true,
     [](In in) { return quantile(sorted_times_ms(in, &PlanCall::cpu_time_s), 0.95); }},
    {"processing_time_max_ms", 1, "ms", "CPU time of the slowest plan call", "maximum", "", kLess,
     kAll, true, [](In in) { return quantile(sorted_times_ms(in, &PlanCall::cpu_time_s), 1.0); }},
    {"processing_wall_time_ms", 1, "ms", "Mean wall time of a plan call", "mean wall time", "",
     kLess, kAll, true, [](In in) { return mean(sorted_times_ms(in, &PlanCall::wall_time_s)); }},
    {"relative_end_distance_ratio", 1, "",
     "Distance left to the goal over that at the start; 0 when finished",
     "|end - goal| / |goal - start|, of several goals along all that are left",
     "after AvoidBench eq. (7)", kLess, kAll, false,
     [](In in) {
       // As above: what is left to the middle is not missing.
       if (finished(in)) return 0.0;
       const GoalsLeft left = goals_left(in);
       return over((end_position(in) - left.next_world).norm() + left.later_m, left.all_m);
     }},
    {"collision_count", 1, "", "Contacts with a surface, rising edges", "count", "", kLess, kAll,
     false, [](In in) { return static_cast<double>(in.record.collisions.size()); }},
    {"collision_speed_mps", 1, "m/s", "Speed at the first contact; none without one",
     "|v| at contact", "", kLess, kAll, false,
     [](In in) {
       return in.record.collisions.empty() ? kNaN : in.record.collisions.front().speed_mps;
     }},
    {"path_length_m", 1, "m", "Length of the flown path", "sum |p(i+1) - p(i)| at the sample rate",
     "", kNeither, kAll, false, [](In in) { return flown_length_m(in.record.samples); }},
    {"flight_time_s", 1, "s", "Time from start to the end of the trial", "T", "", kNeither, kAll,
     false, [](In in) { return in.record.end_time_s; }},
    {"mean_speed_mps", 1, "m/s", "Flown length over flight time", "L / T", "", kNeither, kAll,
     false, [](In in) { return mean_speed_mps(in.record.samples); }},
    {"max_speed_mps", 1, "m/s", "Greatest speed", "max |v|", "", kNeither, kAll, false,
     [](In in) { return max_speed_mps(in.record.samples); }},
    {"min_clearance_m", 1, "m", "Least distance of the body box to a surface, at most 5 m",
     "min distance", "", kMore, kAll, false,
     [](In in) { return min_clearance_m(in.record.samples); }},
    {"mean_clearance_m", 1, "m",
     "Mean distance of the body box to the nearest surface, at most 5 m each",
     "mean distance over time", "", kMore, kAll, false,
     [](In in) { return mean_clearance_m(in.record.samples); }},
    {"mean_curvature_1pm", 1, "1/m", "Mean curvature of the flown path", "sum k(i) ds(i) / L",
     kFlightBench, kLess, kFinished, false,
     [](In in) { return mean_curvature_1pm(in.record.samples); }},
    {"acceleration_effort", 1, "m/s^3", "Squared acceleration over the flown length",
     "integral |a|^2 dt / L", kFlightBench, kLess, kFinished, false,
     [](In in) { return acceleration_effort(in.record.samples); }},
    {"jerk_effort", 2, "m/s^5", "Squared jerk over the flown length",
     "integral |j|^2 dt / L = 50 Hz * sum |a(i+1) - a(i)|^2 / L at 50 Hz; none below it",
     "FlightBench, arXiv 2406.05687; its code's stencil gives 1.25 times the true jerk, this one "
     "the true",
     kLess, kFinished, false, [](In in) { return jerk_effort(in.record.samples); }},
    {"tracking_rmse_m", 1, "m", "Distance between commanded and flown position", "root mean square",
     "", kLess, kAll, false, [](In in) { return tracking_rmse_m(in.record.samples); }},
    {"rotor_energy_j", 1, "J", "Work against the rotors' drag, which drains the battery",
     "integral of the rotors' drag torque * speed", "", kLess, kAll, false,
     [](In in) { return rotor_energy_j(in.record.samples); }},
    {"plan_call_count", 1, "", "Calls of the planner", "count", "", kNeither, kAll, false,
     [](In in) { return count_calls(in, [](const PlanCall&, const TrialSpec&) { return true; }); }},
    {"no_plan_count", 1, "", "Plan calls that gave no command", "count of AB_NO_PLAN", "", kLess,
     kAll, false,
     [](In in) {
       return count_calls(
           in, [](const PlanCall& call, const TrialSpec&) { return call.status == AB_NO_PLAN; });
     }},
    {"deadline_miss_count", 1, "", "Plan calls whose wall time was longer than the plan period",
     "count", "", kLess, kAll, true,
     [](In in) {
       const auto& calls = in.record.plan_calls;
       const bool is_timed = std::none_of(calls.begin(), calls.end(), [](const PlanCall& call) {
         return std::isnan(call.wall_time_s);  // a learner's, who steps the flight
       });
       if (!is_timed) return math::kNaN;
       return count_calls(in, [](const PlanCall& call, const TrialSpec& spec) {
         return call.wall_time_s * spec.rates.plan_hz > 1.0;
       });
     }},
    {"goals_reached_count", 1, "", "Goals of the mission that were reached", "count", "", kMore,
     kAll, false,
     [](In in) {
       const auto times_s = goal_times_s(in.spec.mission, in.mission.mission, in.record);
       return static_cast<double>(times_s.size());
     }},
    {"mover_density_1pm2", 1, "1/m^2", "Movers per square metre; none without movers",
     "count / area of the flight box", "", kNeither, kAll, false,
     [](In in) { return in.movers.density_1pm2; }},
    {"mover_speed_mps", 1, "m/s", "Mean speed of the movers in the first minute",
     "mean over movers and seconds of |v|", "", kNeither, kAll, false,
     [](In in) { return in.movers.speed_mps; }},
    {"dynamic_traversability", 1, "",
     "Share of straight flights through the map with its movers that meet nothing",
     "of 100 flights of 10 m at the speed limit, drawn in place, heading and time", "", kNeither,
     kAll, false, [](In in) { return in.movers.dynamic_traversability; }},
};

constexpr MapMetricDef kMapTable[] = {
    {"traversability", "",
     "Mean free-flight distance over the drone's diameter, from a 1 m grid and 16 headings",
     "mean(free flight) / d_drone, d_drone = sqrt(width^2 + length^2)", "AvoidBench eq. (1)",
     [](const MapRecord& map) { return map.traversability; }},
    {"traversability_normalized_ratio", "", "Traversability over that of the empty map",
     "TRAV / TRAV_max", "AvoidBench eq. (8)",
     [](const MapRecord& map) { return map.traversability_normalized_ratio; }},
    {"relative_gap_size", "",
     "Mean gap between obstacles over the drone's diameter; below 1: not traversable",
     "(r_poisson - mean obstacle width) / d_drone", "AvoidBench eq. (2), as its text has it",
     [](const MapRecord& map) { return map.relative_gap_size; }},
    {"obstacle_density_1pm2", "1/m^2", "Obstacles per square metre", "count / area", "",
     [](const MapRecord& map) { return map.obstacle_density_1pm2; }},
    {"free_volume_ratio", "", "Share of the flight space where the body's ball is free",
     "free points / points of a 1 m x 1 m x 0.5 m grid", "",
     [](const MapRecord& map) { return map.free_volume_ratio; }},
    {"obstacle_count", "", "Obstacles except ground, walls, ceiling and lamps", "count", "",
     [](const MapRecord& map) { return static_cast<double>(map.obstacle_count); }},
};

constexpr MissionMetricDef kMissionTable[] = {
    {"reference_length_m", "m", "Shortest collision-free path of the body to the goal region",
     "d_min: Lazy Theta* on exact clearances, pulled taut, to its first entry into the goal "
     "circle; "
     "of several goals the sum of such legs, each from the end of the one before",
     "AvoidBench, d_min of eq. (4) and (6)",
     [](const MissionRecord& mission) { return mission.reference_length_m; }},
    {"traversability_obstruction", "", "How narrow the free space along the reference path is",
     "4 m / (2 N) * sum(1/r) over the smaller half r of a corridor's N spheres", kFlightBench,
     [](const MissionRecord& mission) { return mission.difficulty.traversability_obstruction; }},
    {"view_occlusion", "", "How much the view along the reference path is blocked",
     "mean of sum(w * 4 m / nearest) over four rings of the field of view", kFlightBench,
     [](const MissionRecord& mission) { return mission.difficulty.view_occlusion; }},
    {"angle_over_length_1pm", "1/m", "How much the reference path turns",
     "sum(exp(2 angle / pi) - 1) / length over its bends", kFlightBench,
     [](const MissionRecord& mission) { return mission.difficulty.angle_over_length_1pm; }},
};

}  // namespace

std::span<const MissionMetricDef> mission_metric_table() { return kMissionTable; }

std::span<const MetricDef> metric_table() { return kTable; }

std::span<const MapMetricDef> map_metric_table() { return kMapTable; }

std::vector<double> compute_metrics(const MetricInput& input) {
  std::vector<double> values;
  for (const MetricDef& metric : kTable) {
    // A metric of finished trials has no value in others.
    const bool applies = metric.population == Population::all || finished(input);
    values.push_back(applies ? metric.compute(input) : kNaN);
  }
  return values;
}

}  // namespace avoidbench
