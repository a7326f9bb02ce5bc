#pragma once

#include <optional>
#include <string>
#include <vector>

#include "metrics/map_record.hpp"
#include "sweep/message.hpp"
#include "trial/trial_record.hpp"
#include "trial/trial_spec.hpp"

/// What a worker is asked to do and what it answers, as messages.
namespace avoidbench {

/// Measure a map and lay out its missions, or, with a mission, fly one trial.
struct Job {
  TrialSpec spec;
  std::int64_t mission_count = 0;                              ///< of a map job
  std::optional<MissionRecord> mission;                        ///< of a trial job
  std::optional<std::vector<double>> recorded_latency_s = {};  ///< of one that replays
};

/// The answer: a map, a flown trial with its metrics, or why neither could be had.
struct JobResult {
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
JobResult result_from(const Message& message);

}  // namespace avoidbench
