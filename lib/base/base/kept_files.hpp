#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

/// Copies of the files that a database's trials were flown with, so that they can be flown again
/// when the originals have changed: beside NAME.db, planners in NAME.planners/DIGEST.so (.py or
/// .run of programs), maps and wind fields in NAME.maps/DIGEST.ending. DIGEST is the SHA-256 of the
/// file.
namespace avoidbench {

/// A file of a run, and the SHA-256 that it has to have.
struct FlownFile {
  std::string file, digest;
  bool is_planner = true;   ///< else a map or wind field
  bool is_program = false;  ///< of a planner: no library
};

/// Copies these files beside the database; what is there stays. Returns what could not be kept and
/// why, a line each: no reason not to fly.
std::vector<std::string> keep_files(const std::vector<FlownFile>& files,
                                    const std::filesystem::path& database);

/// The kept planner of this digest: beside the database, or with another one in its folder. Only a
/// file that has the digest is returned.
std::optional<std::filesystem::path> kept_planner(const std::filesystem::path& database,
                                                  const std::string& digest);

/// The same for the file of a map or wind field of this name.
std::optional<std::filesystem::path> kept_map(const std::filesystem::path& database,
                                              const std::string& digest, const std::string& name);

/// Copies what is kept beside the database `from` beside `into`; only files that have the digest
/// that they are named by. Returns what could not be copied, a line each.
std::vector<std::string> merge_kept_files(const std::filesystem::path& into,
                                          const std::filesystem::path& from);

}  // namespace avoidbench
