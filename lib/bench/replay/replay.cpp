#include "replay/replay.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "base/digest.hpp"
#include "base/input_error.hpp"
#include "base/kept_files.hpp"
#include "base/number_text.hpp"
#include "base/option_error.hpp"
#include "replay/stored_spec.hpp"
#include "store/record_format.hpp"
#include "store/stored_text.hpp"

namespace avoidbench {
namespace {

/// Whether it is the file that the trial was flown with; where it names files, they too.
bool has_digest(const std::filesystem::path& file, const PluginChoice& choice) {
  try {
    return digest_now(file, choice.files) == choice.file_digest;
  } catch (const InputError&) {
    return false;  // one that it names is not there
  }
}

/// "sh -c 'rm …'": what a database would have started.
std::string command_text(const PluginChoice& choice) {
  std::string text;
  for (const std::string& word : choice.command) {
    const std::string& shown = word == kFileWord ? choice.plugin : word;
    const bool is_plain =
        !shown.empty() && shown.find_first_of(" '\"\\$|&;<>()*?`") == std::string::npos;
    text += (text.empty() ? "" : " ") + (is_plain ? shown : "'" + shown + "'");
  }
  return text;
}

/// The file of the database's choice. Of one that was named by a path its bare name is tried, too.
/// It is taken only where it is the file that the trial was flown with; so is the run's copy.
FoundPlanner planner_of_database(const PluginChoice& choice, const ReplayFiles& files) {
  std::vector<std::string> problems;
  std::vector<std::string> names{choice.plugin};
  // `./my_planner.so` is looked for as `my_planner` too.
  const std::string bare = std::filesystem::path(choice.plugin).stem().string();
  if (bare != choice.plugin) names.push_back(bare);
  std::filesystem::path other;
  // The digest decides, not the folder: a file of the right name and another digest is passed over.
  for (const std::string& name : names) {
    for (const std::filesystem::path& folder : files.folders) {
      try {
        const std::filesystem::path file = find_planner(name, folder);
        if (has_digest(file, choice)) return {.source = file};
        if (other.empty()) other = file;
      } catch (const InputError& error) {
        problems.emplace_back(error.what());
      }
    }
  }
  // What a run kept, whatever has become of the file.
  if (const auto copy = kept_planner(files.database, choice.file_digest)) {
    return {.source = *copy, .is_kept = true};
  }
  if (other.empty()) {
    // Without folders nothing was looked for, and there are no problems.
    const std::string problem =
        problems.empty() ? "no planner '" + choice.plugin + "': there is no folder to look in"
                         : problems.front();
    throw OptionError(problem + "; name another library", "", "library");
  }
  throw OptionError(
      {.file = other.string(),
       .message = "is not the library that the trial was flown with (SHA-256 " +
                  file_digest(other).substr(0, 12) + "…, in the database " +
                  choice.file_digest.substr(0, 12) + "…), so it is not loaded unless it is named"},
      "", std::string("library ") + (other.has_parent_path() ? "" : "./") + other.string());
}

/// The place of the file of this name and digest: as `given`, in the folders or their subfolder, or
/// as the run kept it. `what`: "map" or "wind".
std::string found_file(const std::string& what, const std::string& name, const std::string& digest,
                       const std::string& given, const std::string& subfolder,
                       const ReplayFiles& files) {
  std::vector<std::filesystem::path> places;
  // What the user names comes first and is taken whatever its digest: the world's digest is
  // compared later.
  if (!given.empty()) places.emplace_back(given);
  for (const std::filesystem::path& folder : files.folders) {
    places.push_back(folder / name);
    places.push_back(folder / subfolder / name);
  }
  for (const std::filesystem::path& place : places) {
    std::error_code error;
    if (!std::filesystem::is_regular_file(place, error)) continue;
    if (given.empty() && file_digest(place.string()) != digest) continue;
    return place.string();
  }
  if (const auto copy = kept_map(files.database, digest, name)) return copy->string();
  throw OptionError(
      "the " + what + "'s file " + name + " (SHA-256 " + digest + ") was not found: give its path",
      "", what + "-file");
}

/// Finds what the stored trial leaves out before the map is made.
StoredTrial completed(StoredTrial stored, const ReplayFiles& files) {
  if (const FileOfMap map = file_of(stored.spec.map); map.file != nullptr) {
    *map.file = found_file("map", *map.file, *map.digest, files.map, "maps", files);
  }
  if (WindFieldSpec& wind = stored.spec.wind.field; !wind.file.empty()) {
    wind.file = found_file("wind", wind.file, wind.file_digest, files.wind, "configs/wind", files);
  }
  return stored;
}

std::string seconds_text(double time_s) { return fixed_digits(time_s, 4) + " s"; }

/// The first of two runs of elements that differs, or nothing.
template <class Element, class Equal>
std::optional<std::size_t> first_difference(const std::vector<Element>& a,
                                            const std::vector<Element>& b, Equal&& equal) {
  // Runs of unlike length differ where the shorter one ends.
  const auto [in_a, in_b] = std::mismatch(a.begin(), a.end(), b.begin(), b.end(), equal);
  if (in_a == a.end() && in_b == b.end()) return std::nullopt;
  return static_cast<std::size_t>(in_a - a.begin());
}

bool same_bits(const Sample& a, const Sample& b) {
  // By bytes: NaN is equal to itself there, and -0 differs from 0.
  return sample_bytes({&a, 1}) == sample_bytes({&b, 1});
}

bool same_touch(const Collision& a, const Collision& b) {
  return a.time_s == b.time_s && a.speed_mps == b.speed_mps && a.obstacle == b.obstacle &&
         a.kind == b.kind;
}

bool same_answer(const PlanCall& a, const PlanCall& b) {
  // Not CPU and wall times, which the host measures.
  return a.time_s == b.time_s && a.status == b.status && a.command_kind == b.command_kind;
}

template <class Element>
std::string place(const std::vector<Element>& stored, const std::vector<Element>& flown,
                  std::size_t index) {
  const std::size_t least = std::min(stored.size(), flown.size());
  if (index >= least) {
    return "were " + std::to_string(stored.size()) + ", now " + std::to_string(flown.size());
  }
  return "differ from t = " + seconds_text(stored[index].time_s) + " on";
}

}  // namespace

StoredTrial with_files(StoredTrial stored, const ReplayFiles& files) {
  return completed(std::move(stored), files);
}

FoundPlanner planner_for(const PlannerChoice& choice, const ReplayFiles& files) {
  if (choice.file_digest.empty()) {
    throw InputError("the trial of " + choice.label +
                     " is a real flight: it can't be flown again; its twin in simulation can be "
                     "flown (docs/real_flights.md)");
  }
  // Started as a file of its kind is: no word of the database's is.
  if (!files.planner.empty()) return {.source = find_planner(files.planner, ".")};
  return plugin_for(choice, files);
}

FoundPlanner plugin_for(const PluginChoice& choice, const ReplayFiles& files) {
  for (const PlannerChoice& planner : files.own_planners) {
    for (const PluginChoice* own : plugins_of(planner)) {
      const bool is_same = own->command == choice.command && own->file_digest == choice.file_digest;
      if (is_same) return {.source = own->source()};
    }
  }
  if (choice.command.empty()) return planner_of_database(choice, files);
  throw OptionError("the database names a command as planner " + choice.label + ": " +
                        command_text(choice) +
                        ": a command that only a database names is not started. Give your sweep "
                        "file that has it, or a planner's file to fly instead",
                    "", "command");
}

StoredTrial read_stored_trial(const Database& database, const std::string& key) {
  return StoredTrialReader(database).read(key);
}

const MapRow* StoredTrialReader::map(const std::string& key) {
  auto entry = maps_.find(key);
  if (entry == maps_.end()) entry = maps_.emplace(key, database_->read_map(key)).first;
  return entry->second ? &*entry->second : nullptr;
}

StoredTrial StoredTrialReader::read(const std::string& key) {
  const std::filesystem::path& path = database_->path();
  std::optional<TrialRow> row = trials_.read(key);
  if (!row) throw InputError({.file = path.string(), .message = "holds no trial " + key});
  StoredTrial stored;
  stored.row = std::move(*row);
  try {
    stored.spec = stored_spec(stored.row.spec_json);
  } catch (const BadText& bad) {
    throw_damaged(path, "trials", key, std::string("spec_json: ") + bad.what());
  }
  // The same fact in two places of the row: they may differ only in a damaged file.
  if (stored.spec.mission_index != stored.row.mission_index) {
    throw_damaged(path, "trials", key, "spec_json is of another mission");
  }
  const MapRow* const flown = map(stored.row.map_key);
  // A map's missions are there from 0 on without a gap; invalid ones are never flown.
  const auto index = static_cast<std::size_t>(stored.row.mission_index);
  if (flown == nullptr || index >= flown->record.missions.size() ||
      !flown->record.missions[index].is_valid) {
    throw_damaged(path, "trials", key, "its mission is missing or can't be flown");
  }
  const MissionRecord& mission = flown->record.missions[index];
  stored.mission = mission.mission;
  stored.world_digest = flown->record.world_digest;
  stored.reference_length_m = mission.reference_length_m;
  stored.leg_lengths_m = mission.leg_lengths_m;
  return stored;
}

std::string other_library_warning(const PlannerDescription& planner) {
  return "the planner's file differs from the stored trial's: " + planner.file.string();
}

std::vector<ParameterValue> usable_values(const PluginChoice& stored,
                                          const PlannerDescription& planner,
                                          std::vector<std::string>& warnings) {
  ParameterValues given;
  for (const ParameterChoice& choice : stored.parameters) {
    // One at a time, so that one that the library no longer takes leaves the others alone.
    ParameterValues one{{choice.name, {.number = choice.number, .text = choice.text}}};
    const std::vector<std::string> problems = check_parameters(planner, one);
    if (problems.empty()) {
      given.merge(one);
    } else {
      warnings.push_back(problems.front() + ": the stored value is left out");
    }
  }
  for (const ParameterDef& def : planner.parameters) {
    if (given.contains(def.name)) continue;
    warnings.push_back("parameter " + def.name + " has no stored value: its preset is used");
  }
  return resolve_parameters(planner, given);
}

std::vector<std::string> differences(const TrialRecord& stored, const TrialRecord& flown) {
  std::vector<std::string> lines;
  const auto told = [&lines](const char* what, const std::string& was, const std::string& is) {
    if (was != is) lines.push_back(std::string(what) + " was " + was + ", now " + is);
  };
  told("the outcome", std::string(text(stored.outcome)), std::string(text(flown.outcome)));
  const bool same_end = stored.end_time_s == flown.end_time_s ||
                        (std::isnan(stored.end_time_s) && std::isnan(flown.end_time_s));
  if (!same_end) {
    lines.push_back("the end was at " + seconds_text(stored.end_time_s) + ", now at " +
                    seconds_text(flown.end_time_s));
  }
  told("the reason", "'" + stored.reason + "'", "'" + flown.reason + "'");
  if (const auto at = first_difference(stored.samples, flown.samples, same_bits)) {
    lines.push_back("samples of the path " + place(stored.samples, flown.samples, *at));
  }
  if (const auto at = first_difference(stored.plan_calls, flown.plan_calls, same_answer)) {
    lines.push_back("calls of the planner " + place(stored.plan_calls, flown.plan_calls, *at));
  }
  if (const auto at = first_difference(stored.collisions, flown.collisions, same_touch)) {
    lines.push_back("collisions " + place(stored.collisions, flown.collisions, *at));
  }
  return lines;
}

}  // namespace avoidbench
