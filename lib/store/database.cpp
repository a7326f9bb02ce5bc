#include "store/database.hpp"

#include <algorithm>
#include <cctype>

#include "base/check.hpp"
#include "base/input_error.hpp"
#include "store/sql_text.hpp"
#include "store/statement.hpp"

namespace avoidbench {
namespace {

constexpr int kLockTimeout_ms = 10000;

[[noreturn]] void fail(const std::filesystem::path& path, std::string message) {
  throw InputError(InputProblem{.file = path.string(), .message = std::move(message)});
}

/// `path` as a file: URI, for the options that SQLite takes no other way.
std::string file_uri(const std::filesystem::path& path, bool is_immutable) {
  constexpr std::string_view kDigits = "0123456789ABCDEF";
  std::string uri = "file:";
  for (const char c : std::filesystem::absolute(path).string()) {
    const auto byte = static_cast<unsigned char>(c);
    if (std::isalnum(byte) != 0 || c == '/' || c == '.' || c == '-' || c == '_') {
      uri += c;
    } else {
      uri += '%';
      uri += kDigits[byte >> 4U];
      uri += kDigits[byte & 15U];
    }
  }
  return is_immutable ? uri + "?immutable=1" : uri;
}

void check_is_plain_file(const std::filesystem::path& path) {
  std::error_code error;
  const std::filesystem::file_status status = std::filesystem::status(path, error);
  if (std::filesystem::exists(status) && !std::filesystem::is_regular_file(status)) {
    fail(path, std::filesystem::is_directory(status) ? "a folder, not a database file"
                                                     : "not a regular file");
  }
}

bool is_column_name(std::string_view name) {
  return !name.empty() && std::all_of(name.begin(), name.end(), [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '_';
  });
}

MetricRow metric_row(const MetricDef& def) {
  return {.name = std::string(def.name),
          .version = def.version,
          .unit = std::string(def.unit),
          .doc = std::string(def.doc),
          .formula = std::string(def.formula),
          .source = std::string(def.source),
          .better = def.better,
          .population = def.population,
          .is_measured = def.is_measured};
}

std::string with_replaced(std::string text, std::string_view mark, std::string_view by) {
  for (auto at = text.find(mark); at != std::string::npos; at = text.find(mark, at + by.size())) {
    text.replace(at, mark.size(), by);
  }
  return text;
}

/// views.sql with the columns of `metrics`.
std::string views_sql(std::span<const MetricRow> metrics) {
  std::string columns, means;
  for (const MetricRow& metric : metrics) {
    columns += ",\n         t." + metric.name;
    means += ",\n         avg(t." + metric.name + ") AS mean_" + metric.name;
  }
  return with_replaced(with_replaced(std::string(kViewsSql), "{metrics}", columns),
                       "{metric_means}", means);
}

}  // namespace

void Database::Close::operator()(sqlite3* handle) const {
  // A finished database is one file: it can be copied, and read in a folder that can't be written.
  // Where somebody still reads it, it stays in WAL mode, which does no harm.
  if (is_writer) {
    sqlite3_busy_timeout(handle, 0);
    sqlite3_exec(handle, "PRAGMA journal_mode = DELETE", nullptr, nullptr, nullptr);
  }
  sqlite3_close_v2(handle);
}

Database::Database(std::filesystem::path path, std::unique_ptr<sqlite3, Close> handle)
    : path_(std::make_unique<const std::filesystem::path>(std::move(path))),
      handle_(std::move(handle)) {}

Database Database::connect(const std::filesystem::path& path, int flags, bool is_immutable) {
  sqlite3* handle = nullptr;
  const int code = sqlite3_open_v2(file_uri(path, is_immutable).c_str(), &handle,
                                   flags | SQLITE_OPEN_URI, nullptr);
  Database database(path, std::unique_ptr<sqlite3, Close>(handle, Close{.is_writer = false}));
  if (code != SQLITE_OK) throw_sqlite_error(handle, code, path);
  sqlite3_busy_timeout(handle, kLockTimeout_ms);
  return database;
}

Database Database::open_for_run(const std::filesystem::path& path,
                                std::span<const MetricDef> metrics) {
  check_is_plain_file(path);
  Database database = connect(path, SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE, false);
  sqlite3* handle = database.handle();
  database.check_identity();
  if (sqlite3_db_readonly(handle, "main") == 1) {
    throw_sqlite_error(nullptr, SQLITE_READONLY, path);
  }
  database.check_integrity(true);
  // Readers may look while a run writes. FULL: a power cut loses no committed trial either; one
  // fsync a trial is nothing beside its flight.
  execute(handle, path,
          "PRAGMA journal_mode = WAL; PRAGMA synchronous = FULL; PRAGMA foreign_keys = ON;");
  Transaction transaction(handle, path);
  database.create_schema();
  database.bring_metrics(metrics);
  transaction.commit();
  database.handle_.get_deleter().is_writer = true;
  return database;
}

Database Database::open_for_reading(const std::filesystem::path& path) {
  check_is_plain_file(path);
  std::error_code error;
  if (!std::filesystem::exists(path, error)) fail(path, "no such file");
  Database database = connect(path, SQLITE_OPEN_READONLY, false);
  // A database in WAL mode needs files beside it even for reading. Where the folder can't be
  // written and no writer has left any, the file is complete and can be read alone.
  const int code = sqlite3_exec(database.handle(), "SELECT count(*) FROM sqlite_schema", nullptr,
                                nullptr, nullptr);
  const int primary_code = code & 0xff;
  if ((primary_code == SQLITE_CANTOPEN || primary_code == SQLITE_READONLY) &&
      !std::filesystem::exists(path.string() + "-wal", error)) {
    database = connect(path, SQLITE_OPEN_READONLY, true);
  } else if (code != SQLITE_OK) {
    throw_sqlite_error(database.handle(), code, path);
  }
  database.check_identity();
  Statement tables(database.handle(), path, "SELECT count(*) FROM sqlite_schema");
  tables.step();
  if (tables.integer(0) == 0) fail(path, "an empty file: it holds no results");
  if (database.schema_version() < kSchemaVersion) {
    fail(path, "has schema version " + std::to_string(database.schema_version()) +
                   ", this avoidbench reads version " + std::to_string(kSchemaVersion) +
                   ": `avoidbench run` with this --db brings it up");
  }
  database.check_integrity(false);
  // Rows are spread over the whole of a large file: what is mapped into memory is read without a
  // system call each.
  execute(database.handle(), path, "PRAGMA mmap_size = 134217728");
  database.read_metrics();
  return database;
}

void Database::check_identity() const {
  Statement statement(handle(), path(),
                      "SELECT (SELECT count(*) FROM sqlite_schema), "
                      "(SELECT application_id FROM pragma_application_id), "
                      "(SELECT user_version FROM pragma_user_version)");
  statement.step();
  const std::int64_t object_count = statement.integer(0);
  const std::int64_t application_id = statement.integer(1);
  const std::int64_t version = statement.integer(2);
  if (object_count == 0 && application_id == 0) return;  // new
  if (application_id != kApplicationId) {
    fail(path(), "not a database of avoidbench, but of another program; it is left as it is");
  }
  if (version > kSchemaVersion) {
    fail(path(), "made by a newer avoidbench, with schema version " + std::to_string(version) +
                     "; this one knows versions up to " + std::to_string(kSchemaVersion) +
                     ": use an avoidbench with schema version " + std::to_string(version) +
                     " or newer");
  }
}

void Database::check_integrity(bool whole) const {
  // When only reading, or in a large file, the tables that decide: trajectories and plan calls may
  // be gigabytes, and damage in them is seen when they are read.
  constexpr std::uintmax_t kLargeBytes = std::uintmax_t{1} << 28U;
  std::error_code error;
  const std::uintmax_t bytes = std::filesystem::file_size(path(), error);
  const bool is_large = !error && bytes > kLargeBytes;
  const std::vector<std::string> checks =
      whole && !is_large
          ? std::vector<std::string>{"PRAGMA quick_check(1)"}
          : std::vector<std::string>{"PRAGMA quick_check(trials)", "PRAGMA quick_check(missions)",
                                     "PRAGMA quick_check(sweep_trials)"};
  for (const std::string& check : checks) {
    Statement statement(handle(), path(), check);
    statement.step();
    const std::string answer = statement.text(0);
    if (answer != "ok") {
      fail(path(), "damaged (" + answer.substr(0, answer.find('\n')) +
                       "); `sqlite3 FILE .recover` saves what can be read");
    }
  }
}

void Database::create_schema() {
  Statement statement(handle(), path(), "SELECT count(*) FROM sqlite_schema");
  statement.step();
  if (statement.integer(0) == 0) {
    execute(handle(), path(), std::string(kSchemaSql));
    return;
  }
  if (schema_version() < 2) {
    execute(handle(), path(),
            "ALTER TABLE missions ADD COLUMN traversability_obstruction REAL;"
            "ALTER TABLE missions ADD COLUMN view_occlusion REAL;"
            "ALTER TABLE missions ADD COLUMN angle_over_length_1pm REAL;"
            "PRAGMA user_version = 2;");
  }
  if (schema_version() < 3) {
    execute(handle(), path(),
            "ALTER TABLE runs ADD COLUMN shard TEXT NOT NULL DEFAULT '';"
            "ALTER TABLE trials ADD COLUMN wall_time_s REAL;"
            "ALTER TABLE trajectories ADD COLUMN is_packed INTEGER NOT NULL DEFAULT 0 "
            "CHECK (is_packed IN (0, 1));"
            "PRAGMA user_version = 3;");
  }
}

int Database::schema_version() const {
  Statement statement(handle(), path(), "SELECT user_version FROM pragma_user_version");
  statement.step();
  return static_cast<int>(statement.integer(0));
}

void Database::bring_metrics(std::span<const MetricDef> metrics) {
  read_metrics();
  std::vector<MetricRow> wanted;
  for (const MetricDef& def : metrics) wanted.push_back(metric_row(def));

  // Values of two definitions of one metric must never stand in one column.
  std::vector<InputProblem> problems;
  for (const MetricRow& stored : metrics_) {
    const auto same = std::find_if(wanted.begin(), wanted.end(),
                                   [&](const MetricRow& row) { return row.name == stored.name; });
    const std::string holds =
        "holds metric " + stored.name + " in version " + std::to_string(stored.version);
    if (same == wanted.end()) {
      problems.push_back(
          {.file = path().string(),
           .message = holds + ", which this avoidbench does not compute: write to another file"});
    } else if (same->version != stored.version) {
      problems.push_back({.file = path().string(),
                          .message = holds + ", this avoidbench computes version " +
                                     std::to_string(same->version) +
                                     ": the two can't be mixed, write to another file"});
    }
  }
  if (!problems.empty()) throw InputError(problems);

  Statement define(
      handle(), path(),
      "INSERT INTO metric_definitions (name, position, version, unit, doc, formula, "
      "source, better, population, is_measured) VALUES (?,?,?,?,?,?,?,?,?,?) "
      "ON CONFLICT (name) DO UPDATE SET position = excluded.position, doc = excluded.doc, "
      "formula = excluded.formula, source = excluded.source");
  for (std::size_t i = 0; i < wanted.size(); ++i) {
    const MetricRow& row = wanted[i];
    AB_CHECK(is_column_name(row.name), row.name);
    const bool is_new =
        std::none_of(metrics_.begin(), metrics_.end(),
                     [&](const MetricRow& stored) { return stored.name == row.name; });
    if (is_new) execute(handle(), path(), "ALTER TABLE trials ADD COLUMN " + row.name + " REAL");
    define.bind_text(row.name).bind_integer(static_cast<std::int64_t>(i)).bind_integer(row.version);
    define.bind_text(row.unit).bind_text(row.doc).bind_text(row.formula).bind_text(row.source);
    define.bind_text(text(row.better)).bind_text(text(row.population));
    define.bind_integer(row.is_measured ? 1 : 0).run();
  }
  metrics_ = wanted;
  execute(handle(), path(), views_sql(metrics_));
}

void Database::read_metrics() {
  metrics_.clear();
  Statement statement(handle(), path(),
                      "SELECT name, version, unit, doc, formula, source, better, population, "
                      "is_measured FROM metric_definitions ORDER BY position, name");
  while (statement.step()) {
    const auto better = enum_from_text<Better>(statement.text(6));
    const auto population = enum_from_text<Population>(statement.text(7));
    if (!is_column_name(statement.text(0)) || !better || !population) {
      fail(path(), "damaged (metric_definitions)");
    }
    metrics_.push_back({.name = statement.text(0),
                        .version = static_cast<int>(statement.integer(1)),
                        .unit = statement.text(2),
                        .doc = statement.text(3),
                        .formula = statement.text(4),
                        .source = statement.text(5),
                        .better = *better,
                        .population = *population,
                        .is_measured = statement.integer(8) != 0});
  }
}

}  // namespace avoidbench
