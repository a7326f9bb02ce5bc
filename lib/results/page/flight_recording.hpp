#pragma once

#include <cstddef>
#include <limits>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "export/export_flight.hpp"
#include "view/replay_sheet.hpp"
#include "worker/worker.hpp"

/// What a worker notes of a flight that is flown again to be looked at.
namespace avoidbench {

/// A line that the planner logged.
struct LogLine {
  double time_s = std::numeric_limits<double>::quiet_NaN();  ///< NaN: before or after the calls
  std::string text;
};

/// What is asked for; the log always is.
struct RecordingWanted {
  bool has_calls = false, has_moments = false, has_page = false;
  std::vector<double> at_s = {};  ///< moments: see MomentRecorder
  double every_s = 0.0;
  std::optional<std::size_t> most_calls = {};  ///< the flight ends before the call after so many
};

/// What came of it.
// NOLINTNEXTLINE(bugprone-exception-escape): nlohmann::json says it of its own members
struct FlightRecording {
  std::vector<LogLine> log;
  std::vector<CommandLine> calls;
  std::vector<Moment> moments;
  nlohmann::ordered_json seen;  ///< of SeenRecorder
};

/// The lookout that makes a recording, and its name for run_worker().
inline constexpr const char* kRecordingLookout = "recording";
Lookout recording_lookout(const Job& job, const World& world);

/// To be set as Job::lookout of a flight by this spec.
LookoutJob recording_job(RecordingWanted wanted, const TrialSpec& spec);

/// The recording that a worker reports. Its planner shares the worker's memory: throws InputError
/// where what came makes no sense.
FlightRecording recording_from(const Message& reported);

}  // namespace avoidbench
