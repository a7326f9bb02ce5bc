#include "store/database.hpp"

#include <algorithm>
#include <cctype>
#include <cstring>
#include <thread>

#include "base/check.hpp"
#include "base/input_error.hpp"
#include "store/log_check.hpp"
#include "store/run_lock.hpp"
#include "store/schema_check.hpp"
#include "store/statement.hpp"
#include "store/stored_text.hpp"
#include "store/trial_fields.hpp"

namespace avoidbench {
namespace {

// Where the caller has no patience of its own: a run has, since hours of flights hang on it.
constexpr double kLockTimeout_s = 10.0;

/// `path` as a file: URI, for the options that SQLite takes no other way.
std::string file_uri(const std::filesystem::path& path, std::string_view options) {
  constexpr std::string_view kDigits = "0123456789ABCDEF";
  std::string uri = "file:";
  for (const char c : std::filesystem::absolute(path).string()) {
    const auto byte = static_cast<unsigned char>(c);
    // All else is escaped: ?, # and % have a meaning in a URI.
    if (std::isalnum(byte) != 0 || c == '/' || c == '.' || c == '-' || c == '_') {
      uri += c;
    } else {
      uri += '%';
      uri += kDigits[byte >> 4U];
      uri += kDigits[byte & 15U];
    }
  }
  return uri.append(options);
}

/// SQLite neither locks nor looks for a log.
constexpr std::string_view kImmutable = "?immutable=1";
/// SQLite doesn't lock: for files that nobody can have open.
constexpr std::string_view kUnlocked = "?vfs=unix-none";

/// A file that is not there yet passes.
void check_is_plain_file(const std::filesystem::path& path) {
  std::error_code error;
  const std::filesystem::file_status status = std::filesystem::status(path, error);
  if (std::filesystem::exists(status) && !std::filesystem::is_regular_file(status)) {
    refuse_file(path, std::filesystem::is_directory(status) ? "a folder, not a database file"
                                                            : "not a regular file");
  }
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

/// What the file's sweeps vary. A damaged one is passed over: who reads it says so.
std::vector<std::string> axes_of_file(const Database& db) {
  Statement statement(db.handle(), db.path(),
                      "SELECT sweep, spec_json FROM sweeps ORDER BY sweep, revision");
  statement.rows_of("sweeps");
  std::vector<SweepInfo> sweeps;
  while (statement.step()) {
    const std::string spec_json = statement.free_text(1);
    try {
      stored_sweep(spec_json);
    } catch (const BadText&) {
      continue;
    }
    sweeps.push_back({.name = {}, .spec_json = spec_json});
  }
  return axis_fields(sweeps);
}

/// views.sql with the columns of metrics and axes.
std::string views_sql(const Database& db) {
  std::string columns, means;
  for (const MetricRow& metric : db.metrics()) {
    columns += ",\n         t." + sql_name(metric.name);
    means +=
        ",\n         avg(t." + sql_name(metric.name) + ") AS " + sql_name("mean_" + metric.name);
  }
  const std::string sql = with_replaced(std::string(kViewsSql), "{metrics}", columns);
  return with_replaced(with_replaced(sql, "{metric_means}", means), "{axes}",
                       axis_columns(db, axes_of_file(db)));
}

/// Nothing that a file says may run code, write elsewhere or reach another file.
void harden(sqlite3* handle) {
  // DEFENSIVE: SQL can't write to SQLite's own tables. TRUSTED_SCHEMA off: views and defaults call
  // no function that does something. DQS off: "x" is a name, never a text.
  sqlite3_db_config(handle, SQLITE_DBCONFIG_DEFENSIVE, 1, nullptr);
  sqlite3_db_config(handle, SQLITE_DBCONFIG_TRUSTED_SCHEMA, 0, nullptr);
  sqlite3_db_config(handle, SQLITE_DBCONFIG_ENABLE_TRIGGER, 0, nullptr);
  sqlite3_db_config(handle, SQLITE_DBCONFIG_ENABLE_LOAD_EXTENSION, 0, nullptr);
  sqlite3_db_config(handle, SQLITE_DBCONFIG_DQS_DDL, 0, nullptr);
  sqlite3_db_config(handle, SQLITE_DBCONFIG_DQS_DML, 0, nullptr);
  // No statement of ours attaches another file, except merge and the rescue, which raise this for
  // their own.
  sqlite3_limit(handle, SQLITE_LIMIT_ATTACHED, 0);
  // Damaged cells are found when a page is read, not when they are followed.
  sqlite3_exec(handle, "PRAGMA cell_size_check = ON; PRAGMA temp_store = MEMORY", nullptr, nullptr,
               nullptr);
}

/// The file's own views are not used from here on.
void use_temporary_views_only(sqlite3* handle) {
  sqlite3_db_config(handle, SQLITE_DBCONFIG_ENABLE_VIEW, 0, nullptr);
}

std::int64_t value_of(sqlite3* handle, const std::filesystem::path& path, const std::string& sql) {
  Statement statement(handle, path, sql);
  statement.step();
  return statement.integer(0);
}

std::int64_t object_count(sqlite3* handle, const std::filesystem::path& path) {
  return value_of(handle, path, "SELECT count(*) FROM sqlite_schema");
}

}  // namespace

void Database::Close::operator()(sqlite3* handle) const {
  // A finished database is one file: it can be copied, and read in a folder that can't be written.
  // Where somebody still reads it, it stays in WAL mode, which does no harm; what is committed is
  // in the file as far as readers let it.
  if (is_writer) {
    // Without waiting: nobody who still reads is to hold up the end.
    sqlite3_busy_handler(handle, nullptr, nullptr);
    sqlite3_exec(handle, "ROLLBACK", nullptr, nullptr, nullptr);  // what an exception left open
    sqlite3_exec(handle, "PRAGMA journal_mode = DELETE", nullptr, nullptr, nullptr);
    sqlite3_wal_checkpoint_v2(handle, "main", SQLITE_CHECKPOINT_PASSIVE, nullptr, nullptr);
  }
  sqlite3_close_v2(handle);
}

Database::Database(std::filesystem::path path, std::unique_ptr<sqlite3, Close> handle)
    : path_(std::make_unique<const std::filesystem::path>(std::move(path))),
      wait_(std::make_unique<Wait>()),
      handle_(std::move(handle)) {}

Database::Database(Database&& other) noexcept = default;
Database& Database::operator=(Database&& other) noexcept = default;
Database::~Database() = default;

void Database::close() {
  // In this order: see RunLock.
  handle_.reset();
  lock_.reset();
}

int Database::wait_for_lock(void* context, int count) {
  constexpr int kLongestPause_ms = 100;
  auto& wait = *static_cast<Wait*>(context);
  const auto now = std::chrono::steady_clock::now();
  // SQLite counts its calls for one lock from 0.
  if (count == 0) wait.began = now;
  const double waited_s = std::chrono::duration<double>(now - wait.began).count();
  wait.has_given_up = wait.on_wait ? !wait.on_wait(waited_s) : waited_s >= kLockTimeout_s;
  if (wait.has_given_up) return 0;
  // 1, 2, 4, … 32 ms, then tenths of a second: short locks cost little time, long ones little CPU.
  std::this_thread::sleep_for(std::chrono::milliseconds(count < 6 ? 1 << count : kLongestPause_ms));
  return 1;
}

/// Opens and hardens, and believes nothing yet: what the file holds is checked by the two callers.
Database Database::connect(const std::filesystem::path& path, int flags, std::string_view options,
                           OnWait on_wait) {
  sqlite3* handle = nullptr;
  const std::string uri = file_uri(path, options);
  // Also where it fails there is a handle, which has the message and has to be closed.
  // NOMUTEX: a handle serves one thread, and a lock for each column read is felt in large files.
  const int code =
      sqlite3_open_v2(uri.c_str(), &handle, flags | SQLITE_OPEN_URI | SQLITE_OPEN_NOMUTEX, nullptr);
  Database database(path, std::unique_ptr<sqlite3, Close>(handle, Close{.is_writer = false}));
  if (code != SQLITE_OK) throw_sqlite_error(handle, code, path);
  if (options != kImmutable) check_log(handle, path);
  harden(handle);
  database.uri_ = uri;
  database.wait_->on_wait = std::move(on_wait);
  sqlite3_busy_handler(handle, wait_for_lock, database.wait_.get());
  return database;
}

Database Database::open_for_run(const std::filesystem::path& path,
                                std::span<const MetricDef> metrics, OnWait on_wait) {
  check_is_plain_file(path);
  check_no_lost_log(path);
  Database database =
      connect(path, SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE, "", std::move(on_wait));
  sqlite3* handle = database.handle();
  // First whether it is ours at all: a foreign file is not even locked.
  database.check_identity();
  // SQLite opens what it may only read without a word, and fails at the first write.
  if (sqlite3_db_readonly(handle, "main") == 1) {
    throw_sqlite_error(nullptr, SQLITE_READONLY, path);
  }
  // Before anything is looked at closely: nobody else writes from here on.
  database.lock_ = std::make_unique<RunLock>(path);
  check_objects(handle, path, "main", Extras::only_apart);
  database.check_integrity(true);
  // Readers may look while a run writes. FULL: a power cut loses no committed trial either; one
  // fsync a trial is nothing beside its flight.
  execute(handle, path,
          "PRAGMA journal_mode = WAL; PRAGMA synchronous = FULL; PRAGMA foreign_keys = ON;");
  // Schema and metrics in one transaction: a program that is killed here leaves the file as it was.
  Transaction transaction(handle, path);
  const bool is_new = object_count(handle, path) == 0;
  write_cookie(handle, path, cookie_of_next_run(read_cookie(handle, path), is_new));
  if (is_new) {
    execute(handle, path, schema_sql(metrics));
  } else {
    check_columns(handle, path, "main");
    add_lacking_table(handle, path, true);
  }
  database.bring_metrics(metrics, is_new);
  transaction.commit();
  use_temporary_views_only(handle);
  // From here on it is ours: closing may take its log in.
  database.handle_.get_deleter().is_writer = true;
  return database;
}

Database Database::open_for_reading(const std::filesystem::path& path) {
  check_is_plain_file(path);
  std::error_code error;
  if (!std::filesystem::exists(path, error)) refuse_file(path, "no such file");
  Database database = connect(path, SQLITE_OPEN_READONLY, "", {});
  // The first statement that looks into the file: opening alone reads nothing.
  const int code = sqlite3_exec(database.handle(), "SELECT count(*) FROM sqlite_schema", nullptr,
                                nullptr, nullptr);
  const int primary_code = code & 0xff;
  const bool has_log = std::filesystem::exists(path.string() + "-wal", error);
  const bool has_index = std::filesystem::exists(path.string() + "-shm", error);
  // A database in WAL mode needs files beside it even for reading. Where the folder can't be
  // written and none are there, nobody has it open, and it can be read alone, or with its log.
  if ((primary_code == SQLITE_CANTOPEN || primary_code == SQLITE_READONLY) && !has_index) {
    database = connect(path, SQLITE_OPEN_READONLY, has_log ? kUnlocked : kImmutable, {});
    // The log's index is in memory then.
    execute(database.handle(), path, "PRAGMA locking_mode = EXCLUSIVE");
  } else if (code != SQLITE_OK) {
    throw_sqlite_error(database.handle(), code, path);
  }
  database.check_identity();
  if (object_count(database.handle(), path) == 0) {
    refuse_file(path, "an empty file: it holds no results");
  }
  check_objects(database.handle(), path, "main", Extras::only_apart);
  // From here on names and types of columns can be relied on.
  check_columns(database.handle(), path, "main");
  add_lacking_table(database.handle(), path, false);
  // Rows are spread over the whole of a large file: what is mapped into memory is read without a
  // system call and a copy each.
  execute(database.handle(), path, "PRAGMA mmap_size = 2000000000");
  database.check_integrity(false);
  database.read_metrics();
  database.check_references();
  database.make_views(false);
  use_temporary_views_only(database.handle());
  return database;
}

void Database::checkpoint() {
  if (lock_ == nullptr) return;
  // Passive: what readers still need stays in the log, and nobody is waited for.
  const int code =
      sqlite3_wal_checkpoint_v2(handle(), "main", SQLITE_CHECKPOINT_PASSIVE, nullptr, nullptr);
  require_in_place();
  const int primary_code = code & 0xff;
  if (primary_code == SQLITE_OK || primary_code == SQLITE_BUSY || primary_code == SQLITE_LOCKED) {
    return;
  }
  const int error = sqlite3_system_errno(handle());
  refuse_file(*path_, "can't be written any more (" +
                          std::string(error != 0 ? std::strerror(error) : sqlite3_errstr(code)) +
                          "): the last rows are in " + path_->string() +
                          "-wal, which belongs to it. Free disk space, or make the file writable, "
                          "and run the same command again before you move either");
}

void Database::require_in_place() {
  if (lock_ == nullptr || lock_->is_in_place()) return;
  // The log is still found under the old name: what it holds belongs into the file.
  const int moved =
      sqlite3_wal_checkpoint_v2(handle(), "main", SQLITE_CHECKPOINT_TRUNCATE, nullptr, nullptr);
  std::error_code error;
  const bool is_replaced = std::filesystem::exists(*path_, error);
  if (is_replaced) {  // the log's name belongs to the other file now
    sqlite3_db_config(handle(), SQLITE_DBCONFIG_NO_CKPT_ON_CLOSE, 1, nullptr);
    handle_.get_deleter().is_writer = false;
  }
  const std::string began = std::string("was ") +
                            (is_replaced ? "replaced by another file" : "deleted or moved") +
                            " while it was being written to";
  const std::string place = lock_->place_now().string();
  // It is whole where it is now.
  if (!place.empty() && moved == SQLITE_OK) {
    refuse_file(*path_,
                began + ". All that was committed is in " + place +
                    ": move it back, or name it as the database, and run the same command again");
  }
  const std::string copy = rescued_copy();
  if (copy.empty()) {
    refuse_file(*path_, began + ", and what was committed could not be saved elsewhere");
  }
  refuse_file(*path_, began + ". All that was committed is saved in " + copy +
                          ": name it as the database and run the same command again");
}

std::string Database::rescued_copy() {
  // Earlier rescues stay; a hundred of them are a fault that more copies don't mend.
  constexpr int kMostCopies = 100;
  std::filesystem::path folder = std::filesystem::absolute(*path_).parent_path();
  sqlite3_limit(handle(), SQLITE_LIMIT_ATTACHED, 1);  // VACUUM attaches what it writes
  // Beside the lost file first, then where the user is, then where anybody may write.
  std::vector<std::filesystem::path> places{folder};
  std::error_code none;  // a folder that is gone is no place
  for (std::filesystem::path place :
       {std::filesystem::current_path(none), std::filesystem::temp_directory_path(none)}) {
    if (!place.empty()) places.push_back(std::move(place));
  }
  for (const std::filesystem::path& place : places) {
    for (int i = 1; i <= kMostCopies; ++i) {
      std::filesystem::path copy = place / path_->stem();
      copy += i == 1 ? ".rescued.db" : ".rescued" + std::to_string(i) + ".db";
      std::error_code error;
      if (std::filesystem::exists(copy, error)) continue;
      Statement vacuum(handle(), path(), "VACUUM INTO ?");
      vacuum.bind_text(copy.string());
      try {
        vacuum.run();
        return copy.string();
      } catch (const InputError&) {
        std::filesystem::remove(copy, error);  // half a copy
        // This folder can't be written: the next one.
        break;
      }
    }
  }
  return "";
}

void Database::make_views(bool is_in_file) {
  std::string views = views_sql(*this);
  if (views == views_) return;
  std::string drop_own, drop_temporary;
  for (const std::string_view view : kViews) {
    drop_own += "DROP VIEW IF EXISTS main." + sql_name(view) + ";";
    drop_temporary += "DROP VIEW IF EXISTS temp." + sql_name(view) + ";";
  }
  if (is_in_file) execute(handle(), path(), drop_own + views);
  // What a file's views say is up to who wrote it: a temporary view shadows one of the file's of
  // the same name.
  execute(handle(), path(),
          drop_temporary + with_replaced(views, "CREATE VIEW ", "CREATE TEMP VIEW "));
  views_ = std::move(views);
}

void Database::remake_views() {
  // Each change of the schema counts on in the cookie, and a log has to begin with the very next
  // one of its file.
  const std::uint32_t cookie = read_cookie(handle(), path());
  make_views(true);
  write_cookie(handle(), path(), cookie);
}

void Database::check_identity() const {
  const std::int64_t application_id = value_of(handle(), path(), "PRAGMA application_id");
  if (application_id == 0 && object_count(handle(), path()) == 0) return;  // new
  if (application_id != kApplicationId) {
    refuse_file(path(),
                "not a database of avoidbench, but of another program; it is left as it is");
  }
  const std::int64_t version = value_of(handle(), path(), "PRAGMA user_version");
  if (version == kSchemaVersion) return;
  const std::string own = std::to_string(kSchemaVersion), its = std::to_string(version);
  refuse_file(
      path(),
      "its schema version (PRAGMA user_version) is " + its + "; this avoidbench reads version " +
          own + ": " +
          (version > kSchemaVersion ? "use the newer avoidbench that made it, or fly" : "fly") +
          " its sweep again into another file");
}

void Database::check_integrity(bool whole) const {
  // When only reading, or in a large file, the tables that decide: trajectories and plan calls may
  // be gigabytes, and damage in them is seen when they are read.
  // 256 MiB: reading all of a larger file would be felt at each start.
  constexpr std::uintmax_t kLargeBytes = std::uintmax_t{1} << 28U;
  constexpr std::string_view kThatDecide[] = {
      "trials", "missions",       "mission_legs", "sweep_trials",       "maps",     "planners",
      "sweeps", "sweep_missions", "runs",         "metric_definitions", "what_ifs", "explanations"};
  std::error_code error;
  const std::uintmax_t bytes = std::filesystem::file_size(path(), error);
  const bool is_large = !error && bytes > kLargeBytes;
  std::vector<std::string> checks;
  if (whole && !is_large) {
    checks.emplace_back("PRAGMA quick_check(1)");
  } else {
    for (const std::string_view table : kThatDecide) {
      checks.push_back("PRAGMA quick_check(" + std::string(table) + ")");
    }
  }
  for (const std::string& check : checks) {
    Statement statement(handle(), path(), check);
    statement.step();
    const std::string answer = statement.free_text(0);
    if (answer != "ok") {
      refuse_file(path(), "damaged (" + answer.substr(0, answer.find('\n')) +
                              "); `sqlite3 FILE .recover` saves what can be read");
    }
  }
}

void Database::check_references() const {
  // Every row that readers look up from another one is there.
  for (const std::string table :
       {"trials", "missions", "sweep_trials", "sweep_missions", "what_ifs", "explanations"}) {
    Statement lost(handle(), path(), "PRAGMA foreign_key_check(" + table + ")");
    if (!lost.step()) continue;
    const std::string parent = lost.text(2);
    // Column 1 is the row's id, NULL for tables without; column 2 the table that lacks its row.
    std::string key =
        table == "what_ifs" || table == "explanations" ? "(flown again)" : "(of a sweep)";
    if (!lost.is_null(1)) {
      Statement row(handle(), path(), "SELECT trial_key FROM " + table + " WHERE rowid = ?");
      row.bind_integer(lost.integer(1));
      if (row.step()) key = row.free_text(0);
    }
    throw_damaged(path(), table, key, "its row in " + parent + " is not there");
  }
}

void Database::bring_metrics(std::span<const MetricDef> metrics, bool has_columns) {
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

  // Texts may be improved without a new version; what the values mean may not.
  Statement define(
      handle(), path(),
      "INSERT INTO metric_definitions (name, position, version, unit, doc, formula, "
      "source, better, population, is_measured) VALUES (?,?,?,?,?,?,?,?,?,?) "
      "ON CONFLICT (name) DO UPDATE SET position = excluded.position, doc = excluded.doc, "
      "formula = excluded.formula, source = excluded.source");
  for (std::size_t i = 0; i < wanted.size(); ++i) {
    const MetricRow& row = wanted[i];
    const bool is_new =
        std::none_of(metrics_.begin(), metrics_.end(),
                     [&](const MetricRow& stored) { return stored.name == row.name; });
    if (is_new && !has_columns) {
      // Trials that are there keep NULL: they were not measured so.
      execute(handle(), path(), "ALTER TABLE trials ADD COLUMN " + sql_name(row.name) + " REAL");
    }
    define.bind_text(row.name).bind_integer(static_cast<std::int64_t>(i)).bind_integer(row.version);
    define.bind_text(row.unit).bind_text(row.doc).bind_text(row.formula).bind_text(row.source);
    define.bind_text(text(row.better)).bind_text(text(row.population));
    define.bind_integer(row.is_measured ? 1 : 0).run();
  }
  metrics_ = wanted;
  make_views(true);
}

void Database::read_metrics() {
  metrics_.clear();
  Statement statement(handle(), path(),
                      "SELECT name, version, unit, doc, formula, source, better, population, "
                      "is_measured FROM metric_definitions ORDER BY position, name");
  statement.rows_of("metric_definitions");
  while (statement.step()) {
    const auto better = enum_from_text<Better>(statement.text(6));
    const auto population = enum_from_text<Population>(statement.text(7));
    if (!is_column_name(statement.text(0)) || !better || !population) {
      statement.damaged("this avoidbench does not know such a metric");
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
