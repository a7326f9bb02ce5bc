#include <algorithm>
#include <cmath>
#include <map>

#include "base/number_text.hpp"
#include "base/visible_text.hpp"
#include "base/words.hpp"
#include "compare/compare_formats.hpp"
#include "report/table_rows.hpp"
#include "table/table_text.hpp"

namespace avoidbench {
namespace {

/// What rounds to zero gets no sign even where one is asked for: neither +0.000 nor -0.000.
std::string with_decimals(double value, int decimals, bool has_sign = false) {
  if (std::isnan(value)) return "–";
  const std::string digits = fixed_digits(value, decimals);
  if (!has_sign) return digits;
  if (digits.find_first_of("123456789") == std::string::npos) return fixed_digits(0.0, decimals);
  return (value > 0.0 ? "+" : "") + digits;
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
  // Three decimals would round it to 0.000, which no p is.
  return p < 0.0005 ? "<0.001" : with_decimals(p, 3);
}

/// The column's abbreviation, with the unit, and what it stands for; the metric's own name and ""
/// where there is none.
std::pair<std::string, std::string> short_name(const MetricComparison& row) {
  constexpr std::pair<std::string_view, std::string_view> kShort[] = {
      {"success_rate", "SR"},
      {"v90_mps", "v90"},
      {"path_optimality_pct", "PO"},
      {"energy_optimality", "EO"},
      {"average_goal_velocity_mps", "AGV"},
      {"mission_progress_pct", "MP"},
      {"min_clearance_m", "clearance"},
      {"processing_time_ms", "PT"}};
  const std::string of_unit = row.unit.empty() ? "" : ", " + row.unit;
  for (const auto& [name, header] : kShort) {
    if (row.metric == name) return {std::string(header) + of_unit, row.metric};
  }
  return {row.metric, ""};
}

std::string verdict_text(Verdict verdict) {
  if (verdict == Verdict::regression) return "worse";
  if (verdict == Verdict::improvement) return "better";
  return verdict == Verdict::not_gated ? "–" : std::string(text(verdict));
}

Table metric_table_of(const Comparison& comparison) {
  Table table = make_table(
      "metrics", "Planners and metrics",
      {planner_column(),
       {.name = "metric", .place = Place::key},
       {.name = "verdict",
        .doc = "worse or better: p below " + with_decimals(comparison.alpha, 3) +
               " and a change beyond the tolerance; small: the first only; unclear: the second "
               "only; same: neither; –: may not fail the comparison"},
       {.name = "pair_count",
        .header = "pairs",
        .doc = "trials of both sides that the row covers: all for SR, MP, end distance and "
               "collisions, those that both finished for the others"},
       {.name = "base_mean", .header = "base"},
       {.name = "new_mean", .header = "new"},
       {.name = "change",
        .doc = "new less base, over the pairs; its 95 % interval is by bootstrap over maps "
               "(BCa); an end – is unknown from so few maps"},
       {.name = "interval", .header = "95 % interval"},
       {.name = "p",
        .doc = "that nothing changed, corrected (Holm) over the " +
               counted(comparison.test_count, "test") +
               " that may fail the comparison: McNemar for SR, draws of maps for v90, Wilcoxon's "
               "signed-rank test for "
               "the others"}});
  for (const MetricComparison& row : comparison.rows) {
    const int decimals = decimals_of_means(row), finer = decimals_of_change(row);
    const Interval& interval = row.change_interval;
    // Zeros with decimals would look like rounded changes.
    const bool is_untouched = row.change == 0.0 && interval.lower == 0.0 && interval.upper == 0.0;
    std::string change = with_decimals(row.change, finer, true), range;
    if (is_untouched) {
      change = "0";
    } else if (!std::isnan(interval.lower) || !std::isnan(interval.upper)) {
      range = "[" + with_decimals(interval.lower, finer, true) + ", " +
              with_decimals(interval.upper, finer, true) + "]";
    }
    table.rows.push_back(
        make_row(comparison.planners[row.planner].planner, short_name(row).first,
                 verdict_text(row.verdict), row.pair_count, with_decimals(row.base_mean, decimals),
                 with_decimals(row.new_mean, decimals), change, range, p_text(row.adjusted_p)));
  }
  return table;
}

/// A table of single trials, flips or differences: who flew where, then `columns`, whose cells
/// `cells_of` an entry makes. The setting is there where one of them has any.
template <class Entry, class CellsOf>
Table table_of_trials(const std::string& name, const std::string& title,
                      std::span<const Entry> entries, const std::vector<Column>& columns,
                      CellsOf cells_of) {
  const bool has_settings = std::any_of(entries.begin(), entries.end(), [](const Entry& entry) {
    return !entry.identity.setting.empty();
  });
  std::vector<Column> all{planner_column(), {.name = "map", .place = Place::key}};
  if (has_settings) all.push_back({.name = "setting", .place = Place::key});
  all.push_back({.name = "mission_index", .header = "mission", .place = Place::key});
  all.insert(all.end(), columns.begin(), columns.end());
  Table table = make_table(name, title, all);
  for (const Entry& entry : entries) {
    const TrialIdentity& identity = entry.identity;
    Row row =
        make_row(identity.planner, identity.generator + " " + std::to_string(identity.map_seed));
    if (has_settings) append(row, identity.setting);
    append(row, identity.mission_index);
    append(row, cells_of(entry));
    table.rows.push_back(std::move(row));
  }
  return table;
}

/// Of few flips all, of many the first; the title counts all of them.
Table flip_table(const Comparison& comparison) {
  const std::size_t count = comparison.flips.size(), shown = std::min(kShownTrials, count);
  std::int64_t lost = 0, gained = 0;
  for (const PlannerPairs& planner : comparison.planners) {
    lost += planner.lost_count;
    gained += planner.gained_count;
  }
  // Neither lost nor won: collided before, timed out now.
  const auto others = static_cast<std::int64_t>(count) - lost - gained;
  std::string title = "Trials with another outcome: " + std::to_string(lost) + " lost, " +
                      std::to_string(gained) + " won, " + std::to_string(others) +
                      " failed in another way";
  if (shown < count) {
    title += "; " + std::to_string(shown) + " of " + std::to_string(count) + " are shown";
  }
  return table_of_trials("flips", title, std::span(comparison.flips).first(shown),
                         {{.name = "before"}, {.name = "after"}}, [](const Flip& flip) {
                           return make_row(text(flip.before), text(flip.after));
                         });
}

Table cause_change_table(const Comparison& comparison) {
  Table table = make_table(
      "causes", "Causes of failures",
      {planner_column(),
       {.name = "cause", .place = Place::key},
       {.name = "base_count", .header = "base"},
       {.name = "new_count", .header = "new"},
       {.name = "p",
        .header = "p cause",
        .doc = "that a cause is as frequent as before (McNemar's exact test over the pairs), not "
               "corrected, and no verdict"}});
  for (const CauseChange& change : comparison.causes) {
    table.rows.push_back(make_row(change.planner, change.cause, change.base_count, change.new_count,
                                  p_text(change.p)));
  }
  return table;
}

Table difference_table(const ExactComparison& comparison) {
  const std::size_t count = comparison.differences.size(), shown = std::min(kShownTrials, count);
  return table_of_trials(
      "differences",
      "Differences" + (shown < count ? "; " + std::to_string(shown) + " are shown" : std::string()),
      std::span(comparison.differences).first(shown),
      {{.name = "what", .place = Place::key},
       {.name = "before", .header = "base"},
       {.name = "after", .header = "new"}},
      [](const Difference& difference) {
        return make_row(difference.what, difference.before, difference.after);
      });
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
  const bool has_flights = comparison.flight_count == comparison.pair_count;
  const std::string checked = comparison.now + " against " + comparison.base + ", sweep " +
                              comparison.new_sweep + ": " +
                              counted(comparison.pair_count, "trial") +
                              (has_flights ? ", flights and " : ", outcomes and ") +
                              counted(comparison.metrics.size(), "metric") + " bit for bit";
  if (comparison.differences.empty()) return "Equal: " + checked;
  return counted(comparison.differences.size(), "difference") + ": " + checked + "; " +
         std::to_string(comparison.equal_count) + " are equal";
}

}  // namespace

Section comparison_section(const Comparison& comparison) {
  Section section{.name = comparison.new_sweep,
                  .title = title_of(comparison),
                  .tables = {metric_table_of(comparison)},
                  .warnings = comparison.warnings};
  if (!comparison.flips.empty()) section.tables.push_back(flip_table(comparison));
  if (!comparison.causes.empty()) section.tables.push_back(cause_change_table(comparison));
  if (comparison.flips.size() > kShownTrials) {
    section.notes.emplace_back("…", "the JSON lists all trials with another outcome");
  }
  for (const MetricComparison& row : comparison.rows) {
    const auto [name, meaning] = short_name(row);
    // Each abbreviation once: every planner has the same metrics.
    if (row.planner == comparison.rows.front().planner && !meaning.empty()) {
      section.notes.emplace_back(name.substr(0, name.find(',')), meaning);
    }
  }
  return section;
}

Section comparison_section(const ExactComparison& comparison) {
  Section section{.name = comparison.new_sweep,
                  .title = exact_title(comparison),
                  .warnings = comparison.warnings};
  if (!comparison.differences.empty()) section.tables.push_back(difference_table(comparison));
  return section;
}

std::string exact_text(const ExactComparison& comparison) {
  constexpr std::size_t kWidth = 100, kShownValues = 3;
  std::string out = wrapped(visible_line(exact_title(comparison)), kWidth, 2) + "\n";
  for (const std::string& warning : comparison.warnings) {
    out += wrapped(visible_line("Warning: " + warning), kWidth, 9) + "\n";
  }
  std::map<TrialIdentity, std::vector<std::string>> trials;  // with what differs in each
  for (const Difference& difference : comparison.differences) {
    const std::string before = difference.before.empty() ? ": " : " " + difference.before + " → ";
    trials[difference.identity].push_back(difference.what + before + difference.after);
  }
  std::size_t shown_count = 0;
  for (auto& [identity, values] : trials) {
    if (shown_count == kShownTrials) break;
    out += shown_count++ == 0 ? "\n" : "";
    if (values.size() > kShownValues) {
      const std::size_t more = values.size() - kShownValues;
      values.resize(kShownValues);
      values.push_back("and " + std::to_string(more) + " more");
    }
    const std::string head = "  " + identity.planner + ", " + place_text(identity);
    out += wrapped(visible_line(head), kWidth, 6) + "\n" +
           wrapped(visible_line("      " + joined(values)), kWidth, 8) + "\n";
  }
  if (trials.size() > kShownTrials) {
    out +=
        "\n  and " + counted(trials.size() - kShownTrials, "trial") + " more: the JSON has all\n";
  }
  return out;
}

}  // namespace avoidbench
