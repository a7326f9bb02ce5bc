#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "store/database.hpp"

namespace avoidbench {

struct MergeResult {
  std::int64_t trials = 0;      ///< that the file has
  std::int64_t new_trials = 0;  ///< of them: that were not there before
};

/// Takes all rows of the database at `from` into `into`, in one transaction. Rows that are there
/// stay; a second time nothing changes. Sweeps of equal name and content are one sweep. Throws
/// InputError, and changes nothing, where `from` is no database of this schema and these metrics,
/// where a row or flight is not as it was stored, or where the two hold a map, mission or trial of
/// one key with different values: then one of them was made by another program or from other files.
MergeResult merge_database(Database& into, const std::filesystem::path& from);

/// What a sweep lacks.
struct SweepCompleteness {
  std::string name;
  std::int64_t revision = 1;
  std::int64_t wanted = 0;  ///< trials, without those of missions known to be invalid
  std::int64_t flown = 0;
  std::vector<std::string> shards;       ///< "1/3", that any of its runs flew; "" is a whole run
  std::vector<std::string> lost_shards;  ///< of those numbers, the shards that no run flew
};

std::vector<SweepCompleteness> sweep_completeness(const Database& database);

}  // namespace avoidbench
