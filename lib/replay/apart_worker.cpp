#include "replay/apart_worker.hpp"

#include <poll.h>

#include <algorithm>
#include <csignal>
#include <utility>

#include "base/input_error.hpp"
#include "plugin/planner_description.hpp"
#include "worker/crash_report.hpp"
#include "worker/worker_death.hpp"

namespace avoidbench {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::size_t kMostFrames = 12;

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

std::vector<std::string> command_of(const ApartOptions& options, std::uint32_t needs) {
  std::vector<std::string> command = options.worker_command;
  if (options.sandbox.empty()) return command;
  command.insert(command.end(),
                 {"--sandbox", options.sandbox, "--allow", text(sandbox_rules(needs))});
  return command;
}

/// The samples and calls up to the death, from memory that is shared with the worker.
ApartFlight ended_by(Death death, WorkerProcess& process, const PlannerChoice& planner) {
  add_flight(death, process);
  ApartFlight flight;
  flight.has_begun = death.flown.has_value();
  if (death.flown) flight.record = *death.flown;
  flight.record.outcome = death.outcome;
  flight.record.reason = under_flown_name(death.reason, planner);
  flight.stack = stack_lines(process.notes(), planner.file, kMostFrames);
  for (std::string& line : flight.stack) line = under_flown_name(line, planner);
  return flight;
}

}  // namespace

ApartWorker::ApartWorker(const ApartOptions& options, std::uint32_t needs)
    : options_(options), process_(command_of(options, needs)) {
  std::signal(SIGPIPE, SIG_IGN);  // a dead worker is seen by its result
}

void ApartWorker::begin(Job job) {
  job_ = std::move(job);
  looked_ = Clock::now();
  busy_s_ = silent_s_ = 0.0;
  if (process_.send(job_message(job_), most_result_bytes(job_))) return;
  is_over_ = true;
  throw InputError("the worker process ends before it takes a job: " + last_words(process_));
}

std::optional<ApartFlight> ApartWorker::look() {
  constexpr double kLongestWait_s = 1.0;
  const Clock::time_point now = Clock::now();
  const std::chrono::duration<double> since = now - looked_;
  const double waited_s = std::min(since.count(), kLongestWait_s);
  looked_ = now;
  busy_s_ += waited_s;
  // A worker that lives makes a note every second.
  silent_s_ = process_.listen() ? 0.0 : silent_s_ + waited_s;
  // Asked before the pipe is read: an answer that was written just before the end is then still
  // found.
  const bool has_ended = process_.has_ended();
  const bool can_send = !process_.has_more_to_send() || process_.send_more();
  const WorkerProcess::Answer answer = process_.receive();
  if (answer == WorkerProcess::Answer::whole) return answered();
  if (answer == WorkerProcess::Answer::malformed) return ended(broken_pipes());
  if (answer == WorkerProcess::Answer::gone || !can_send || has_ended) {
    const ProcessEnd end = process_.wait();
    ApartFlight flight = ended(death_of(end, process_.notes(), job_.spec.planner));
    if (is_from_outside(end)) flight.killed_by = end.text;
    return flight;
  }
  if (busy_s_ > options_.trial_timeout_s) {
    return ended({Outcome::planner_hung, "the trial lasted longer than its timeout"});
  }
  if (silent_s_ > options_.silence_s) {
    return ended({Outcome::planner_hung, "the worker did not answer any more"});
  }
  return std::nullopt;
}

ApartFlight ApartWorker::answered() {
  const auto message = process_.answer();
  auto result = message ? result_from(*message, job_) : std::nullopt;
  // An answer that can't be read is as bad as none.
  if (!result) return ended(broken_pipes());
  if (result->is_out_of_memory) return ended(too_much_memory());
  // The trial could not be begun at all: that is no outcome.
  if (!result->error.empty()) {
    is_over_ = true;
    throw InputError(result->error);
  }
  ApartFlight flight;
  flight.record = std::move(*result->trial);
  flight.has_begun = !flight.record.samples.empty();
  flight.printed = process_.printed();
  return flight;
}

ApartFlight ApartWorker::ended(Death death) {
  is_over_ = true;
  ApartFlight flight = ended_by(std::move(death), process_, job_.spec.planner);
  flight.printed = process_.printed();
  return flight;
}

void wait_for_news(std::span<const ApartWorker* const> workers) {
  // How long it may take until a death or a timeout is seen.
  constexpr int kWait_ms = 200;
  std::vector<pollfd> waiting;
  for (const ApartWorker* worker : workers) {
    waiting.push_back({.fd = worker->result_fd(), .events = POLLIN, .revents = 0});
  }
  ::poll(waiting.data(), waiting.size(), kWait_ms);
}

}  // namespace avoidbench
