#include "metrics/legs.hpp"

#include <algorithm>

#include "metrics/flight_measures.hpp"
#include "trial/goals.hpp"

namespace avoidbench {

std::vector<FlownLeg> flown_legs(const TrialSpec& spec, const MissionRecord& mission,
                                 const TrialRecord& record) {
  const std::vector<Eigen::Vector3d> goals = goals_of(mission.mission);
  const std::vector<double> reached_s = goal_times_s(spec.mission, mission.mission, record);
  std::vector<FlownLeg> legs;
  const std::vector<Sample>& samples = record.samples;
  auto begin = samples.begin();
  for (std::size_t i = 0; i < std::min(reached_s.size() + 1, goals.size()); ++i) {
    const bool is_reached = i < reached_s.size();
    const double begin_s = i == 0 ? 0.0 : reached_s[i - 1];
    const double end_s = is_reached ? reached_s[i] : record.end_time_s;
    // Each goal that is reached has a sample at that moment, which ends one leg and begins another.
    const auto end = std::find_if(begin, samples.end(),
                                  [&](const Sample& sample) { return sample.time_s > end_s; });
    legs.push_back({.index = static_cast<std::int64_t>(i),
                    .goal_world = goals[i],
                    .is_reached = is_reached,
                    .begin_s = begin_s,
                    .end_s = end_s,
                    .path_length_m = flown_length_m({begin, end}),
                    .reference_length_m =
                        goals.size() == 1 ? mission.reference_length_m : mission.leg_lengths_m[i]});
    if (end != begin) begin = end - 1;
  }
  return legs;
}

}  // namespace avoidbench
