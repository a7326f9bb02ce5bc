#pragma once

#include <condition_variable>
#include <exception>
#include <filesystem>
#include <map>
#include <memory>
#include <mutex>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <string>
#include <thread>
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

/// How much room a packed flight or map takes in a page.
std::size_t bytes_in_page(const nlohmann::ordered_json& packed);

/// Reads flights in several threads while a page is filled: digests and unpacking are most of what
/// a page takes. What comes out does not depend on the number of threads.
class FlightReader {
 public:
  /// Begins with the first of these trials. Flights that nobody has asked for yet are read until
  /// they are `ahead_bytes` large: those that a page has no room for stay unread.
  FlightReader(std::span<const PageDatabase> databases, std::vector<std::string> keys,
               std::size_t ahead_bytes);
  FlightReader(const FlightReader&) = delete;
  FlightReader& operator=(const FlightReader&) = delete;
  ~FlightReader();  ///< what is not read by then stays unread

  /// The flights in their order, one a call, up to the last.
  PackedFlight next();

 private:
  void work();
  std::optional<std::size_t> claimed();

  std::vector<std::filesystem::path> files_;
  std::map<std::string, ExplanationRow> explanations_;  ///< by trial key
  const std::vector<std::string> keys_;
  const std::size_t ahead_bytes_;
  std::mutex mutex_;  ///< of all below but the threads
  std::condition_variable changed_;
  std::vector<std::unique_ptr<PackedFlight>> flights_;  ///< one for each key, as they are read
  std::size_t claimed_count_ = 0, asked_count_ = 0, bytes_ = 0;
  std::exception_ptr problem_;
  bool is_stopped_ = false;
  std::vector<std::thread> threads_;
};

}  // namespace avoidbench
