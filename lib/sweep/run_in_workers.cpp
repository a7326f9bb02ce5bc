#include "sweep/seats.hpp"

#include <poll.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <map>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include "base/input_error.hpp"
#include "process/process_tree.hpp"
#include "worker/worker.hpp"
#include "worker/worker_death.hpp"
#include "worker/worker_process.hpp"

namespace avoidbench {
namespace {

using Clock = std::chrono::steady_clock;

/// What a worker is doing.
struct Task {
  Assignment assignment;
  Job job;
  double busy_s = 0.0;   ///< since it was handed out
  double quiet_s = 0.0;  ///< since more of its answer came
  int stops = 0;         ///< how often a signal stopped the worker
};

/// A worker process, what it is doing and what it has in memory.
/// Invariants: a seat with a task has sent its job, or is sending it; `memory` is what the process
/// will have in memory after its task, and is empty after the process was replaced; the process
/// lives in the sandbox of `rules`.
struct Seat {
  WorkerProcess process;
  SandboxRules rules;  ///< that the process lives by
  std::optional<Task> task;
  Memory memory;
  double silent_s = 0.0;  ///< since it last said that it lives
};

/// The seats of a run and what is around them.
struct Desk {
  Run& run;
  std::vector<Seat> seats = {};
  // The caller may have children of its own; end_orphans() must spare them.
  std::set<pid_t> others = own_children();  ///< before the run: not ours to end
  /// Jobs whose worker was killed from outside.
  std::set<std::pair<std::size_t, std::optional<std::size_t>>> killed_once = {};
};

/// What a worker has in memory once it did this.
Memory memory_after(const Run& run, const Assignment& assignment) {
  if (!assignment.trial) return {.map = assignment.map, .planner_label = {}};
  return {.map = assignment.map,
          .planner_label = run.schedule.trials[*assignment.trial].planner_label()};
}

WorkerProcess start(const Run& run, const SandboxRules& rules) {
  std::vector<std::string> command = run.options.worker_command;
  if (const std::string& sandbox = run.options.sandbox; !sandbox.empty()) {
    command.insert(command.end(), {"--sandbox", sandbox, "--allow", text(rules)});
  }
  return WorkerProcess(command);
}

/// Ends what planners started and left behind, now that `label`'s worker is gone: workers adopt
/// what theirs leave, so that only what belonged to one that ended is found here.
void end_left_behind(Desk& desk, const std::string& label) {
  std::set<pid_t> spared = desk.others;
  for (const Seat& seat : desk.seats) spared.insert(seat.process.pid());
  if (const int count = end_orphans(spared); count > 0) desk.run.left_behind[label] += count;
}

/// The new worker has neither a map nor a planner in memory.
void replace_process(Desk& desk, Seat& seat, const SandboxRules& rules) {
  seat.process.kill();
  end_left_behind(desk, seat.memory.planner_label);
  seat.process = start(desk.run, rules);
  seat.rules = rules;
  seat.memory = {};
  seat.silent_s = 0.0;
}

/// Hands the seat its next job, if there is one for it. A process flies one planner only, so that
/// what one does to its process is no other one's misfortune; and of a planner that keeps what it
/// knows in globals one trial only. A worker that is gone is replaced
/// once.
void hand_out(Desk& desk, Seat& seat) {
  Run& run = desk.run;
  const auto assignment = next_assignment(run.schedule, seat.memory);
  if (!assignment) return;
  const Memory next = memory_after(run, *assignment);
  const std::string& flown = seat.memory.planner_label;
  // A map job runs no planner's code: its process gets the rules of the planner that will fly there
  // first, and stays for it with the map.
  const auto known = run.sandbox_rules.find(
      assignment->trial ? next.planner_label : first_planner(run.schedule, assignment->map));
  const SandboxRules rules = known == run.sandbox_rules.end() ? SandboxRules{} : known->second;
  const bool may_stay =
      flown.empty() || (flown == next.planner_label && !run.planners_with_globals.contains(flown));
  // A sandbox can't be changed from within: another planner's needs take another process.
  if (!may_stay || rules != seat.rules) replace_process(desk, seat, rules);
  seat.task = Task{.assignment = *assignment, .job = job_of(run, *assignment)};
  seat.memory = next;
  seat.silent_s = 0.0;
  const Message message = job_message(seat.task->job);
  const std::size_t most_bytes = most_result_bytes(seat.task->job);
  // A worker may have ended after its last answer, through what its planner left there. That is no
  // fault of this job's: it gets a new process. If that one takes no job either, the fault is not a
  // planner's.
  if (seat.process.send(message, most_bytes)) return;
  replace_process(desk, seat, rules);
  seat.memory = next;
  if (!seat.process.send(message, most_bytes)) {
    const std::string words = last_words(seat.process);
    throw InputError("worker processes end before they take a job" +
                     (words.empty() ? "" : ": " + words));
  }
}

/// The seat's job has come to an end; the process may live on or not.
Task end_task(Seat& seat) { return *std::exchange(seat.task, std::nullopt); }

/// The worker was killed by somebody else: its trial is flown again, once. After that it stays
/// unflown, since what killed it is no result of the planner's.
void take_kill(Desk& desk, Seat& seat, const ProcessEnd& end) {
  const Task task = end_task(seat);
  const auto [map, trial] = task.assignment;
  // Once may be chance, such as memory that another process took; the second time would go on for
  // ever.
  if (desk.killed_once.insert({map, trial}).second) {
    give_back(desk.run.schedule, task.assignment);
  } else if (!trial) {
    take_death(desk.run, task.assignment, task.job,
               {.reason = end.text, .last_words = last_words(seat.process)});
  } else {
    desk.run.unflown.push_back({.key = desk.run.schedule.keys[*trial],
                                .planner_label = task.job.spec.planner.label,
                                .reason = end.text});
  }
  replace_process(desk, seat, seat.rules);
}

/// The trial ends with its worker.
void take_end(Desk& desk, Seat& seat, Death death) {
  add_flight(death, seat.process);
  const Task task = end_task(seat);
  take_death(desk.run, task.assignment, task.job, death);
  replace_process(desk, seat, seat.rules);
}

/// No answer will come: the process has ended, or what came through its pipe is none.
void take_failure(Desk& desk, Seat& seat) {
  const ProcessEnd end = seat.process.wait();
  if (is_from_outside(end)) return take_kill(desk, seat, end);
  take_end(desk, seat, death_of(end, seat.process.notes(), seat.task->job.spec.planner));
}

/// An answer that can't be read counts as the worker's death.
void take_answer(Desk& desk, Seat& seat) {
  const auto message = seat.process.answer();
  auto result = message ? result_from(*message, seat.task->job) : std::nullopt;
  if (!result) return take_end(desk, seat, broken_pipes());
  const bool is_trial = seat.task->assignment.trial.has_value();
  // A planner's bad_alloc is a crash like others. Without a planner, in a map job, it is the run's
  // problem.
  if (is_trial && result->is_out_of_memory) return take_end(desk, seat, too_much_memory());
  take_result(desk.run, end_task(seat).assignment, std::move(*result));
}

/// Takes what a busy seat has to say, if anything.
void listen_to(Desk& desk, Seat& seat) {
  // Asked first: what the process sent before it ended is then all in the pipe when it is read.
  const bool has_ended = seat.process.has_ended();  // before the last look at what it has sent
  const bool can_send = !seat.process.has_more_to_send() || seat.process.send_more();
  const std::size_t known_bytes = seat.process.answer_bytes();
  switch (seat.process.receive()) {
    case WorkerProcess::Answer::whole:
      return take_answer(desk, seat);
    case WorkerProcess::Answer::malformed:
      return take_end(desk, seat, broken_pipes());
    case WorkerProcess::Answer::gone:
      return take_failure(desk, seat);
    case WorkerProcess::Answer::incomplete:
      break;
  }
  if (!can_send || has_ended) return take_failure(desk, seat);
  if (seat.process.answer_bytes() > known_bytes) seat.task->quiet_s = 0.0;
}

/// Ends what takes too long. A worker that a signal has stopped goes on, a few times.
void look_at_time(Desk& desk, Seat& seat) {
  // A debugger or a terminal stops a worker once or twice. A planner that stops its own process
  // whenever it goes on would hold the seat for ever.
  constexpr int kMostStops = 3;
  const RunOptions& options = desk.run.options;
  Task& task = *seat.task;
  if (task.assignment.trial && task.busy_s > options.trial_timeout_s) {
    return take_end(desk, seat,
                    {Outcome::planner_hung, "the trial lasted longer than its timeout"});
  }
  if (seat.silent_s > options.silence_s) {
    if (task.stops == kMostStops || !seat.process.go_on()) {
      return take_end(desk, seat, {Outcome::planner_hung, "the worker did not answer any more"});
    }
    ++task.stops;
    seat.silent_s = task.quiet_s = 0.0;
  }
  // It lives, but the rest of what came does not: a planner wrote the beginning.
  const bool is_answering = seat.process.answer_bytes() > 0;
  if (is_answering && task.quiet_s > options.silence_s) take_end(desk, seat, broken_pipes());
}

/// Waits a second at most until busy seats have something to say, and takes it.
void take_next_results(Desk& desk) {
  // Long enough to cost nothing, short enough for time limits, which are of seconds, and for the
  // progress line.
  constexpr int kWait_ms = 1000;
  std::vector<pollfd> waiting;
  std::vector<Seat*> busy;
  for (Seat& seat : desk.seats) {
    if (!seat.task) continue;
    const int job_fd = seat.process.has_more_to_send() ? seat.process.job_fd() : -1;
    // Two a seat; poll() passes over those with a negative number.
    waiting.push_back({.fd = seat.process.result_fd(), .events = POLLIN, .revents = 0});
    waiting.push_back({.fd = job_fd, .events = POLLOUT, .revents = 0});
    busy.push_back(&seat);
  }
  const Clock::time_point began = Clock::now();
  // A signal ends the wait, too: the caller looks at `stop`.
  // Only busy seats are waited for: an idle worker's pipe says nothing until the next job.
  const bool has_news = ::poll(waiting.data(), waiting.size(), kWait_ms) >= 0;
  // No wait counts for longer: what stops this process stops its workers, too.
  const std::chrono::duration<double> waited = Clock::now() - began;
  const double waited_s = std::min(waited.count(), 1e-3 * kWait_ms);
  for (Seat* seat : busy) {
    seat->silent_s = seat->process.listen() ? 0.0 : seat->silent_s + waited_s;
    seat->task->busy_s += waited_s;
    seat->task->quiet_s += waited_s;
    if (has_news) listen_to(desk, *seat);
    if (seat->task) look_at_time(desk, *seat);
  }
}

/// Hands out jobs and takes their answers until all is done or the run is to stop.
void fly_in(Desk& desk) {
  constexpr auto kSaving =
      std::chrono::seconds(5);  // so that a copy of the file alone has nearly all
  Run& run = desk.run;
  std::optional<Clock::time_point> stopped;
  Clock::time_point saved = Clock::now();
  while (!run.must_end_now()) {
    bool is_busy = false;
    for (Seat& seat : desk.seats) {
      if (!seat.task && !run.is_stopped()) hand_out(desk, seat);
      is_busy = is_busy || seat.task.has_value();
    }
    // Nothing left to hand out, and nobody who flies.
    if (!is_busy) return;
    if (run.is_stopped() && !stopped) stopped = Clock::now();
    // What is still in flight then is not stored: the next run flies it.
    const std::chrono::duration<double> grace(run.options.grace_s);
    if (stopped && Clock::now() - *stopped > grace) return;
    take_next_results(desk);
    if (Clock::now() - saved > kSaving) {
      run.database.checkpoint();
      saved = Clock::now();
    }
    report_progress(run);
  }
}

/// Ends all workers and what their planners left behind.
void clear(Desk& desk) {
  for (Seat& seat : desk.seats) {
    seat.process.kill();
    end_left_behind(desk, seat.memory.planner_label);
  }
}

}  // namespace

void run_in_workers(Run& run) {
  std::signal(SIGPIPE, SIG_IGN);  // a dead worker is seen by its result
  // Before the first worker: what a planner detaches then comes to this process, not to init.
  adopt_orphans();
  Desk desk{.run = run};
  for (int i = 0; i < run.options.jobs; ++i) {
    desk.seats.push_back(
        {.process = start(run, {}), .rules = {}, .task = {}, .memory = {}, .silent_s = 0.0});
  }
  try {
    fly_in(desk);
  } catch (...) {
    clear(desk);
    throw;
  }
  clear(desk);
}

}  // namespace avoidbench
