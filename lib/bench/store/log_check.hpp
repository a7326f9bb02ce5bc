#pragma once

#include <cstdint>
#include <filesystem>

struct sqlite3;

/// SQLite takes NAME-wal for the log of the file NAME by its name alone. A killed run leaves one,
/// and if another file then gets that name, pages of the old one would be written into it.
namespace avoidbench {

/// By the schema cookie, four bytes in the file's first page of which SQLite asks only that they
/// change with the schema, a file and its log know each other: the upper half is another one after
/// each open for a run, at random, the lower half counts transactions.
std::uint32_t cookie_of_next_run(std::uint32_t cookie, bool is_new_file);
std::uint32_t cookie_of_next_transaction(std::uint32_t cookie);

/// Throws InputError where a log lies beside the file that is not the file's own: call it on a
/// fresh connection, before SQLite looks into the file. A log in which nothing is committed passes,
/// since SQLite takes nothing from it. The file and its log may be in use meanwhile.
void check_log(sqlite3* handle, const std::filesystem::path& file);

/// Throws InputError where a file that is missing or empty has a log with committed rows, which
/// SQLite would delete.
void check_no_lost_log(const std::filesystem::path& file);

}  // namespace avoidbench
