#pragma once

#include <sqlite3.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "base/digest.hpp"
#include "store/statement.hpp"

namespace avoidbench::test {

/// Gives each trial the digests of what the file now holds, as a program would that had stored it
/// so.
inline void redigest(sqlite3* handle) {
  const std::filesystem::path path = "(to be digested)";
  std::vector<std::string> columns;  // by name, as row_digest.hpp says
  {
    Statement names(handle, path,
                    "SELECT name FROM pragma_table_info('trials') WHERE name NOT IN ('attempt', "
                    "'run_id', 'row_digest') ORDER BY name");
    while (names.step()) columns.push_back(names.text(0));
  }
  std::string list;
  for (const std::string& column : columns) list += ", \"" + column + "\"";
  std::vector<std::string> keys;
  {
    Statement trials(handle, path, "SELECT trial_key FROM trials");
    while (trials.step()) keys.push_back(trials.free_text(0));
  }
  const auto digest_of = [&](const std::string& sql, const std::string& key, std::string& bytes) {
    Statement row(handle, path, sql);
    row.bind_text(key);
    while (row.step()) {
      for (int i = 0; i < row.column_count(); ++i) row.append_value(row.column_name(i), i, bytes);
    }
    return Digest().add(bytes).hex();
  };
  const auto write = [&](const std::string& column, const std::string& key,
                         const std::string& hex) {
    Statement update(handle, path, "UPDATE trials SET " + column + " = ? WHERE trial_key = ?");
    update.bind_text(hex).bind_text(key).run();
  };
  for (const std::string& key : keys) {
    std::string bytes;
    digest_of("SELECT sample_count, samples_digest FROM trajectories WHERE trial_key = ?", key,
              bytes);
    digest_of("SELECT call_count, calls_digest FROM plan_calls WHERE trial_key = ?", key, bytes);
    write("flight_digest", key,
          digest_of("SELECT event_index, kind, time_s, speed_mps, obstacle_index, obstacle_kind "
                    "FROM events WHERE trial_key = ? ORDER BY event_index",
                    key, bytes));
    bytes.clear();
    write("row_digest", key,
          digest_of("SELECT " + list.substr(2) + " FROM trials WHERE trial_key = ?", key, bytes));
  }
}

inline void redigest(const std::filesystem::path& path) {
  sqlite3* opened = nullptr;
  const int code = sqlite3_open(path.c_str(), &opened);
  const std::unique_ptr<sqlite3, decltype(&sqlite3_close)> handle(opened, sqlite3_close);
  if (code == SQLITE_OK) redigest(opened);
}

}  // namespace avoidbench::test
