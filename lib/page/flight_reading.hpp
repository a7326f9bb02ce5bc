#pragma once

#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "replay/replay.hpp"

namespace avoidbench {

/// A database, and where its maps' files may be.
struct PageDatabase {
  const Database* database = nullptr;
  ReplayFiles files;
};

/// A stored flight, packed for a page.
struct PackedFlight {
  std::optional<StoredTrial> stored;  ///< without samples and calls; nothing where it can't be read
  std::size_t database = 0;           ///< that has it
  std::unique_ptr<nlohmann::ordered_json> json = {};  ///< null where it has no samples
  std::string problem;                                ///< why it can't be read
};

/// Reads flights in several threads: digests and unpacking are most of what a page takes. Each
/// thread has handles of its own. What comes out does not depend on the number of threads.
class FlightReader {
 public:
  explicit FlightReader(std::span<const PageDatabase> databases);

  /// The flights of these trials, in their order.
  std::vector<PackedFlight> read(std::span<const std::string> keys);

 private:
  std::vector<std::vector<Database>> handles_;  ///< by thread
};

}  // namespace avoidbench
