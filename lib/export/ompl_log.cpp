#include "export/ompl_log.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>

#include "base/check.hpp"
#include "report/environment_summary.hpp"
#include "store/record_format.hpp"
#include "text/number_text.hpp"
#include "text/words.hpp"

namespace avoidbench {
namespace {

constexpr std::size_t kKeyLetters = 8;  // of a key in a name

/// A word of OMPL's grammar: no white space, and none of the marks that part values.
std::string as_word(const std::string& text) {
  std::string word = text;
  for (char& c : word) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte <= 0x20 || byte == 0x7f || c == '|' || c == ';') c = '_';
  }
  return word.empty() ? "_" : word;
}

/// One line of a text in several lines.
std::string as_line(std::string text) {
  std::replace(text.begin(), text.end(), '\n', ' ');
  std::replace(text.begin(), text.end(), '\r', ' ');
  return text + "\n";
}

/// A number that a REAL field can hold: OMPL's scripts take no value for infinity.
std::string finite(double value) { return std::isfinite(value) ? shortest(value) : ""; }

/// "2024-02-03T04:05:06Z" as OMPL writes dates: "2024-02-03 04:05:06".
std::string date_text(std::string date) {
  std::replace(date.begin(), date.end(), 'T', ' ');
  if (date.ends_with('Z')) date.pop_back();
  return date.empty() ? "unknown" : date;
}

/// The reader's present row with its columns by name.
class TrialFields {
 public:
  explicit TrialFields(const TrialTableReader& reader) : reader_(reader) {
    for (std::size_t i = 0; i < reader.columns().size(); ++i) at_[reader.columns()[i]] = i;
  }
  const TableValue& operator[](const std::string& name) const {
    const auto found = at_.find(name);
    AB_CHECK(found != at_.end(), name);
    return reader_.row()[found->second];
  }
  std::string text(const std::string& name) const { return text_of((*this)[name]); }
  /// Whole numbers count as reals; nothing and texts are NaN.
  double real(const std::string& name) const {
    return number_in((*this)[name]).value_or(std::nan(""));
  }
  bool has(const std::string& name) const { return at_.contains(name); }

 private:
  const TrialTableReader& reader_;
  std::map<std::string, std::size_t> at_;
};

/// A property of each run: its name with OMPL's type, and its value as text.
struct RunProperty {
  std::string name, type;
  std::string (*value)(const TrialFields&, const std::string& name);
};

std::string stored_value(const TrialFields& trial, const std::string& name) {
  return finite(trial.real(name));
}

std::string planning_time(const TrialFields& trial, const std::string&) {
  constexpr double kSecondsPerMs = 0.001;
  // Mean over the calls times their number.
  return finite(kSecondsPerMs * trial.real("processing_time_ms") * trial.real("plan_call_count"));
}

std::string is_solved(const TrialFields& trial, const std::string&) {
  return trial.text("outcome") == text(Outcome::reached_goal) ? "1" : "0";
}

/// The outcome's number among the values that the preamble lists.
std::string status(const TrialFields& trial, const std::string&) {
  const std::optional<Outcome> outcome = enum_from_text<Outcome>(trial.text("outcome"));
  return outcome ? std::to_string(static_cast<int>(*outcome)) : "";
}

/// Only of a flight that arrived: the way up to a crash is no solution.
std::string solution_length(const TrialFields& trial, const std::string&) {
  return trial.text("outcome") == text(Outcome::reached_goal) ? finite(trial.real("path_length_m"))
                                                              : "";
}

/// The properties of a run, in the order of its line's values. Those that the database lacks (an
/// older program's) are left out.
std::vector<RunProperty> run_properties(const Database& database, const TrialFields& fields) {
  std::vector<RunProperty> properties;
  if (fields.has("processing_time_ms") && fields.has("plan_call_count")) {
    properties.push_back({"time", "REAL", planning_time});
  }
  properties.push_back({"solved", "BOOLEAN", is_solved});
  properties.push_back({"status", "ENUM", status});
  if (fields.has("path_length_m")) {
    properties.push_back({"solution_length", "REAL", solution_length});
  }
  properties.push_back({"mission_index", "INTEGER", stored_value});
  for (const char* name : {"reference_length_m", "traversability_obstruction", "view_occlusion",
                           "angle_over_length_1pm"}) {
    properties.push_back({name, "REAL", stored_value});
  }
  for (const MetricRow& metric : database.metrics()) {
    if (metric.name == "finished") continue;  // that is `solved`
    const bool is_count = metric.name.ends_with("_count");
    properties.push_back({metric.name, is_count ? "INTEGER" : "REAL", stored_value});
  }
  return properties;
}

/// A planner's runs on the map.
struct PlannerRuns {
  std::string name, planner_key;
  std::string lines = {};                    // of its runs
  std::vector<std::string> trial_keys = {};  // in order of the lines
};

/// The lines of all runs on the experiment's map, and which properties these have.
std::vector<PlannerRuns> read_runs(const Database& database, const OmplExperiment& experiment,
                                   std::vector<RunProperty>& properties) {
  TrialTableReader reader(database, {&experiment.sweep, 1}, experiment.flights.map_key);
  const TrialFields trial(reader);
  properties = run_properties(database, trial);
  std::vector<PlannerRuns> planners;
  // Rows come by planner: a planner's runs adjoin.
  while (reader.next()) {
    const std::string key = trial.text("planner_key");
    if (planners.empty() || planners.back().planner_key != key) {
      planners.push_back({.name = as_word(trial.text("planner")), .planner_key = key});
    }
    for (const RunProperty& property : properties) {
      // An empty value is one that OMPL's scripts take as missing.
      planners.back().lines += property.value(trial, property.name) + "; ";
    }
    planners.back().lines += "\n";
    planners.back().trial_keys.push_back(trial.text("trial_key"));
  }
  // Names must differ in a log: labels may be alike for two files, or become alike as words.
  std::map<std::string, int> uses;
  for (const PlannerRuns& planner : planners) ++uses[planner.name];
  for (PlannerRuns& planner : planners) {
    if (uses[planner.name] > 1) planner.name += "_" + planner.planner_key.substr(0, kKeyLetters);
  }
  return planners;
}

/// The log's head, line by line as OMPL's grammar wants them.
std::string preamble(const OmplExperiment& experiment, const std::vector<PlannerRuns>& planners) {
  const RunRow& run = experiment.flights.first_run;
  const MapRecord& map = experiment.map.record;
  std::string text = "avoidbench version " + as_word(run.program_version) + "\n";
  text += "Experiment " + experiment.name + "\n";
  std::vector<std::string> properties;
  const auto add = [&](const std::string& name, double value) {
    if (std::isfinite(value)) properties.push_back(name + " REAL = " + shortest(value) + "\n");
  };
  add("poisson_radius_m", spec_number(experiment.map, "poisson_radius_m"));
  add("traversability", map.traversability);
  add("traversability_normalized_ratio", map.traversability_normalized_ratio);
  add("relative_gap_size", map.relative_gap_size);
  add("obstacle_density_1pm2", map.obstacle_density_1pm2);
  add("free_volume_ratio", map.free_volume_ratio);
  if (!properties.empty()) {
    text += std::to_string(properties.size()) + " experiment properties\n" + joined(properties, "");
  }
  text += "Running on " + as_word(run.host) + "\n";
  text += "Starting at " + date_text(run.started_at) + "\n";
  // The set-up, then the host's processor and the build, both as free text.
  text += "<<<|\n" + as_line("map " + experiment.map.spec_json) +
          as_line("map_key " + map.key + ", world " + map.world_digest) +
          as_line("sweep " + experiment.sweep.name + ", revision " +
                  std::to_string(experiment.sweep.revision) + ", git " + run.git_hash) +
          "|>>>\n";
  text += "<<<|\n" + as_line(run.cpu + ", " + run.isa) +
          as_line("built with " + run.compiler + ", " + run.flags) + "|>>>\n";

  std::size_t run_count = 0;
  for (const PlannerRuns& planner : planners) {
    run_count = std::max(run_count, planner.trial_keys.size());
  }
  text += std::to_string(experiment.map.map_seed) + " is the random seed\n";
  text += shortest(std::isnan(experiment.flights.time_limit_s) ? 0.0
                                                               : experiment.flights.time_limit_s) +
          " seconds per run\n0 MB per run\n";  // 0: no limit is stored
  text += std::to_string(run_count) + " runs per planner\n";
  text += shortest(experiment.flights.wall_time_s) + " seconds spent to collect the data\n";
  text += "1 enum type\nstatus";
  for (const auto& [outcome, name] : EnumText<Outcome>::entries) text += "|" + std::string(name);
  return text + "\n" + std::to_string(planners.size()) + " planners\n";
}

std::string common_properties(const PlannerRow& planner) {
  std::vector<std::string> lines = {
      "planner_name = " + as_word(planner.name), "planner_version = " + as_word(planner.version),
      "file_sha256 = " + as_word(planner.file_digest),
      "is_privileged = " + std::to_string(planner.is_privileged ? 1 : 0)};
  const auto parsed = nlohmann::json::parse(planner.parameters_json, nullptr, false);
  const auto parameters = parsed.is_discarded() ? nlohmann::json::object() : parsed;
  for (const auto& [name, value] : parameters.items()) {
    const std::string word = value.is_string()         ? value.get<std::string>()
                             : value.is_number_float() ? shortest(value.get<double>())
                                                       : value.dump();
    lines.push_back(as_word(name) + " = " + as_word(word));
  }
  std::string text = std::to_string(lines.size()) + " common properties\n";
  for (const std::string& line : lines) text += line + "\n";
  return text;
}

/// The flight in steps of at least `period_s`, its last sample among them.
std::string progress_line(std::span<const Sample> samples, const Eigen::Vector3d& goal_world,
                          double period_s) {
  // A run has a line in any case, since lines are counted.
  if (samples.empty()) return "0,nan,nan,nan,;\n";
  std::string line;
  double next_s = 0.0;
  for (const Sample& sample : samples) {
    const bool is_due = sample.time_s >= next_s || &sample == &samples.back();
    if (!is_due) continue;
    // The next multiple of the period, so that times don't drift where samples are late.
    next_s = (std::floor(sample.time_s / period_s) + 1.0) * period_s;
    line += shortest(sample.time_s) + "," + shortest((sample.position_world - goal_world).norm()) +
            "," + shortest(sample.velocity_world.norm()) + "," + text_of(sample.clearance_m) + ",;";
  }
  return line + "\n";
}

/// NaN for a mission that the map lacks.
Eigen::Vector3d goal_of(const MapRow& map, std::int64_t mission_index) {
  for (const MissionRecord& mission : map.record.missions) {
    if (mission.index == mission_index) return mission.mission.goal_world;
  }
  return Eigen::Vector3d::Constant(std::nan(""));
}

}  // namespace

/// An experiment of OMPL is one problem for several planners: here, one map. Its name is the
/// file's.
std::vector<OmplExperiment> ompl_experiments(const Database& database, const SweepInfo& sweep) {
  std::vector<OmplExperiment> experiments;
  for (MapFlights& flights : read_map_flights(database, sweep)) {
    std::optional<MapRow> map = database.read_map(flights.map_key);
    AB_CHECK(map.has_value(), flights.map_key);
    std::string name = sweep.name;
    if (sweep.revision > 1) name += "_" + std::to_string(sweep.revision);
    name += "-" + map->generator;
    const double radius_m = spec_number(*map, "poisson_radius_m");
    if (!std::isnan(radius_m)) name += "-r" + shortest(radius_m);
    name += "-s" + std::to_string(map->map_seed) + "-" + flights.map_key.substr(0, kKeyLetters);
    experiments.push_back({.name = as_word(name),
                           .sweep = sweep,
                           .map = std::move(*map),
                           .flights = std::move(flights)});
  }
  return experiments;
}

/// Planner by planner: common properties, properties of runs with a line a run, and the progress of
/// each run, for which its flight is read from the database one at a time.
void write_ompl_log(const Database& database, const OmplExperiment& experiment,
                    double progress_period_s,
                    const std::function<void(const std::string&)>& write) {
  std::map<std::string, PlannerRow> rows;
  for (const PlannerRow& row : database.read_planners()) rows.emplace(planner_key(row), row);
  std::vector<RunProperty> properties;
  // All runs are read first: the preamble says how many planners follow.
  const std::vector<PlannerRuns> planners = read_runs(database, experiment, properties);
  write(preamble(experiment, planners));
  for (const PlannerRuns& planner : planners) {
    write(planner.name + "\n" + common_properties(rows[planner.planner_key]));
    write(std::to_string(properties.size()) + " properties for each run\n");
    for (const RunProperty& property : properties) {
      write(property.name + " " + property.type + "\n");
    }
    write(std::to_string(planner.trial_keys.size()) + " runs\n" + planner.lines);
    if (progress_period_s > 0.0) {
      write(
          "4 progress properties for each run\ntime REAL\ngoal_distance_m REAL\n"
          "speed_mps REAL\nclearance_m REAL\n" +
          std::to_string(planner.trial_keys.size()) + " runs\n");
      for (const std::string& key : planner.trial_keys) {
        const std::optional<TrialRow> trial = database.read_trial(key);
        AB_CHECK(trial.has_value(), key);
        write(progress_line(trial->record.samples, goal_of(experiment.map, trial->mission_index),
                            progress_period_s));
      }
    }
    write(".\n");
  }
}

}  // namespace avoidbench
