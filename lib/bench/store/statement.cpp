#include "store/statement.hpp"

#include <cmath>
#include <limits>

#include "base/check.hpp"
#include "base/input_error.hpp"
#include "store/log_check.hpp"
#include "store/stored_text.hpp"

namespace avoidbench {
namespace {

/// What a user can do about it, where SQLite's message says only what happened.
std::string meaning(int primary_code, const std::string& message) {
  switch (primary_code) {
    case SQLITE_FULL:
      return "no space left on its disk. Every trial committed before is kept: free some space and "
             "run the same command again";
    case SQLITE_IOERR:
      return "reading or writing failed (" + message +
             "). Every trial committed before is kept: check the disk and run the same command "
             "again";
    case SQLITE_BUSY:
    case SQLITE_LOCKED:
      return "locked by another program that is writing to it; wait until that has ended";
    case SQLITE_READONLY:
      return "can't be written: the file or its folder is read-only";
    case SQLITE_CANTOPEN:
      return "can't be opened (" + message + "): check that its folder exists and may be written";
    case SQLITE_PERM:
    case SQLITE_AUTH:
      return "no permission to open it";
    case SQLITE_NOTADB:
      return "not a database of avoidbench: it is not an SQLite file";
    case SQLITE_CORRUPT:
      return "damaged (" + message + "); `sqlite3 FILE .recover` saves what can be read";
    case SQLITE_CONSTRAINT:
      return "damaged: its rows contradict each other (" + message + ")";
    default:
      return message;
  }
}

/// Throws where a text that SQL took for JSON is none.
void find_bad_json(sqlite3* handle, const std::filesystem::path& path) {
  struct Place {
    const char *table, *key, *column;
  };
  constexpr Place kPlaces[] = {{"trials", "trial_key", "spec_json"},
                               {"maps", "map_key", "spec_json"},
                               {"sweeps", "sweep", "spec_json"},
                               {"planners", "planner_key", "parameters_json"},
                               {"plan_calls", "trial_key", "calls_json"}};
  for (const Place& place : kPlaces) {
    Statement s(handle, path,
                std::string("SELECT ") + place.key + " FROM " + place.table +
                    " WHERE NOT json_valid(" + place.column + ") LIMIT 1");
    if (s.step())
      throw_damaged(path, place.table, s.free_text(0), std::string(place.column) + " is not JSON");
  }
}

}  // namespace

void throw_sqlite_error(sqlite3* handle, int code, const std::filesystem::path& path) {
  const std::string message = handle != nullptr ? sqlite3_errmsg(handle) : sqlite3_errstr(code);
  // The lower byte; the rest says more precisely what SQLite did.
  const int primary_code = code & 0xff;
  // SQLite was called wrongly: our own error, not the file's.
  AB_CHECK(primary_code != SQLITE_MISUSE, path, message);
  // SQL does not say in which row.
  if (handle != nullptr && message == "malformed JSON") find_bad_json(handle, path);
  throw InputError(InputProblem{.file = path.string(), .message = meaning(primary_code, message)});
}

void execute(sqlite3* handle, const std::filesystem::path& path, const std::string& sql) {
  const int code = sqlite3_exec(handle, sql.c_str(), nullptr, nullptr, nullptr);
  if (code != SQLITE_OK) throw_sqlite_error(handle, code, path);
}

Statement::Statement(sqlite3* handle, const std::filesystem::path& path, std::string_view sql)
    : handle_(handle), path_(path) {
  check(sqlite3_prepare_v2(handle, sql.data(), static_cast<int>(sql.size()), &statement_, nullptr));
}

Statement::~Statement() { sqlite3_finalize(statement_); }

void Statement::check(int code) const {
  if (code != SQLITE_OK) throw_sqlite_error(handle_, code, path_);
}

Statement& Statement::rows_of(std::string_view table, int key_column) {
  table_ = table;
  key_column_ = key_column;
  return *this;
}

void Statement::damaged(std::string_view what) const {
  throw_damaged(path_, table_.empty() ? "of a query" : table_, free_text(key_column_), what);
}

void Statement::wrong_type(int column, std::string_view wanted) const {
  damaged(as_utf8(column_name(column)) + " is not " + std::string(wanted));
}

Statement& Statement::bind_text(std::string_view value) {
  // Reasons come from planners: any bytes.
  if (!is_utf8(value)) return bind_text(as_utf8(value));
  // A null pointer would be NULL.
  const char* data = value.empty() ? "" : value.data();
  // TRANSIENT: SQLite copies it, since callers pass what ends before the statement runs.
  check(sqlite3_bind_text64(statement_, ++bound_count_, data, value.size(), SQLITE_TRANSIENT,
                            SQLITE_UTF8));
  return *this;
}

Statement& Statement::bind_integer(std::int64_t value) {
  check(sqlite3_bind_int64(statement_, ++bound_count_, value));
  return *this;
}

Statement& Statement::bind_real(double value) {
  ++bound_count_;
  // SQL has no NaN.
  check(std::isnan(value) ? sqlite3_bind_null(statement_, bound_count_)
                          : sqlite3_bind_double(statement_, bound_count_, value));
  return *this;
}

Statement& Statement::bind_blob(std::span<const std::byte> value) {
  ++bound_count_;
  // As above: an empty blob is not NULL.
  check(value.empty() ? sqlite3_bind_zeroblob(statement_, bound_count_, 0)
                      : sqlite3_bind_blob64(statement_, bound_count_, value.data(), value.size(),
                                            SQLITE_TRANSIENT));
  return *this;
}

bool Statement::step() {
  const int code = sqlite3_step(statement_);
  if (code == SQLITE_ROW) return true;
  if (code != SQLITE_DONE) throw_sqlite_error(handle_, code, path_);
  return false;
}

void Statement::run() {
  while (step()) {
  }
  reset();
}

Statement& Statement::reset() {
  // Its code is that of the last step, which has been told.
  sqlite3_reset(statement_);
  sqlite3_clear_bindings(statement_);
  bound_count_ = 0;
  return *this;
}

std::string Statement::text(int column) const {
  // The type is asked before the value, which SQLite would convert.
  const int type = sqlite3_column_type(statement_, column);
  if (type == SQLITE_NULL) return "";
  if (type != SQLITE_TEXT) wrong_type(column, "text");
  const std::span<const std::byte> bytes = blob(column);  // text as bytes: no zero ends it early
  const std::string_view value(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  if (!is_utf8(value)) wrong_type(column, "UTF-8");
  return std::string(value);
}

std::string Statement::free_text(int column) const {
  const std::span<const std::byte> bytes = blob(column);
  return as_utf8({reinterpret_cast<const char*>(bytes.data()), bytes.size()});
}

std::int64_t Statement::integer(int column) const {
  if (sqlite3_column_type(statement_, column) != SQLITE_INTEGER) {
    wrong_type(column, "a whole number");
  }
  return sqlite3_column_int64(statement_, column);
}

double Statement::real(int column) const {
  const int type = sqlite3_column_type(statement_, column);
  if (type == SQLITE_NULL) return std::numeric_limits<double>::quiet_NaN();
  if (type != SQLITE_FLOAT && type != SQLITE_INTEGER) wrong_type(column, "a number");
  return sqlite3_column_double(statement_, column);
}

bool Statement::is_null(int column) const {
  return sqlite3_column_type(statement_, column) == SQLITE_NULL;
}

std::span<const std::byte> Statement::blob(int column) const {
  const void* data = sqlite3_column_blob(statement_, column);
  const int size = sqlite3_column_bytes(statement_, column);
  return {static_cast<const std::byte*>(data), static_cast<std::size_t>(size)};
}

int Statement::column_count() const { return sqlite3_column_count(statement_); }

std::string Statement::column_name(int column) const {
  const char* name = sqlite3_column_name(statement_, column);
  return name == nullptr ? std::string() : std::string(name);
}

TableValue Statement::value(int column) const {
  switch (sqlite3_column_type(statement_, column)) {
    case SQLITE_INTEGER:
      return integer(column);
    case SQLITE_FLOAT:
      return real(column);
    case SQLITE_TEXT:
      return free_text(column);
    default:
      return std::monostate{};
  }
}

/// Sizes and types are part of it, so that no two rows give the same bytes.
void Statement::append_value(std::string_view name, int column, std::string& bytes) const {
  const auto append = [&bytes](const auto& number) {
    bytes.append(reinterpret_cast<const char*>(&number), sizeof number);
  };
  const auto append_text = [&](std::string_view text) {
    append(static_cast<std::uint64_t>(text.size()));
    bytes += text;
  };
  const int type = sqlite3_column_type(statement_, column);
  // Left out, so that columns which later programs add change no digest.
  if (type == SQLITE_NULL) return;
  append_text(name);
  append(static_cast<std::uint64_t>(type));
  if (type == SQLITE_INTEGER) {
    append(static_cast<std::int64_t>(sqlite3_column_int64(statement_, column)));
  } else if (type == SQLITE_FLOAT) {
    append(sqlite3_column_double(statement_, column));
  } else {
    const std::span<const std::byte> value = blob(column);
    append_text({reinterpret_cast<const char*>(value.data()), value.size()});
  }
}

std::uint32_t read_cookie(sqlite3* handle, const std::filesystem::path& path) {
  Statement statement(handle, path, "PRAGMA schema_version");
  statement.step();
  return static_cast<std::uint32_t>(statement.integer(0));
}

void write_cookie(sqlite3* handle, const std::filesystem::path& path, std::uint32_t cookie) {
  // The defensive setting keeps SQL of others from it.
  sqlite3_db_config(handle, SQLITE_DBCONFIG_DEFENSIVE, 0, nullptr);
  execute(handle, path,
          "PRAGMA schema_version = " + std::to_string(static_cast<std::int32_t>(cookie)));
  sqlite3_db_config(handle, SQLITE_DBCONFIG_DEFENSIVE, 1, nullptr);
}

Transaction::Transaction(sqlite3* handle, const std::filesystem::path& path)
    : handle_(handle), path_(path) {
  // The lock for writing is taken at once: a transaction that first reads and then wants to write
  // may find that it can't.
  execute(handle_, path_, "BEGIN IMMEDIATE");
  // Puts the file's first page into the log, too, by which check_log() knows whose log it is.
  write_cookie(handle_, path_, cookie_of_next_transaction(read_cookie(handle_, path_)));
}

Transaction::~Transaction() {
  // SQLite itself rolls back after some errors, such as a full disk.
  if (is_open_ && sqlite3_get_autocommit(handle_) == 0) {
    sqlite3_exec(handle_, "ROLLBACK", nullptr, nullptr, nullptr);
  }
}

void Transaction::commit() {
  execute(handle_, path_, "COMMIT");
  is_open_ = false;
}

OneMoment::OneMoment(sqlite3* handle)
    : handle_(sqlite3_get_autocommit(handle) != 0 ? handle : nullptr) {
  if (handle_ != nullptr) sqlite3_exec(handle_, "BEGIN", nullptr, nullptr, nullptr);
}

OneMoment::~OneMoment() {
  if (handle_ != nullptr) sqlite3_exec(handle_, "COMMIT", nullptr, nullptr, nullptr);
}

}  // namespace avoidbench
