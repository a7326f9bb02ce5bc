#include "compare/compare_formats.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>

#include "base/input_error.hpp"
#include "base/number_text.hpp"
#include "base/visible_text.hpp"
#include "base/words.hpp"
#include "table/table_text.hpp"

namespace avoidbench {
namespace {

using Json = nlohmann::ordered_json;

/// JSON has no NaN: null.
Json number(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }

Json json_of(const TrialIdentity& identity) {
  return {{"planner", identity.planner},
          {"generator", identity.generator},
          {"map_seed", identity.map_seed},
          {"setting", identity.setting},
          {"mission_index", identity.mission_index}};
}

Json json_of(const MetricComparison& row, const std::string& planner) {
  return {{"planner", planner},
          {"metric", row.metric},
          {"unit", row.unit},
          {"better", text(row.better)},
          {"is_measured", row.is_measured},
          {"pair_count", row.pair_count},
          {"base_mean", number(row.base_mean)},
          {"new_mean", number(row.new_mean)},
          {"change", number(row.change)},
          {"change_lower", number(row.change_interval.lower)},
          {"change_upper", number(row.change_interval.upper)},
          {"limit", number(row.limit)},
          {"p", number(row.p)},
          {"adjusted_p", number(row.adjusted_p)},
          {"verdict", text(row.verdict)}};
}

std::string json_text(const ExactComparison& comparison) {
  Json differences = Json::array();
  for (const Difference& difference : comparison.differences) {
    Json& entry = differences.emplace_back(json_of(difference.identity));
    entry["what"] = difference.what;
    entry["before"] = difference.before;
    entry["after"] = difference.after;
  }
  return dumped({{"base", comparison.base},
                 {"new", comparison.now},
                 {"base_sweep", comparison.base_sweep},
                 {"new_sweep", comparison.new_sweep},
                 {"pair_count", comparison.pair_count},
                 {"equal_count", comparison.equal_count},
                 {"flight_count", comparison.flight_count},
                 {"metrics", comparison.metrics},
                 {"warnings", comparison.warnings},
                 {"differences", differences}});
}

/// Text for XML: what has a meaning there is escaped, what XML 1.0 can't hold is shown.
std::string in_xml(std::string_view text) {
  constexpr std::pair<std::string_view, std::string_view> kSigns[] = {
      {"&", "&amp;"}, {"<", "&lt;"}, {">", "&gt;"}, {"\"", "&quot;"}};
  return replaced(visible_line(text), kSigns);
}

/// CI systems show a metric of a planner as a test: class and name.
struct TestCase {
  std::string planner, metric;
  std::string failure = {};  ///< "" where it passed
  std::string skipped = {};  ///< why; "" where it was not
  std::string details = {};
};

/// The counts stand twice, at all suites and at the one: readers take either.
std::string junit_of(const std::string& suite, const std::vector<TestCase>& cases) {
  const auto failures = std::count_if(cases.begin(), cases.end(),
                                      [](const TestCase& test) { return !test.failure.empty(); });
  const auto skipped = std::count_if(cases.begin(), cases.end(),
                                     [](const TestCase& test) { return !test.skipped.empty(); });
  const std::string counts = "tests=\"" + std::to_string(cases.size()) + "\" failures=\"" +
                             std::to_string(failures) + "\" errors=\"0\" skipped=\"" +
                             std::to_string(skipped) + "\"";
  std::string out = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites " + counts +
                    ">\n  <testsuite name=\"" + in_xml(suite) + "\" " + counts + ">\n";
  for (const TestCase& test : cases) {
    out += "    <testcase classname=\"" + in_xml(test.planner) + "\" name=\"" +
           in_xml(test.metric) + "\">\n";
    if (!test.failure.empty()) {
      out += "      <failure type=\"regression\" message=\"" + in_xml(test.failure) + "\">" +
             in_xml(test.details) + "</failure>\n";
    } else if (!test.skipped.empty()) {
      out += "      <skipped message=\"" + in_xml(test.skipped) + "\"/>\n";
    }
    if (test.failure.empty() && !test.details.empty()) {
      out += "      <system-out>" + in_xml(test.details) + "</system-out>\n";
    }
    out += "    </testcase>\n";
  }
  return out + "  </testsuite>\n</testsuites>\n";
}

/// One line: what a page of a CI system shows of a test.
std::string figures(const MetricComparison& row) {
  const auto digits = [](double value) {
    return std::isnan(value) ? std::string("–") : significant_digits(value, 5);
  };
  if (row.pair_count == 0) return "no pair of trials";
  std::string line = digits(row.base_mean) + " -> " + digits(row.new_mean) +
                     (row.unit.empty() ? "" : " " + row.unit) + ", change " + digits(row.change);
  const Interval& interval = row.change_interval;
  if (!std::isnan(interval.lower) || !std::isnan(interval.upper)) {
    line += " [" + digits(interval.lower) + ", " + digits(interval.upper) + "]";
  }
  line += ", tolerance " + digits(row.limit);
  if (!std::isnan(row.adjusted_p)) line += ", p " + digits(row.adjusted_p);
  return line + ", " + std::to_string(row.pair_count) + " pairs";
}

/// Rows that may not fail the comparison are skipped tests, with their figures.
std::string junit_text(const Comparison& comparison) {
  std::vector<TestCase> cases;
  for (const MetricComparison& row : comparison.rows) {
    TestCase& test =
        cases.emplace_back(TestCase{.planner = comparison.planners[row.planner].planner,
                                    .metric = row.metric,
                                    .details = figures(row)});
    if (row.verdict == Verdict::regression) test.failure = row.metric + " is worse";
    if (row.verdict == Verdict::not_gated) test.skipped = "may not fail the comparison";
  }
  return junit_of("avoidbench compare " + comparison.new_sweep, cases);
}

std::string junit_text(const ExactComparison& comparison) {
  // By planner and by what differs: a test case has all trials in which its metric differs.
  std::map<std::pair<std::string, std::string>, std::vector<const Difference*>> found;
  for (const Difference& difference : comparison.differences) {
    found[{difference.identity.planner, difference.what}].push_back(&difference);
  }
  std::vector<std::string> names = comparison.metrics;
  names.insert(names.begin(), {"trial", "mission", "outcome", "flight"});
  std::vector<TestCase> cases;
  for (const std::string& planner : comparison.planners) {
    for (const std::string& name : names) {
      TestCase& test = cases.emplace_back(TestCase{.planner = planner, .metric = name});
      for (const Difference* difference : found[{planner, name}]) {
        if (!test.details.empty()) test.details += "; ";
        test.details += place_text(difference->identity) + ": " + difference->before + " -> " +
                        difference->after;
      }
      const std::size_t count = found[{planner, name}].size();
      if (count > 0) test.failure = name + " differs in " + counted(count, "trial");
    }
  }
  return junit_of("avoidbench compare, exact, " + comparison.new_sweep, cases);
}

/// The metrics of which less is better, and the failure rate.
std::string github_text(const Comparison& comparison) {
  Json all = Json::array();
  for (const MetricComparison& row : comparison.rows) {
    // That tool knows one direction a file.
    const bool is_turned = row.metric == "success_rate";
    if (std::isnan(row.new_mean) || (row.better != Better::less && !is_turned)) continue;
    Json entry{{"name", comparison.planners[row.planner].planner + " / " +
                            (is_turned ? "failure_rate" : row.metric)},
               {"unit", row.unit.empty() ? "ratio" : row.unit},
               {"value", is_turned ? 1.0 - row.new_mean : row.new_mean}};
    if (std::isfinite(row.new_interval.lower) && std::isfinite(row.new_interval.upper)) {
      entry["range"] =
          // The tool's range is one text: half the width, although BCa's intervals are not
          // symmetric.
          "± " + significant_digits(0.5 * (row.new_interval.upper - row.new_interval.lower), 5);
    }
    entry["extra"] = figures(row) + ": " + std::string(text(row.verdict));
    all.push_back(std::move(entry));
  }
  return dumped(all);
}

std::string section_text(const Section& section, TableFormat format) {
  return format_sections(std::span(&section, 1), format);
}

}  // namespace

Json comparison_json(const Comparison& comparison) {
  Json planners = Json::array(), rows = Json::array(), flips = Json::array(),
       causes = Json::array();
  for (const PlannerPairs& planner : comparison.planners) {
    planners.push_back({{"planner", planner.planner},
                        {"pair_count", planner.pair_count},
                        {"only_base_count", planner.only_base_count},
                        {"only_new_count", planner.only_new_count},
                        {"lost_count", planner.lost_count},
                        {"gained_count", planner.gained_count}});
  }
  for (const MetricComparison& row : comparison.rows) {
    rows.push_back(json_of(row, comparison.planners[row.planner].planner));
  }
  for (const Flip& flip : comparison.flips) {
    Json& entry = flips.emplace_back(json_of(flip.identity));
    entry["before"] = text(flip.before);
    entry["after"] = text(flip.after);
  }
  for (const CauseChange& change : comparison.causes) {
    causes.push_back({{"planner", change.planner},
                      {"cause", change.cause},
                      {"pair_count", change.pair_count},
                      {"base_count", change.base_count},
                      {"new_count", change.new_count},
                      {"p", number(change.p)}});
  }
  return {{"base", comparison.base},
          {"new", comparison.now},
          {"base_sweep", comparison.base_sweep},
          {"new_sweep", comparison.new_sweep},
          {"alpha", comparison.alpha},
          {"test_count", comparison.test_count},
          {"regression_count", count_of(comparison, Verdict::regression)},
          {"improvement_count", count_of(comparison, Verdict::improvement)},
          {"warnings", comparison.warnings},
          {"planners", planners},
          {"metrics", rows},
          {"flips", flips},
          {"causes", causes}};
}

std::string format_comparison(const Comparison& comparison, CompareFormat format) {
  switch (format) {
    case CompareFormat::table:
      return section_text(comparison_section(comparison), TableFormat::table);
    case CompareFormat::markdown:
      return section_text(comparison_section(comparison), TableFormat::markdown);
    case CompareFormat::json:
      return dumped(comparison_json(comparison));
    case CompareFormat::junit:
      return junit_text(comparison);
    case CompareFormat::github:
      return github_text(comparison);
  }
  return {};
}

std::string format_comparison(const ExactComparison& comparison, CompareFormat format) {
  if (format == CompareFormat::table) return exact_text(comparison);
  if (format == CompareFormat::json) return json_text(comparison);
  if (format == CompareFormat::junit) return junit_text(comparison);
  if (format == CompareFormat::markdown) {
    return section_text(comparison_section(comparison), TableFormat::markdown);
  }
  throw InputError(
      "an exact comparison is of trials, not means: its formats are table, markdown, json and "
      "junit");
}

}  // namespace avoidbench
