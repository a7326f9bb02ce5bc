#include "export/export_trials.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <optional>

#include "base/check.hpp"
#include "base/option_error.hpp"
#include "base/words.hpp"
#include "maps/map_spec.hpp"
#include "report/selection.hpp"
#include "store/record_format.hpp"
#include "store/trial_fields.hpp"
#include "store/trial_table.hpp"
#include "table/csv.hpp"

namespace avoidbench {
namespace {

using TrialValues = std::vector<TableValue>;

/// How TrialTableReader orders rows within a file: merging relies on it.
constexpr std::string_view kOrder[] = {"sweep",   "revision",      "planner",  "planner_key",
                                       "map_key", "mission_index", "trial_key"};

/// The positions of kOrder among the columns.
std::vector<std::size_t> order_of(const std::vector<std::string>& columns) {
  std::vector<std::size_t> order;
  for (const std::string_view name : kOrder) {
    order.push_back(place_of(std::string(name), columns));
  }
  return order;
}

/// Negative, 0 or positive as row `a` stands before, beside or after row `b`.
int compared(const TrialValues& a, const TrialValues& b, const std::vector<std::size_t>& order) {
  for (const std::size_t i : order) {
    if (a[i] < b[i]) return -1;
    if (b[i] < a[i]) return 1;
  }
  return 0;
}

/// Rows of several databases stand in one table: they must mean the same, column by column.
void check_same_columns(const std::vector<std::string>& first,
                        const std::vector<std::string>& columns, const Database& database) {
  if (columns == first) return;
  std::string difference = "in another order";
  for (const std::string& name : columns) {
    if (!contains(first, name)) difference = "with " + name;
  }
  for (const std::string& name : first) {
    if (!contains(columns, name)) difference = "without " + name;
  }
  refuse_file(database.path(), "has other columns than the first database (" + difference +
                                   "): export it by itself, or merge the two");
}

std::string quoted(const std::string& word) {
  return nlohmann::json(word).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

/// NaN and infinity are null.
std::string json_text(const TableValue& value) {
  if (const auto* word = std::get_if<std::string>(&value)) return quoted(*word);
  const auto* number = std::get_if<double>(&value);
  const std::string text = number != nullptr && std::isinf(*number) ? "" : text_of(value);
  return text.empty() ? "null" : text;
}

std::string csv_line(const TrialValues& row) {
  CsvRow line;
  for (const TableValue& value : row) line.add_value(value);
  return line.line();
}

/// JSON Lines: an object a row.
std::string json_line(const std::vector<std::string>& columns, const TrialValues& row) {
  std::string line = "{";
  for (std::size_t i = 0; i < row.size(); ++i) {
    line += (i == 0 ? "" : ",") + quoted(columns[i]) + ":" + json_text(row[i]);
  }
  return line + "}\n";
}

/// The rows of all these files in order, each once.
class MergedRows {
 public:
  MergedRows(std::vector<TrialTableReader> readers, const std::vector<std::string>& columns)
      : readers_(std::move(readers)), order_(order_of(columns)) {
    // Each reader stands on its next row; one without any goes.
    std::erase_if(readers_, [](TrialTableReader& reader) { return !reader.next(); });
  }

  /// The next row; nothing at the end.
  std::optional<TrialValues> next() {
    while (!readers_.empty()) {
      // The files' rows are in order: the least of their next rows is the next one.
      const auto least =
          std::min_element(readers_.begin(), readers_.end(),
                           [&](const TrialTableReader& a, const TrialTableReader& b) {
                             return compared(a.row(), b.row(), order_) < 0;
                           });
      TrialValues row = least->row();
      if (!least->next()) readers_.erase(least);
      // The same trial in two databases: in order, the two adjoin.
      if (!last_.empty() && compared(last_, row, order_) == 0) continue;
      last_ = row;
      return row;
    }
    return std::nullopt;
  }

 private:
  std::vector<TrialTableReader> readers_;
  std::vector<std::size_t> order_;
  TrialValues last_;
};

/// The column of this name.
std::size_t column_of(const std::string& name, const std::vector<std::string>& columns) {
  const auto column = place_in(columns, name);
  if (!column) {
    throw OptionError(name + ": no column of the table" + did_you_mean(name, columns), "sort");
  }
  return *column;
}

/// The rows that are wanted, in the order of column `sorted` or as they come, each given to `take`.
template <class Take>
void take_rows(MergedRows& rows, std::optional<std::size_t> sorted,
               const std::vector<MetricRow>& metrics, const TrialOrder& trial_order, Take take) {
  std::size_t left = trial_order.limit.value_or(std::numeric_limits<std::size_t>::max());
  if (!sorted) {
    for (std::optional<TrialValues> row = rows.next(); row && left > 0; row = rows.next()) {
      take(*row);
      --left;
    }
    return;
  }
  // Sorting takes all rows in memory; without it, one is enough.
  std::vector<TrialValues> all;
  std::vector<TableValue> values;
  for (std::optional<TrialValues> row = rows.next(); row; row = rows.next()) {
    values.push_back((*row)[*sorted]);
    all.push_back(std::move(*row));
  }
  for (const std::size_t place : worst_first(values, better_of(trial_order.field, metrics))) {
    if (left-- == 0) return;
    take(all[place]);
  }
}

/// Columns that would mean nothing: fields of obstacles where every map comes from a file, and the
/// ids of trials of several files.
std::vector<std::string> columns_left_out(std::span<const Database> databases,
                                          const std::vector<std::vector<SweepInfo>>& sweeps) {
  std::size_t file_count = 0;
  bool are_from_files = true;
  for (std::size_t i = 0; i < databases.size(); ++i) {
    if (sweeps[i].empty()) continue;
    ++file_count;
    for (const std::string& generator : generators_of(databases[i], sweeps[i])) {
      are_from_files = are_from_files && is_from_file(generator);
    }
  }
  std::vector<std::string> left_out;
  if (are_from_files) left_out = {"relative_gap_size", "obstacle_density_1pm2"};
  if (file_count > 1) left_out.emplace_back("trial_id");
  return left_out;
}

}  // namespace

void export_trials(std::span<const Database> databases, std::string_view wanted, TrialFormat format,
                   const std::function<void(const std::string&)>& write,
                   const TrialOrder& trial_order) {
  // By database: those of the sweep that is wanted, which a database may lack.
  const std::vector<std::vector<SweepInfo>> sweeps = chosen_sweeps(databases, wanted);
  std::vector<SweepInfo> all_sweeps;
  for (const auto& some : sweeps) all_sweeps.insert(all_sweeps.end(), some.begin(), some.end());
  const std::vector<std::string> axes = axis_fields(all_sweeps);
  std::vector<TrialTableReader> readers;
  const Database* first = nullptr;
  for (std::size_t i = 0; i < databases.size(); ++i) {
    if (sweeps[i].empty()) continue;
    if (first == nullptr) first = &databases[i];
    // The axes of all sweeps are columns in each, so that the columns are the same.
    readers.emplace_back(databases[i], sweeps[i], axes);
    check_same_columns(readers.front().columns(), readers.back().columns(), databases[i]);
  }
  const std::vector<std::string> left_out = columns_left_out(databases, sweeps);
  const std::vector<std::string> columns = readers.front().columns();
  std::vector<std::size_t> shown;
  std::vector<std::string> names;
  CsvRow header;
  for (std::size_t i = 0; i < columns.size(); ++i) {
    if (contains(left_out, columns[i])) continue;
    shown.push_back(i);
    names.push_back(columns[i]);
    header.add(columns[i]);
  }
  // Among all columns: one may sort by what is not shown.
  std::optional<std::size_t> sorted;
  if (!trial_order.field.empty()) sorted = column_of(trial_order.field, columns);
  if (format == TrialFormat::csv) write(header.line());
  MergedRows rows(std::move(readers), columns);
  take_rows(rows, sorted, first->metrics(), trial_order, [&](const TrialValues& row) {
    TrialValues cells;
    for (const std::size_t i : shown) cells.push_back(row[i]);
    write(format == TrialFormat::csv ? csv_line(cells) : json_line(names, cells));
  });
}

}  // namespace avoidbench
