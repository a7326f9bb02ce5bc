#include "commands.hpp"
#include "metrics/metric_table.hpp"
#include "output.hpp"
#include "report/table_rows.hpp"

namespace avoidbench {
namespace {

/// One row of each metric of trials, maps and missions.
Table all_metrics() {
  Table table =
      make_list({"name", "of", "unit", "better", "trials", "version", "doc", "formula", "source"});
  for (const MetricDef& metric : metric_table()) {
    const std::string measured = metric.is_measured ? " Measured: differs from run to run." : "";
    table.rows.push_back(make_row(
        metric.name, "trial", metric.unit, text(metric.better), text(metric.population),
        metric.version, std::string(metric.doc) + measured, metric.formula, metric.source));
  }
  const auto add_all = [&](const auto& metrics, const char* of) {
    for (const auto& metric : metrics) {
      table.rows.push_back(make_row(metric.name, of, metric.unit, "", "", Cell{}, metric.doc,
                                    metric.formula, metric.source));
    }
  };
  add_all(map_metric_table(), "map");
  add_all(mission_metric_table(), "mission");
  return table;
}

/// For people: a paragraph a metric, since formulas are too long for a table's column.
std::string paragraphs(const Table& table) {
  std::string text;
  for (const Row& row : table.rows) {
    const auto word = [&](std::size_t i) -> const std::string& {
      return std::get<std::string>(row[i].value);
    };
    text += (text.empty() ? "" : "\n") + word(0) + (word(2).empty() ? "" : " [" + word(2) + "]") +
            ", of a " + word(1);
    if (word(3) == "less") text += ", less is better";
    if (word(3) == "more") text += ", more is better";
    if (word(4) == "finished") text += ", of finished trials only";
    text += "\n  " + word(6) + "\n";
    if (!word(7).empty()) text += "  = " + word(7) + "\n";
    if (!word(8).empty()) text += "  source: " + word(8) + "\n";
  }
  return text;
}

void print_metrics(const std::string& name, const OutputOptions& options) {
  Table table = all_metrics();
  if (!name.empty()) {
    std::vector<std::string> names;
    for (const Row& row : table.rows) names.push_back(std::get<std::string>(row[0].value));
    std::erase_if(table.rows, [&](const Row& row) { return row[0].value != TableValue(name); });
    if (table.rows.empty()) {
      throw InputError("no metric '" + name + "'" + did_you_mean(name, names) +
                       "; avoidbench metrics lists them");
    }
  }
  options.is_for_people() ? write_text(paragraphs(table), options.output)
                          : write_table(table, options);
}

}  // namespace

void add_metrics_command(CLI::App& app) {
  struct Options {
    std::string name;
    OutputOptions output;
  };
  const auto [command, options] = add_command<Options>(
      app, "metrics", "The metrics of trials and maps: units, formulas, sources",
      [](const Options& asked) { print_metrics(asked.name, asked.output); });
  command.add_option("name", options.name, "Only this metric (default: all)");
  add_output_options(command, options.output);
  command.footer(
      "Examples:\n"
      "  avoidbench metrics\n"
      "  avoidbench metrics --format markdown --output metrics.md");
}

}  // namespace avoidbench
