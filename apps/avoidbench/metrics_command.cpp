#include <memory>

#include "base/input_error.hpp"
#include "commands.hpp"
#include "metrics/metric_table.hpp"
#include "reference_table.hpp"

namespace avoidbench {
namespace {

using Words = std::vector<std::string>;

const Words kColumns{"name",    "of",  "unit",    "better", "trials",
                     "version", "doc", "formula", "source"};

/// One row of each metric of trials, maps and missions, in kColumns' order.
std::vector<Words> all_metrics() {
  std::vector<Words> rows;
  for (const MetricDef& metric : metric_table()) {
    rows.push_back({std::string(metric.name), "trial", std::string(metric.unit),
                    std::string(text(metric.better)), std::string(text(metric.population)),
                    std::to_string(metric.version), std::string(metric.doc),
                    std::string(metric.formula), std::string(metric.source)});
    if (metric.is_measured) rows.back()[6] += " Measured: differs from run to run.";
  }
  for (const MapMetricDef& metric : map_metric_table()) {
    rows.push_back({std::string(metric.name), "map", std::string(metric.unit), "", "", "",
                    std::string(metric.doc), std::string(metric.formula),
                    std::string(metric.source)});
  }
  for (const MissionMetricDef& metric : mission_metric_table()) {
    rows.push_back({std::string(metric.name), "mission", std::string(metric.unit), "", "", "",
                    std::string(metric.doc), std::string(metric.formula),
                    std::string(metric.source)});
  }
  return rows;
}

/// For people: a paragraph a metric, since formulas are too long for a table's column.
std::string paragraphs(const std::vector<Words>& rows) {
  std::string text;
  for (const Words& row : rows) {
    text += (text.empty() ? "" : "\n") + row[0] + (row[2].empty() ? "" : " [" + row[2] + "]") +
            ", of a " + row[1];
    if (row[3] == "less") text += ", less is better";
    if (row[3] == "more") text += ", more is better";
    if (row[4] == "finished") text += ", of finished trials only";
    text += "\n  " + row[6] + "\n";
    if (!row[7].empty()) text += "  = " + row[7] + "\n";
    if (!row[8].empty()) text += "  source: " + row[8] + "\n";
  }
  return text;
}

void print_metrics(const std::string& name, const TableOptions& options) {
  std::vector<Words> rows = all_metrics();
  if (!name.empty()) {
    Words names;
    for (const Words& row : rows) names.push_back(row[0]);
    std::erase_if(rows, [&](const Words& row) { return row[0] != name; });
    if (rows.empty()) {
      throw InputError("no metric '" + name + "'" + did_you_mean(name, names) +
                       "; avoidbench metrics lists them");
    }
  }
  if (options.format == "table") return write_text(paragraphs(rows), options.output);
  write_table({kColumns, rows}, options);
}

}  // namespace

void add_metrics_command(CLI::App& app) {
  struct Options {
    std::string name;
    TableOptions table;
  };
  const auto options = std::make_shared<Options>();
  CLI::App* command =
      app.add_subcommand("metrics", "The metrics of trials and maps: units, formulas, sources");
  command->add_option("name", options->name, "Only this metric (default: all)");
  add_table_options(*command, options->table);
  command->footer(
      "Examples:\n"
      "  avoidbench metrics\n"
      "  avoidbench metrics --format markdown --output metrics.md");
  command->callback([options] { print_metrics(options->name, options->table); });
}

}  // namespace avoidbench
