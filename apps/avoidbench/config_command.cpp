#include <iostream>
#include <memory>

#include "commands.hpp"
#include "config/defaults.hpp"
#include "config/explain.hpp"
#include "config/json_schema.hpp"
#include "config/sweep_file.hpp"
#include "output.hpp"
#include "report/table_rows.hpp"
#include "yaml/includes.hpp"

namespace avoidbench {
namespace {

void check(const std::string& file, const std::vector<std::string>& overrides, bool resolved) {
  const SweepSpec sweep = read_sweep(file, overrides);
  const Document document = read_sweep_document(file, overrides);
  for (const std::string& warning : sweep.warnings) std::cerr << "warning: " << warning << "\n";
  std::size_t settings = 1;
  for (const Axis& axis : sweep.axes) settings *= axis.values.size();
  const auto missions = static_cast<std::size_t>(sweep.trials);
  std::string text =
      sweep.name + ": " + std::to_string(settings * missions * sweep.planners.size()) +
      " trials = " + std::to_string(settings) + " settings × " + std::to_string(missions) +
      " missions × " + std::to_string(sweep.planners.size()) + " planners\n";
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
  const std::vector<std::string> kinds{"sweep", "part", "vehicle", "sensor"};
  if (what != "sweep" && what != "part") {
    throw InputError("no schema of '" + what + "'" + did_you_mean(what, kinds) + "; it is one of " +
                     joined(kinds));
  }
  std::vector<std::string> problems;
  const std::vector<PlannerDescription> planners = list_planners(problems);
  for (const std::string& problem : problems) std::cerr << "warning: " << problem << "\n";
  return sweep_schema(planners, what == "part").dump(1) + "\n";
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
  };
  const auto options = std::make_shared<Options>();
  CLI::App* command =
      app.add_subcommand("config", "Print and explain what files can say; check sweep files");
  command->footer(
      "Examples:\n"
      "  avoidbench config defaults > my_sweep.yaml\n"
      "  avoidbench config defaults firefly\n"
      "  avoidbench config explain maps.poisson_radius_m\n"
      "  avoidbench config schema --output sweep.schema.json\n"
      "  avoidbench config check my_sweep.yaml --set maps.poisson_radius_m=3");
  CLI::App* defaults = command->add_subcommand(
      "defaults", "Everything that a file can say, at its default, with docs and ranges, as YAML");
  defaults
      ->add_option("what", options->preset,
                   "A sweep, or a vehicle or sensor that is built in: " + joined(default_names()))
      ->capture_default_str();
  add_output_file(*defaults, options->output);
  defaults->callback([options] { write_text(defaults_yaml(options->preset), options->output); });
  CLI::App* schema = command->add_subcommand(
      "schema", "JSON Schema (2020-12) of a kind of file: editors complete and check by it");
  schema
      ->add_option("what", options->schema,
                   "sweep, part (a file that sweeps include), vehicle or sensor")
      ->capture_default_str();
  add_output_file(*schema, options->schema_output);
  schema->footer(
      "Example:\n"
      "  avoidbench config schema --output sweep.schema.json\n"
      "and as the first line of a sweep file beside it, for editors with a YAML language server:\n"
      "  # yaml-language-server: $schema=sweep.schema.json");
  schema->callback([options] { write_text(schema_text(options->schema), options->schema_output); });
  CLI::App* check_command = command->add_subcommand(
      "check", "Read a sweep file and print what it would fly, or all that is wrong with it");
  check_command->add_option("sweep", options->file, "Sweep file (YAML)")
      ->required()
      ->type_name("FILE");
  add_overrides(*check_command, options->overrides, "maps.poisson_radius_m=3.0");
  check_command->add_flag("--resolved", options->resolved,
                          "Print the file with what it includes and --set put in, each value with "
                          "where it comes from (default: a summary)");
  check_command->footer(
      "Examples:\n"
      "  avoidbench config check my_sweep.yaml\n"
      "  avoidbench config check my_sweep.yaml --set maps.poisson_radius_m=3 --resolved");
  check_command->callback(
      [options] { check(options->file, options->overrides, options->resolved); });
  CLI::App* explain_command = command->add_subcommand(
      "explain", "What a key means: its range and default, and how to write it, also as an axis");
  explain_command
      ->add_option("key", options->key,
                   "Path of a key, as maps.bush_ratio or latency; maps.hall for one generator's "
                   "keys; reactive.margin_m for a planner's parameter (default: all top keys)")
      ->type_name("KEY");
  explain_command->footer(
      "Examples:\n"
      "  avoidbench config explain\n"
      "  avoidbench config explain latency\n"
      "  avoidbench config explain maps.poisson_radius_m\n"
      "  avoidbench config explain reactive.margin_m");
  explain_command->callback([options] { write_text(explanation_text(options->key), "-"); });
}

}  // namespace avoidbench
