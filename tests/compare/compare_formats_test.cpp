#include "compare/compare_formats.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "base/input_error.hpp"
#include "compare/compare_samples.hpp"
#include "table/table_text.hpp"

namespace avoidbench {
namespace {

using namespace compare_samples;
using nlohmann::json;

/// A planner with a name that hurts, whose flights got longer and which lost 20 of 40 trials and
/// with them progress.
Comparison sample() {
  TrialTable base = finished_table("a.db", 10, 4, "<ego & \"co\">");
  TrialTable now = base;
  now.source = "b.db";
  for (std::size_t i = 0; i < now.trials.size(); ++i) {
    now.trials[i].metrics[0] = 7.0;
    if (i % 2 == 0) crash(now.trials[i]);
  }
  return compare_tables(base, now, {});
}

TEST(CompareFormats, TableFitsATerminal) {
  const std::string text = format_comparison(sample(), CompareFormat::table);
  EXPECT_EQ(text.find("4 regressions: b.db against a.db"), 0U) << text;
  std::size_t start = 0;
  while (start < text.size()) {
    const std::string line = text.substr(start, text.find('\n', start) - start);
    EXPECT_LE(display_width(line), 100U) << line;
    start += line.size() + 1;
  }
  EXPECT_NE(text.find("20 lost, 0 won"), std::string::npos);
  EXPECT_NE(text.find("worse"), std::string::npos);
}

TEST(CompareFormats, ChangesHaveSignsAndDigitsOfTheirInterval) {
  Comparison comparison = sample();
  MetricComparison& row = comparison.rows.front();
  row.base_mean = 0.5;
  row.new_mean = 0.502;
  row.change = 0.002;
  row.change_interval = {0.25, 0.75};
  std::string text = format_comparison(comparison, CompareFormat::table);
  EXPECT_NE(text.find("+0.002"), std::string::npos) << text;
  EXPECT_NE(text.find("[+0.250, +0.750]"), std::string::npos) << text;
  EXPECT_EQ(text.find("+0.0020"), std::string::npos) << text;
  EXPECT_EQ(text.find("+0.50"), std::string::npos) << text;  // means have none
  // An end that is not known.
  row.change_interval.upper = std::nan("");
  text = format_comparison(comparison, CompareFormat::table);
  EXPECT_NE(text.find("[+0.250, –]"), std::string::npos) << text;
}

TEST(CompareFormats, JsonHasAllFlips) {
  const json all = json::parse(format_comparison(sample(), CompareFormat::json));
  EXPECT_EQ(all.at("regression_count"), 4);
  EXPECT_EQ(all.at("flips").size(), 20U);
  EXPECT_EQ(all.at("flips")[0].at("before"), "reached_goal");
  EXPECT_EQ(all.at("metrics")[0].at("metric"), "success_rate");
  EXPECT_EQ(all.at("metrics")[0].at("change"), -0.5);
  EXPECT_EQ(all.at("metrics")[0].at("verdict"), "regression");
}

TEST(CompareFormats, JunitIsEscapedAndCounts) {
  const std::string xml = format_comparison(sample(), CompareFormat::junit);
  EXPECT_NE(xml.find("tests=\"7\" failures=\"4\" errors=\"0\" skipped=\"1\""), std::string::npos)
      << xml;
  EXPECT_NE(xml.find("classname=\"&lt;ego &amp; &quot;co&quot;&gt;\" name=\"success_rate\""),
            std::string::npos);
  EXPECT_EQ(xml.find("<ego"), std::string::npos);
}

/// github-action-benchmark: an array of name, unit, value, of which less is better.
TEST(CompareFormats, GithubActionBenchmark) {
  const json all = json::parse(format_comparison(sample(), CompareFormat::github));
  std::vector<std::string> names;
  for (const json& entry : all) {
    EXPECT_TRUE(entry.at("value").is_number());
    EXPECT_TRUE(entry.at("unit").is_string());
    names.push_back(entry.at("name").get<std::string>().substr(15));
  }
  EXPECT_EQ(names, (std::vector<std::string>{"failure_rate", "path_optimality_pct",
                                             "processing_time_ms"}));
  EXPECT_EQ(all[0].at("value"), 0.5);
}

TEST(CompareFormats, ExactComparisons) {
  const TrialTable base = finished_table("a.db", 10, 4);
  TrialTable now = base;
  for (TableTrial& row : now.trials) crash(row);
  ++now.trials[0].flight;
  const ExactComparison comparison = compare_exactly(base, now);
  const std::string text = format_comparison(comparison, CompareFormat::table);
  EXPECT_NE(text.find("outcome reached_goal → collided"), std::string::npos);
  EXPECT_NE(text.find("flight: another trajectory, command or event"), std::string::npos) << text;
  EXPECT_NE(text.find("and 20 trials more: the JSON has all"), std::string::npos) << text;
  EXPECT_EQ(
      json::parse(format_comparison(comparison, CompareFormat::json)).at("differences").size(),
      comparison.differences.size());
  const std::string xml = format_comparison(comparison, CompareFormat::junit);
  EXPECT_NE(xml.find("outcome differs in 40 trials"), std::string::npos);
  EXPECT_THROW(format_comparison(comparison, CompareFormat::github), InputError);
}

}  // namespace
}  // namespace avoidbench
