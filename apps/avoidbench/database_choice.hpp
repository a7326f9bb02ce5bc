#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "commands.hpp"
#include "replay/apart.hpp"
#include "store/database.hpp"

namespace avoidbench {

/// The database itself, or that of a sweep by its file or name: results/NAME.db.
std::filesystem::path database_of(const std::string& given);

/// The results/*.db that was written to last; says on stderr that `purpose` takes it. Throws
/// InputError where there is none.
std::filesystem::path newest_database(const std::string& purpose);

/// Opens a database for reading after checking the digests of all its trials' rows.
Database open_checked(const std::filesystem::path& path);

/// The databases, opened so, or the newest one where none is given.
std::vector<Database> opened(const std::vector<std::string>& files, const std::string& purpose);

/// --library, --map-file, --wind-file: what to fly stored trials with, where it is to be others
/// than those that are found.
void add_file_options(CLI::App& command, ReplayFiles& files);

/// These, with the places where others are looked for: here, and beside the database, as it was
/// given and where it is.
ReplayFiles files_beside(const std::string& given, const Database& database, ReplayFiles files);

/// How `jobs` workers fly these trials again: in the sandbox, unless one of them was flown without.
ApartOptions apart_options(const Database& database, const std::vector<std::string>& keys,
                           double plan_timeout_s, int jobs);

/// The stored trial, ready to be flown. Throws InputError as read_stored_trial() does, and where
/// its spec contradicts itself as no sweep file may.
StoredTrial possible_trial(const Database& database, const std::string& key);

}  // namespace avoidbench
