#include "compare/compare_tables.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include "table/table_text.hpp"
#include "text/visible_text.hpp"

namespace avoidbench {
namespace {

std::string counted(std::int64_t count, const std::string& noun) {
  return std::to_string(count) + " " + noun + (count == 1 ? "" : "s");
}

std::string with_decimals(double value, int decimals, bool has_sign = false) {
  if (std::isnan(value)) return "–";
  std::array<char, 400> buffer{};
  std::snprintf(buffer.data(), buffer.size(), has_sign ? "%+.*f" : "%.*f", decimals, value);
  const bool is_zero =
      std::string_view(buffer.data()).find_first_of("123456789") == std::string_view::npos;
  if (is_zero && has_sign) std::snprintf(buffer.data(), buffer.size(), "%.*f", decimals, 0.0);
  return buffer.data();
}

/// Decimals that show `digits` digits of a number of this size, at most 6.
int decimals_for(double size, int digits) {
  int decimals = digits - 1;
  for (double limit = 10.0; size >= limit && decimals > 0; limit *= 10.0) --decimals;
  for (double limit = 1.0; size < limit && size > 0.0 && decimals < 6; limit *= 0.1) ++decimals;
  return decimals;
}

/// Of the two means: three digits of the greater.
int decimals_of_means(const MetricComparison& row) {
  if (row.metric == "success_rate") return 3;
  return std::min(4, decimals_for(std::max(std::abs(row.base_mean), std::abs(row.new_mean)), 3));
}

/// Of the change and its interval: two digits of the greatest, and not many more than the means'.
int decimals_of_change(const MetricComparison& row) {
  double greatest = std::abs(row.change);
  for (const double end : {row.change_interval.lower, row.change_interval.upper}) {
    if (std::isfinite(end)) greatest = std::max(greatest, std::abs(end));
  }
  const int decimals = decimals_of_means(row);
  return std::clamp(decimals_for(greatest, 2), decimals, decimals + 1);
}

std::string p_text(double p) {
  if (std::isnan(p)) return "–";
  return p < 0.0005 ? "<0.001" : with_decimals(p, 3);
}

std::pair<std::string, std::string> short_name(const MetricComparison& row) {
  constexpr std::pair<std::string_view, std::string_view> kShort[] = {
      {"success_rate", "SR"},         {"path_optimality_pct", "PO"},
      {"energy_optimality", "EO"},    {"average_goal_velocity_mps", "AGV"},
      {"mission_progress_pct", "MP"}, {"min_clearance_m", "clearance"},
      {"processing_time_ms", "PT"}};
  const std::string of_unit = row.unit.empty() ? "" : ", " + row.unit;
  for (const auto& [name, header] : kShort) {
    if (row.metric == name) return {std::string(header) + of_unit, row.metric};
  }
  return {row.metric, ""};
}

std::string verdict_text(const MetricComparison& row) {
  switch (row.verdict) {
    case Verdict::regression:
      return "worse";
    case Verdict::improvement:
      return "better";
    case Verdict::not_gated:
      return "–";
    default:
      return std::string(text(row.verdict));
  }
}

Cell cell(std::string words) { return {.value = std::move(words), .is_best = false}; }

Column column(std::string name, std::string header, std::string doc, Place place = Place::value) {
  return {.name = std::move(name),
          .header = std::move(header),
          .unit = "",
          .doc = std::move(doc),
          .place = place};
}

Table metric_table_of(const Comparison& comparison) {
  Table table{.name = "metrics", .title = "Planners and metrics", .columns = {}, .rows = {}};
  table.columns = {
      column("planner", "planner", "", Place::key),
      column("metric", "metric", "", Place::key),
      column("verdict", "verdict",
             "worse or better: p below " + with_decimals(comparison.alpha, 3) +
                 " and a change beyond the tolerance; small: the first only; unclear: the second "
                 "only; same: neither; –: may not fail the comparison"),
      column("pair_count", "pairs",
             "trials of both sides that the row speaks of: all for SR, MP, end distance and "
             "collisions, those that both finished for the others"),
      column("base_mean", "base", ""),
      column("new_mean", "new", ""),
      column("change", "change",
             "new less base, over the pairs; its 95 % interval is by bootstrap over maps (BCa)"),
      column("interval", "95 % interval", ""),
      column("p", "p",
             "that nothing changed, corrected (Holm) over the " +
                 counted(comparison.test_count, "test") +
                 " that may fail the comparison: McNemar for SR, Wilcoxon's signed-rank test for "
                 "the others")};
  for (const MetricComparison& row : comparison.rows) {
    const int decimals = decimals_of_means(row), finer = decimals_of_change(row);
    const Interval& interval = row.change_interval;
    const bool is_untouched = row.change == 0.0 && interval.lower == 0.0 && interval.upper == 0.0;
    std::string change = with_decimals(row.change, finer, true), range;
    if (is_untouched) {
      change = "0";
    } else if (!std::isnan(interval.lower)) {
      range = "[" + with_decimals(interval.lower, finer, true) + ", " +
              with_decimals(interval.upper, finer, true) + "]";
    }
    table.rows.push_back({cell(comparison.planners[row.planner].planner),
                          cell(short_name(row).first),
                          cell(verdict_text(row)),
                          {.value = row.pair_count, .is_best = false},
                          cell(with_decimals(row.base_mean, decimals)),
                          cell(with_decimals(row.new_mean, decimals)),
                          cell(std::move(change)),
                          cell(std::move(range)),
                          cell(p_text(row.adjusted_p))});
  }
  return table;
}

std::string map_text(const TrialIdentity& identity) {
  return identity.generator + " " + std::to_string(identity.map_seed);
}

Table flip_table(const Comparison& comparison) {
  const std::size_t shown = std::min(kShownTrials, comparison.flips.size());
  Table table{.name = "flips", .title = "Trials with another outcome: ", .columns = {}, .rows = {}};
  std::int64_t lost = 0, gained = 0;
  for (const PlannerPairs& planner : comparison.planners) {
    lost += planner.lost_count;
    gained += planner.gained_count;
  }
  const auto others = static_cast<std::int64_t>(comparison.flips.size()) - lost - gained;
  table.title += std::to_string(lost) + " lost, " + std::to_string(gained) + " won, " +
                 std::to_string(others) + " failed in another way";
  if (shown < comparison.flips.size()) {
    table.title += "; " + std::to_string(shown) + " of " + std::to_string(comparison.flips.size()) +
                   " are shown";
  }
  const bool has_settings = std::any_of(
      comparison.flips.begin(), comparison.flips.begin() + static_cast<std::ptrdiff_t>(shown),
      [](const Flip& flip) { return !flip.identity.setting.empty(); });
  table.columns = {column("planner", "planner", "", Place::key),
                   column("map", "map", "", Place::key)};
  if (has_settings) table.columns.push_back(column("setting", "setting", "", Place::key));
  table.columns.push_back(column("mission_index", "mission", ""));
  table.columns.push_back(column("before", "before", ""));
  table.columns.push_back(column("after", "after", ""));
  for (std::size_t i = 0; i < shown; ++i) {
    const Flip& flip = comparison.flips[i];
    std::vector<Cell>& row = table.rows.emplace_back();
    row.push_back(cell(flip.identity.planner));
    row.push_back(cell(map_text(flip.identity)));
    if (has_settings) row.push_back(cell(flip.identity.setting));
    row.push_back({.value = flip.identity.mission_index, .is_best = false});
    row.push_back(cell(std::string(text(flip.before))));
    row.push_back(cell(std::string(text(flip.after))));
  }
  return table;
}

std::string title_of(const Comparison& comparison) {
  const std::int64_t regressions = count_of(comparison, Verdict::regression);
  const std::int64_t improvements = count_of(comparison, Verdict::improvement);
  std::int64_t pairs = 0;
  for (const PlannerPairs& planner : comparison.planners) pairs += planner.pair_count;
  return (regressions == 0 ? "No regression" : counted(regressions, "regression")) +
         (improvements == 0 ? "" : ", " + counted(improvements, "improvement")) + ": " +
         comparison.now + " against " + comparison.base + ", sweep " + comparison.new_sweep +
         (comparison.base_sweep == comparison.new_sweep ? ""
                                                        : " against " + comparison.base_sweep) +
         ", " + counted(pairs, "pair") + " of trials";
}

std::string exact_title(const ExactComparison& comparison) {
  const std::string checked =
      comparison.now + " against " + comparison.base + ", sweep " + comparison.new_sweep + ": " +
      counted(comparison.pair_count, "trial") + ", outcomes and " +
      counted(static_cast<std::int64_t>(comparison.metrics.size()), "metric") + " bit for bit";
  if (comparison.differences.empty()) return "Equal: " + checked;
  return counted(static_cast<std::int64_t>(comparison.differences.size()), "difference") + ": " +
         checked + "; " + std::to_string(comparison.equal_count) + " are equal";
}

}  // namespace

Section comparison_section(const Comparison& comparison) {
  Section section{.name = comparison.new_sweep,
                  .title = title_of(comparison),
                  .tables = {metric_table_of(comparison)},
                  .notes = {},
                  .warnings = comparison.warnings};
  if (!comparison.flips.empty()) section.tables.push_back(flip_table(comparison));
  if (comparison.flips.size() > kShownTrials) {
    section.notes.emplace_back("…", "--format json lists all trials with another outcome");
  }
  for (const MetricComparison& row : comparison.rows) {
    const auto [name, meaning] = short_name(row);
    if (row.planner == comparison.rows.front().planner && !meaning.empty()) {
      section.notes.emplace_back(name.substr(0, name.find(',')), meaning);
    }
  }
  return section;
}

Section comparison_section(const ExactComparison& comparison) {
  const std::size_t shown = std::min(kShownTrials, comparison.differences.size());
  Section section{.name = comparison.new_sweep,
                  .title = exact_title(comparison),
                  .tables = {},
                  .notes = {},
                  .warnings = comparison.warnings};
  if (comparison.differences.empty()) return section;
  Table table{.name = "differences", .title = "Differences", .columns = {}, .rows = {}};
  if (shown < comparison.differences.size()) {
    table.title += "; " + std::to_string(shown) + " are shown";
  }
  table.columns = {column("planner", "planner", "", Place::key),
                   column("map", "map", "", Place::key)};
  const bool has_settings = std::any_of(
      comparison.differences.begin(),
      comparison.differences.begin() + static_cast<std::ptrdiff_t>(shown),
      [](const Difference& difference) { return !difference.identity.setting.empty(); });
  if (has_settings) table.columns.push_back(column("setting", "setting", "", Place::key));
  table.columns.push_back(column("mission_index", "mission", "", Place::key));
  table.columns.push_back(column("what", "what", "", Place::key));
  table.columns.push_back(column("before", "base", ""));
  table.columns.push_back(column("after", "new", ""));
  for (std::size_t i = 0; i < shown; ++i) {
    const Difference& difference = comparison.differences[i];
    std::vector<Cell>& row = table.rows.emplace_back();
    row.push_back(cell(difference.identity.planner));
    row.push_back(cell(map_text(difference.identity)));
    if (has_settings) row.push_back(cell(difference.identity.setting));
    row.push_back({.value = difference.identity.mission_index, .is_best = false});
    row.push_back(cell(difference.what));
    row.push_back(cell(difference.before));
    row.push_back(cell(difference.after));
  }
  section.tables.push_back(std::move(table));
  return section;
}

std::string exact_text(const ExactComparison& comparison) {
  constexpr std::size_t kWidth = 100, kShownValues = 3;
  std::string out = wrapped(visible_line(exact_title(comparison)), kWidth, 2) + "\n";
  for (const std::string& warning : comparison.warnings) {
    out += wrapped(visible_line("Warning: " + warning), kWidth, 9) + "\n";
  }
  std::size_t trial_count = 0;
  for (std::size_t i = 0; i < comparison.differences.size(); ++trial_count) {
    const TrialIdentity& identity = comparison.differences[i].identity;
    std::string line;
    std::size_t end = i;
    for (; end < comparison.differences.size() && comparison.differences[end].identity == identity;
         ++end) {
      const Difference& difference = comparison.differences[end];
      if (end - i < kShownValues) {
        line += (line.empty() ? "      " : ", ") + difference.what + " " + difference.before +
                " → " + difference.after;
      }
    }
    if (end - i > kShownValues) line += ", and " + std::to_string(end - i - kShownValues) + " more";
    if (trial_count < kShownTrials) {
      out += (trial_count == 0 ? "\n" : "");
      const std::string head = "  " + identity.planner + ", " + place_text(identity);
      out += wrapped(visible_line(head), kWidth, 6) + "\n" +
             wrapped(visible_line(line), kWidth, 8) + "\n";
    }
    i = end;
  }
  if (trial_count > kShownTrials) {
    out += "\n  and " + counted(static_cast<std::int64_t>(trial_count - kShownTrials), "trial") +
           " more: --format json has all\n";
  }
  return out;
}

}  // namespace avoidbench
