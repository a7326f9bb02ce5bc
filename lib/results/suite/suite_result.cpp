#include "suite/suite_result.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <tuple>

#include "base/input_error.hpp"
#include "base/input_file.hpp"
#include "base/number_text.hpp"
#include "base/output_file.hpp"
#include "base/words.hpp"
#include "table/csv.hpp"
#include "table/csv_reader.hpp"
#include "yaml/includes.hpp"
#include "yaml/yaml_reader.hpp"
#include "yaml/yaml_values.hpp"

namespace avoidbench {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kResultTitle = "# avoidbench suite result, format 1";
constexpr std::array<std::string_view, 12> kResultColumns{"cell",
                                                          "sweep",
                                                          "map_seed",
                                                          "mission_index",
                                                          "trial_key",
                                                          "outcome",
                                                          "reference_length_m",
                                                          "end_time_s",
                                                          "goal_velocity_mps",
                                                          "path_length_m",
                                                          "cause",
                                                          "flight_digest"};
constexpr std::uint64_t kMostTableBytes = 500'000'000;

std::string header_line() {
  CsvRow row;
  for (const std::string_view name : kResultColumns) row.add(name);
  return row.line();
}

std::string line_of(const SuiteRow& row) {
  CsvRow line;
  line.add(row.cell).add(row.sweep);
  line.add_value(row.map_seed).add_value(row.mission_index);
  line.add(row.trial_key).add(text(row.outcome));
  line.add(row.reference_length_m).add(row.end_time_s).add(row.goal_velocity_mps);
  line.add(row.path_length_m).add(row.cause).add(row.flight_digest);
  return line.line();
}

SuiteRow row_from(const CsvReader& reader, const std::vector<std::string>& fields) {
  if (fields.size() != kResultColumns.size()) {
    reader.fail(std::to_string(fields.size()) + " fields instead of " +
                std::to_string(kResultColumns.size()));
  }
  const auto word = [&](std::size_t i) { return std::string(text_of_csv_field(fields[i])); };
  const auto outcome = enum_from_text<Outcome>(word(5));
  if (!outcome) reader.fail("outcome: '" + word(5) + "' is invalid");
  return {.cell = word(0),
          .sweep = word(1),
          .map_seed = reader.number<std::uint64_t>(fields[2], "map_seed"),
          .mission_index = reader.number<std::int64_t>(fields[3], "mission_index"),
          .trial_key = word(4),
          .outcome = *outcome,
          .reference_length_m = reader.number<double>(fields[6], "reference_length_m"),
          .end_time_s = reader.number<double>(fields[7], "end_time_s"),
          .goal_velocity_mps = reader.number<double>(fields[8], "goal_velocity_mps"),
          .path_length_m = reader.number<double>(fields[9], "path_length_m"),
          .cause = word(10),
          .flight_digest = word(11)};
}

std::vector<SuiteRow> read_rows(const fs::path& file) {
  const std::string text = read_input_file(file, kMostTableBytes);
  const std::string source = file.string();
  CsvReader reader(text, source);
  std::string_view line;
  if (!reader.next(line) || line != kResultTitle) {
    reader.fail("expected '" + std::string(kResultTitle) + "': is it a suite's trials.csv?");
  }
  bool has_header = false;
  std::vector<SuiteRow> rows;
  while (reader.next(line)) {
    if (line.starts_with('#')) continue;
    const std::vector<std::string> fields = reader.fields(line);
    if (has_header) {
      rows.push_back(row_from(reader, fields));
    } else if (!std::equal(fields.begin(), fields.end(), kResultColumns.begin(),
                           kResultColumns.end())) {
      reader.fail("expected the columns " + joined(kResultColumns));
    }
    has_header = true;
  }
  return rows;
}

/// A line `name: "text"` of planner.yaml.
std::string yaml_line(std::string_view name, const std::string& text) {
  return std::string(name) + ": " + nlohmann::json(text).dump() + "\n";
}

/// The entry as a file in `folder` says it: a planner's file by its way from there.
YamlNode entry_seen_from(const YamlNode& entry, const fs::path& folder) {
  YamlNode seen = entry;
  const std::size_t at = entry.index_of("plugin");
  if (at == entry.keys.size() || entry.items[at].scalar.find('/') == std::string::npos) return seen;
  const fs::path file = folder_of(entry.items[at], ".") / entry.items[at].scalar;
  const fs::path way = fs::absolute(file).lexically_normal().lexically_relative(
      fs::absolute(folder).lexically_normal());
  // With a slash: a bare name would be looked for among the planners that come with the program.
  seen.items[at].scalar = (way.has_parent_path() ? "" : "./") + way.string();
  return seen;
}

std::string planner_yaml(const SuiteResult& result, const fs::path& folder) {
  std::string text =
      "# What flew, with one setting for all cells, and where: `avoidbench suite verify` reads it, "
      "and it\n# is a planner for `suite run`. Flights: trials.csv.\n";
  text += yaml_line("suite", result.suite) + yaml_line("track", result.track);
  text += yaml_line("track_sha256", result.track_sha256);
  text += yaml_line("split", std::string(avoidbench::text(result.split)));
  if (!result.key_sha256.empty()) text += yaml_line("key_sha256", result.key_sha256);
  text += yaml_line("label", result.label) + yaml_line("name", result.planner_name);
  text += yaml_line("version", result.planner_version);
  text += yaml_line("digest", result.planner_digest);
  text += std::string("is_privileged: ") + (result.is_privileged ? "true" : "false") + "\n";
  text += yaml_line("program", result.program);
  text += "planner: " + flow_text(entry_seen_from(result.planner.entry, folder)) + "\n";
  text += yaml_line("licence", result.planner.licence) + yaml_line("source", result.planner.source);
  return text + yaml_line("tuned_on", result.planner.tuned_on);
}

std::int64_t missions_a_map(const SuiteSpec& suite, Split split) {
  return split == Split::dev    ? suite.dev.missions
         : split == Split::open ? suite.open.missions
                                : suite.sealed_missions;
}

void write_file(const fs::path& file, const std::string& text) {
  std::ofstream stream = open_output(file);
  stream << text;
  close_output(stream, file);
}

}  // namespace

std::vector<SuiteRow> rows_of(const Database& database, const SuiteSpec& suite) {
  std::vector<SuiteRow> rows;
  const std::vector<SweepInfo> flown = database.read_sweeps();
  for (const SuiteCell& cell : suite.cells) {
    for (const SuiteSweep& sweep : cell.sweeps) {
      const auto latest = std::find_if(flown.rbegin(), flown.rend(), [&](const SweepInfo& info) {
        return info.name == sweep.name;
      });
      if (latest == flown.rend()) continue;
      const SweepResult result =
          database.read_sweep(sweep.name, latest->revision, {"flight_digest", "path_length_m"});
      std::map<std::string, std::uint64_t> seed_of;
      for (const MapRow& map : result.maps) seed_of[map.record.key] = map.map_seed;
      std::vector<SuiteRow> part;
      for (const TrialSummary& trial : result.trials) {
        part.push_back({.cell = cell.name,
                        .sweep = sweep.name,
                        .map_seed = seed_of.at(trial.map_key),
                        .mission_index = trial.mission_index,
                        .trial_key = trial.key,
                        .outcome = trial.outcome,
                        .reference_length_m = trial.reference_length_m,
                        .end_time_s = trial.end_time_s,
                        .goal_velocity_mps = goal_velocity_mps(trial),
                        .path_length_m = number_in(trial.fields[1]).value_or(0.0),
                        .cause = trial.cause,
                        .flight_digest = text_of(trial.fields[0])});
      }
      std::sort(part.begin(), part.end(), [](const SuiteRow& a, const SuiteRow& b) {
        return std::tuple(a.map_seed, a.mission_index) < std::tuple(b.map_seed, b.mission_index);
      });
      std::move(part.begin(), part.end(), std::back_inserter(rows));
    }
  }
  return rows;
}

void write_result(const SuiteResult& result, const fs::path& folder) {
  std::string table = std::string(kResultTitle) + "\r\n" + header_line();
  for (const SuiteRow& row : result.rows) table += line_of(row);
  write_file(folder / kTrialsFile, table);
  write_file(folder / kPlannerFile, planner_yaml(result, folder));
}

SuiteResult read_result(const fs::path& folder) {
  const fs::path file = folder / kPlannerFile;
  const YamlNode root = read_yaml(file);
  Reading reading;
  const GivenValue given{root, "", reading};
  const auto take = [&](std::string_view name, bool is_needed = true) -> std::string {
    const YamlNode* node = root.find(name);
    if (node != nullptr) return read_text(given.at(*node, name)).value_or("");
    if (is_needed) given.add_problem("lacks '" + std::string(name) + "'");
    return "";
  };
  SuiteResult result;
  result.suite = take("suite");
  result.track = take("track");
  result.track_sha256 = take("track_sha256");
  const std::string split = take("split");
  result.key_sha256 = take("key_sha256", false);
  result.label = take("label");
  result.planner_name = take("name");
  result.planner_version = take("version");
  result.planner_digest = take("digest");
  result.program = take("program", false);
  if (const YamlNode* node = root.find("is_privileged")) {
    result.is_privileged = read_truth(given.at(*node, "is_privileged")).value_or(false);
  }
  const auto known = enum_from_text<Split>(split);
  if (!known && !split.empty()) {
    given.at(*root.find("split"), "split").add_expected("dev, public or sealed");
  }
  if (!reading.problems.empty()) throw InputError(std::move(reading.problems));
  result.split = *known;
  result.planner = read_suite_planner(file);
  result.rows = read_rows(folder / kTrialsFile);
  return result;
}

std::string rows_problem(const SuiteSpec& suite, const SuiteResult& result) {
  const std::int64_t missions = missions_a_map(suite, result.split);
  std::map<std::string, std::string> cell_of;  // of a sweep
  for (const SuiteCell& cell : suite.cells) {
    for (const SuiteSweep& sweep : cell.sweeps) cell_of[sweep.name] = cell.name;
  }
  std::map<std::string, std::set<std::uint64_t>> maps_of;  // by sweep
  std::set<std::tuple<std::string, std::uint64_t, std::int64_t>> seen;
  for (const SuiteRow& row : result.rows) {
    const std::string place = row.sweep + ", map " + std::to_string(row.map_seed) + ", mission " +
                              std::to_string(row.mission_index);
    const auto cell = cell_of.find(row.sweep);
    if (cell == cell_of.end() || cell->second != row.cell) {
      return place + ": the suite has no such sweep in a cell " + row.cell;
    }
    if (row.mission_index < 0 || row.mission_index >= missions) return place + ": no such mission";
    if (!seen.emplace(row.sweep, row.map_seed, row.mission_index).second) {
      return place + ": it is listed twice";
    }
    maps_of[row.sweep].insert(row.map_seed);
    const bool is_there = row.outcome == Outcome::reached_goal;
    const double velocity_mps = is_there ? row.reference_length_m / row.end_time_s : 0.0;
    if (row.goal_velocity_mps == velocity_mps) continue;
    return place + ": goal velocity " + shortest(row.goal_velocity_mps) +
           " m/s, but its length over its time is " + shortest(velocity_mps);
  }
  for (const SuiteCell& cell : suite.cells) {
    for (const SuiteSweep& sweep : cell.sweeps) {
      std::set<std::uint64_t> expected = maps_of[sweep.name];
      // Sealed seeds follow from a key that is not here: their number alone is known.
      if (result.split != Split::sealed) {
        const SweepSeeds seeds = seeds_of(suite, cell, sweep, result.split, "");
        expected = {seeds.map_seeds.begin(), seeds.map_seeds.end()};
      }
      if (maps_of[sweep.name] != expected ||
          static_cast<std::int64_t>(expected.size()) != sweep.map_count) {
        return sweep.name + ": its maps are not those of the suite";
      }
    }
  }
  const auto expected = static_cast<std::size_t>(mission_count(suite, result.split));
  if (seen.size() == expected) return "";
  return counted(seen.size(), "trial") + ", expected " + std::to_string(expected);
}

std::int64_t mission_count(const SuiteSpec& suite, Split split) {
  std::int64_t maps = 0;
  for (const SuiteCell& cell : suite.cells) {
    for (const SuiteSweep& sweep : cell.sweeps) maps += sweep.map_count;
  }
  return maps * missions_a_map(suite, split);
}

}  // namespace avoidbench
