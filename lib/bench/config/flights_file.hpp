#pragma once

#include <array>
#include <filesystem>
#include <string>
#include <vector>

#include "config/field_tree.hpp"
#include "config/sweep_file.hpp"
#include "trial/recording_spec.hpp"

/// Files of real flights: `avoidbench import flights.yaml`.
namespace avoidbench {

/// A point in the log's frame and the same one in the map's.
struct PointPairSpec {
  std::array<double, 3> log{0.0, 0.0, 0.0}, map{0.0, 0.0, 0.0};
};

template <class Visitor, ConstOr<PointPairSpec> Spec>
void visit(Visitor& v, Spec& s) {
  v.field("log", s.log, Range{-1e8, 1e8}, "The point in the log's frame, metres.");
  v.field("map", s.map, Range{-1e8, 1e8}, "The same point in the map's frame, metres.");
}

/// How the logs' frame lies in the map's.
struct AlignmentSpec {
  std::vector<PointPairSpec> points;
  std::array<double, 3> translation_m{0.0, 0.0, 0.0};
  double yaw_deg = 0.0;
};

template <class Visitor, ConstOr<AlignmentSpec> Spec>
void visit(Visitor& v, Spec& s) {
  v.field("points", s.points,
          "At least three points known in both frames, not on one line: the rotation and "
          "translation that fit best.");
  v.field("translation_m", s.translation_m, Range{-1e8, 1e8},
          "Without points: the origin of the logs' frame in the map's.");
  v.field("yaw_deg", s.yaw_deg, Range{-360, 360},
          "Without points: the heading of the logs' x axis in the map's frame.");
}

/// One real flight.
struct RealFlightSpec {
  std::string log, topic, child_frame, planner;
  std::vector<double> start, goal;
  double begin_s = 0.0, end_s = 0.0;
  GivenOutcome outcome = GivenOutcome::judged;
  std::string calls;
};

template <class Visitor, ConstOr<RealFlightSpec> Spec>
void visit(Visitor& v, Spec& s) {
  v.field("log", s.log,
          "ROS 1 bag, rosbag2 (.db3, .mcap or their folder), PX4 ULog, TUM or EuRoC CSV; relative "
          "to this file's folder.");
  v.field("topic", s.topic, "The topic of its poses; \"\": the only one that fits.");
  v.field("child_frame", s.child_frame,
          "Of transforms: the frame of the vehicle; \"\": the only one.");
  v.field("planner", s.planner, "What reports call the planner that flew.");
  v.field("start", s.start, Range{-1e5, 1e5},
          "[x, y, z] in the map's frame; []: where the log is at begin_s.");
  v.field("goal", s.goal, Range{-1e5, 1e5}, "[x, y, z] in the map's frame.");
  v.field("begin_s", s.begin_s, Range{0, 1e6},
          "When the flight begins, seconds after the log's first pose: after take-off.");
  v.field("end_s", s.end_s, Range{0, 1e6},
          "When it ends, seconds after the log's first pose; 0: at the log's end.");
  v.field("outcome", s.outcome,
          "How it ended; judged: from its path, as for simulated flights. A log of poses does not "
          "show a crash: give it here.");
  v.field("calls", s.calls,
          "The planner's calls, as `avoidbench export calls` writes them (CSV); \"\": not logged.");
}

/// A flight, and where it stands.
struct ReadRealFlight {
  RealFlightSpec spec;  ///< with `log` and `calls` as paths from here
  YamlNode node;

  /// A problem at one of its keys, or at the whole where that is not given.
  InputProblem problem(std::string_view key, std::string message) const;
};

struct FlightsFile {
  std::string name;
  MapChoice place;  ///< map, vehicle, mission rules and sensor, as the block `sweep` says
  AlignmentSpec alignment;
  InputProblem alignment_place;  ///< without a message
  SmoothingSpec smoothing;
  std::vector<ReadRealFlight> flights;
  Document document;
};

/// Throws InputError with all that is wrong at once, each at its place.
FlightsFile read_flights(const std::filesystem::path& file,
                         const std::vector<std::string>& overrides = {});

/// A mission of the twin.
struct TwinMission {
  std::array<double, 3> start_m, goal_m;
  double yaw_deg = 0.0;
};

/// The sweep of the same place, vehicle and missions, as a document that `run` reads.
Document twin_document(const FlightsFile& flights, const std::vector<TwinMission>& missions);

/// Everything that such a file can say, `sweep` aside.
const FieldTree& flights_tree();

}  // namespace avoidbench
