#include <algorithm>
#include <iostream>
#include <memory>
#include <set>

#include "base/words.hpp"
#include "commands.hpp"
#include "config/defaults.hpp"
#include "config/explain.hpp"
#include "config/json_schema.hpp"
#include "config/sweep_file.hpp"
#include "metrics/flyable.hpp"
#include "output.hpp"
#include "report/table_rows.hpp"
#include "sweep/listed_missions.hpp"
#include "yaml/built_in_sweeps.hpp"
#include "yaml/includes.hpp"

namespace avoidbench {
namespace {

/// Throws where no mission of a map from a file has a free start and goal, as where the file's up
/// axis is another one. Maps of generators are as their makers meant them, and take longer.
void check_own_maps(const SweepSpec& sweep, const Document& document, const std::string& file) {
  if (!sweep.missions.empty()) return;  // those are looked at one by one
  constexpr std::int64_t kTried = 5;
  constexpr std::size_t kMostFiles = 5;
  std::set<std::string> seen;
  for (const PlannedTrial& planned : expand(sweep)) {
    TrialSpec trial = planned.spec();
    const FileOfMap map = file_of(trial.map);
    if (map.file == nullptr || seen.size() == kMostFiles) return;
    if (!seen.insert(*map.file).second) continue;
    const std::int64_t tried = std::min(kTried, sweep.trials);
    if (placed_missions(trial, tried) > 0) continue;
    const YamlNode* block = document.root.find("maps");
    const YamlNode* place = block == nullptr ? nullptr : block->find("file");
    const std::string message =
        "maps.file: no mission can be flown; " + unflyable_hint(trial, tried);
    throw InputError(place == nullptr ? InputProblem{.file = file, .message = message}
                                      : problem_at(*place, message));
  }
}

/// "quick: 32 trials = 2 settings × 4 missions × 4 planners"
std::string size_text(const SweepSpec& sweep) {
  std::size_t settings = 1;
  for (const Axis& axis : sweep.axes) settings *= axis.values.size();
  const auto missions = static_cast<std::size_t>(sweep.trials);
  std::size_t trials = settings * missions * sweep.planners.size();
  std::string missions_text = counted(missions, "mission");
  if (!sweep.missions.empty()) {  // maps may have fewer than `missions`
    const std::vector<PlannedTrial> planned = expand(sweep);
    check_listed_missions(sweep, planned);
    const bool is_even = planned.size() == trials;
    trials = planned.size();
    missions_text = std::string(is_even ? "" : "up to ") + counted(missions, "listed mission");
  }
  return sweep.name + ": " + counted(trials, "trial") + " = " + counted(settings, "setting") +
         " × " + missions_text + " × " + counted(sweep.planners.size(), "planner") + "\n";
}

void check(const std::string& file, const std::vector<std::string>& overrides, bool resolved) {
  const Document document = read_sweep_document(file, overrides);
  const SweepSpec sweep = sweep_of_document(document);
  for (const std::string& warning : sweep.warnings) std::cerr << "warning: " << warning << "\n";
  check_own_maps(sweep, document, file);
  std::string text = size_text(sweep);
  for (const Axis& axis : sweep.axes) {
    text += "  " + axis.path + ": " + nlohmann::json(axis.values).dump() + "\n";
  }
  for (const PlannerChoice& planner : sweep.planners) text += "  planner " + planner.label + "\n";
  for (const std::string& included : document.included) text += "  included " + included + "\n";
  for (const std::string& option : overrides) text += "  --set " + option + "\n";
  write_text(resolved ? document_text(document) : text, "-");
}

std::string schema_text(const std::string& what) {
  if (what == "vehicle") return vehicle_schema().dump(1) + "\n";
  if (what == "sensor") return sensor_schema().dump(1) + "\n";
  const std::vector<std::string> kinds{"sweep", "part", "flights", "vehicle", "sensor"};
  if (what != "sweep" && what != "part" && what != "flights") {
    throw InputError("no schema of '" + what + "'" + did_you_mean(what, kinds) + "; it is one of " +
                     joined(kinds));
  }
  std::vector<std::string> problems;
  const std::vector<PlannerDescription> planners = list_planners(problems);
  for (const std::string& problem : problems) std::cerr << "warning: " << problem << "\n";
  return (what == "flights" ? flights_schema(planners) : sweep_schema(planners, what == "part"))
             .dump(1) +
         "\n";
}

std::string keys_text(const Explanation& about) {
  Table table = make_list(about.columns);
  for (const std::vector<std::string>& words : about.keys) {
    Row& row = table.rows.emplace_back();
    for (const std::string& word : words) append(row, word);
  }
  return format_table(table, TableFormat::table);
}

/// For people: titles, facts, tables.
std::string explanation_text(const std::string& key) {
  std::vector<std::string> unused;
  std::string text;
  for (const Explanation& about : explain(key, list_planners(unused))) {
    text += (text.empty() ? "" : "\n") + about.title + "\n";
    std::size_t width = 0;
    for (const auto& [name, fact] : about.facts) width = std::max(width, name.size());
    for (const auto& [name, fact] : about.facts) {
      text += "  " + name + std::string(width + 2 - name.size(), ' ') + fact + "\n";
    }
    if (!about.keys.empty()) text += "\n" + keys_text(about);
  }
  return text;
}

/// Name, first sentence, file of each sweep that comes with the program.
void list_sweeps(const OutputOptions& options) {
  Table table = make_list({"name", "file", "what"});
  table.columns[1].place = Place::machine;
  for (const BuiltInSweep& sweep : built_in_sweeps()) {
    const std::size_t end = sweep.doc.find(". ");
    table.rows.push_back(make_row(sweep.name, sweep.file.string(),
                                  sweep.doc.substr(0, end) + (end < sweep.doc.size() ? "." : "")));
  }
  write_table(table, options);
}

}  // namespace

void add_config_command(CLI::App& app) {
  struct Options {
    std::string preset = "sweep";
    std::string output = "-";
    std::string schema = "sweep", schema_output = "-";
    std::string file;
    std::vector<std::string> overrides;
    bool resolved = false;
    std::string key;
    OutputOptions sweeps_output;
  };
  const auto options = std::make_shared<Options>();
  CLI::App* command =
      app.add_subcommand("config", "Print and explain the keys of files; check sweep files");
  command->footer(
      "Examples:\n"
      "  avoidbench config sweeps\n"
      "  avoidbench config defaults > my_sweep.yaml\n"
      "  avoidbench config defaults firefly\n"
      "  avoidbench config explain maps.poisson_radius_m\n"
      "  avoidbench config schema --output sweep.schema.json\n"
      "  avoidbench config check my_sweep.yaml --set maps.poisson_radius_m=3");
  CLI::App* sweeps = command->add_subcommand(
      "sweeps", "The sweeps that come with avoidbench: `avoidbench run NAME` flies one");
  add_output_options(*sweeps, options->sweeps_output);
  sweeps->callback([options] { list_sweeps(options->sweeps_output); });
  CLI::App* defaults = command->add_subcommand(
      "defaults", "Every key of a file at its default, with description and range, as YAML");
  defaults->add_option(
      "what", options->preset,
      "A sweep, or a vehicle or sensor that is built in: " + joined(default_names()));
  add_output_file(*defaults, options->output);
  defaults->callback([options] { write_text(defaults_yaml(options->preset), options->output); });
  CLI::App* schema = command->add_subcommand(
      "schema", "JSON Schema (2020-12) of a kind of file, for completion and checks in editors");
  schema->add_option("what", options->schema,
                     "sweep, part (a file that sweeps include), flights (of `import`), vehicle or "
                     "sensor");
  add_output_file(*schema, options->schema_output);
  schema->footer(
      "Example:\n"
      "  avoidbench config schema --output sweep.schema.json\n"
      "and the first line of a sweep file next to it, for editors with a YAML language server:\n"
      "  # yaml-language-server: $schema=sweep.schema.json");
  schema->callback([options] { write_text(schema_text(options->schema), options->schema_output); });
  CLI::App* check_command = command->add_subcommand(
      "check", "Check a sweep file: print what it would fly, or all its errors");
  add_typed(*check_command, "sweep", options->file, "FILE",
            "Sweep file (YAML); - is standard input")
      ->required();
  add_overrides(*check_command, options->overrides, "maps.poisson_radius_m=3.0");
  check_command->add_flag("--resolved", options->resolved,
                          "Print the file with its includes and --set applied, and the source of "
                          "each value (default: a summary)");
  check_command->footer(
      "Examples:\n"
      "  avoidbench config check my_sweep.yaml\n"
      "  avoidbench config check my_sweep.yaml --set maps.poisson_radius_m=3 --resolved");
  check_command->callback(
      [options] { check(options->file, options->overrides, options->resolved); });
  CLI::App* explain_command = command->add_subcommand(
      "explain",
      "Explain a key: its meaning, range and default, and how to write it, also as an axis");
  add_typed(*explain_command, "key", options->key, "KEY",
            "Path of a key, such as maps.bush_ratio or latency; maps.hall for one generator's "
            "keys; reactive.margin_m for a planner's parameter (default: all top keys)");
  explain_command->footer(
      "Examples:\n"
      "  avoidbench config explain\n"
      "  avoidbench config explain latency\n"
      "  avoidbench config explain maps.poisson_radius_m\n"
      "  avoidbench config explain reactive.margin_m");
  explain_command->callback([options] { write_text(explanation_text(options->key), "-"); });
}

}  // namespace avoidbench
