#include "store/schema_check.hpp"

#include <algorithm>
#include <map>
#include <memory>
#include <set>

#include "base/check.hpp"
#include "base/input_error.hpp"
#include "store/statement.hpp"

namespace avoidbench {
namespace {

struct Column {
  std::string name, type, default_value;
  std::int64_t is_required = 0, key_position = 0;
  std::int64_t hidden = 0;  ///< other than 0: generated

  bool operator==(const Column&) const = default;
};

/// Files of older programs lack it: they have no missions of several goals.
constexpr std::string_view kAddedTable = "mission_legs";

struct Table {
  bool is_strict = false, is_without_rowid = false;
  std::vector<Column> columns;
  std::vector<std::string> names;  ///< of the columns
  std::string sql;                 ///< that makes it; of what schema.sql makes
};

/// What schema.sql makes.
struct Expected {
  std::map<std::string, Table, std::less<>> tables;
  std::map<std::string, std::string, std::less<>> indices;  ///< the SQL of each
};

/// By SQLite's own view of it, not by the text that made it.
Table read_table(sqlite3* handle, const std::filesystem::path& path, std::string_view schema,
                 std::string_view name) {
  Table table;
  Statement kind(handle, path,
                 "SELECT strict, wr FROM pragma_table_list WHERE schema = ? AND name = ?");
  kind.bind_text(schema).bind_text(name);
  if (kind.step()) {
    table.is_strict = kind.integer(0) != 0;
    table.is_without_rowid = kind.integer(1) != 0;
  }
  Statement columns(handle, path,
                    "SELECT name, type, dflt_value, \"notnull\", pk, hidden FROM "
                    "pragma_table_xinfo(?, ?) ORDER BY cid");
  columns.bind_text(name).bind_text(schema);
  while (columns.step()) {
    table.columns.push_back({.name = columns.text(0),
                             .type = columns.text(1),
                             .default_value = columns.text(2),
                             .is_required = columns.integer(3),
                             .key_position = columns.integer(4),
                             .hidden = columns.integer(5)});
    table.names.push_back(table.columns.back().name);
  }
  return table;
}

/// schema.sql itself is run in memory and looked at: there is no second description that could lag
/// behind.
Expected made_by_schema() {
  sqlite3* opened = nullptr;
  AB_CHECK(sqlite3_open(":memory:", &opened) == SQLITE_OK);
  const std::unique_ptr<sqlite3, decltype(&sqlite3_close)> handle(opened, sqlite3_close);
  const std::filesystem::path path = ":memory:";
  execute(opened, path, schema_sql({}));
  Expected expected;
  Statement objects(opened, path, "SELECT type, name, sql FROM sqlite_schema WHERE sql NOT NULL");
  while (objects.step()) {
    const std::string name = objects.text(1);
    if (objects.text(0) == "table") {
      Table table = read_table(opened, path, "main", name);
      table.sql = objects.text(2);
      expected.tables.emplace(name, std::move(table));
    } else if (objects.text(0) == "index") {
      expected.indices.emplace(name, objects.text(2));
    }
  }
  return expected;
}

const Expected& expected() {
  static const Expected made = made_by_schema();
  return made;
}

/// A foreign name in a message: not longer than people read.
std::string shown(const std::string& name) {
  constexpr std::size_t kMost = 60;
  std::string text(name, 0, kMost);
  if (name.size() > kMost) text.append("…");
  return text;
}

/// Nothing is repaired or dropped here: it may be the user's own.
[[noreturn]] void refuse_object(const std::filesystem::path& path, const std::string& kind,
                                const std::string& name) {
  refuse_file(path,
              "holds the " + kind + " '" + shown(name) +
                  "', which avoidbench does not make; it is left as it is. If you made it, drop "
                  "it (DROP " +
                  (kind == "table"  ? "TABLE"
                   : kind == "view" ? "VIEW"
                                    : "INDEX or TRIGGER") +
                  ") and try again; else don't trust this file");
}

bool is_view(std::string_view name) {
  return std::find(std::begin(kViews), std::end(kViews), name) != std::end(kViews);
}

/// One row of sqlite_schema.
struct Object {
  std::string type, name, table, sql;
  std::int64_t root_page = 0;
};

/// By name and kind; columns are compared by check_columns().
bool is_ours(const Object& object) {
  const auto& [tables, indices] = expected();
  if (object.type == "table") {
    return tables.contains(object.name) && object.root_page > 0;  // not a virtual one
  }
  if (object.type == "view") return is_view(object.name);
  if (object.type != "index" || !tables.contains(object.table)) return false;
  const auto index = indices.find(object.name);
  if (index != indices.end()) return index->second == object.sql;
  // SQLite's own, of a PRIMARY KEY or UNIQUE.
  return object.sql.empty() && object.name.starts_with("sqlite_autoindex_");
}

/// What ANALYZE leaves, and what SQLite keeps for itself.
bool is_of_sqlite(const Object& object) {
  return object.type == "table" && object.root_page > 0 && object.name.starts_with("sqlite_stat");
}

/// Of a user, and beside our tables: nothing of it acts on them. Triggers and indices of our tables
/// do.
bool is_apart(const Object& object) {
  const auto& tables = expected().tables;
  if (object.type == "index") return !tables.contains(object.table);
  return (object.type == "table" || object.type == "view") && !tables.contains(object.name) &&
         !is_view(object.name);
}

/// What is wrong with the table, or "".
std::string fault_of(const Table& found, const Table& wanted,
                     const std::set<std::string>& metrics) {
  // STRICT: only then types of values can be relied on.
  if (!found.is_strict || found.is_without_rowid != wanted.is_without_rowid) {
    return "is of a different kind than avoidbench creates";
  }
  std::set<std::string> seen;
  for (const Column& column : found.columns) {
    const auto same = std::find_if(wanted.columns.begin(), wanted.columns.end(),
                                   [&](const Column& other) { return other.name == column.name; });
    // All metrics' columns are alike.
    const Column metric{.name = column.name, .type = "REAL", .default_value = {}};
    const bool is_expected = same != wanted.columns.end()
                                 ? column == *same
                                 : metrics.contains(column.name) && column == metric;
    if (!is_expected || !seen.insert(column.name).second) {
      return "has the column '" + shown(column.name) +
             "', which avoidbench does not create like this";
    }
  }
  for (const Column& column : wanted.columns) {
    if (!seen.contains(column.name)) return "lacks the column " + column.name;
  }
  for (const std::string& metric : metrics) {
    if (!seen.contains(metric)) return "lacks the column of metric " + shown(metric);
  }
  return "";
}

/// Metrics' columns are allowed beside those of schema.sql.
void check_table(sqlite3* handle, const std::filesystem::path& path, std::string_view schema,
                 const std::string& name, const std::set<std::string>& metrics) {
  const Table& wanted = expected().tables.find(name)->second;
  const Table found = read_table(handle, path, schema, name);
  if (found.columns.empty()) refuse_file(path, "damaged: it lacks the table " + name);
  const std::string fault = fault_of(found, wanted, metrics);
  if (!fault.empty()) refuse_file(path, "damaged: its table " + name + " " + fault);
}

/// The names in metric_definitions, none of which is a column of `trials` otherwise.
std::set<std::string> metric_names(sqlite3* handle, const std::filesystem::path& path,
                                   std::string_view schema) {
  Statement s(handle, path, "SELECT name FROM " + sql_name(schema) + ".metric_definitions");
  std::set<std::string> names;
  const std::vector<std::string>& own = columns_of("trials");
  while (s.step()) {
    const std::string name = s.text(0);
    if (!is_column_name(name) || std::find(own.begin(), own.end(), name) != own.end()) {
      refuse_file(path, "damaged: table metric_definitions, row '" + shown(name) +
                            "': not the name of a metric");
    }
    names.insert(name);
  }
  return names;
}

}  // namespace

void add_lacking_table(sqlite3* handle, const std::filesystem::path& path, bool is_in_file) {
  if (has_table(handle, path, "main", kAddedTable)) return;
  const std::string& sql = expected().tables.find(kAddedTable)->second.sql;
  execute(handle, path,
          is_in_file ? sql : with_replaced(sql, "CREATE TABLE ", "CREATE TEMP TABLE "));
}

bool has_table(sqlite3* handle, const std::filesystem::path& path, std::string_view schema,
               std::string_view name) {
  return !read_table(handle, path, schema, name).columns.empty();
}

bool is_column_name(std::string_view name) {
  return !name.empty() && std::all_of(name.begin(), name.end(), [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '_';
  });
}

std::string with_replaced(std::string text, std::string_view mark, std::string_view by) {
  for (auto at = text.find(mark); at != std::string::npos; at = text.find(mark, at + by.size())) {
    text.replace(at, mark.size(), by);
  }
  return text;
}

std::string schema_sql(std::span<const MetricDef> metrics) {
  std::string columns;
  for (const MetricDef& metric : metrics) {
    AB_CHECK(is_column_name(metric.name), metric.name);
    columns += "  " + sql_name(metric.name) + " REAL,\n";
  }
  return with_replaced(std::string(kSchemaSql), "{metrics}", columns);
}

std::string sql_name(std::string_view name) {
  std::string text = "\"";
  for (const char c : name) {
    if (c == '"') text += '"';
    text += c;
  }
  return text + '"';
}

const std::vector<std::string>& columns_of(std::string_view table) {
  const auto found = expected().tables.find(table);
  AB_CHECK(found != expected().tables.end(), table);
  return found->second.names;
}

/// What else a file holds could run as soon as it is touched: a trigger, a view that shadows a
/// table, a virtual table.
void check_objects(sqlite3* handle, const std::filesystem::path& path, std::string_view schema,
                   Extras extras) {
  Statement s(
      handle, path,
      "SELECT type, name, tbl_name, sql, rootpage FROM " + sql_name(schema) + ".sqlite_schema");
  while (s.step()) {
    const Object object{.type = s.text(0),
                        .name = s.text(1),
                        .table = s.text(2),
                        .sql = s.text(3),
                        .root_page = s.integer(4)};
    if (is_ours(object) || is_of_sqlite(object)) continue;
    if (extras == Extras::only_apart && is_apart(object)) continue;
    refuse_object(path, object.type, object.name);
  }
}

void check_columns(sqlite3* handle, const std::filesystem::path& path, std::string_view schema) {
  for (const auto& [name, table] : expected().tables) {
    const bool may_lack = name == kAddedTable && !has_table(handle, path, schema, name);
    if (name != "trials" && !may_lack) check_table(handle, path, schema, name, {});
  }
  check_table(handle, path, schema, "trials", metric_names(handle, path, schema));
}

}  // namespace avoidbench
