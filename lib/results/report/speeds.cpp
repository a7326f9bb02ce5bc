#include "report/speeds.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "base/math.hpp"
#include "statistics/bootstrap.hpp"
#include "statistics/rates.hpp"

namespace avoidbench {
namespace {

using math::kNaN;

constexpr Estimate kNone{.value = kNaN, .interval = {kNaN, kNaN}};

Estimate reached(const std::vector<SpeedStep>& curve, double share, std::int64_t trial_count) {
  if (trial_count < least_trials_for(share)) return kNone;
  return {.value = reached_speed(curve, share), .interval = reached_speed_interval(curve, share)};
}

/// The mean goal velocity, with the interval of a mean over maps.
Estimate mean_speed(const std::vector<SpeedTrial>& trials) {
  if (trials.empty()) return kNone;
  std::vector<std::pair<double, double>> maps;  // sum, count
  std::map<std::size_t, std::size_t> places;
  double sum = 0.0;
  for (const SpeedTrial& trial : trials) {
    const auto [place, is_new] = places.emplace(trial.map, maps.size());
    if (is_new) maps.emplace_back();
    maps[place->second].first += trial.speed_mps;
    maps[place->second].second += 1.0;
    sum += trial.speed_mps;
  }
  Estimate mean{.value = sum / static_cast<double>(trials.size()), .interval = {kNaN, kNaN}};
  if (maps.size() < kLeastMaps) return mean;
  mean.interval = bca_interval(
      maps.size(),
      [&](std::span<const std::size_t> drawn) {
        double drawn_sum = 0.0, count = 0.0;
        for (const std::size_t map : drawn) {
          drawn_sum += maps[map].first;
          count += maps[map].second;
        }
        return drawn_sum / count;
      },
      stream(1, "mean_goal_speed"));
  return mean;
}

/// The best by v90, where its difference to each other planner is above 0; Bonferroni corrected.
/// One that sees the world itself does not compete.
void mark_best_speed(const SweepResult& result, std::vector<PlannerSpeeds>& speeds) {
  std::vector<PlannerSpeeds*> rivals;
  for (PlannerSpeeds& one : speeds) {
    if (!result.planners[one.planner].is_privileged) rivals.push_back(&one);
  }
  PlannerSpeeds* best = nullptr;
  for (PlannerSpeeds* one : rivals) {
    if (std::isnan(one->v90.value)) continue;
    if (best == nullptr || one->v90.value > best->v90.value) best = one;
  }
  if (best == nullptr || rivals.size() < 2) return;
  const double confidence = 1.0 - kAlpha / static_cast<double>(rivals.size() - 1);
  best->is_best = std::all_of(rivals.begin(), rivals.end(), [&](const PlannerSpeeds* other) {
    return other == best ||
           v90_difference(*best, *other, result.maps.size(), confidence).interval.lower > 0.0;
  });
}

}  // namespace

PlannerSpeeds speeds_of(const std::vector<SpeedTrial>& trials, std::int64_t crash_count,
                        double flown_m, std::size_t map_count, std::uint64_t stream_index) {
  PlannerSpeeds speeds;
  speeds.trial_count = static_cast<std::int64_t>(trials.size());
  speeds.crash_count = crash_count;
  speeds.flown_km = 1e-3 * flown_m;
  const Interval crashes = poisson_interval(crash_count);
  speeds.crashes_per_km =
      flown_m > 0.0 ? Estimate{static_cast<double>(crash_count) / speeds.flown_km,
                               {crashes.lower / speeds.flown_km, crashes.upper / speeds.flown_km}}
                    : kNone;
  speeds.curve = speed_curve(trials);
  speeds.v90 = reached(speeds.curve, kReachedShare, speeds.trial_count);
  speeds.v50 = reached(speeds.curve, 0.5, speeds.trial_count);
  speeds.mean = mean_speed(trials);
  speeds.v90_draws =
      reached_speed_draws(trials, map_count, kReachedShare, kSpeedDraws, stream_index);
  return speeds;
}

std::vector<PlannerSpeeds> planner_speeds(const SweepResult& result,
                                          const std::vector<Trials>& planners) {
  const auto path_metric =
      std::find_if(result.metrics.begin(), result.metrics.end(),
                   [](const MetricRow& metric) { return metric.name == "path_length_m"; });
  const auto path_index = static_cast<std::size_t>(path_metric - result.metrics.begin());
  std::vector<PlannerSpeeds> all;
  for (std::size_t i = 0; i < planners.size(); ++i) {
    std::vector<SpeedTrial> trials;
    std::int64_t crash_count = 0;
    double flown_m = 0.0;
    for (const auto& [trial, map] : planners[i]) {
      trials.push_back({.map = map, .speed_mps = goal_velocity_mps(*trial)});
      crash_count += trial->outcome == Outcome::collided ? 1 : 0;
      const double path_m = path_index < result.metrics.size() ? trial->metrics[path_index] : kNaN;
      // A planner that fails at its start flies nothing.
      if (!std::isnan(path_m)) flown_m += path_m;
    }
    all.push_back(speeds_of(trials, crash_count, flown_m, result.maps.size()));
    all.back().planner = i;
  }
  mark_best_speed(result, all);
  return all;
}

SpeedDifference v90_difference(const PlannerSpeeds& first, const PlannerSpeeds& second,
                               std::size_t map_count, double confidence) {
  return speed_difference(first.v90.value, second.v90.value, first.v90_draws, second.v90_draws,
                          map_count, confidence);
}

std::vector<BestSetting> best_settings(const std::vector<PlannerSpeeds>& speeds,
                                       const std::vector<PlannerRow>& planners) {
  std::map<std::string, BestSetting> by_file;
  for (std::size_t i = 0; i < speeds.size(); ++i) {
    if (std::isnan(speeds[i].v90.value)) continue;
    const PlannerRow& row = planners[speeds[i].planner];
    BestSetting& setting =
        by_file.emplace(row.name + '\0' + row.file_digest, BestSetting{i, 0}).first->second;
    ++setting.setting_count;
    if (speeds[i].v90.value > speeds[setting.best].v90.value) setting.best = i;
  }
  std::vector<BestSetting> settings;
  for (const auto& [file, setting] : by_file) {
    if (setting.setting_count > 1) settings.push_back(setting);
  }
  return settings;
}

}  // namespace avoidbench
