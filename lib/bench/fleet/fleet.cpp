#include "fleet/fleet.hpp"

#include <poll.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <set>
#include <utility>

#include "base/input_error.hpp"
#include "process/process_tree.hpp"
#include "worker/crash_report.hpp"
#include "worker/worker_process.hpp"

namespace avoidbench {
namespace {

using Clock = std::chrono::steady_clock;

bool is_set(const std::atomic<bool>* flag) { return flag != nullptr && flag->load(); }

/// What a worker is doing.
struct Task {
  FleetJob job;
  int tries = 1;
  double busy_s = 0.0;   ///< since it was handed out
  double quiet_s = 0.0;  ///< since more of its answer came
  int stops = 0;         ///< how often a signal stopped the worker
};

/// A worker process, what it is doing and what it has in memory.
/// Invariants: a seat with a task has a process that has got its job, or is getting it; `memory` is
/// what the process will have in memory after its task, and is empty where there is no process; the
/// process lives in the sandbox of `rules`.
struct Seat {
  std::optional<WorkerProcess> process;
  SandboxRules rules;
  std::optional<Task> task;
  Memory memory;
  std::string planner_digest = {};  ///< of the planner in memory: labels may have several files
  double silent_s = 0.0;            ///< since it last said that it lives
};

class Fleet {
 public:
  Fleet(const std::function<std::optional<FleetJob>(const Memory&)>& next,
        const std::function<void(const FleetJob&, JobEnd)>& ended, const FleetOptions& options)
      : next_(next), ended_(ended), options_(options) {
    std::signal(SIGPIPE, SIG_IGN);  // a dead worker is seen by its result
    // Before the first worker: what a planner detaches then comes to this process, not to init.
    adopt_orphans();
    seats_.resize(static_cast<std::size_t>(std::max(options.jobs, 1)));
  }
  ~Fleet() { clear(); }
  Fleet(const Fleet&) = delete;
  Fleet& operator=(const Fleet&) = delete;

  void fly() {
    std::optional<Clock::time_point> stopped;
    while (!is_set(options_.stop_now)) {
      bool is_busy = false;
      for (Seat& seat : seats_) {
        if (!seat.task && !is_set(options_.stop)) hand_out(seat);
        is_busy = is_busy || seat.task.has_value();
      }
      if (!is_busy) return;
      if (is_set(options_.stop) && !stopped) stopped = Clock::now();
      const std::chrono::duration<double> grace(options_.grace_s);
      if (stopped && Clock::now() - *stopped > grace) return;
      take_next_results();
      if (options_.on_turn) options_.on_turn();
    }
  }

  /// Ends all workers and what their planners left behind.
  std::map<std::string, int> clear() {
    for (Seat& seat : seats_) end_process(seat);
    return std::exchange(left_behind_, {});
  }

 private:
  void start_process(Seat& seat, const FleetJob& job) {
    std::vector<std::string> command = options_.worker_command;
    if (!options_.sandbox.empty()) {
      const std::string granted = text(job.rules);
      if (!granted.empty() && options_.on_granted) options_.on_granted(job);
      command.insert(command.end(), {"--sandbox", options_.sandbox, "--allow", granted});
    }
    seat.process.emplace(command);
    seat.rules = job.rules;
    seat.silent_s = 0.0;
  }

  /// Ends also what its planner started and left behind: workers adopt what theirs leave, so that
  /// only what belonged to one that ended is found here.
  void end_process(Seat& seat) {
    if (!seat.process) return;
    seat.process.reset();
    // The caller may have children of its own.
    std::set<pid_t> spared = others_;
    for (const Seat& other : seats_) {
      if (other.process) spared.insert(other.process->pid());
    }
    if (const int count = end_orphans(spared); count > 0) {
      left_behind_[seat.memory.planner_label] += count;
    }
    seat.memory = {};
  }

  void hand_out(Seat& seat) {
    if (std::optional<FleetJob> job = next_(seat.memory)) begin(seat, {.job = std::move(*job)});
  }

  /// In the seat's process, if that may take the job, else in a new one.
  void begin(Seat& seat, Task task) {
    const FleetJob& job = task.job;
    const std::string& flown = seat.memory.planner_label;
    const bool is_same =
        flown == job.planner_label && seat.planner_digest == flown_digest(job.job.spec.planner);
    const bool may_stay = flown.empty() || (is_same && !job.needs_new_process);
    // A sandbox can't be changed from within: another planner's needs take another process.
    if (!may_stay || job.rules != seat.rules) end_process(seat);
    const Message message = job_message(job.job);
    const std::size_t most_bytes = most_result_bytes(job.job);
    const bool has_pieces = job.job.lookout && job.job.lookout->has_pieces;
    // A worker may have ended after its last answer, through what its planner left there. That is
    // no fault of this job's: it gets a new process. If that one takes no job either, somebody has
    // killed it, or workers can't be started at all.
    bool is_sent = seat.process && seat.process->send(message, most_bytes, has_pieces);
    if (!is_sent) {
      end_process(seat);
      start_process(seat, job);
      is_sent = seat.process->send(message, most_bytes, has_pieces);
    }
    const ProcessEnd end = is_sent ? ProcessEnd{} : seat.process->wait();
    if (!is_sent && end.signal == 0) {
      const std::string words = last_words(*seat.process);
      throw InputError("worker processes end before they take a job" +
                       (words.empty() ? "" : ": " + words));
    }
    seat.memory = {.map = job.map, .planner_label = job.planner_label};
    seat.planner_digest = flown_digest(job.job.spec.planner);
    seat.silent_s = 0.0;
    seat.task = std::move(task);
    if (!is_sent) take_kill(seat, end);
  }

  /// The seat's job has come to an end.
  void end_task(Seat& seat, JobEnd end) {
    const Task task = *std::exchange(seat.task, std::nullopt);
    if (task.job.job.lookout && seat.process) end.printed = seat.process->printed();
    if (!end.answer) end_process(seat);
    ended_(task.job, std::move(end));
  }

  /// The job ends with its worker.
  void take_death(Seat& seat, Death death) {
    add_flight(death, *seat.process);
    constexpr std::size_t kMostFrames = 12;
    const std::string file = crashed_file(seat.process->notes(), seat.task->job.job.spec.planner);
    CrashStack stack = crash_stack(seat.process->notes(), file, kMostFrames);
    end_task(seat, {.death = std::move(death), .stack = std::move(stack)});
  }

  /// The worker was killed by somebody else: its job is done again, but not for ever.
  void take_kill(Seat& seat, const ProcessEnd& end) {
    if (seat.task->tries == kMostTries) {
      return end_task(seat, {.killed_by = end.text});
    }
    Task task = *std::exchange(seat.task, std::nullopt);
    end_process(seat);
    if (is_set(options_.stop)) return;  // begin nothing more
    begin(seat, {.job = std::move(task.job), .tries = task.tries + 1});
  }

  /// No answer will come: the process has ended, or what came through its pipe is none.
  void take_failure(Seat& seat) {
    const ProcessEnd end = seat.process->wait();
    if (is_from_outside(end)) return take_kill(seat, end);
    take_death(seat, death_of(end, seat.process->notes(), seat.task->job.job.spec.planner));
  }

  /// Whether it was one.
  static bool take_piece(Seat& seat, const std::optional<Message>& message) {
    if (!message || !is_piece_of(*message, seat.task->job.job)) return false;
    seat.task->quiet_s = 0.0;
    if (seat.task->job.on_piece) seat.task->job.on_piece(*message);
    return true;
  }

  /// An answer that can't be read counts as the worker's death.
  void take_answer(Seat& seat, const std::optional<Message>& message) {
    auto result = message ? result_from(*message, seat.task->job.job) : std::nullopt;
    if (!result) return take_death(seat, broken_pipes());
    // A planner's bad_alloc is a crash like others. Without a planner it is the caller's problem.
    if (!seat.task->job.planner_label.empty() && result->is_out_of_memory) {
      return take_death(seat, too_much_memory());
    }
    end_task(seat, {.answer = std::move(*result)});
  }

  /// Takes what a busy seat has to say, if anything.
  void listen_to(Seat& seat) {
    WorkerProcess& process = *seat.process;
    // Asked first: what the process sent before it ended is then all in the pipe when it is read.
    const bool has_ended = process.has_ended();
    const bool can_send = !process.has_more_to_send() || process.send_more();
    const std::size_t known_bytes = process.answer_bytes();
    WorkerProcess::Answer answer = process.receive();
    while (answer == WorkerProcess::Answer::whole) {
      const std::optional<Message> message = process.answer();
      if (!take_piece(seat, message)) return take_answer(seat, message);
      answer = process.receive();
    }
    switch (answer) {
      case WorkerProcess::Answer::malformed:
        return take_death(seat, broken_pipes());
      case WorkerProcess::Answer::gone:
        return take_failure(seat);
      case WorkerProcess::Answer::whole:
      case WorkerProcess::Answer::incomplete:
        break;
    }
    if (!can_send || has_ended) return take_failure(seat);
    if (process.answer_bytes() > known_bytes) seat.task->quiet_s = 0.0;
  }

  /// Ends what takes too long. A worker that a signal has stopped goes on, a few times.
  void look_at_time(Seat& seat) {
    // A debugger or a terminal stops a worker once or twice. A planner that stops its own process
    // whenever it goes on would hold the seat for ever.
    constexpr int kMostStops = 3;
    Task& task = *seat.task;
    if (task.job.job.mission && task.busy_s > options_.trial_timeout_s) {
      return take_death(seat, {Outcome::planner_hung, "the trial lasted longer than its timeout"});
    }
    if (seat.silent_s > options_.silence_s) {
      if (task.stops == kMostStops || !seat.process->go_on()) {
        return take_death(seat, {Outcome::planner_hung, "the worker did not answer any more"});
      }
      ++task.stops;
      seat.silent_s = task.quiet_s = 0.0;
    }
    // It lives, but the rest of what came does not: a planner wrote the beginning.
    const bool is_answering = seat.process->answer_bytes() > 0;
    if (is_answering && task.quiet_s > options_.silence_s) take_death(seat, broken_pipes());
  }

  /// Waits a second at most until busy seats have something to say, and takes it.
  void take_next_results() {
    // Long enough to cost nothing, short enough for time limits, which are of seconds, and for
    // progress lines.
    constexpr int kWait_ms = 1000;
    std::vector<pollfd> waiting;
    std::vector<Seat*> busy;
    for (Seat& seat : seats_) {
      if (!seat.task) continue;
      const int job_fd = seat.process->has_more_to_send() ? seat.process->job_fd() : -1;
      // Two a seat; poll() passes over those with a negative number.
      waiting.push_back({.fd = seat.process->result_fd(), .events = POLLIN, .revents = 0});
      waiting.push_back({.fd = job_fd, .events = POLLOUT, .revents = 0});
      busy.push_back(&seat);
    }
    const Clock::time_point began = Clock::now();
    // A signal ends the wait, too: the stop flags are looked at next.
    // Only busy seats are waited for: an idle worker's pipe says nothing until the next job.
    const bool has_news = ::poll(waiting.data(), waiting.size(), kWait_ms) >= 0;
    // No wait counts for longer: what stops this process stops its workers, too.
    const std::chrono::duration<double> waited = Clock::now() - began;
    const double waited_s = std::min(waited.count(), 1e-3 * kWait_ms);
    for (Seat* seat : busy) {
      seat->silent_s = seat->process->listen() ? 0.0 : seat->silent_s + waited_s;
      seat->task->busy_s += waited_s;
      seat->task->quiet_s += waited_s;
      const int tries = seat->task->tries;
      if (has_news) listen_to(*seat);
      // Not of a task that has just begun again.
      if (seat->task && seat->task->tries == tries) look_at_time(*seat);
    }
  }

  const std::function<std::optional<FleetJob>(const Memory&)>& next_;
  const std::function<void(const FleetJob&, JobEnd)>& ended_;
  const FleetOptions& options_;
  const std::set<pid_t> others_ = own_children();  ///< of before: not ours to end
  std::vector<Seat> seats_;
  std::map<std::string, int> left_behind_;
};

}  // namespace

std::map<std::string, int> fly(const std::function<std::optional<FleetJob>(const Memory&)>& next,
                               const std::function<void(const FleetJob&, JobEnd)>& ended,
                               const FleetOptions& options) {
  Fleet fleet(next, ended, options);
  fleet.fly();
  return fleet.clear();
}

}  // namespace avoidbench
