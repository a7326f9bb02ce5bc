#include "sweep/computing_times.hpp"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

namespace avoidbench {
namespace {

/// Calls, those longer than the plan period, mean wall and mean CPU time.
constexpr std::string_view kTimeMetrics[] = {"plan_call_count", "deadline_miss_count",
                                             "processing_wall_time_ms", "processing_time_ms"};

/// Whether the field is an axis: then its base value is not what every trial flew with.
bool is_varied(const nlohmann::json& spec, std::string_view path) {
  for (const auto& axis : spec.value("axes", nlohmann::json::array())) {
    if (axis.value("path", "") == path) return true;
  }
  return false;
}

}  // namespace

ComputingTimes::ComputingTimes(std::span<const MetricRow> metrics) {
  // All of them or none.
  for (const std::string_view name : kTimeMetrics) {
    const auto found = std::find_if(metrics.begin(), metrics.end(),
                                    [&](const MetricRow& metric) { return metric.name == name; });
    if (found == metrics.end()) {
      columns_.clear();
      return;
    }
    columns_.push_back(static_cast<std::size_t>(found - metrics.begin()));
  }
}

void ComputingTimes::add(const std::string& planner_key, std::span<const double> values) {
  if (columns_.empty()) return;
  const double count = values[columns_[0]], wall_ms = values[columns_[2]],
               cpu_ms = values[columns_[3]];
  // Flights without a call, and those whose times nobody measured, count for nothing.
  if (!(count > 0.0) || std::isnan(wall_ms) || std::isnan(cpu_ms)) return;
  Sums& sums = sums_[planner_key];
  sums.count += count;
  sums.late_count += values[columns_[1]];
  // Trials have means over their calls: the mean over all calls weighs them by their number.
  sums.wall_ms += count * wall_ms;
  sums.cpu_ms += count * cpu_ms;
}

std::map<std::string, CallTimes> ComputingTimes::by_planner() const {
  std::map<std::string, CallTimes> times;
  for (const auto& [key, sums] : sums_) {
    times[key] = {.count = std::llround(sums.count),
                  .late_count = std::llround(sums.late_count),
                  .wall_s = 1e-3 * sums.wall_ms / sums.count,
                  .cpu_s = 1e-3 * sums.cpu_ms / sums.count,
                  .most_wall_s = std::nan("")};
  }
  return times;
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

std::vector<std::string> computing_time_warnings(const std::string& label, const CallTimes& times,
                                                 const TimeDemand& demand) {
  std::vector<std::string> warnings;
  const std::string late =
      // Where computing time is simulated, late calls have had their effect on the flight.
      demand.is_charged ? "" : lateness(times, demand.plan_period_s, demand.latency_s, label);
  if (!late.empty()) {
    warnings.push_back(late +
                       "; it flew as if it had answered in time. A sweep with latency {mode: "
                       "measured} charges what calls take");
  }
  const std::string hidden = hidden_time(times, label);
  if (!hidden.empty()) warnings.push_back(hidden);
  return warnings;
}

}  // namespace avoidbench
