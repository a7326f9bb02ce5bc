#include "real_flights/import_flights.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <set>

#include "base/digest.hpp"
#include "base/math.hpp"
#include "base/number_text.hpp"
#include "base/option_error.hpp"
#include "base/spec_json.hpp"
#include "base/words.hpp"
#include "logs/recorded_flight.hpp"
#include "metrics/metric_table.hpp"
#include "real_flights/alignment.hpp"
#include "real_flights/judged_flight.hpp"
#include "real_flights/logged_calls.hpp"
#include "sweep/listed_missions.hpp"
#include "sweep/sweep_rows.hpp"
#include "trial/map_scene.hpp"

namespace avoidbench {
namespace {

/// A flight's log, in the map's frame, its times from the flight's beginning.
struct ReadLog {
  RecordingSpec spec;
  RecordedMotion motion;
  std::vector<PlanCall> calls;
  double rate_hz = 0.0;  ///< of its poses, on the mean
};

/// To whole millimetres: what the twin's file can say in few digits, to the last bit.
std::array<double, 3> in_millimetres(const Eigen::Vector3d& place) {
  std::array<double, 3> rounded_m{};
  for (std::size_t i = 0; i < 3; ++i) {
    rounded_m[i] = std::round(place[static_cast<Eigen::Index>(i)] * 1000.0) / 1000.0 + 0.0;
  }
  return rounded_m;
}

/// Throws where the poses can't say what was flown: too few, a gap among them, or more than memory
/// is for.
void check_poses(const std::vector<MeasuredPosition>& positions) {
  constexpr double kLongestGap_s = 1.0;
  constexpr std::size_t kMostPoses = 500'000, kFewestPoses = 10;
  if (positions.size() < kFewestPoses) {
    throw InputError("has " + std::to_string(positions.size()) +
                     " poses between begin_s and end_s; at least 10 are needed");
  }
  if (positions.size() > kMostPoses) {
    throw InputError("has " + std::to_string(positions.size()) +
                     " poses between begin_s and end_s, more than 500000: 200 Hz are enough");
  }
  for (std::size_t i = 1; i < positions.size(); ++i) {
    const double gap_s = positions[i].time_s - positions[i - 1].time_s;
    if (gap_s <= kLongestGap_s) continue;
    throw InputError("has no pose for " + fixed_digits(gap_s, 2) + " s, " +
                     fixed_digits(positions[i - 1].time_s, 2) +
                     " s after begin_s: the flight in between is unknown");
  }
}

/// SHA-256 of a log, of a folder that of its files by name.
std::string log_digest(const std::string& log) {
  if (!std::filesystem::is_directory(log)) return file_digest(log);
  std::map<std::string, std::string> files;
  for (const auto& entry : std::filesystem::directory_iterator(log)) {
    if (entry.is_regular_file()) {
      files[entry.path().filename().string()] = file_digest(entry.path());
    }
  }
  Digest digest;
  for (const auto& [name, of_file] : files) digest.add(name).add(of_file);
  return digest.hex();
}

ReadLog read_log(const ReadRealFlight& flight, const FlightsFile& file, const Pose& T_map_log,
                 ImportedFlights& imported) {
  const RealFlightSpec& given = flight.spec;
  const RecordedFlight recorded = read_recorded_flight(
      {.file = given.log, .topic = given.topic, .child_frame = given.child_frame});
  for (const std::string& warning : recorded.warnings) {
    imported.warnings.push_back(text(flight.problem("log", given.log + ": " + warning)));
  }
  const Eigen::Quaterniond q_map_log(T_map_log.linear());
  const RecordingSpec spec{
      .log = std::filesystem::path(given.log).filename().string(),
      .log_digest = log_digest(given.log),
      .topic = given.topic,
      .child_frame = given.child_frame,
      .begin_s = given.begin_s,
      .end_s = given.end_s,
      .translation_m = to_array(T_map_log.translation()),
      .q_map_log = {q_map_log.w(), q_map_log.x(), q_map_log.y(), q_map_log.z()},
      .smoothing = file.smoothing,
      .outcome = given.outcome,
      .calls_digest = given.calls.empty() ? "" : file_digest(given.calls)};
  std::vector<MeasuredPosition> positions;
  std::vector<MeasuredAttitude> attitudes;
  const std::int64_t first_ns = recorded.poses.empty() ? 0 : recorded.poses.front().time_ns;
  for (const RecordedPose& pose : recorded.poses) {
    // From whole nanoseconds: seconds since 1970 in a double are too coarse.
    const double time_s = static_cast<double>(pose.time_ns - first_ns) * 1e-9;
    if (time_s < given.begin_s) continue;
    if (given.end_s > 0.0 && time_s > given.end_s) break;
    positions.push_back({time_s - given.begin_s, T_map_log * pose.position});
    if (recorded.has_attitude) {
      attitudes.push_back({time_s - given.begin_s, (q_map_log * pose.q).normalized()});
    }
  }
  check_poses(positions);
  const double duration_s = positions.back().time_s;
  return {.spec = spec,
          .motion = {.path = SmoothPath(positions, file.smoothing),
                     .attitudes = std::move(attitudes),
                     .duration_s = duration_s},
          .calls = given.calls.empty() ? std::vector<PlanCall>{}
                                       : read_logged_calls(given.calls, given.begin_s),
          .rate_hz = static_cast<double>(positions.size() - 1) / duration_s};
}

/// Start, goal and heading of a flight.
TwinMission mission_of(const ReadRealFlight& flight, const RecordedMotion& motion,
                       double goal_radius_m) {
  const RealFlightSpec& given = flight.spec;
  const Eigen::Vector3d first = motion.path.at(0.0).position_world;
  TwinMission mission{.start_m = in_millimetres(first),
                      .goal_m = {given.goal[0], given.goal[1], given.goal[2]}};
  if (!given.start.empty()) {
    mission.start_m = {given.start[0], given.start[1], given.start[2]};
    const double off_m = (first - to_eigen(mission.start_m)).norm();
    if (off_m > goal_radius_m) {
      throw InputError(flight.problem(
          "start", "start: the log is " + fixed_digits(off_m, 2) +
                       " m from it at begin_s, more than mission.goal_radius_m; alignment, begin_s "
                       "or start is wrong"));
    }
  }
  const double yaw_rad = motion.attitudes.empty() ? yaw_toward_goal_rad(to_eigen(mission.start_m),
                                                                        to_eigen(mission.goal_m))
                                                  : yaw_of(motion.attitudes.front().q_world_body);
  // As the twin's file will say it, so that both have the same bits.
  mission.yaw_deg = *number_from<double>(fixed_digits(yaw_rad / math::kDegree, 2));
  return mission;
}

Mission flown(const TwinMission& mission) {
  return {.start_world = to_eigen(mission.start_m),
          .goal_world = to_eigen(mission.goal_m),
          .start_yaw_rad = mission.yaw_deg * math::kDegree};
}

/// The planner of a flight, as trials name it. No file flew: its digest is empty.
PlannerChoice choice_of(const std::string& planner) {
  PlannerChoice choice;
  choice.plugin = planner;
  choice.label = planner + std::string(kRealLabel);
  return choice;
}

/// The sweep that the flights are the trials of: mission k is flight k.
SweepSpec sweep_of(const FlightsFile& file, const std::vector<TwinMission>& missions) {
  SweepSpec sweep;
  sweep.name = file.name;
  sweep.base = file.place.trial;
  sweep.trials = static_cast<std::int64_t>(missions.size());
  for (std::size_t k = 0; k < missions.size(); ++k) {
    sweep.missions.push_back(
        {.map = "", .mission = flown(missions[k]), .place = file.flights[k].problem("goal", "")});
  }
  std::set<std::string> labels;
  for (const ReadRealFlight& flight : file.flights) {
    if (labels.insert(flight.spec.planner).second) {
      sweep.planners.push_back(choice_of(flight.spec.planner));
    }
  }
  return sweep;
}

void check_place(const FlightsFile& file) {
  const TrialSpec& trial = file.place.trial;
  const auto refuse = [&](const std::string& message) {
    throw InputError({.file = file.document.file.string(), .message = message});
  };
  if (has_movers(trial.movers)) refuse("sweep.movers: real flights have none; remove them");
  if (trial.mission.waypoints > 0 || trial.mission.return_to_start ||
      trial.mission.goal_motion.path != GoalPath::none) {
    refuse("sweep.mission: a real flight has one goal, which does not move");
  }
}

/// Reads all logs and lays out a mission for each.
std::vector<ReadLog> read_logs(const FlightsFile& file, ImportedFlights& imported) {
  const Alignment alignment = align(file.alignment, file.alignment_place);
  imported.alignment_residual_m = alignment.residual_m;
  std::vector<InputProblem> problems;
  std::vector<ReadLog> logs;
  for (const ReadRealFlight& flight : file.flights) {
    try {
      logs.push_back(read_log(flight, file, alignment.T_map_log, imported));
    } catch (const InputError& error) {
      for (const InputProblem& problem : error.problems()) {
        problems.push_back(flight.problem("log", "log: " + text(problem)));
      }
      continue;
    }
    try {
      imported.missions.push_back(
          mission_of(flight, logs.back().motion, file.place.trial.mission.goal_radius_m));
    } catch (const InputError& error) {
      problems.insert(problems.end(), error.problems().begin(), error.problems().end());
    }
  }
  if (!problems.empty()) throw InputError(std::move(problems));
  return logs;
}

MapRow map_row(const TrialSpec& setting, const Scene& scene, const SweepSpec& sweep) {
  std::vector<Mission> missions;
  for (const ListedMission& listed : sweep.missions) missions.push_back(listed.mission);
  MapRow row{.record = make_map_record(setting, scene, sweep.trials, missions),
             .generator = std::string(kind(setting.map)),
             .spec_json = {},
             .map_seed = setting.map_seed};
  row.record.key = map_key(setting);
  nlohmann::json spec = spec_to_json(setting.map);
  forget_folder(spec);
  row.spec_json = spec.dump();
  return row;
}

/// The flight as a row. Throws InputError at its place where it has no valid mission or contradicts
/// what is given.
ImportedFlight imported_flight(const ReadRealFlight& flight, ReadLog log, TrialSpec spec,
                               const MissionRecord& mission, const Scene& scene) {
  if (!mission.is_valid) {
    throw InputError(flight.problem(
        "start",
        mission.invalid_reason +
            " (sweep.mission.free_radius_m says how much free space starts and goals need)"));
  }
  spec.mission_index = mission.index;
  spec.planner = choice_of(flight.spec.planner);
  spec.recording = log.spec;
  JudgedFlight judged = judge(spec, mission.mission, scene, log.motion);
  if (!judged.problem.empty()) throw InputError(flight.problem("outcome", judged.problem));
  std::erase_if(log.calls, [&](const PlanCall& call) {
    return call.time_s < 0.0 || call.time_s > judged.record.end_time_s;
  });
  judged.record.plan_calls = std::move(log.calls);
  ImportedFlight one{.row = {},
                     .reference_length_m = mission.reference_length_m,
                     .residual_m = log.motion.path.residual_m(),
                     .rate_hz = log.rate_hz,
                     .has_attitude = !log.motion.attitudes.empty(),
                     .spec = spec};
  one.row = {.key = trial_key(spec),
             .sweep = {},
             .map_key = map_key(spec),
             .planner_label = spec.planner.label,
             .planner_file_digest = "",
             .mission_index = spec.mission_index,
             .spec_json = trial_json(spec),
             .record = std::move(judged.record),
             .metrics = {}};
  one.row.metrics = compute_metrics({spec, mission, one.row.record});
  return one;
}

/// The latest revision of the sweep of this name.
SweepInfo sweep_named(const Database& database, const std::string& name) {
  const std::vector<SweepInfo> sweeps = database.read_sweeps();
  std::vector<std::string> names;
  const SweepInfo* found = nullptr;
  for (const SweepInfo& sweep : sweeps) {
    names.push_back(sweep.name);
    if (sweep.name == name) found = &sweep;  // revisions rise
  }
  if (found == nullptr) {
    throw OptionError(database.path().string() + " has no sweep " + name +
                          did_you_mean(name, names) + "; there are: " + joined(names),
                      "", "beside");
  }
  return *found;
}

/// Of these positions another noise is more likely than `smoothing.position_noise_m`.
void warn_of_noise(const FlightsFile& file, ImportedFlights& imported) {
  constexpr double kFactor = 2.0;
  const double noise_m = file.smoothing.position_noise_m;
  for (std::size_t k = 0; k < imported.flights.size(); ++k) {
    const double residual_m = imported.flights[k].residual_m;
    if (residual_m <= kFactor * noise_m) continue;
    imported.warnings.push_back(text(file.flights[k].problem(
        "log", "its positions are " + significant_digits(residual_m, 2) +
                   " m from the smoothed path (RMS per axis): set smoothing.position_noise_m near "
                   "that, or raise smoothing.jerk_mps3")));
  }
}

}  // namespace

ImportedFlights import_flights(const FlightsFile& file) {
  check_place(file);
  ImportedFlights imported;
  std::vector<ReadLog> logs = read_logs(file, imported);
  const SweepSpec sweep = sweep_of(file, imported.missions);
  const TrialSpec setting = *expand(sweep).front().setting;
  const MapScene map(setting);
  imported.map = map_row(setting, map.scene, sweep);
  std::vector<InputProblem> problems;
  std::vector<PlannedTrial> trials;
  for (std::size_t k = 0; k < file.flights.size(); ++k) {
    const MissionRecord& mission = imported.map.record.missions[k];
    try {
      imported.flights.push_back(
          imported_flight(file.flights[k], std::move(logs[k]), setting, mission, map.scene));
    } catch (const InputError& error) {
      problems.insert(problems.end(), error.problems().begin(), error.problems().end());
      continue;
    }
    imported.flights.back().row.sweep = file.name;
    trials.push_back({.setting = std::make_shared<const TrialSpec>(imported.flights.back().spec),
                      .mission_index = mission.index,
                      .latency_digest = {}});
  }
  if (!problems.empty()) throw InputError(std::move(problems));
  warn_of_noise(file, imported);
  imported.sweep = {.name = file.name, .spec_json = sweep_json(sweep, trials)};
  for (const PlannerChoice& planner : sweep.planners) {
    imported.planners.push_back({.label = planner.label,
                                 .name = planner.plugin,
                                 .version = "",
                                 .file_digest = "",
                                 .parameters_json = "{}"});
  }
  return imported;
}

std::size_t store_flights(const ImportedFlights& imported, const RunRow& run,
                          const std::string& beside, Database& database) {
  const std::optional<SweepInfo> simulated =
      beside.empty() ? std::nullopt : std::optional(sweep_named(database, beside));
  const std::set<std::string> there = database.finished_keys();
  database.add_run(run);
  database.add_sweep(imported.sweep);
  for (const PlannerRow& planner : imported.planners) database.add_planner(planner);
  database.add_map(imported.map, imported.sweep.name);
  std::vector<std::string> known;
  std::size_t added = 0;
  for (const ImportedFlight& flight : imported.flights) {
    if (there.contains(flight.row.key)) {
      known.push_back(flight.row.key);
      continue;
    }
    database.add_trial(flight.row);
    ++added;
  }
  database.add_to_sweep(imported.sweep.name, known);
  if (simulated) {
    std::vector<std::string> all;
    for (const ImportedFlight& flight : imported.flights) all.push_back(flight.row.key);
    // As it is there: later calls then mean this revision.
    database.add_sweep({.name = simulated->name, .spec_json = simulated->spec_json});
    database.add_to_sweep(simulated->name, all);
  }
  return added;
}

std::vector<std::string> lacking_metrics(const ImportedFlights& imported) {
  // What has a value once all is said that logs can lack.
  std::set<std::size_t> lacking;
  for (std::size_t k = 0; k < imported.flights.size(); ++k) {
    const ImportedFlight& flight = imported.flights[k];
    TrialRecord whole = flight.row.record;
    for (Sample& sample : whole.samples) {
      sample.reference_world = sample.position_world;
      sample.rotor_power_w = 0.0;
    }
    whole.plan_calls.assign(2, PlanCall{});
    const std::vector<double> values =
        compute_metrics({flight.spec, imported.map.record.missions[k], whole});
    for (std::size_t m = 0; m < values.size(); ++m) {
      if (std::isnan(flight.row.metrics[m]) && !std::isnan(values[m])) lacking.insert(m);
    }
  }
  std::vector<std::string> names;
  for (const std::size_t m : lacking) names.emplace_back(metric_table()[m].name);
  return names;
}

}  // namespace avoidbench
