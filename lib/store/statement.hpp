#pragma once

#include <sqlite3.h>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>

#include "store/table_value.hpp"

namespace avoidbench {

/// Throws what SQLite's error code `code` means to a user as InputError naming the file. A broken
/// constraint is a file whose rows contradict each other; misuse of SQLite is our bug and aborts.
[[noreturn]] void throw_sqlite_error(sqlite3* handle, int code, const std::filesystem::path& path);

/// Runs statements that return nothing.
void execute(sqlite3* handle, const std::filesystem::path& path, const std::string& sql);

/// One prepared statement. Parameters are bound in order, columns count from 0.
class Statement {
 public:
  Statement(sqlite3* handle, const std::filesystem::path& path, std::string_view sql);
  ~Statement();
  Statement(const Statement&) = delete;
  Statement& operator=(const Statement&) = delete;

  Statement& bind_text(std::string_view value);
  Statement& bind_integer(std::int64_t value);
  Statement& bind_real(double value);  ///< NaN becomes NULL
  Statement& bind_blob(std::span<const std::byte> value);

  bool step();  ///< true while there is a row
  void
  run();  ///< to the end; bindings are cleared, so that the statement can be bound and run again

  std::string text(int column) const;
  std::int64_t integer(int column) const;
  double real(int column) const;                      ///< NULL becomes NaN
  std::span<const std::byte> blob(int column) const;  ///< valid until the next step
  int column_count() const;
  std::string column_name(int column) const;
  TableValue value(int column) const;  ///< a blob becomes nothing

 private:
  void check(int code) const;

  sqlite3* handle_;
  const std::filesystem::path& path_;
  sqlite3_stmt* statement_ = nullptr;
  int bound_count_ = 0;
};

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

}  // namespace avoidbench
