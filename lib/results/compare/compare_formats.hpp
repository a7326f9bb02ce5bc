#pragma once

#include <nlohmann/json_fwd.hpp>

#include "compare/compare.hpp"
#include "table/table.hpp"

namespace avoidbench {

enum class CompareFormat { table, markdown, json, junit, github };
template <>
struct EnumText<CompareFormat> {
  static constexpr std::pair<CompareFormat, std::string_view> entries[] = {
      {CompareFormat::table, "table"},
      {CompareFormat::markdown, "markdown"},
      {CompareFormat::json, "json"},
      {CompareFormat::junit, "junit"},
      {CompareFormat::github, "github"}};
};

/// Everything, all flips too, numbers with all digits, null where there is none.
nlohmann::ordered_json comparison_json(const Comparison& comparison);

/// The comparison as text that ends with a newline.
/// - table, markdown: for people, comparison_section();
/// - json: comparison_json();
/// - junit: JUnit XML, one test case a planner and metric: a regression is a failure, a metric that
///   may not fail the comparison is skipped;
/// - github: github-action-benchmark's customSmallerIsBetter of the new means of metrics of which
///   less is better, the failure rate among them.
std::string format_comparison(const Comparison& comparison, CompareFormat format);

/// The same for table, markdown, json and junit (a test case a planner and metric, failed where a
/// trial differs); throws InputError for the others, which have means to tell.
std::string format_comparison(const ExactComparison& comparison, CompareFormat format);

/// Flips, or differences, that people are shown; all are in the JSON.
inline constexpr std::size_t kShownTrials = 20;

/// What a comparison found, for people: verdict in the title, figures, trials that flipped.
Section comparison_section(const Comparison& comparison);
Section comparison_section(const ExactComparison& comparison);

/// The same of exact comparisons for a terminal: a paragraph a trial, since bits take many digits.
std::string exact_text(const ExactComparison& comparison);

}  // namespace avoidbench
