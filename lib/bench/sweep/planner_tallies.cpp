#include "sweep/planner_tallies.hpp"

#include <cmath>
#include <nlohmann/json.hpp>

#include "base/number_text.hpp"
#include "base/words.hpp"

namespace avoidbench {
namespace {

constexpr double kStanding_mps = 0.1;

/// The places of all these metrics, or none.
std::vector<std::size_t> columns_of(std::span<const MetricRow> metrics,
                                    std::initializer_list<std::string_view> names) {
  std::vector<std::size_t> columns;
  for (const std::string_view name : names) {
    const auto place = place_in(metrics, name, &MetricRow::name);
    if (!place) return {};
    columns.push_back(*place);
  }
  return columns;
}

/// Whether the field is an axis: then its base value is not what every trial flew with.
bool is_varied(const nlohmann::json& spec, std::string_view path) {
  for (const auto& axis : spec.value("axes", nlohmann::json::array())) {
    if (axis.value("path", "") == path) return true;
  }
  return false;
}

void warn_of_standing(const std::string& label, const PlannerTally& tally,
                      std::vector<std::string>& warnings) {
  const std::string of_all = " of " + counted(tally.trials, "trial");
  if (tally.standing > 0) {
    warnings.push_back(label + " hovered until the time limit in " +
                       std::to_string(tally.standing) + of_all + " (mean speed below " +
                       shortest(kStanding_mps) +
                       " m/s): `avoidbench replay` shows what it saw, `avoidbench explain` why");
  }
  if (tally.silent > 0) {
    warnings.push_back(label + " gave no command at all in " + std::to_string(tally.silent) +
                       of_all);
  }
}

void warn_of_times(const std::string& label, const CallTimes& times, const TimeDemand& demand,
                   std::vector<std::string>& warnings) {
  const std::string late =
      // Where computing time is simulated, late calls have had their effect on the flight.
      demand.is_charged ? "" : lateness(times, demand.plan_period_s, demand.latency_s, label);
  if (!late.empty()) {
    warnings.push_back(late +
                       "; it flew as if it had answered in time. A sweep with latency {mode: "
                       "measured} accounts for the time of calls");
  }
  const std::string hidden = hidden_time(times, label);
  if (!hidden.empty()) warnings.push_back(hidden);
}

}  // namespace

CallTimes PlannerTally::call_times() const {
  return {.count = std::llround(calls),
          .late_count = std::llround(late_calls),
          .wall_s = 1e-3 * wall_ms / calls,
          .cpu_s = 1e-3 * cpu_ms / calls,
          .most_wall_s = std::nan("")};
}

PlannerTallies::PlannerTallies(std::span<const MetricRow> metrics)
    : standing_columns_(
          columns_of(metrics, {"mean_speed_mps", "plan_call_count", "no_plan_count"})),
      time_columns_(columns_of(metrics, {"plan_call_count", "deadline_miss_count",
                                         "processing_wall_time_ms", "processing_time_ms"})) {}

void PlannerTallies::add(const std::string& planner_key, Outcome outcome,
                         std::span<const double> values) {
  PlannerTally& tally = tallies_[planner_key];
  ++tally.trials;
  if (!standing_columns_.empty()) {
    const double speed_mps = values[standing_columns_[0]], calls = values[standing_columns_[1]];
    if (outcome == Outcome::timed_out && speed_mps < kStanding_mps) ++tally.standing;
    if (calls > 0.0 && values[standing_columns_[2]] == calls) ++tally.silent;
  }
  if (time_columns_.empty()) return;
  const double calls = values[time_columns_[0]], wall_ms = values[time_columns_[2]],
               cpu_ms = values[time_columns_[3]];
  // Flights without a call, and those whose times nobody measured, count for nothing.
  if (!(calls > 0.0) || std::isnan(wall_ms) || std::isnan(cpu_ms)) return;
  tally.calls += calls;
  tally.late_calls += values[time_columns_[1]];
  // Trials have means over their calls: the mean over all calls weighs them by their number.
  tally.wall_ms += calls * wall_ms;
  tally.cpu_ms += calls * cpu_ms;
}

std::vector<std::string> PlannerTallies::warnings(
    const std::vector<std::pair<std::string, std::string>>& planners,
    std::string_view sweep_spec_json) const {
  const TimeDemand demand = time_demand(sweep_spec_json);
  std::vector<std::string> standing, times;
  for (const auto& [key, label] : planners) {
    const auto found = tallies_.find(key);
    if (found == tallies_.end()) continue;
    warn_of_standing(label, found->second, standing);
    if (found->second.calls > 0.0) warn_of_times(label, found->second.call_times(), demand, times);
  }
  standing.insert(standing.end(), times.begin(), times.end());
  return standing;
}

TimeDemand time_demand(std::string_view sweep_spec_json) {
  const nlohmann::json spec = nlohmann::json::parse(sweep_spec_json, nullptr, false);
  if (!spec.is_object()) return {};
  TimeDemand demand;
  const nlohmann::json base = spec.value("base", nlohmann::json::object());
  const nlohmann::json latency = base.value("latency", nlohmann::json::object());
  const std::string mode = latency.value("mode", "");
  demand.is_charged = mode == "measured" || mode == "replay";
  // If settings differ there is no single number to hold calls against; 0 stands for that.
  const bool has_one_latency = !is_varied(spec, "latency.mode") && !is_varied(spec, "latency.ms");
  if (mode == "fixed" && has_one_latency) demand.latency_s = 1e-3 * latency.value("ms", 0.0);
  const double plan_hz = base.value("rates", nlohmann::json::object()).value("plan_hz", 0.0);
  if (plan_hz > 0.0 && !is_varied(spec, "rates.plan_hz")) demand.plan_period_s = 1.0 / plan_hz;
  return demand;
}

}  // namespace avoidbench
