#include "table/table.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <nlohmann/json.hpp>
#include <sstream>
#include <utility>
#include <vector>

#include "base/random.hpp"
#include "base/visible_text.hpp"
#include "report/parsed_csv.hpp"
#include "report/table_rows.hpp"
#include "table/csv.hpp"
#include "table/table_text.hpp"

namespace avoidbench {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

/// Two planners: one with an odd name, one without a finished trial.
Section section() {
  Table table{.name = "planners", .title = "Planners", .columns = {}, .rows = {}};
  table.columns = {
      {.name = "planner", .header = "planner", .unit = "", .doc = "", .place = Place::key},
      {.name = "trial_count", .header = "trials", .unit = "", .doc = ""},
      {.name = "success_rate", .header = "SR", .unit = "", .doc = "success rate"},
      {.name = "success_rate_lower", .header = "", .unit = "", .doc = "", .place = Place::bound},
      {.name = "success_rate_upper", .header = "", .unit = "", .doc = "", .place = Place::bound},
      {.name = "path_optimality_pct", .header = "PO", .unit = "%", .doc = "excess path"},
      {.name = "path_optimality_pct_count",
       .header = "",
       .unit = "",
       .doc = "",
       .place = Place::machine}};
  const auto row = [&](const std::string& name, std::int64_t trials, double rate, double lower,
                       double upper, double path, std::int64_t count, bool is_best) {
    std::vector<Cell> cells(7);
    cells[0].value = name;
    cells[1].value = trials;
    cells[2].value = rate;
    cells[2].is_best = is_best;
    cells[3].value = lower;
    cells[4].value = upper;
    if (path == path) cells[5].value = path;
    cells[6].value = count;
    table.rows.push_back(cells);
  };
  row("émile, \"2\"|x", 120, 0.875, 0.8, 0.93125, 12.3456789012345678, 105, true);
  row("b", 8, 0.0, 0.0, 0.325, kNaN, 0, false);
  return {.name = "forest",
          .title = "Sweep forest",
          .tables = {table},
          .notes = {{"*", "best"}},
          .warnings = {"few trials"}};
}

TEST(Table, IsAlignedForPeople) {
  const Section sections[] = {section()};
  EXPECT_EQ(format_sections(sections, TableFormat::table),
            "Sweep forest\n"
            "\n"
            "Warning: few trials\n"
            "\n"
            "Planners\n"
            "planner       trials                  SR    PO\n"
            "                                             %\n"
            "────────────  ──────  ──────────────────  ────\n"
            "émile, \"2\"|x     120  0.88* [0.80, 0.93]  12.3\n"
            "b                  8  0.00  [0.00, 0.33]     –\n"
            "\n"
            "SR  success rate\n"
            "PO  excess path\n"
            "*   best\n");
}

TEST(Table, MarkdownEscapesWhatItMust) {
  const Section sections[] = {section()};
  EXPECT_EQ(format_sections(sections, TableFormat::markdown),
            "## Sweep forest\n"
            "\n"
            "> **Warning:** few trials\n"
            "\n"
            "### Planners\n"
            "\n"
            "| planner | trials | SR | PO, % |\n"
            "|:--|--:|--:|--:|\n"
            "| émile, \"2\"\\|x | 120 | 0.88\\* [0.80, 0.93] | 12.3 |\n"
            "| b | 8 | 0.00  [0.00, 0.33] | – |\n"
            "\n"
            "- **SR** success rate\n"
            "- **PO** excess path\n"
            "- **\\*** best\n");
}

TEST(Table, ABriefSectionHasOneLineOfWarningsAndOneParagraphOfLegend) {
  Section brief = section();
  brief.is_brief = true;
  brief.warnings = {"few trials of a: anecdotes", "the sweep is not done (8 of 20 left)", "old"};
  brief.tables[0].columns[2].brief = "success rate";
  brief.footer = "There is more.";
  const Section sections[] = {brief};
  const std::string text = format_sections(sections, TableFormat::table);
  EXPECT_NE(text.find("\n\nWarning: few trials of a; the sweep is not done; old\n\n"),
            std::string::npos)
      << text;
  EXPECT_TRUE(text.ends_with("\n\nSR success rate, * best\nThere is more.\n")) << text;
  const std::string markdown = format_sections(sections, TableFormat::markdown);
  EXPECT_TRUE(markdown.ends_with("\n**SR** success rate, **\\*** best\n\nThere is more.\n"))
      << markdown;
  // Machines get everything, and a single warning is not cut.
  const nlohmann::json all = nlohmann::json::parse(format_sections(sections, TableFormat::json));
  EXPECT_EQ(all[0]["warnings"][1], "the sweep is not done (8 of 20 left)");
  brief.warnings.resize(1);
  const Section one[] = {brief};
  EXPECT_NE(format_sections(one, TableFormat::table).find("few trials of a: anecdotes"),
            std::string::npos);
}

TEST(Table, AColumnWithoutAHeaderIsExplainedByItsName) {
  Section named = section();
  named.tables[0].columns[5].header = "";
  EXPECT_EQ(legend(named)[1].first, "path_optimality_pct");
  const std::string text = format_sections({&named, 1}, TableFormat::markdown);
  EXPECT_NE(text.find("- **path\\_optimality\\_pct** excess path"), std::string::npos) << text;
}

TEST(Table, AnIntervalMayHaveOneEnd) {
  Section open = section();
  open.tables[0].rows[0][4].value = {};
  open.tables[0].rows[1][3].value = open.tables[0].rows[1][4].value = {};
  const std::string text = format_sections({&open, 1}, TableFormat::table);
  EXPECT_NE(text.find("0.88* [0.80, –]"), std::string::npos) << text;
  EXPECT_EQ(text.find("[–"), std::string::npos) << text;
}

TEST(Table, CsvReadsBackWithAllDigits) {
  const Section sections[] = {section()};
  const auto rows = parsed_csv(format_sections(sections, TableFormat::csv));
  ASSERT_EQ(rows.size(), 1U + 2U * 6U);
  const std::vector<std::string> header{"sweep", "table", "planner", "name", "unit", "value"};
  EXPECT_EQ(rows[0], header);
  for (const auto& row : rows) EXPECT_EQ(row.size(), 6U);
  const std::vector<std::string> path{"forest", "planners", "émile, \"2\"|x", "path_optimality_pct",
                                      "%",      rows[5][5]};
  EXPECT_EQ(rows[5], path);
  EXPECT_EQ(std::stod(rows[5][5]), 12.3456789012345678);
  EXPECT_EQ(rows[11][3], "path_optimality_pct");
  EXPECT_EQ(rows[11][5], "");
}

TEST(Table, JsonReadsBack) {
  const Section sections[] = {section(), section()};
  const nlohmann::json all = nlohmann::json::parse(format_sections(sections, TableFormat::json));
  ASSERT_EQ(all.size(), 2U);
  const nlohmann::json& rows = all[0]["tables"]["planners"];
  EXPECT_EQ(rows[0]["planner"], "émile, \"2\"|x");
  EXPECT_EQ(rows[0]["path_optimality_pct"], 12.3456789012345678);
  EXPECT_EQ(rows[0]["trial_count"], 120);
  EXPECT_TRUE(rows[1]["path_optimality_pct"].is_null());
  EXPECT_EQ(all[0]["columns"]["path_optimality_pct"]["unit"], "%");
  EXPECT_EQ(all[0]["warnings"][0], "few trials");
}

TEST(Table, NeverExceedsAHundredColumns) {
  Section wide = section();
  Table& table = wide.tables[0];
  std::string long_doc(300, 'x');
  long_doc.append(" ").append(60, 'y');
  for (int i = 0; i < 20; ++i) {
    table.columns.push_back({.name = "metric",
                             .header = "some_metric_" + std::to_string(i),
                             .unit = "m",
                             .doc = long_doc});
    for (auto& row : table.rows) row.emplace_back().value = 1e5 + i;
  }
  table.rows[0][0].value = std::string(70, 'n');
  wide.warnings.push_back("a " + std::string(90, 'w') +
                          " warning of many words that goes on and on");
  for (auto& column : table.columns)
    column.doc = "word " + column.name + " and so on, and so on, and so on, and so on, and so on";
  const Section sections[] = {wide};
  std::istringstream lines(format_sections(sections, TableFormat::table));
  std::string line, all;
  while (std::getline(lines, line)) {
    EXPECT_LE(display_width(line), 100U) << line;
    all += line + "\n";
  }
  for (int i = 0; i < 20; ++i)
    EXPECT_NE(all.find("some_metric_" + std::to_string(i)), std::string::npos);
  EXPECT_NE(all.find("Planners (continued)"), std::string::npos);
}

TEST(Table, LatexEscapesAndSetsTheBestInBold) {
  Section some = section();
  some.tables[0].columns[5].doc = "path_optimality_pct: excess & more, in % of P_τ";
  some.tables[0].columns[5].unit = "m/s^2";
  const Section sections[] = {some};
  const std::string text = format_sections(sections, TableFormat::latex);
  EXPECT_NE(text.find("\\toprule"), std::string::npos);
  EXPECT_NE(text.find("\\textbf{0.88} [0.80, 0.93]"), std::string::npos) << text;
  // What a column means is for who sets the table: captions of a line, comments for the rest.
  EXPECT_NE(text.find("% PO: excess & more, in % of P_τ\n"), std::string::npos) << text;
  EXPECT_NE(text.find("\\caption{Planners. Bold: significantly best.}"), std::string::npos) << text;
  EXPECT_NE(text.find("m/s$^2$"), std::string::npos) << text;
  EXPECT_NE(text.find("\\label{tab:forest-planners}"), std::string::npos);
  EXPECT_EQ(text.find(" & --"), text.rfind(" & --"));  // one cell is not defined
}

TEST(Table, AStarOfALabelIsNoMarkOfTheBest) {
  Section some = section();
  some.tables[0].rows[0][0].value = std::string("a*b*");
  const std::string marked = format_sections({&some, 1}, TableFormat::latex);
  EXPECT_NE(marked.find("  a*b* & 120 & \\textbf{0.88} [0.80, 0.93]"), std::string::npos) << marked;
  some.tables[0].rows[0][2].is_best = false;
  some.tables[0].rows[1][5].value = std::string("5*");  // a text among numbers
  const std::string plain = format_sections({&some, 1}, TableFormat::latex);
  EXPECT_EQ(plain.find("\\textbf"), std::string::npos) << plain;
  EXPECT_EQ(plain.find("Bold"), std::string::npos) << plain;
  EXPECT_NE(plain.find("5*"), std::string::npos) << plain;
  const std::string coloured =
      format_sections({&some, 1}, TableFormat::table, {.width = 100, .is_coloured = true});
  EXPECT_EQ(coloured.find("\033[32m"), std::string::npos);
}

TEST(Table, ColoursOnlyWhereAsked) {
  const Section sections[] = {section()};
  const std::string plain = format_sections(sections, TableFormat::table);
  EXPECT_EQ(plain.find('\033'), std::string::npos);
  std::string coloured =
      format_sections(sections, TableFormat::table, {.width = 100, .is_coloured = true});
  EXPECT_NE(coloured.find("\033[32m"), std::string::npos);
  while (coloured.find('\033') != std::string::npos) {
    const std::size_t at = coloured.find('\033');
    coloured.erase(at, coloured.find('m', at) + 1 - at);
  }
  EXPECT_EQ(coloured, plain);  // nothing but colours is added
}

TEST(Table, FoldsToANarrowTerminal) {
  const Section sections[] = {section()};
  std::istringstream lines(
      format_sections(sections, TableFormat::table, {.width = 60, .is_coloured = false}));
  int count = 0;
  for (std::string line; std::getline(lines, line); ++count) {
    EXPECT_LE(display_width(line), 60U) << line;
  }
  EXPECT_GT(count, 5);
}

TEST(Table, WidthsAreThoseOfATerminal) {
  EXPECT_EQ(display_width("abc"), 3U);
  EXPECT_EQ(display_width("é–τ"), 3U);
  EXPECT_EQ(display_width("森林"), 4U);
  EXPECT_EQ(display_width("e\u0301"), 1U);
  EXPECT_EQ(display_width("\xff\xc3"), 2U);  // no UTF-8
  EXPECT_EQ(cut_to_width("森林森林", 6), "森林…");
  EXPECT_EQ(cut_to_width("short", 6), "short");
  EXPECT_EQ(wrapped("one two three", 7, 2), "one two\n  three");
  EXPECT_EQ(wrapped("PO   a b", 6, 5), "PO   a\n     b");
}

/// A database of somebody else's may hold anything as a label.
TEST(Table, ShowsControlCharactersToPeopleAndKeepsThemForPrograms) {
  const std::string hostile = "\033]0;x\a=1+2\u202e\n\\input{/etc/passwd} ![p](http://h/p)`";
  Section section = ::avoidbench::section();
  section.title = section.name = hostile;
  section.warnings = {hostile};
  section.notes = {{hostile, hostile}};
  section.tables[0].title = hostile;
  section.tables[0].rows[0][0].value = hostile;
  for (const TableFormat format : {TableFormat::table, TableFormat::markdown, TableFormat::latex}) {
    const std::string text = format_sections({&section, 1}, format);
    EXPECT_EQ(visible_text(text), text) << text;
    EXPECT_EQ(text.find("\n\\input"), std::string::npos) << text;
    EXPECT_EQ(text.find("![p](http"),
              format == TableFormat::markdown ? std::string::npos : text.find("![p](http"));
  }
  const std::string json = format_sections({&section, 1}, TableFormat::json);
  EXPECT_EQ(nlohmann::json::parse(json)[0]["tables"]["planners"][0]["planner"], hostile);
  section.tables[0].rows[0][0].value = "no UTF-8: \xff";
  EXPECT_TRUE(nlohmann::json::accept(format_sections({&section, 1}, TableFormat::json)));
}

/// A list as commands print: texts, a number, something that is not defined.
Table list() {
  Table table = make_list({"name", "summary"});
  table.columns.insert(table.columns.begin() + 1, {.name = "count"});
  table.columns.insert(table.columns.begin() + 2, {.name = "ratio_pct", .decimals = 1});
  table.rows.push_back(make_row("ego", 3, 1.0 / 3.0, "flies, *fast*"));
  table.rows.push_back(
      make_row("b|c", 12, kNaN, std::string(60, 'x') + " " + std::string(30, 'y')));
  return table;
}

TEST(List, IsHeaderAndRowsForPeople) {
  EXPECT_EQ(format_table(list(), TableFormat::table),
            "name  count  ratio_pct  summary\n"
            "ego       3        0.3  flies, *fast*\n"
            "b|c      12          –  " +
                std::string(60, 'x') + "\n" + std::string(24, ' ') + std::string(30, 'y') + "\n");
  const std::string coloured =
      format_table(list(), TableFormat::table, {.width = 100, .is_coloured = true});
  EXPECT_EQ(coloured.find("\033[32m"), std::string::npos);  // a * in a text marks nothing as best
  const std::string markdown = format_table(list(), TableFormat::markdown);
  EXPECT_TRUE(
      markdown.starts_with("| name | count | ratio\\_pct | summary |\n|:--|--:|--:|:--|\n"
                           "| ego | 3 | 0.3 | flies, \\*fast\\* |\n"))
      << markdown;
  const std::string latex = format_table(list(), TableFormat::latex);
  EXPECT_EQ(latex.find("caption"), std::string::npos);
  EXPECT_EQ(latex.find("textbf"), std::string::npos);
}

TEST(List, HasALineARowForPrograms) {
  const auto rows = parsed_csv(format_table(list(), TableFormat::csv));
  ASSERT_EQ(rows.size(), 3U);
  EXPECT_EQ(rows[0], (std::vector<std::string>{"name", "count", "ratio_pct", "summary"}));
  EXPECT_EQ(rows[1], (std::vector<std::string>{"ego", "3", "0.3333333333333333", "flies, *fast*"}));
  EXPECT_EQ(rows[2][2], "");
  const nlohmann::json all = nlohmann::json::parse(format_table(list(), TableFormat::json));
  EXPECT_EQ(all.at(0).at("count"), 3);
  EXPECT_TRUE(all.at(1).at("ratio_pct").is_null());
}

TEST(MakeTable, EndsOfIntervalsStandBehindTheirColumn) {
  const Table table = make_table(
      "t", "T", {{.name = "a"}, {.name = "b_m", .unit = "m", .has_interval = true}, {.name = "c"}});
  ASSERT_EQ(table.columns.size(), 5U);
  EXPECT_EQ(table.columns[2].name, "b_m_lower");
  EXPECT_EQ(table.columns[3].name, "b_m_upper");
  EXPECT_EQ(table.columns[3].unit, "m");
  EXPECT_EQ(table.columns[3].place, Place::bound);
}

/// RFC 4180, read back.
std::string unquoted(std::string_view field) {
  const std::vector<std::vector<std::string>> rows = parsed_csv(std::string(field) + "\r\n");
  return rows.at(0).at(0);
}

TEST(Decimals, AreThoseOfSoManyDigits) {
  const std::vector<std::pair<double, int>> of_three{{0.0, 2},  {1.0, 2},   {9.99, 2},  {10.0, 1},
                                                     {99.9, 1}, {100.0, 0}, {1e6, 0},   {0.99, 3},
                                                     {0.1, 3},  {0.099, 4}, {0.002, 5}, {1e-9, 6}};
  for (const auto& [size, decimals] : of_three) EXPECT_EQ(decimals_for(size, 3), decimals) << size;
  EXPECT_EQ(decimals_for(10.0, 2), 0);
  EXPECT_EQ(decimals_for(5.0, 2), 1);
}

TEST(Csv, NoFieldIsAFormula) {
  EXPECT_EQ(csv_field("=1+2"), "'=1+2");
  EXPECT_EQ(csv_field("@SUM(A1)"), "'@SUM(A1)");
  EXPECT_EQ(csv_field("+cmd|' /C calc'!A0"), "'+cmd|' /C calc'!A0");
  EXPECT_EQ(csv_field("-a,b"), "\"'-a,b\"");
  EXPECT_EQ(csv_field("\t=1"), "'\t=1");
  EXPECT_EQ(csv_field("\r=1"), "\"'\r=1\"");
  EXPECT_EQ(csv_field("'=1"), "''=1");
  EXPECT_EQ(csv_field("+-5"), "'+-5");
  for (const std::string word : {"-5", "+5", "-0.25", "-1e-300", "-inf", "a=b", "ego", "'quoted'",
                                 "O'Neill", "'", "", "1-2"}) {
    EXPECT_EQ(csv_field(word), word);
  }
}

/// Else the readers of tables take its line for a comment.
TEST(Csv, NoFieldBeginsAComment) {
  EXPECT_EQ(csv_field("#1"), "\"#1\"");
  EXPECT_EQ(csv_field("a#1"), "a#1");
  CsvRow row;
  EXPECT_EQ(row.add_words({"#1", "x"}).line(), "\"#1\",x\r\n");
}

TEST(Csv, EveryWordReadsBack) {
  const std::string letters = "'=+-@\t\r\n\",a5. #";
  RandomStream random = stream(1, "csv words");
  int numbers = 0;
  for (int round = 0; round < 20000; ++round) {
    std::string word(random.below(6), ' ');
    for (char& c : word) c = letters[random.below(letters.size())];
    const std::string field = csv_field(word), bare = unquoted(field);
    EXPECT_EQ(text_of_csv_field(bare), word) << field;
    if (bare.find_first_of("=+-@\t\r") == 0) {
      ++numbers;
      EXPECT_NO_THROW(static_cast<void>(std::stod(bare))) << bare;
    }
  }
  EXPECT_GT(numbers, 10);
}

}  // namespace
}  // namespace avoidbench
