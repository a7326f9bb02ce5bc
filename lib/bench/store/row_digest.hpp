#pragma once

#include <cstdint>
#include <memory>
#include <string_view>

#include "store/database.hpp"

/// Digests over what is stored of each trial, against accidents and edits by hand. They are no
/// signature: who means to deceive can make them as well.
///
/// - `flight_digest`, of the trajectory's and the plan calls' counts and digests and of all events;
/// - `row_digest`, of the trial's other columns that have a value, each with its name, so that
///   metrics that are added later change nothing. Left out are attempt and run_id, which follow
///   from the file that the trial is in.
///
/// Rows of what_ifs and explanations have a row_digest, too, of all other columns: written by
/// Database::add_what_if() and add_explanation(), checked where they are read, all of this file.
namespace avoidbench {

/// Writes both digests into the trial's row; for this room.
void write_digests(const Database& database, std::string_view trial_key);

/// Checks the rows of all trials and what-ifs against their row_digest, and with `flights` what is
/// beside trials against flight_digest. Throws InputError that names the first row that differs or
/// has no digest.
void check_digests(const Database& database, bool flights);

/// Checks that too, each flight and the plan calls against their digests, and the whole file as
/// SQLite does. Returns how many trials there are. Throws InputError as check_digests().
std::int64_t check_all(const Database& database);

/// Checks one trial after the other, as check_digests() with flights.
class TrialDigests {
 public:
  explicit TrialDigests(const Database& database);
  ~TrialDigests();
  void check(std::string_view trial_key);

 private:
  struct Statements;
  std::unique_ptr<Statements> statements_;
};

}  // namespace avoidbench
