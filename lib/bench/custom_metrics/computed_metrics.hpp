#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "store/database.hpp"

namespace avoidbench {

/// Metrics that are computed from stored trials, after the flights.
struct ComputedMetrics {
  std::vector<MetricRow> metrics;
  /// By trial key, one an element of `metrics`; NaN where not defined.
  std::map<std::string, std::vector<double>, std::less<>> values;
};

/// How long the SELECT of query_metrics() may run, s: hundreds of times what one over 20,000 trials
/// takes.
inline constexpr double kQueryLimit_s = 60.0;

/// A metric named `name`, as its author describes it: "Way flown beyond the shortest [m]; less is
/// better". Throws InputError for a name that can't be a column's.
MetricRow described_metric(const std::string& name, std::string doc);

/// The metrics that `sql`, one SELECT over the tables and views of the database, computes: its
/// column trial_key says of which trial a row is, each other column is a metric. Lines
/// `-- NAME: description` describe them. Nothing but reading is allowed. Throws InputError with
/// SQLite's message, for two rows of one trial that differ, and for what has not ended after
/// `limit_s`.
ComputedMetrics query_metrics(const Database& database, const std::string& sql,
                              double limit_s = kQueryLimit_s);

/// Puts the metrics behind those of `result`. Throws InputError for a name that is there.
void add_metrics(const ComputedMetrics& computed, SweepResult& result);

}  // namespace avoidbench
