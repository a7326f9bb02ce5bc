#pragma once

#include <filesystem>
#include <string>

namespace avoidbench {

/// The database itself, or that of a sweep by its file or name: results/NAME.db.
std::filesystem::path database_of(const std::string& given);

/// The results/*.db that was written to last; says on stderr that `purpose` takes it. Throws
/// InputError where there is none.
std::filesystem::path newest_database(const std::string& purpose);

}  // namespace avoidbench
