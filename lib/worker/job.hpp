#pragma once

#include <optional>
#include <string>
#include <vector>

#include "metrics/map_record.hpp"
#include "trial/flight_change.hpp"
#include "trial/trial_record.hpp"
#include "trial/trial_spec.hpp"
#include "worker/message.hpp"

/// What a worker is asked to do and what it answers, as messages.
namespace avoidbench {

/// Measure a map and lay out its missions, or, with a mission, fly one trial.
struct Job {
  /// Drawn for this job; the answer repeats it, so that an older one, or one that somebody else
  /// writes, is none.
  std::string token = {};
  TrialSpec spec;
  std::int64_t mission_count = 0;             ///< of a map job
  std::vector<Mission> listed_missions = {};  ///< of a map whose missions are not made
  std::optional<MissionRecord> mission;       ///< of a trial job
  std::optional<std::vector<double>> recorded_latency_s = {};  ///< of one that replays
  FlightChange change = {};                                    ///< of a trial job
};

/// The answer: a map, a flown trial with its metrics, or why neither could be had.
struct JobResult {
  std::string token = {};
  std::optional<MapRecord> map;
  std::optional<TrialRecord> trial;
  std::vector<double> metrics;
  double wall_time_s = 0.0;  ///< that the job took
  std::string error;
  bool is_out_of_memory = false;  ///< that was the error
};

Message job_message(const Job& job);
Job job_from(const Message& message);
Message result_message(const JobResult& result);
/// Nothing where the message is no answer to this job: another token, a part that is missing, of
/// another type or of another size than asked for.
std::optional<JobResult> result_from(const Message& message, const Job& job);

/// No answer to this job is longer.
std::size_t most_result_bytes(const Job& job);

/// 32 digits from the system's random numbers: a token, no part of any result.
std::string make_token();

}  // namespace avoidbench
