#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/enum_text.hpp"
#include "compare/trial_table.hpp"
#include "statistics/interval.hpp"

namespace avoidbench {

/// How much worse a metric may be before it matters.
struct Tolerance {
  enum class Kind {
    relative,  ///< `value` is a share of the base's mean
    absolute,  ///< `value` is in the metric's unit
    ignored    ///< the metric is shown and fails nothing
  };
  Kind kind = Kind::relative;
  double value = 0.05;
};

struct CompareSettings {
  double alpha = 0.01;                          ///< of all tests together
  Tolerance tolerance;                          ///< where `tolerances` says nothing
  std::map<std::string, Tolerance> tolerances;  ///< by metric; "success_rate" and "v90_mps" too
  bool gates_measured = false;                  ///< whether times of the host may fail it
  std::size_t replicate_count = 2000;           ///< draws of a bootstrap interval
  std::vector<std::string>
      metrics;  ///< to compare beside success rate and v90; empty: the usual ones
};

/// `5%` or `0.05` of the base's mean: what --min-effect takes. Throws InputError.
Tolerance min_effect_from(std::string_view text);

/// Reads a file of tolerances into `settings`: a mapping of metrics (success_rate, those in
/// `metrics`, or `default`) to a share of the base's mean (`10%`), a number in the metric's unit,
/// or `ignore`. Throws InputError with every problem at its place.
void read_tolerances(const std::filesystem::path& file, const std::vector<std::string>& metrics,
                     CompareSettings& settings);

enum class Verdict { regression, improvement, small, unclear, same, not_gated };
template <>
struct EnumText<Verdict> {
  static constexpr std::pair<Verdict, std::string_view> entries[] = {
      {Verdict::regression, "regression"},    // worse, by both limits
      {Verdict::improvement, "improvement"},  // better, by both limits
      {Verdict::small, "small"},              // surely different, but by less than the tolerance
      {Verdict::unclear, "unclear"},          // different by the tolerance, but may be chance
      {Verdict::same, "same"},                // neither
      {Verdict::not_gated, "not_gated"}};     // no direction, measured, ignored or nothing to pair
};

/// One metric of one planner over the pairs of trials that it speaks of.
struct MetricComparison {
  std::size_t planner = 0;  ///< index into Comparison::planners
  std::string metric;       ///< "success_rate", "v90_mps" or a metric's name
  std::string unit;
  Better better = Better::neither;
  bool is_measured = false;
  std::int64_t pair_count = 0;
  double base_mean = 0.0, new_mean = 0.0;  ///< (v90: values) over the pairs; NaN without
  double change = 0.0;                     ///< new − base
  Interval change_interval;                ///< 95 %, maps as clusters; NaN for fewer than 2 maps
  Interval new_interval;                   ///< the same of new_mean
  double p = 0.0;                          ///< of no change; NaN where nothing was tested
  double adjusted_p = 0.0;                 ///< Holm; NaN for metrics that are not gated
  double limit = 0.0;                      ///< least change that matters, in the metric's unit
  Verdict verdict = Verdict::same;
};

/// A trial with another outcome than before.
struct Flip {
  TrialIdentity identity;
  Outcome before = Outcome::timed_out, after = Outcome::timed_out;
};

/// How often a planner's trials failed for one cause, over the pairs of which every failure has a
/// cause on both sides.
struct CauseChange {
  std::string planner, cause;
  std::int64_t pair_count = 0, base_count = 0, new_count = 0;
  double p = 1.0;  ///< of no change: McNemar's exact test, not corrected
};

struct PlannerPairs {
  std::string planner;
  std::int64_t pair_count = 0, only_base_count = 0, only_new_count = 0;
  std::int64_t lost_count = 0, gained_count = 0;  ///< finished before only, finished now only
};

struct Comparison {
  std::string base, now;  ///< files
  std::string base_sweep, new_sweep;
  double alpha = 0.01;
  std::int64_t test_count = 0;  ///< that were corrected together
  std::vector<PlannerPairs> planners;
  std::vector<MetricComparison> rows;  ///< by planner, then as the metrics were asked for
  std::vector<Flip> flips;             ///< lost ones, gained ones, other failures; each by identity
  std::vector<CauseChange> causes;     ///< by planner, those that grew most first
  std::vector<std::string> warnings;
};

/// Compares the trials that both tables have.
///
/// Success is tested by McNemar's exact test, v90 (over all pairs, from 29 on) by draws of maps,
/// any other metric by Wilcoxon's signed-rank test of the differences; p is two-sided and corrected
/// by Holm over all tests that may fail the comparison. Mission progress, end distance and
/// collisions, which a failure makes worst, are compared over all pairs; every other metric over
/// the missions that both finished, so that failing on hard missions improves none. Throws
/// InputError where nothing is paired, a metric is unknown, or the two define it in different
/// versions.
Comparison compare_tables(const TrialTable& base, const TrialTable& now,
                          const CompareSettings& settings);

std::int64_t count_of(const Comparison& comparison, Verdict verdict);

/// The trials of one identity; null where that side has none.
struct TrialPair {
  const TableTrial* before = nullptr;
  const TableTrial* after = nullptr;

  bool is_whole() const { return before != nullptr && after != nullptr; }
  const TrialIdentity& identity() const { return (before != nullptr ? before : after)->identity; }
};

/// All trials of the two by their identities, in order. They point into the tables.
std::vector<TrialPair> paired_trials(const TrialTable& base, const TrialTable& now);

bool has_metric(const TrialTable& table, std::string_view name);

/// Position of a metric of this name in both tables. Throws InputError where one of them lacks it
/// or their versions differ.
std::pair<std::size_t, std::size_t> common_metric(const TrialTable& base, const TrialTable& now,
                                                  const std::string& name);

/// Something of a trial that is not the same to the last bit.
struct Difference {
  TrialIdentity identity;
  std::string what;  ///< "outcome", a metric, "mission", or "trial" where one side has none
  std::string before, after;  ///< numbers with all digits; "" if none
};

struct ExactComparison {
  std::string base, now;  ///< files
  std::string base_sweep, new_sweep;
  std::vector<std::string> planners = {};  ///< labels of either side
  std::int64_t pair_count = 0;
  std::int64_t equal_count = 0;              ///< of the pairs: without any difference
  std::int64_t flight_count = 0;             ///< of the pairs: both sides have the flight's digest
  std::vector<std::string> metrics = {};     ///< that were compared
  std::vector<Difference> differences = {};  ///< by identity
  std::vector<std::string> warnings = {};
};

/// Compares outcomes, missions, digests of flights and every deterministic metric that both tables
/// define, bit for bit; NaN equals NaN. A trial that one side lacks is a difference, except those
/// of `base` where `now` is a sample of it. Throws InputError where a metric's versions differ, and
/// where a sample has no trial of `base`.
ExactComparison compare_exactly(const TrialTable& base, const TrialTable& now,
                                bool is_sample = false);

}  // namespace avoidbench
