#include "replay/apart.hpp"

#include <poll.h>

#include <chrono>
#include <csignal>

#include "base/digest.hpp"
#include "base/input_error.hpp"
#include "plugin/planner_description.hpp"
#include "sweep/recorded_latency.hpp"
#include "worker/crash_report.hpp"
#include "worker/job.hpp"
#include "worker/worker_death.hpp"

namespace avoidbench {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::size_t kMostFrames = 12;

double seconds_since(Clock::time_point begin) {
  return std::chrono::duration<double>(Clock::now() - begin).count();
}

/// The stored trial with the library that flies it, and parameters that it takes.
Job job_of(StoredTrial stored, const PlannerDescription& planner,
           std::vector<std::string>& warnings) {
  PlannerChoice& choice = stored.spec.planner;
  // Another library may have other parameters: it is given those that it takes.
  if (planner.file_digest != choice.file_digest) {
    warnings.push_back(other_library_warning(planner));
    const std::vector<ParameterValue> values = usable_values(choice, planner, warnings);
    choice.parameters.clear();
    for (std::size_t i = 0; i < values.size(); ++i) {
      const ParameterDef& def = planner.parameters[i];
      choice.parameters.push_back({.name = def.name,
                                   .number = values[i].number,
                                   .text = values[i].text,
                                   .is_text = def.kind == AB_TEXT || def.kind == AB_CHOICE});
    }
  }
  choice.file = planner.file.string();
  choice.file_digest = planner.file_digest;
  // The mission as it was stored: nothing is measured again.
  MissionRecord mission;
  mission.index = stored.spec.mission_index;
  mission.mission = stored.mission;
  return {.token = make_token(),
          .spec = stored.spec,
          .mission_count = 0,
          .mission = mission,
          .recorded_latency_s = recorded_latencies(stored.spec, stored.row.record)};
}

/// A kept copy, whose name is its digest, under the name that the library had as it was flown.
std::string under_flown_name(std::string text, const PlannerChoice& planner) {
  const std::filesystem::path file = planner.file;
  // Then it was loaded under its own name.
  if (file.stem() != planner.file_digest) return text;
  const std::string kept = file.filename().string();
  const std::string flown = std::filesystem::path(planner.plugin).stem().string() + ".so";
  for (std::size_t at = 0; (at = text.find(kept, at)) != std::string::npos; at += flown.size()) {
    text.replace(at, kept.size(), flown);
  }
  return text;
}

/// Why the worker has to end; nothing while it may go on.
std::optional<Death> timeout_of(double flown_s, double silent_s, const ApartOptions& options) {
  if (flown_s > options.trial_timeout_s) {
    return Death{Outcome::planner_hung, "the trial lasted longer than its timeout"};
  }
  if (silent_s > options.silence_s) {
    return Death{Outcome::planner_hung, "the worker did not answer any more"};
  }
  return std::nullopt;
}

/// Waits for the answer to the job, or for the worker's death.
std::optional<JobResult> answer_of(WorkerProcess& process, const Job& job,
                                   const ApartOptions& options, Death& death) {
  // How long it may take until a death or a timeout is seen.
  constexpr int kWait_ms = 200;
  const Clock::time_point began = Clock::now();
  Clock::time_point heard = began;
  while (true) {
    pollfd waiting[] = {{.fd = process.result_fd(), .events = POLLIN, .revents = 0}};
    ::poll(waiting, 1, kWait_ms);
    // A worker that lives makes a note every second.
    if (process.listen()) heard = Clock::now();
    // Asked before the pipe is read: an answer that was written just before the end is then still
    // found.
    const bool has_ended = process.has_ended();
    const bool can_send = !process.has_more_to_send() || process.send_more();
    const WorkerProcess::Answer answer = process.receive();
    if (answer == WorkerProcess::Answer::whole) {
      const auto message = process.answer();
      auto result = message ? result_from(*message, job) : std::nullopt;
      // An answer that can't be read is as bad as none.
      if (!result) death = broken_pipes();
      if (result && result->is_out_of_memory) death = too_much_memory();
      return result && !result->is_out_of_memory ? result : std::nullopt;
    }
    if (answer == WorkerProcess::Answer::malformed) {
      death = broken_pipes();
      return std::nullopt;
    }
    if (answer == WorkerProcess::Answer::gone || !can_send || has_ended) {
      const ProcessEnd end = process.wait();
      death = death_of(end, process.notes(), job.spec.planner);
      return std::nullopt;
    }
    if (const auto late = timeout_of(seconds_since(began), seconds_since(heard), options)) {
      death = *late;
      return std::nullopt;
    }
  }
}

std::vector<std::string> command_of(const ApartOptions& options, std::uint32_t needs) {
  std::vector<std::string> command = options.worker_command;
  if (options.sandbox.empty()) return command;
  command.insert(command.end(),
                 {"--sandbox", options.sandbox, "--allow", text(sandbox_rules(needs))});
  return command;
}

}  // namespace

ApartFlight fly_apart(const StoredTrial& stored, const ReplayFiles& files,
                      const ApartOptions& options) {
  ApartFlight flight;
  const PlannerDescription planner = describe_planner(library_for(stored.spec.planner, files));
  const Job job = job_of(with_files(stored, files), planner, flight.warnings);
  std::signal(SIGPIPE, SIG_IGN);  // a dead worker is seen by its result
  WorkerProcess process(command_of(options, planner.needs));
  if (!process.send(job_message(job), most_result_bytes(job))) {
    throw InputError("the worker process ends before it takes a job: " + last_words(process));
  }
  Death death;
  const std::optional<JobResult> result = answer_of(process, job, options, death);
  // The trial could not be begun at all: that is no outcome.
  if (result && !result->error.empty()) throw InputError(result->error);
  if (result) {
    flight.record = *result->trial;
    flight.has_begun = !flight.record.samples.empty();
  } else {
    // The samples and calls up to the death, from memory that is shared with the worker.
    add_flight(death, process);
    flight.has_begun = death.flown.has_value();
    if (death.flown) flight.record = *death.flown;
    flight.record.outcome = death.outcome;
    flight.record.reason = under_flown_name(death.reason, job.spec.planner);
    flight.stack = stack_lines(process.notes(), job.spec.planner.file, kMostFrames);
    for (std::string& line : flight.stack) line = under_flown_name(line, job.spec.planner);
  }
  flight.printed = process.printed();
  return flight;
}

}  // namespace avoidbench
