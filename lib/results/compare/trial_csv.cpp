#include <algorithm>
#include <array>
#include <cstdio>
#include <span>
#include <sstream>

#include "base/option_error.hpp"
#include "base/utf8.hpp"
#include "base/visible_text.hpp"
#include "compare/trial_table.hpp"
#include "table/csv.hpp"
#include "table/csv_reader.hpp"

namespace avoidbench {
namespace {

constexpr std::string_view kTitle = "# avoidbench trials, format ";
constexpr std::array<std::string_view, 9> kColumns{"planner", "generator",     "map_seed",
                                                   "setting", "mission_index", "map",
                                                   "mission", "outcome",       "flight"};
using Columns = std::span<const std::string_view>;

/// Format 1 has no flights. Fails for a format that this program does not know.
Columns columns_of(const CsvReader& reader, std::string_view title) {
  const std::string_view format = title.substr(kTitle.size());
  if (format.starts_with("2:")) return kColumns;
  if (format.starts_with("1:")) return Columns(kColumns).first(kColumns.size() - 1);
  reader.fail("a table of another format than 1 and 2: a newer avoidbench wrote it");
}

/// Before the fields of a metric's definition. No field: with its # in quotes it would be none.
constexpr std::string_view kMetric = "# metric,";

/// Digests as 16 digits, whatever their leading zeros.
std::string in_hex(std::uint64_t value) {
  std::array<char, 24> buffer{};
  std::snprintf(buffer.data(), buffer.size(), "%016llx", static_cast<unsigned long long>(value));
  return buffer.data();
}

/// A line before the rows that is no row, with their end of line.
std::string comment_line(const std::string& text) { return text + "\r\n"; }

/// A table has to be read by later programs, whose metrics may have changed: it brings the
/// definitions that comparing needs.
MetricRow metric_of(const CsvReader& reader, const std::vector<std::string>& fields) {
  const auto better = enum_from_text<Better>(fields.size() == 6 ? fields[4] : "");
  const auto population = enum_from_text<Population>(fields.size() == 6 ? fields[5] : "");
  if (!better || !population) {
    reader.fail("a metric is '# metric,NAME,VERSION,UNIT,less|more|neither,all|finished'");
  }
  MetricRow metric;
  metric.name = fields[1];
  metric.version = reader.number<int>(fields[2], "version");
  metric.unit = fields[3];
  metric.better = *better;
  metric.population = *population;
  return metric;
}

/// Comments that are not known are passed over.
void read_comment(const CsvReader& reader, std::string_view line, TrialTable& table) {
  if (line.starts_with("# sweep: ")) table.sweep = line.substr(9);
  if (line.starts_with("# axes:")) {
    std::istringstream paths(std::string(line.substr(7)));
    for (std::string path; paths >> path;) table.axes.push_back(path);
  }
  if (line.starts_with(kMetric)) {
    table.metrics.push_back(metric_of(reader, reader.fields(line)));
  }
}

/// A line of the table; fails, with its place, at the first field that can't be.
TableTrial trial_of(const CsvReader& reader, const std::vector<std::string>& fields,
                    std::size_t column_count, std::size_t metric_count) {
  if (fields.size() != column_count + metric_count) {
    reader.fail(std::to_string(fields.size()) + " fields instead of " +
                std::to_string(column_count + metric_count));
  }
  TableTrial trial;
  // Without the apostrophe that guards spreadsheets from formulas.
  trial.identity = {.planner = std::string(text_of_csv_field(fields[0])),
                    .generator = std::string(text_of_csv_field(fields[1])),
                    .map_seed = reader.number<std::uint64_t>(fields[2], "map_seed"),
                    .setting = std::string(text_of_csv_field(fields[3])),
                    .mission_index = reader.number<std::int64_t>(fields[4], "mission_index")};
  trial.map = reader.number<std::uint64_t>(fields[5], "map", 16);
  trial.mission = reader.number<std::uint64_t>(fields[6], "mission", 16);
  const auto outcome = enum_from_text<Outcome>(fields[7]);
  if (!outcome) {
    reader.fail("outcome: '" + fields[7] + "' is invalid" +
                did_you_mean(fields[7], enum_texts<Outcome>()));
  }
  trial.outcome = *outcome;
  if (column_count == kColumns.size()) {
    trial.flight = reader.number<std::uint64_t>(fields[8], "flight", 16);
  }
  for (std::size_t i = column_count; i < fields.size(); ++i) {
    trial.metrics.push_back(reader.number<double>(fields[i], "metric"));
  }
  return trial;
}

}  // namespace

std::string csv_of_table(const TrialTable& table) {
  std::string title(kTitle), axes = "# axes:";
  title += "2: what `avoidbench compare` needs of each trial, as it wrote it";
  for (const std::string& path : table.axes) axes += " " + path;
  std::string out = comment_line(title);
  // Without the revision: the file is compared by name. A database of somebody else's may have any
  // name, and a comment is one line.
  out += comment_line("# sweep: " + visible_line(table.sweep.substr(0, table.sweep.find('@'))));
  out += comment_line(axes);
  CsvRow header;
  for (const std::string_view column : kColumns) header.add(column);
  for (const MetricRow& metric : table.metrics) {
    // Left out, so that the file does not change from run to run.
    if (metric.is_measured) continue;
    CsvRow definition;
    definition.add_words({metric.name, std::to_string(metric.version), metric.unit});
    definition.add_words({text(metric.better), text(metric.population)});
    out += std::string(kMetric) + definition.line();
    header.add(metric.name);
  }
  out += header.line();
  for (const TableTrial& trial : table.trials) {
    const TrialIdentity& id = trial.identity;
    CsvRow row;
    row.add_words({id.planner, id.generator, std::to_string(id.map_seed), id.setting});
    row.add_words({std::to_string(id.mission_index), in_hex(trial.map), in_hex(trial.mission)});
    row.add_words({std::string(text(trial.outcome)), in_hex(trial.flight)});
    for (std::size_t i = 0; i < table.metrics.size(); ++i) {
      if (!table.metrics[i].is_measured) row.add(trial.metrics[i]);
    }
    out += row.line();
  }
  return out;
}

TrialTable table_of_csv(const std::string& text, const std::string& source) {
  check_utf8(text, source);
  CsvReader reader(text, source, kMetric);
  TrialTable table{.source = source};
  std::string_view line;
  if (!reader.next(line) || !line.starts_with(kTitle)) {
    throw OptionError(
        {.file = source,
         .message = "is neither a database of results nor a table of trials that `avoidbench "
                    "compare` wrote"},
        "", "bless");
  }
  const Columns columns = columns_of(reader, line);
  bool has_header = false;
  while (reader.next(line)) {
    if (line.empty()) continue;
    if (line.starts_with('#')) {
      read_comment(reader, line, table);
    } else if (!has_header) {
      std::vector<std::string> wanted(columns.begin(), columns.end());
      for (const MetricRow& metric : table.metrics) wanted.push_back(metric.name);
      if (reader.fields(line) != wanted) {
        reader.fail("the columns are not those of this format and of the metrics above");
      }
      has_header = true;
    } else {
      table.trials.push_back(
          trial_of(reader, reader.fields(line), columns.size(), table.metrics.size()));
      const std::size_t count = table.trials.size();
      // Pairing and the comparison bit for bit walk through trials in order; an edited file may
      // have lost it.
      if (count > 1 && !(table.trials[count - 2].identity < table.trials[count - 1].identity)) {
        reader.fail("trials are not in order, or this one is listed twice");
      }
    }
  }
  if (table.trials.empty()) refuse_file(source, "has no trials");
  return table;
}

}  // namespace avoidbench
