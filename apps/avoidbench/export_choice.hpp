#pragma once

#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "store/database.hpp"

/// The trials that `export` writes and where each goes.
namespace avoidbench {

/// Whether the word names a database, not a trial.
bool is_database(const std::string& word);

/// The database and the trials that "[DB] TRIAL…" mean. Throws InputError where there are none.
std::pair<Database, std::vector<TrialListing>> chosen_of(const std::vector<std::string>& words);

/// On stderr, of a flight that has none.
void warn_of_no_path(const TrialListing& trial, const TrialRecord& record);

/// Calls `write` with each trial and its file: one trial's is `output`, of several each has one in
/// the folder `output`. Says on stderr what was written there. Throws InputError where the ending
/// of `output` is another format's, or it can't be written.
void write_files(const std::vector<TrialListing>& trials, const std::string& output,
                 const std::string& extension,
                 const std::function<void(const TrialListing&, const std::string& file)>& write);

}  // namespace avoidbench
