#pragma once

#include <array>
#include <string>

#include "base/enum_text.hpp"
#include "base/fields.hpp"

namespace avoidbench {

/// How a real flight ended, as those who flew it say.
enum class GivenOutcome { judged, reached_goal, collided, left_bounds, timed_out, planner_gave_up };

template <>
struct EnumText<GivenOutcome> {
  static constexpr std::pair<GivenOutcome, std::string_view> entries[] = {
      {GivenOutcome::judged, "judged"},       {GivenOutcome::reached_goal, "reached_goal"},
      {GivenOutcome::collided, "collided"},   {GivenOutcome::left_bounds, "left_bounds"},
      {GivenOutcome::timed_out, "timed_out"}, {GivenOutcome::planner_gave_up, "planner_gave_up"}};
};

/// How positions of a log become a path with velocity and acceleration:
/// real_flights/smooth_path.hpp.
struct SmoothingSpec {
  double position_noise_m = 0.01;
  double jerk_mps3 = 15.0;
};

template <class Visitor, ConstOr<SmoothingSpec> Spec>
void visit(Visitor& v, Spec& s) {
  v.field("position_noise_m", s.position_noise_m, Range{1e-4, 1},
          "Standard deviation of a logged position along each axis.");
  v.field(
      "jerk_mps3", s.jerk_mps3, Range{1, 1000},
      "Jerk that the vehicle is expected to keep up for a tenth of a second: less is smoother.");
}

/// Where a trial that was flown in reality comes from. With the map and the mission it determines
/// all that is stored of it.
struct RecordingSpec {
  std::string log;         ///< the file's name
  std::string log_digest;  ///< SHA-256 of the file
  std::string topic, child_frame;
  double begin_s = 0.0, end_s = 0.0;
  std::array<double, 3> translation_m{0.0, 0.0, 0.0};   ///< of the log's frame in the map's
  std::array<double, 4> q_map_log{1.0, 0.0, 0.0, 0.0};  ///< w x y z
  SmoothingSpec smoothing;
  GivenOutcome outcome = GivenOutcome::judged;
  std::string calls_digest;  ///< SHA-256 of the table of the planner's calls; "": there is none
};

template <class Visitor, ConstOr<RecordingSpec> Spec>
void visit(Visitor& v, Spec& s) {
  v.field("log", s.log, "The log's file name.");
  v.field("log_digest", s.log_digest, "SHA-256 of the log.");
  v.field("topic", s.topic, "The topic that the poses are from.");
  v.field("child_frame", s.child_frame, "Of transforms: the frame of the vehicle.");
  v.field("begin_s", s.begin_s, Range{0, 1e6}, "When the flight begins, after the first pose.");
  v.field("end_s", s.end_s, Range{0, 1e6}, "When it ends, after the first pose; 0: the log's end.");
  v.field("translation_m", s.translation_m, Range{-1e8, 1e8},
          "Origin of the log's frame in the map's.");
  v.field("q_map_log", s.q_map_log, Range{-1, 1},
          "Rotation from the log's frame to the map's, w x y z.");
  v.field("smoothing", s.smoothing, "How positions become a path.");
  v.field("outcome", s.outcome, "How the flight ended; judged: by its path.");
  v.field("calls_digest", s.calls_digest, "SHA-256 of the table of the planner's calls.");
}

}  // namespace avoidbench
