#pragma once

#include <sqlite3.h>

#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "metrics/metric_table.hpp"

namespace avoidbench {

extern const std::string_view kSchemaSql;  ///< schema.sql, with {metrics} in it
extern const std::string_view kViewsSql;   ///< views.sql

/// The views of views.sql.
inline constexpr std::string_view kViews[] = {"trial_table", "latest_trials", "planner_summary",
                                              "map_summary", "plan_call_table"};

/// `text` with `by` wherever it has `mark`.
std::string with_replaced(std::string text, std::string_view mark, std::string_view by);

/// schema.sql with a column for each of these metrics, whose names are is_column_name().
std::string schema_sql(std::span<const MetricDef> metrics);

/// What a file may hold beside the tables, indices and views of this program.
enum class Extras {
  only_apart,  ///< tables and views of other names; nothing that acts on ours
  none         ///< nothing
};

/// Throws InputError where `schema` ("main" or an attached file's) holds a table, index or view of
/// one of our names that is of another kind, a trigger, or what `extras` does not let it hold.
void check_objects(sqlite3* handle, const std::filesystem::path& path, std::string_view schema,
                   Extras extras);

/// Throws InputError unless each of our tables is there with exactly the columns of schema.sql, in
/// `trials` also one for each name in metric_definitions. The table of add_lacking_table() may be
/// missing.
void check_columns(sqlite3* handle, const std::filesystem::path& path, std::string_view schema);

/// Makes the table that files of older programs lack, empty: in the file, or beside it where that
/// is only read.
void add_lacking_table(sqlite3* handle, const std::filesystem::path& path, bool is_in_file);

bool has_table(sqlite3* handle, const std::filesystem::path& path, std::string_view schema,
               std::string_view name);

/// The columns of our table `table`, in the order of schema.sql; without those of metrics.
const std::vector<std::string>& columns_of(std::string_view table);

/// Whether metrics may be called so: a to z, 0 to 9, _.
bool is_column_name(std::string_view name);

/// `name` as an identifier in SQL.
std::string sql_name(std::string_view name);

}  // namespace avoidbench
