#include <deque>
#include <iostream>
#include <optional>

#include "base/words.hpp"
#include "commands.hpp"
#include "compare/compare_formats.hpp"
#include "compare/reality.hpp"
#include "database_choice.hpp"
#include "output.hpp"
#include "page/comparison_page.hpp"
#include "page_output.hpp"

namespace avoidbench {
namespace {

constexpr int kExitRegression = 1;

struct CompareCommand {
  std::string base, now;
  std::string sweep, planner;
  CompareFormat format = CompareFormat::table;
  std::string output = "-";
  std::string min_effect;
  std::string tolerances_file;
  std::string bless_file, page;
  std::optional<double> page_mb;
  bool is_exact = false, is_sample = false, is_real = false;
  std::vector<std::string> more;  // simulations beside `now`
  bool must_be_complete = false;
  CompareSettings settings;
};

/// A file, or results/NAME.db by its short name.
std::filesystem::path table_file(const std::string& given) {
  const std::filesystem::path path = given;
  return path.has_extension() ? path : database_of(given);
}

void bless(const CompareCommand& command) {
  if (!command.now.empty()) {
    throw InputError("--bless writes the table of one database: give no second one");
  }
  const TrialTable table = read_table(table_file(command.base), command.sweep);
  write_text(csv_of_table(table), command.bless_file);
  std::cerr << command.bless_file << ": " << counted(table.trials.size(), "trial") << " of sweep "
            << table.sweep << "\n";
}

/// Whether the exit code is that of a failed gate.
bool compare_bits(const CompareCommand& command, const TablePair& tables) {
  const ExactComparison comparison = compare_exactly(tables.base, tables.now, command.is_sample);
  write_text(format_comparison(comparison, command.format), command.output);
  return !comparison.differences.empty();
}

/// The databases that the two sides are of; a table has none, and no flights.
void write_comparison_page(const CompareCommand& command, const Comparison& comparison,
                           const TablePair& tables, const std::filesystem::path& base,
                           const std::filesystem::path& now) {
  std::deque<Database> databases;  // they stay where they are
  const auto side_of = [&](const TrialTable& table, const std::filesystem::path& file) {
    const bool is_database = !table.trials.empty() && !table.trials.front().key.empty();
    if (!is_database) return ComparedSide{.table = &table};
    const Database& database = databases.emplace_back(Database::open_for_reading(file));
    return ComparedSide{
        .table = &table,
        .database = {.database = &database,
                     .files = {.folders = {".", file.parent_path()}, .database = file}}};
  };
  const std::size_t trial_count = tables.base.trials.size() + tables.now.trials.size();
  write_page(comparison_page(comparison, side_of(tables.base, base), side_of(tables.now, now),
                             page_origin(), page_room(command.page_mb, trial_count)),
             command.page);
}

bool compare_figures(const CompareCommand& command, const TablePair& tables,
                     const std::filesystem::path& base, const std::filesystem::path& now) {
  CompareSettings settings = command.settings;
  if (!command.tolerances_file.empty()) {
    std::vector<std::string> names;
    for (const MetricRow& metric : tables.now.metrics) names.push_back(metric.name);
    read_tolerances(command.tolerances_file, names, settings);
  }
  if (!command.min_effect.empty()) settings.tolerance = min_effect_from(command.min_effect);
  const Comparison comparison = compare_tables(tables.base, tables.now, settings);
  write_text(format_comparison(comparison, command.format), command.output);
  if (!command.page.empty()) write_comparison_page(command, comparison, tables, base, now);
  const bool is_for_people =
      command.format == CompareFormat::table || command.format == CompareFormat::markdown;
  if (!is_for_people) {
    for (const std::string& warning : comparison.warnings) std::cerr << warning << "\n";
  }
  const bool has_gap =
      std::any_of(comparison.planners.begin(), comparison.planners.end(),
                  [](const PlannerPairs& planner) { return planner.only_base_count > 0; });
  return count_of(comparison, Verdict::regression) > 0 || (command.must_be_complete && has_gap);
}

/// How near simulations come to real flights: no gate.
void compare_with_reality(const CompareCommand& command) {
  if (command.now.empty()) throw InputError("--real: expected REAL TWIN [TWIN…]");
  const Database real = open_checked(database_of(command.base));
  std::vector<Database> simulations;
  simulations.push_back(open_checked(database_of(command.now)));
  for (const std::string& file : command.more) {
    simulations.push_back(open_checked(database_of(file)));
  }
  const OptionError no_format("expected table, markdown or json", "", "format");
  const auto format = enum_from_text<TableFormat>(text(command.format));
  if (!format) throw no_format;
  write_table(reality_table(reality_gaps(real, simulations)),
              {.format = *format, .output = command.output});
}

void compare(const CompareCommand& command) {
  if (!command.page.empty()) check_page(command.page);
  if (command.is_real) return compare_with_reality(command);
  if (!command.more.empty()) {
    throw InputError(command.more.front() + ": more than one set of new results needs --real");
  }
  if (!command.bless_file.empty()) return bless(command);
  if (command.now.empty() && command.planner.empty()) {
    throw InputError(
        "NEW is required: compare BASE NEW, or two planners of one database: compare DB --planner "
        "ego:mine");
  }
  const std::filesystem::path base = table_file(command.base);
  const std::filesystem::path now = command.now.empty() ? base : table_file(command.now);
  TablePair tables = read_tables(base, now, command.sweep);
  if (!command.planner.empty()) tables = of_planners(std::move(tables), command.planner);
  const bool failed = command.is_exact ? compare_bits(command, tables)
                                       : compare_figures(command, tables, base, now);
  if (failed) throw CLI::RuntimeError(kExitRegression);
}

void add_options(CLI::App& command, CompareCommand& options) {
  command
      .add_option("BASE", options.base,
                  "Database, a name for results/NAME.db, or table of trials that --bless wrote")
      ->required();
  command.add_option("NEW", options.now,
                     "The same, for the results to judge (default with --planner: BASE)");
  command.add_option("MORE", options.more, "With --real: further simulations");
  CLI::Option* real = command.add_flag(
      "--real", options.is_real,
      "BASE has real flights (avoidbench import), NEW and MORE simulate them: shows how close each "
      "one comes, without a judgement; exit code 0");
  CLI::Option* planner = command.add_option(
      "--planner", options.planner,
      "Only this planner, by its label; or BASE:NEW, two planners on the same missions");
  command.add_option("--sweep", options.sweep,
                     "Sweep to compare: NAME, NAME@2 for its revision 2, or BASE:NEW where the two "
                     "sides differ (default: the latest revision of the one that both have)");
  add_list(command, "--metrics", options.settings.metrics,
           "Metrics in addition to the success rate, separated by commas, or all (default: path "
           "and energy optimality, average goal velocity, mission progress, least clearance, "
           "processing time)");
  add_number(command, "--alpha", options.settings.alpha, CLI::Range(1e-6, 0.5),
             "Statistical limit: the chance of any false alarm in the comparison");
  command.add_option("--min-effect", options.min_effect,
                     "Practical limit: the smallest change that matters, as a share of the base's "
                     "mean (default: 5%)");
  command.add_option("--tolerances", options.tolerances_file,
                     "YAML file with practical limits by metric: 10%, a number in the metric's "
                     "unit, or ignore; `default` for the others");
  command.add_flag("--gate-measured", options.settings.gates_measured,
                   "Let metrics from the host's clock fail the comparison too");
  command.add_flag("--complete", options.must_be_complete,
                   "Exit code 1 also if NEW lacks trials of BASE");
  CLI::Option* exact =
      command.add_flag("--exact", options.is_exact,
                       "No statistics: outcomes, flights and deterministic metrics must be equal "
                       "to the last bit, and no trial may be missing");
  command
      .add_flag("--sample", options.is_sample,
                "NEW is a part of BASE, such as one --shard of its sweep: missing trials are not a "
                "difference")
      ->needs(exact);
  CLI::Option* bless =
      command
          .add_option("--bless", options.bless_file,
                      "Write BASE's trials to this table, to be committed, and compare nothing")
          ->excludes(planner);
  CLI::Option* page =
      add_typed(command, "--page", options.page, "FILE",
                "Also write a page: one HTML file with the changes, all missions that were lost or "
                "won, and both sides' flights in 3-D (docs/page.md)")
          ->excludes(exact)
          ->excludes(bless)
          ->excludes(real);
  add_page_size(command, page, options.page_mb);
  add_choice(command, "--format", options.format,
             "table, markdown, json, junit or github (github-action-benchmark's "
             "customSmallerIsBetter)");
  add_output_file(command, options.output);
}

}  // namespace

void add_compare_command(CLI::App& app) {
  const auto [command, options] =
      add_command(app, "compare",
                  "Compare new results with a base and report significant regressions", compare);
  add_options(command, options);
  command.footer(
      "Trials are paired by planner label, map and mission. A regression is a change for the worse "
      "that is significant\n"
      "(--alpha, corrected over all tests) and exceeds the tolerance (--min-effect, --tolerances). "
      "Exit codes: 0 no\n"
      "regression, 1 a regression (--exact: a difference), 2 bad input.\n\n"
      "Examples:\n"
      "  avoidbench compare main.db branch.db\n"
      "  avoidbench compare main.db branch.db --page compare.html\n"
      "  avoidbench compare main.db branch.db --format junit --output compare.xml\n"
      "  avoidbench compare main.db --bless baseline.csv         # a table to commit\n"
      "  avoidbench compare baseline.csv branch.db --exact\n"
      "  avoidbench compare paper.csv shard.db --exact --sample  # flown by run --shard 1/100\n"
      "  avoidbench compare r.db r.db --sweep forest@1:forest@2  # two revisions of one sweep\n"
      "  avoidbench compare r.db --planner ego:mine              # two planners, mission by "
      "mission\n"
      "  avoidbench compare --real wood.db wood_twin.db wood_wind.db");
}

}  // namespace avoidbench
