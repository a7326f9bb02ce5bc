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

/// What somebody wants to know of a trial besides its record: see Lookout.
// NOLINTNEXTLINE(bugprone-exception-escape): nlohmann::json says it of its own members
struct LookoutJob {
  std::string kind;            ///< of the lookout: one that run_worker() was given
  Message wanted;              ///< what it needs to know
  std::size_t most_bytes = 0;  ///< that it reports
  bool has_flight = true;      ///< false: it looks at the map alone, and no planner is flown
  bool has_pieces = false;     ///< it also reports during the flight: see Lookout::take_piece
};

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
  std::optional<LookoutJob> lookout = {};                      ///< of a trial job
};

/// The answer: a map, a flown trial with its metrics, what a lookout reports, or why there is none.
struct JobResult {
  std::string token = {};
  std::optional<MapRecord> map;
  std::optional<TrialRecord> trial;
  std::vector<double> metrics;
  std::string world_digest;         ///< of the map
  std::optional<Message> reported;  ///< by the lookout
  double wall_time_s = 0.0;         ///< that the job took
  std::string error;
  bool is_out_of_memory = false;  ///< that was the error
};

Message job_message(const Job& job);
Job job_from(const Message& message);
Message result_message(const JobResult& result);
/// Nothing where the message is no answer to this job: another token, a part that is missing, of
/// another type or of another size than asked for.
std::optional<JobResult> result_from(const Message& message, const Job& job);

/// What a lookout reports during the flight, marked so that it is taken for no answer.
Message piece_message(const std::string& token, Message piece);
/// Whether it is a piece of this job, not its answer.
bool is_piece_of(const Message& message, const Job& job);

/// A flight's record as a message, bit for bit.
Message record_message(const TrialRecord& record);
/// Throws InputError or nlohmann's exceptions where the message is none.
TrialRecord record_from(const Message& message);

/// No answer to this job, and no piece of it, is longer.
std::size_t most_result_bytes(const Job& job);

/// 32 digits from the system's random numbers: a token, no part of any result.
std::string make_token();

}  // namespace avoidbench
