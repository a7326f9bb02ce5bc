#pragma once

#include <sqlite3.h>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>

#include "table/table_value.hpp"

namespace avoidbench {

/// Throws what SQLite's error code `code` means to a user as InputError naming the file. A broken
/// constraint is a file whose rows contradict each other; misuse of SQLite is our bug and aborts.
[[noreturn]] void throw_sqlite_error(sqlite3* handle, int code, const std::filesystem::path& path);

/// Runs statements that return nothing.
void execute(sqlite3* handle, const std::filesystem::path& path, const std::string& sql);

/// One prepared statement. Parameters are bound in order, columns count from 0. A value of another
/// type than the function returns, and text that is not UTF-8, is damage: InputError.
class Statement {
 public:
  Statement(sqlite3* handle, const std::filesystem::path& path, std::string_view sql);
  ~Statement();
  Statement(const Statement&) = delete;
  Statement& operator=(const Statement&) = delete;

  /// For messages about damage: rows are of `table`, and this column is their key.
  Statement& rows_of(std::string_view table, int key_column = 0);
  /// Throws that the present row is damaged.
  [[noreturn]] void damaged(std::string_view what) const;

  Statement& bind_text(std::string_view value);  ///< what is no UTF-8 is replaced
  Statement& bind_integer(std::int64_t value);
  Statement& bind_real(double value);  ///< NaN becomes NULL
  Statement& bind_blob(std::span<const std::byte> value);

  bool step();  ///< true while there is a row
  void run();   ///< to the end, then reset()
  /// Without bindings, to be bound and run again.
  Statement& reset();

  std::string text(int column) const;  ///< NULL becomes ""
  std::string free_text(
      int column) const;  ///< of people and planners: what is no UTF-8 is replaced
  std::int64_t integer(int column) const;
  double real(int column) const;  ///< NULL becomes NaN
  bool is_null(int column) const;
  std::span<const std::byte> blob(int column) const;  ///< valid until the next step
  int column_count() const;
  std::string column_name(int column) const;
  TableValue value(int column) const;  ///< a blob becomes nothing
  /// Appends name, type and bytes of a value; nothing for NULL. For digests.
  void append_value(std::string_view name, int column, std::string& bytes) const;

 private:
  void check(int code) const;
  [[noreturn]] void wrong_type(int column, std::string_view wanted) const;

  sqlite3* handle_;
  const std::filesystem::path& path_;
  sqlite3_stmt* statement_ = nullptr;
  int bound_count_ = 0;
  std::string_view table_;
  int key_column_ = 0;
};

/// The schema cookie of the main file, within a transaction (log_check.hpp).
std::uint32_t read_cookie(sqlite3* handle, const std::filesystem::path& path);
void write_cookie(sqlite3* handle, const std::filesystem::path& path, std::uint32_t cookie);

/// All or nothing: what was not committed when it goes out of scope is rolled back.
class Transaction {
 public:
  Transaction(sqlite3* handle, const std::filesystem::path& path);
  ~Transaction();
  Transaction(const Transaction&) = delete;
  Transaction& operator=(const Transaction&) = delete;
  void commit();

 private:
  sqlite3* handle_;
  const std::filesystem::path& path_;
  bool is_open_ = true;
};

/// For as long as it lives all that is read is of one moment, whatever a run commits meanwhile.
class OneMoment {
 public:
  explicit OneMoment(sqlite3* handle);
  ~OneMoment();
  OneMoment(const OneMoment&) = delete;
  OneMoment& operator=(const OneMoment&) = delete;

 private:
  sqlite3* handle_;  ///< null: it is within a transaction already
};

}  // namespace avoidbench
