#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iostream>
#include <map>
#include <set>
#include <tuple>

#include "base/digest.hpp"
#include "base/number_text.hpp"
#include "base/visible_text.hpp"
#include "base/words.hpp"
#include "output.hpp"
#include "replay/sample.hpp"
#include "suite.hpp"
#include "suite/suite_maps.hpp"
#include "suite/suite_score.hpp"
#include "sweep/key_maker.hpp"

namespace avoidbench {
namespace {

namespace fs = std::filesystem;

constexpr int kExitRefused = 1;

/// A folder that goes away with it.
class TemporaryFolder {
 public:
  TemporaryFolder() {
    std::string name = (fs::temp_directory_path() / "avoidbench-verify-XXXXXX").string();
    if (::mkdtemp(name.data()) == nullptr) throw InputError(name + ": can't be made");
    path_ = name;
  }
  ~TemporaryFolder() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  const fs::path& path() const { return path_; }

 private:
  fs::path path_;
};

/// What is claimed of one sweep, and how to fly it again.
struct ClaimedSweep {
  const SuiteSweep* sweep = nullptr;
  SweepSeeds seeds;
  SweepSpec spec;
  std::map<std::string, std::string> key_of_claimed;  ///< this program's key by the claimed one
  /// The claimed key by map seed and mission.
  std::map<std::pair<std::uint64_t, std::int64_t>, std::string> key_at;
};

/// Why something can't be what it says it is.
[[noreturn]] void refuse(const std::string& reason) {
  std::cout << "refused: " << visible_line(reason) << '\n';
  throw CLI::RuntimeError(kExitRefused);
}

SuiteTrack suite_of(const SuiteResult& result, const SuiteOptions& options) {
  const SuiteTrack chosen =
      suite_track(options.track.empty() ? result.suite + "/" + result.track : options.track);
  if (chosen.sha256 != result.track_sha256) {
    refuse("it was flown in a different " + result.suite + "/" + result.track +
           ": its SHA-256 is " + result.track_sha256 + ", this one's " + chosen.sha256);
  }
  return chosen;
}

/// The planner to fly with: the user's, else one that comes with the program. A file or a command
/// that a result names is not started on its word: results come from strangers.
SuitePlanner own_planner(const SuiteResult& result, const std::string& given) {
  if (given.ends_with(".yaml") || given.ends_with(".yml")) return read_suite_planner(given);
  SuitePlanner planner = result.planner;
  const std::size_t index = planner.entry.index_of("plugin");
  const bool is_entry = index < planner.entry.items.size();
  const std::string plugin = is_entry ? planner.entry.items[index].scalar : planner.entry.scalar;
  if (given.empty()) {
    if (is_name(plugin) && plugin != "process") return planner;
    throw InputError("the result was flown by " + visible_line(plugin) +
                     ", a file that only the result names and that is not started: get the "
                     "planner, inspect it, and give your copy with --planner");
  }
  YamlNode file = node_at(planner.entry, YamlNode::Kind::scalar, given);
  // Relative to where it was typed.
  file.source = std::make_shared<const std::string>("--planner");
  if (is_entry) {
    planner.entry.items[index] = file;
  } else {
    planner.entry = file;
  }
  return planner;
}

/// Which trials the suite has, with the keys that the claimed planner gives them.
ClaimedSweep claimed_sweep(const SuiteTrack& chosen, const SuiteCell& cell, const SuiteSweep& sweep,
                           const SuiteResult& result, const SuitePlanner& planner,
                           const std::string& key) {
  ClaimedSweep claimed;
  claimed.sweep = &sweep;
  claimed.seeds = seeds_of(chosen.suite, cell, sweep, result.split, key);
  claimed.spec = suite_sweep(chosen, sweep, claimed.seeds, planner);
  if (claimed.spec.planners.size() != 1) refuse("its planner has several settings");
  KeyMaker keys;
  for (const PlannedTrial& trial : expand(claimed.spec)) {
    TrialSpec spec = trial.spec();
    // That of a planner with a filter is one digest of two files: it is verified with both as they
    // were.
    if (!spec.planner.filter) spec.planner.file_digest = result.planner_digest;
    spec.planner.label = result.label;
    const std::string key_of_row = trial_key(spec);
    claimed.key_of_claimed[key_of_row] = keys.trial_key(trial);
    claimed.key_at[{spec.map_seed, spec.mission_index}] = key_of_row;
  }
  return claimed;
}

std::string place_of(const SuiteRow& row) {
  return row.sweep + ", map " + std::to_string(row.map_seed) + ", mission " +
         std::to_string(row.mission_index);
}

/// Throws where the rows are not the suite's, or one's key is not that of its mission with this
/// planner and setting.
void check_rows(const SuiteTrack& chosen, const SuiteResult& result,
                const std::vector<ClaimedSweep>& sweeps) {
  if (const std::string problem = rows_problem(chosen.suite, result); !problem.empty()) {
    refuse(problem);
  }
  for (const SuiteRow& row : result.rows) {
    const auto is_of = [&](const ClaimedSweep& one) { return one.sweep->name == row.sweep; };
    const auto sweep = std::find_if(sweeps.begin(), sweeps.end(), is_of);
    const auto key = sweep->key_at.find({row.map_seed, row.mission_index});
    if (key == sweep->key_at.end() || key->second != row.trial_key) {
      refuse(place_of(row) +
             ": its key does not belong to this suite with this planner and setting");
    }
  }
}

/// What differs between a claimed row and the flight, "" where nothing does.
std::string difference(const SuiteRow& claimed, const SuiteRow& flown) {
  if (claimed.outcome != flown.outcome) {
    return "claimed " + std::string(text(claimed.outcome)) + ", flown " +
           std::string(text(flown.outcome));
  }
  const auto differs = [](double a, double b) {
    return a != b && !(std::isnan(a) && std::isnan(b));
  };
  for (const auto& [what, a, b] :
       {std::tuple("reference_length_m", claimed.reference_length_m, flown.reference_length_m),
        std::tuple("end_time_s", claimed.end_time_s, flown.end_time_s),
        std::tuple("path_length_m", claimed.path_length_m, flown.path_length_m)}) {
    if (differs(a, b)) {
      return std::string(what) + ": claimed " + shortest(a) + ", flown " + shortest(b);
    }
  }
  if (claimed.flight_digest != flown.flight_digest) {
    return "flight_digest: claimed " + claimed.flight_digest.substr(0, 16) + "…, flown " +
           flown.flight_digest.substr(0, 16) + "…";
  }
  return "";
}

/// The sample: rows whose digest with the salt is small, and one at least.
std::set<std::string> sampled_keys(const SuiteResult& result, double share,
                                   const std::string& salt) {
  std::set<std::string> keys;
  std::pair<std::string, std::string> least{"g", ""};
  for (const SuiteRow& row : result.rows) {
    const std::string drawn = sha256(salt + row.trial_key);
    if (is_sampled(drawn, share)) keys.insert(row.trial_key);
    least = std::min(least, std::pair(drawn, row.trial_key));
  }
  if (keys.empty()) keys.insert(least.second);
  return keys;
}

/// Flies the sampled trials and returns the rows by this program's keys.
std::map<std::string, SuiteRow> fly_sample(const SuiteTrack& chosen, const SuiteOptions& options,
                                           const std::vector<ClaimedSweep>& sweeps,
                                           const std::set<std::string>& sample) {
  const TemporaryFolder folder;
  RunCommand run = options.run;
  run.is_of_suite = true;
  run.no_keep = true;
  run.database_file = (folder.path() / "flights.db").string();
  for (const ClaimedSweep& one : sweeps) {
    std::set<std::string> wanted;
    for (const auto& [claimed, own] : one.key_of_claimed) {
      if (sample.contains(claimed)) wanted.insert(own);
    }
    if (wanted.empty()) continue;
    run.is_wanted = [wanted](const std::string& key) { return wanted.contains(key); };
    run.sweep_file = one.sweep->name;
    fly_sweep(run, one.spec, {});
  }
  const Database database = Database::open_for_reading(run.database_file);
  std::map<std::string, SuiteRow> rows;
  for (SuiteRow& row : rows_of(database, chosen.suite)) rows[row.trial_key] = row;
  return rows;
}

}  // namespace

void verify_suite(const SuiteOptions& options) {
  const SuiteResult result = read_result(options.folder);
  const SuiteTrack chosen = suite_of(result, options);
  if (result.split == Split::sealed && options.sealed.empty()) {
    throw InputError(options.folder + " is for sealed maps: give their key with --sealed KEYFILE");
  }
  const std::string key =
      result.split == Split::sealed ? read_suite_key(options.sealed, chosen.suite) : "";
  const SuitePlanner planner = own_planner(result, options.planner);
  std::vector<ClaimedSweep> sweeps;
  for (const SuiteCell& cell : chosen.suite.cells) {
    for (const SuiteSweep& sweep : cell.sweeps) {
      sweeps.push_back(claimed_sweep(chosen, cell, sweep, result, planner, key));
    }
  }
  const PlannerChoice& own = sweeps.front().spec.planners.front();
  if (((needs_of(own) & AB_INPUT_WORLD) != 0) != result.is_privileged) {
    refuse("is_privileged: the planner says otherwise");
  }
  check_rows(chosen, result, sweeps);
  const SuiteScore score = score_of(chosen.suite, result);
  std::cout << "claimed: " << visible_line(result.label) << ", " << result.suite << "/"
            << result.track << " " << text(result.split) << ", "
            << counted(result.rows.size(), "flight") << ", score "
            << fixed_digits(score.score.value, 2) << " m/s\n";
  if (const std::string digest = flown_digest(own); digest != result.planner_digest) {
    std::cerr << "note: the planner here is a different build (SHA-256 " << digest.substr(0, 12)
              << "…) than the one that flew (" << result.planner_digest.substr(0, 12) << "…)\n";
  }
  const std::string salt =
      options.salt.empty() ? file_digest(fs::path(options.folder) / kTrialsFile) : options.salt;
  const std::set<std::string> sample = sampled_keys(result, share_from(options.sample), salt);
  std::cout << "sampled: " << sample.size() << " of " << counted(result.rows.size(), "flight")
            << '\n'
            << std::flush;
  const std::map<std::string, SuiteRow> flown = fly_sample(chosen, options, sweeps, sample);
  std::size_t verified = 0;
  for (const SuiteRow& row : result.rows) {
    if (!sample.contains(row.trial_key)) continue;
    std::string own_key;
    for (const ClaimedSweep& sweep : sweeps) {
      const auto found = sweep.key_of_claimed.find(row.trial_key);
      if (found != sweep.key_of_claimed.end()) own_key = found->second;
    }
    const auto again = flown.find(own_key);
    const std::string found =
        again == flown.end() ? "it can't be flown" : difference(row, again->second);
    if (found.empty()) ++verified;
    if (!found.empty()) std::cout << "  " << place_of(row) << ": " << found << '\n';
  }
  std::cout << "verified: " << verified << " of " << counted(sample.size(), "flight")
            << (sample.size() == 1 ? " is" : " are") << " the same, bit for bit\n";
  if (verified < sample.size()) {
    refuse("the flights are not those that it claims");
  }
}

}  // namespace avoidbench
