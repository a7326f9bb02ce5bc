#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <type_traits>
#include <vector>

#include "base/enum_text.hpp"
#include "base/fields.hpp"
#include "maps/map_spec.hpp"
#include "movers/mover_spec.hpp"
#include "plugin/planner_description.hpp"
#include "sensing/imu.hpp"
#include "sensing/odometry.hpp"
#include "sensing/sensor_spec.hpp"
#include "sensing/tracks.hpp"
#include "trial/recording_spec.hpp"
#include "vehicle/vehicle_spec.hpp"
#include "wind/wind_spec.hpp"

namespace avoidbench {

enum class GoalPath { none, line, circle };

template <>
struct EnumText<GoalPath> {
  static constexpr std::pair<GoalPath, std::string_view> entries[] = {
      {GoalPath::none, "none"}, {GoalPath::line, "line"}, {GoalPath::circle, "circle"}};
};

/// How a mission's last goal moves: see goal_place() of trial/goals.hpp.
struct GoalMotionSpec {
  GoalPath path = GoalPath::none;
  double speed_mps = 1.0;
  double extent_m = 4.0;  ///< length of the line, diameter of the circle
};

template <class Visitor, ConstOr<GoalMotionSpec> Spec>
void visit(Visitor& v, Spec& s) {
  v.field("path", s.path,
          "none: it stands still; line: back and forth across the way to it, with the place in the "
          "middle; circle: through the place, anticlockwise, leaving it straight ahead.");
  v.field("speed_mps", s.speed_mps, Range{0.01, 20}, "Its constant speed.");
  v.field("extent_m", s.extent_m, Range{0.1, 100}, "Length of the line; diameter of the circle.");
}

/// Goals of one mission at most, drawn or listed.
inline constexpr int kMostGoals = 1000;

/// The rules of a flight.
struct MissionSpec {
  double goal_radius_m = 0.8;
  double time_limit_s = 60.0;
  double free_radius_m = 1.3;
  std::int64_t max_collisions = 0;
  std::int64_t waypoints = 0;
  bool return_to_start = false;
  GoalMotionSpec goal_motion = {};
};

template <class Visitor, ConstOr<MissionSpec> Spec>
void visit(Visitor& v, Spec& s) {
  v.field("goal_radius_m", s.goal_radius_m, Range{0.05, 20},
          "The goal is reached within this horizontal distance.");
  v.field("time_limit_s", s.time_limit_s, Range{1, 3600}, "A longer flight ends with timed_out.");
  v.field("free_radius_m", s.free_radius_m, Range{0.4, 10},
          "No surface is nearer than this to a start or goal.");
  v.field("max_collisions", s.max_collisions, Range{0, 100},
          "Contacts that a flight may survive; the next one ends it with collided.");
  v.field("waypoints", s.waypoints, Range{0, 100},
          "Goals to reach in order before the last one, drawn anywhere in the flight bounds.");
  v.field("return_to_start", s.return_to_start, "Whether the start is one more goal, the last.");
  v.field("goal_motion", s.goal_motion, "How the last goal moves.");
}

/// How often things happen. Each period is a whole number of 1/36000 s ticks; see base/ticks.hpp.
struct RatesSpec {
  double physics_hz = 1000.0;
  double plan_hz = 30.0;
  double sample_hz = 100.0;
};

template <class Visitor, ConstOr<RatesSpec> Spec>
void visit(Visitor& v, Spec& s) {
  v.field("physics_hz", s.physics_hz, Range{250, 4000},
          "Steps of the vehicle's dynamics and collision tests per second.");
  v.field("plan_hz", s.plan_hz, Range{0.5, 1000}, "Calls of the planner per second.");
  v.field("sample_hz", s.sample_hz, Range{10, 1000},
          "Samples of the recorded trajectory per second.");
}

enum class LatencyMode { zero, fixed, measured, replay };

template <>
struct EnumText<LatencyMode> {
  static constexpr std::pair<LatencyMode, std::string_view> entries[] = {
      {LatencyMode::zero, "zero"},
      {LatencyMode::fixed, "fixed"},
      {LatencyMode::measured, "measured"},
      {LatencyMode::replay, "replay"}};
};

/// When a command takes effect: what the planner sees at time t acts at t + latency.
struct LatencySpec {
  LatencyMode mode = LatencyMode::fixed;
  double ms = 33.0;      ///< of `fixed`
  double scale = 1.0;    ///< of `measured`, and of the measured run that `replay` repeats
  std::string database;  ///< of that run; not part of a trial's key: see TrialSpec::latency_digest
};

/// Whether latencies are times that some machine took.
inline bool is_measured(const LatencySpec& latency) {
  return latency.mode == LatencyMode::measured || latency.mode == LatencyMode::replay;
}

template <class Visitor, ConstOr<LatencySpec> Spec>
void visit(Visitor& v, Spec& s) {
  v.field("mode", s.mode,
          "zero: immediately; fixed: after `ms`, the same on every machine; measured: after the "
          "wall time that the call took on this machine, times `scale`; replay: after the times of "
          "the measured run in `database`.");
  v.field("ms", s.ms, Range{0, 10000},
          "Time from an observation to the command that answers it (fixed).");
  v.field("scale", s.scale, Range{0.001, 1000},
          "How many times slower the planner's computer is than this machine (measured); that of "
          "the repeated run (replay).");
  v.field("database", s.database, "Database of the measured run that is repeated (replay).");
}

/// One configured parameter of a planner: a number, or a text.
struct ParameterChoice {
  std::string name;
  double number = 0.0;
  std::string text;
  bool is_text = false;
};

template <class Visitor, ConstOr<ParameterChoice> Spec>
void visit(Visitor& v, Spec& s) {
  v.field("name", s.name, "Name, as the planner declares it.");
  v.field("number", s.number, "Value of a numeric parameter.");
  v.field("text", s.text, "Value of a choice or text parameter.");
  v.field("is_text", s.is_text, "Whether the value is the text.");
}

template <class Visitor, ConstOr<PlannerFile> Spec>
void visit(Visitor& v, Spec& s) {
  v.field("name", s.name, "Relative to the planner's own file.");
  v.field("digest", s.digest, "SHA-256 of the file.");
}

inline constexpr std::int64_t kAllCameras = -1;

/// A library or program as chosen in a sweep, with its parameters.
struct PluginChoice {
  std::string plugin;                       ///< as named by the user
  std::string label;                        ///< what reports call it
  std::string file;                         ///< the file found for it; not part of a trial's key
  std::string file_digest;                  ///< planner_digest(); part of a trial's key
  std::vector<ParameterChoice> parameters;  ///< every declared parameter, in the planner's order
  /// How a program is started, where the sweep says so, with kFileWord for its file; part of a
  /// trial's key where it is not empty.
  std::vector<std::string> command = {};
  std::vector<PlannerFile> files = {};  ///< that file_digest is made of, where there are several
  std::uint32_t needs = 0;              ///< AB_… bits that it declares; follow from the file

  PlannerSource source() const { return {file, command}; }
};

template <class Visitor, ConstOr<PluginChoice> Spec>
void visit(Visitor& v, Spec& s) {
  v.field("plugin", s.plugin, "Bare name, or path of a library.");
  v.field("label", s.label, "Name in reports; unique in a sweep.");
  v.field("file", s.file, "The library or program found.");
  v.field("file_digest", s.file_digest, "SHA-256 of the library or program.");
  v.field("parameters", s.parameters, "Values of all its parameters.");
  v.field("command", s.command, "How a program is started, if the sweep gives a command.");
  v.field("files", s.files, "Files that it depends on, if it names any.");
}

/// A planner as chosen in a sweep.
struct PlannerChoice : PluginChoice {
  /// The one camera of the sensor that it sees, by its index; kAllCameras: each. Part of a trial's
  /// key where it is one.
  std::int64_t camera = kAllCameras;
  /// What its commands pass through; part of a trial's key where there is one.
  std::optional<PluginChoice> filter = {};
};

template <class Visitor, ConstOr<PlannerChoice> Spec>
void visit(Visitor& v, Spec& s) {
  using Plugin = std::conditional_t<std::is_const_v<Spec>, const PluginChoice, PluginChoice>;
  visit(v, static_cast<Plugin&>(s));
  v.field("camera", s.camera, Range{kAllCameras, 10000},
          "Index of the one camera of the sensor that it sees; -1: all.");
  v.field("filter", s.filter, "The filter that its commands pass through, if the sweep names one.");
}

/// The planner itself and its filter, where there is one.
std::vector<const PluginChoice*> plugins_of(const PlannerChoice& planner);

std::uint32_t needs_of(const PlannerChoice& planner);  ///< of all of them

/// By what a database and a worker know who flies: file_digest, or one of the digests of both.
std::string flown_digest(const PlannerChoice& planner);

/// Everything that determines one trial. A trial is a pure function of this and the planner's file.
struct TrialSpec {
  MapSpec map;
  std::uint64_t map_seed = 1;
  std::uint64_t seed = 1;  ///< of the sweep: missions and noise follow from it
  std::int64_t mission_index = 0;
  MissionSpec mission;
  VehicleSpec vehicle = hummingbird_spec();
  SensorSpec sensor;
  ImuSpec imu;
  OdometrySpec odometry;
  PlannerChoice planner;
  RatesSpec rates;
  LatencySpec latency;
  std::string latency_digest;  ///< of the times that a replay takes; the program fills it
  /// Of the map's missions where the sweep lists its own (sweep/own_missions.hpp); "": generated.
  std::string missions_digest;
  WindSpec wind;
  MoversSpec movers;
  TracksSpec tracks;
  /// Of a trial that was flown in reality; nothing can fly it again.
  std::optional<RecordingSpec> recording = {};
};

template <class Visitor, ConstOr<TrialSpec> Spec>
void visit(Visitor& v, Spec& s) {
  v.field("map", s.map, "The map.");
  v.field("map_seed", s.map_seed, "Seed of the map.");
  v.field("seed", s.seed, "Seed of missions and noise.");
  v.field("mission_index", s.mission_index, Range{0, 1e9}, "Which mission of the map.");
  v.field("mission", s.mission, "Rules of a flight.");
  v.field("vehicle", s.vehicle, "The vehicle.");
  v.field("sensor", s.sensor, "The camera.");
  v.field("imu", s.imu, "The inertial measurement unit; the defaults are an ADIS16448's.");
  v.field("odometry", s.odometry,
          "Errors of the position and attitude that vehicle and planner get; all zero: exact.");
  v.field("planner", s.planner, "The planner.");
  v.field("rates", s.rates, "How often things happen; each period is a whole number of 1/36000 s.");
  v.field("latency", s.latency, "When commands take effect.");
  v.field("latency_digest", s.latency_digest, "SHA-256 of the latencies that are replayed.");
  v.field("missions_digest", s.missions_digest, "SHA-256 of the map's listed missions.");
  v.field("wind", s.wind, "Wind and disturbances, added up; see docs/wind.md.");
  v.field("movers", s.movers, "Things that move through the map; see docs/movers.md.");
  v.field("tracks", s.tracks,
          "Tracks of things that move, for planners that declare them; true by default.");
  v.field("recording", s.recording, "Of a trial that was flown in reality: its log.");
}

}  // namespace avoidbench
