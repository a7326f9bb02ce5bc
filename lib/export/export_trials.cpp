#include "export/export_trials.hpp"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>

#include "base/check.hpp"
#include "base/input_error.hpp"
#include "report/sweep_choice.hpp"
#include "store/record_format.hpp"
#include "store/trial_table.hpp"
#include "table/csv.hpp"
#include "text/number_text.hpp"

namespace avoidbench {
namespace {

using Row = std::vector<TableValue>;

constexpr std::string_view kOrder[] = {"sweep",   "revision",      "planner",  "planner_key",
                                       "map_key", "mission_index", "trial_key"};

/// The positions of kOrder among the columns.
std::vector<std::size_t> order_of(const std::vector<std::string>& columns) {
  std::vector<std::size_t> order;
  for (const std::string_view name : kOrder) {
    const auto at = std::find(columns.begin(), columns.end(), name);
    AB_CHECK(at != columns.end(), name);
    order.push_back(static_cast<std::size_t>(at - columns.begin()));
  }
  return order;
}

/// Negative, 0 or positive as row `a` stands before, beside or after row `b`.
int compared(const Row& a, const Row& b, const std::vector<std::size_t>& order) {
  for (const std::size_t i : order) {
    if (a[i] < b[i]) return -1;
    if (b[i] < a[i]) return 1;
  }
  return 0;
}

void check_same_columns(const std::vector<std::string>& first,
                        const std::vector<std::string>& columns, const Database& database) {
  if (columns == first) return;
  std::string difference = "in another order";
  for (const std::string& name : columns) {
    if (std::find(first.begin(), first.end(), name) == first.end()) difference = "with " + name;
  }
  for (const std::string& name : first) {
    if (std::find(columns.begin(), columns.end(), name) == columns.end()) {
      difference = "without " + name;
    }
  }
  throw InputError({.file = database.path().string(),
                    .message = "has other columns than the first database (" + difference +
                               "): export it by itself, or merge the two"});
}

std::string quoted(const std::string& word) {
  return nlohmann::json(word).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

std::string json_text(const TableValue& value) {
  if (const auto* word = std::get_if<std::string>(&value)) return quoted(*word);
  if (const auto* count = std::get_if<std::int64_t>(&value)) return std::to_string(*count);
  if (const auto* seed = std::get_if<std::uint64_t>(&value)) return std::to_string(*seed);
  const auto* number = std::get_if<double>(&value);
  return number == nullptr || !std::isfinite(*number) ? "null" : shortest(*number);
}

std::string csv_line(const Row& row) {
  CsvRow line;
  for (const TableValue& value : row) line.add_value(value);
  return line.line();
}

std::string json_line(const std::vector<std::string>& columns, const Row& row) {
  std::string line = "{";
  for (std::size_t i = 0; i < row.size(); ++i) {
    line += (i == 0 ? "" : ",") + quoted(columns[i]) + ":" + json_text(row[i]);
  }
  return line + "}\n";
}

std::string header(const std::vector<std::string>& columns) {
  CsvRow line;
  for (const std::string& name : columns) line.add(name);
  return line.line();
}

}  // namespace

void export_trials(std::span<const Database> databases, std::string_view wanted, TrialFormat format,
                   const std::function<void(const std::string&)>& write) {
  const std::vector<std::vector<SweepInfo>> sweeps = chosen_sweeps(databases, wanted);
  std::vector<TrialTableReader> readers;
  for (std::size_t i = 0; i < databases.size(); ++i) {
    if (sweeps[i].empty()) continue;
    readers.emplace_back(databases[i], sweeps[i]);
    check_same_columns(readers.front().columns(), readers.back().columns(), databases[i]);
  }
  const std::vector<std::string> columns = readers.front().columns();
  const std::vector<std::size_t> order = order_of(columns);
  if (format == TrialFormat::csv) write(header(columns));

  // The files' rows are in order: the least of their next rows is the next one.
  std::erase_if(readers, [](TrialTableReader& reader) { return !reader.next(); });
  Row last;
  while (!readers.empty()) {
    const auto least = std::min_element(readers.begin(), readers.end(),
                                        [&](const TrialTableReader& a, const TrialTableReader& b) {
                                          return compared(a.row(), b.row(), order) < 0;
                                        });
    const Row& row = least->row();
    if (last.empty() || compared(last, row, order) != 0) {
      write(format == TrialFormat::csv ? csv_line(row) : json_line(columns, row));
      last = row;
    }
    if (!least->next()) readers.erase(least);
  }
}

}  // namespace avoidbench
