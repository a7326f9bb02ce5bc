#include "store/statement.hpp"

#include <cmath>
#include <limits>

#include "base/check.hpp"
#include "base/input_error.hpp"

namespace avoidbench {
namespace {

std::string meaning(int primary_code, const std::string& message) {
  switch (primary_code) {
    case SQLITE_FULL:
      return "no space left on its disk. Every trial committed before is kept: make room and run "
             "the same command again";
    case SQLITE_IOERR:
      return "reading or writing failed (" + message +
             "). Every trial committed before is kept: see to the disk and run the same command "
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
      return "not a database of avoidbench: it is no SQLite file";
    case SQLITE_CORRUPT:
      return "damaged (" + message + "); `sqlite3 FILE .recover` saves what can be read";
    case SQLITE_CONSTRAINT:
      return "damaged: its rows contradict each other (" + message + ")";
    default:
      return message;
  }
}

}  // namespace

void throw_sqlite_error(sqlite3* handle, int code, const std::filesystem::path& path) {
  const std::string message = handle != nullptr ? sqlite3_errmsg(handle) : sqlite3_errstr(code);
  const int primary_code = code & 0xff;
  AB_CHECK(primary_code != SQLITE_MISUSE, path, message);
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

Statement& Statement::bind_text(std::string_view value) {
  const char* data = value.empty() ? "" : value.data();
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
  check(std::isnan(value) ? sqlite3_bind_null(statement_, bound_count_)
                          : sqlite3_bind_double(statement_, bound_count_, value));
  return *this;
}

Statement& Statement::bind_blob(std::span<const std::byte> value) {
  ++bound_count_;
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
  check(sqlite3_reset(statement_));
  sqlite3_clear_bindings(statement_);
  bound_count_ = 0;
}

std::string Statement::text(int column) const {
  const std::span<const std::byte> bytes = blob(column);  // text as bytes: no zero ends it early
  std::string value(bytes.size(), '\0');
  for (std::size_t i = 0; i < bytes.size(); ++i) value[i] = static_cast<char>(bytes[i]);
  return value;
}

std::int64_t Statement::integer(int column) const {
  return sqlite3_column_int64(statement_, column);
}

double Statement::real(int column) const {
  if (sqlite3_column_type(statement_, column) == SQLITE_NULL) {
    return std::numeric_limits<double>::quiet_NaN();
  }
  return sqlite3_column_double(statement_, column);
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
      return text(column);
    default:
      return std::monostate{};
  }
}

Transaction::Transaction(sqlite3* handle, const std::filesystem::path& path)
    : handle_(handle), path_(path) {
  execute(handle_, path_, "BEGIN IMMEDIATE");
}

Transaction::~Transaction() {
  if (is_open_ && sqlite3_get_autocommit(handle_) == 0) {
    sqlite3_exec(handle_, "ROLLBACK", nullptr, nullptr, nullptr);
  }
}

void Transaction::commit() {
  execute(handle_, path_, "COMMIT");
  is_open_ = false;
}

}  // namespace avoidbench
