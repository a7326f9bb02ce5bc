#include <bit>
#include <cmath>
#include <set>

#include "base/input_error.hpp"
#include "base/number_text.hpp"
#include "base/words.hpp"
#include "compare/compare.hpp"
#include "store/record_format.hpp"

namespace avoidbench {
namespace {

/// A metric and its place among those of either table.
struct ComparedColumn {
  std::string name;
  std::size_t base, now;
};

/// 0 and −0 differ here, as the bits do; NaN stands for "no value" and has many bit patterns.
bool same_bits(double a, double b) {
  return (std::isnan(a) && std::isnan(b)) ||
         std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b);
}

std::string value_text(double value) { return std::isnan(value) ? "none" : shortest(value); }

/// The deterministic metrics of both tables; a warning for each that one of them lacks.
std::vector<ComparedColumn> columns_of(const TrialTable& base, const TrialTable& now,
                                       std::vector<std::string>& warnings) {
  std::vector<ComparedColumn> columns;
  // Measured ones depend on the host and never repeat.
  for (const MetricRow& metric : now.metrics) {
    if (metric.is_measured) continue;
    if (!has_metric(base, metric.name)) {
      warnings.push_back(metric.name + " is not in " + base.source + ": not compared");
      continue;
    }
    const auto [i, k] = common_metric(base, now, metric.name);
    columns.push_back({.name = metric.name, .base = i, .now = k});
  }
  for (const MetricRow& metric : base.metrics) {
    if (metric.is_measured || has_metric(now, metric.name)) continue;
    warnings.push_back(metric.name + " is not in " + now.source + ": not compared");
  }
  return columns;
}

bool both_have_flights(const TableTrial& before, const TableTrial& after) {
  return before.flight != 0 && after.flight != 0;
}

/// A difference for each thing that is not the same, also where one follows from another.
void compare_pair(const TableTrial& before, const TableTrial& after,
                  const std::vector<ComparedColumn>& columns,
                  std::vector<Difference>& differences) {
  const auto add = [&](const std::string& what, std::string old_text, std::string new_text) {
    differences.push_back({.identity = before.identity,
                           .what = what,
                           .before = std::move(old_text),
                           .after = std::move(new_text)});
  };
  if (before.mission != after.mission) add("mission", "", "another world, start or goal");
  if (before.outcome != after.outcome) {
    add("outcome", std::string(text(before.outcome)), std::string(text(after.outcome)));
  }
  if (both_have_flights(before, after) && before.flight != after.flight) {
    add("flight", "", "another trajectory, command or event");
  }
  for (const ComparedColumn& column : columns) {
    const double old_value = before.metrics[column.base], new_value = after.metrics[column.now];
    if (same_bits(old_value, new_value)) continue;
    add(column.name, value_text(old_value), value_text(new_value));
  }
}

}  // namespace

ExactComparison compare_exactly(const TrialTable& base, const TrialTable& now, bool is_sample) {
  ExactComparison result{
      .base = base.source, .now = now.source, .base_sweep = base.sweep, .new_sweep = now.sweep};
  const std::vector<ComparedColumn> columns = columns_of(base, now, result.warnings);
  for (const ComparedColumn& column : columns) result.metrics.push_back(column.name);
  std::set<std::string> planners;
  for (const TrialPair& pair : paired_trials(base, now)) {
    if (is_sample && pair.after == nullptr) continue;
    planners.insert(pair.identity().planner);
    if (pair.is_whole()) {
      const std::size_t so_far = result.differences.size();
      compare_pair(*pair.before, *pair.after, columns, result.differences);
      ++result.pair_count;
      result.flight_count += both_have_flights(*pair.before, *pair.after) ? 1 : 0;
      result.equal_count += result.differences.size() == so_far ? 1 : 0;
    } else {
      result.differences.push_back({.identity = pair.identity(),
                                    .what = "trial",
                                    .before = pair.before != nullptr ? "there" : "missing",
                                    .after = pair.after != nullptr ? "there" : "missing"});
    }
  }
  if (is_sample && result.pair_count == 0) {
    throw InputError(now.source + " has no trial of " + base.source);
  }
  if (result.flight_count < result.pair_count) {
    result.warnings.push_back("the digest of " +
                              counted(result.pair_count - result.flight_count, "flight") +
                              " is not in both: only outcomes and metrics are compared");
  }
  result.planners.assign(planners.begin(), planners.end());
  return result;
}

}  // namespace avoidbench
