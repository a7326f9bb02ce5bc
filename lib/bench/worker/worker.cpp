#include "worker/worker.hpp"

#include <fcntl.h>
#include <pthread.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <map>
#include <optional>
#include <thread>
#include <utility>

#include "base/digest.hpp"
#include "base/input_error.hpp"
#include "base/spec_json.hpp"
#include "metrics/known_world.hpp"
#include "metrics/metric_table.hpp"
#include "process/inherited.hpp"
#include "process/print_capture.hpp"
#include "process/process_tree.hpp"
#include "process/sandbox.hpp"
#include "program_planner/program_prints.hpp"
#include "trial/flown_world.hpp"
#include "trial/map_scene.hpp"
#include "trial/planner_view.hpp"
#include "trial/run_trial.hpp"
#include "worker/crash_report.hpp"
#include "worker/lost_time.hpp"

namespace avoidbench {
namespace {

/// Which file a descriptor led to.
class FileIdentity {
 public:
  // A number alone says nothing: a planner may close it and open another file that gets the same
  // one.
  explicit FileIdentity(int fd) { is_known_ = ::fstat(fd, &file_) == 0; }
  bool is_still(int fd) const {
    struct stat now {};
    return is_known_ && ::fstat(fd, &now) == 0 && now.st_dev == file_.st_dev &&
           now.st_ino == file_.st_ino;
  }

 private:
  struct stat file_ {};
  bool is_known_ = false;
};

/// What a process that a planner forks does first: it lets go of the worker's pipes, ends with the
/// worker, and lets the worker see how much memory it uses, which enter_sandbox() may have
/// switched off.
// A global, since what pthread_atfork() calls takes no argument.
std::array<int, 3> pipes{-1, -1, -1};
void leave_worker() {
  for (const int fd : pipes) ::close(fd);
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  ::prctl(PR_SET_DUMPABLE, 1);
}

void keep_from_children(const std::array<int, 3>& fds) {
  pipes = fds;
  // fork() and exec() each need a door closed: a program that the planner starts must not hold the
  // pipes, or the parent waits for their end.
  for (const int fd : fds) ::fcntl(fd, F_SETFD, FD_CLOEXEC);
  ::pthread_atfork(nullptr, nullptr, leave_worker);
}

/// All that a planner's instance is made from.
std::string instance_key(const TrialSpec& spec, const PluginChoice& plugin) {
  // Not latency, wind or mission: a planner is not told of them at creation (see ab_mission).
  return spec_to_json(plugin).dump() + std::to_string(spec.planner.camera) +
         spec_to_json(spec.vehicle).dump() + spec_to_json(spec.sensor).dump() +
         spec_to_json(spec.rates).dump();
}

constexpr const char* kFileChanged = "the planner's file changed during the run";

void require_unchanged(const PluginChoice& plugin) {
  if (digest_now(plugin.file, plugin.files) == plugin.file_digest) return;
  throw InputError({.file = plugin.file, .message = kFileChanged});
}

/// What those who look at a flight see: the map with the movers of the job's mission.
class LookedAtWorld {
 public:
  LookedAtWorld(const Job& job, const MapScene& map) : map_(map.world) {
    if (job.lookout && job.mission) {
      with_movers_ = world_with_movers(job.spec, map.scene, job.mission->mission);
    }
  }
  const World& world() const { return with_movers_ ? *with_movers_ : map_; }

 private:
  const World& map_;
  std::optional<World> with_movers_;
};

}  // namespace

/// Members are destroyed from the last to the first: instances before their libraries, both while
/// the watchdog still looks at them.
struct Worker::Internals {
  CallClock clock;
  std::jthread watchdog;  // ends after the instances, whose destruction may hang
  std::string map_key;
  std::unique_ptr<MapScene> map;
  // By file and command.
  std::map<std::pair<std::string, std::vector<std::string>>, PlannerLibrary> libraries;
  std::map<std::string, PlannerInstance> instances;  // by instance_key
  std::optional<FlightJournal> journal;
  std::optional<PrintTrimmer> trimmer;
  LookoutMakers lookouts;
  std::function<void(const Message&)> send;

  const MapScene& map_of(const TrialSpec& spec);
  PlannerInstance& instance_of(const TrialSpec& spec, const PluginChoice& plugin);
  Pilot pilot_of(const TrialSpec& spec);
  TrialRecord fly(const Job& job, const Scene& scene, const World& flown_world,
                  std::optional<Lookout>& lookout);
  TrialObserver bookkeeper(const Job& job, const Lookout* lookout);
  void send_piece(const Job& job, const Lookout& lookout);
  std::optional<Lookout> lookout_of(const Job& job, const World& world);
};

const MapScene& Worker::Internals::map_of(const TrialSpec& spec) {
  const std::string key = map_scene_key(spec);
  if (map == nullptr || key != map_key) {
    map.reset();  // two large maps need not fit beside each other
    map = std::make_unique<MapScene>(spec);
    map_key = key;
  }
  return *map;
}

PlannerInstance& Worker::Internals::instance_of(const TrialSpec& spec, const PluginChoice& plugin) {
  const std::string key = instance_key(spec, plugin);
  if (const auto kept = instances.find(key); kept != instances.end()) return kept->second;
  const std::pair name(plugin.file, plugin.command);
  auto library = libraries.find(name);
  if (library == libraries.end()) {
    library = libraries.emplace(name, PlannerLibrary::load(plugin.source(), &clock)).first;
  }
  // Loaded now, flown under the sweep's digest: they must be the same file.
  if (library->second.description().file_digest != plugin.file_digest) {
    throw InputError({.file = plugin.file, .message = kFileChanged});
  }
  PlannerInstance made(library->second, planner_setup(spec), parameter_values(plugin), &clock);
  return instances.emplace(key, std::move(made)).first->second;
}

Pilot Worker::Internals::pilot_of(const TrialSpec& spec) {
  PlannerInstance& planner = instance_of(spec, spec.planner);
  if (!spec.planner.filter) return planner;
  return {planner, &instance_of(spec, *spec.planner.filter)};
}

std::optional<Lookout> Worker::Internals::lookout_of(const Job& job, const World& world) {
  if (!job.lookout) return std::nullopt;
  return lookouts.at(job.lookout->kind)(job, world);
}

/// `lookout` gets what has looked on, where the job asks for one; it looks at `flown_world`.
TrialRecord Worker::Internals::fly(const Job& job, const Scene& scene, const World& flown_world,
                                   std::optional<Lookout>& lookout) {
  std::optional<Pilot> made;
  try {
    made = pilot_of(job.spec);
  } catch (const InputError& error) {
    // Else it is no error of these.
    for (const PluginChoice* plugin : plugins_of(job.spec.planner)) require_unchanged(*plugin);
    TrialRecord record;
    record.outcome = Outcome::planner_error;
    record.reason = error.what();
    return record;
  }
  const Pilot& pilot = *made;
  const std::vector<double>* recorded_s =
      job.recorded_latency_s ? &*job.recorded_latency_s : nullptr;
  want_drawings(pilot, lookout && lookout->wants_drawings);
  if (lookout && lookout->logged) lookout->logged(take_log(pilot));
  if ((needs(pilot) & AB_INPUT_WORLD) != 0) {
    show_world(pilot, known_world(job.spec, scene, job.mission->mission));
  }
  const auto flown = [&] {
    return run_trial(job.spec, scene, job.mission->mission, pilot,
                     bookkeeper(job, lookout ? &*lookout : nullptr), recorded_s, job.change);
  };
  TrialRecord record = flown();
  const auto is_killed = [&] {
    return record.outcome == Outcome::planner_crashed && was_killed(pilot);
  };
  if (is_killed()) {
    // By somebody else, maybe, as a worker may be: flown again. A second time it counts, unless a
    // limit of CPU time ends programs whatever they do.
    if (journal) journal->restart();
    lookout = lookout_of(job, flown_world);
    record = flown();
    if (is_killed() && has_cpu_limit()) end_from_outside(SIGXCPU);
  }
  if (lookout && lookout->logged) lookout->logged(take_log(pilot));
  return record;
}

void Worker::Internals::send_piece(const Job& job, const Lookout& lookout) {
  if (std::optional<Message> piece = lookout.take_piece()) {
    send(piece_message(job.token, std::move(*piece)));
  }
}

TrialObserver Worker::Internals::bookkeeper(const Job& job, const Lookout* lookout) {
  TrialObserver observer;
  if (lookout != nullptr) observer = lookout->observer;
  if (lookout != nullptr && lookout->take_piece && send) {
    observer.planning = [this, &job, lookout,
                         asked = observer.planning](const PlanCallAhead& call) {
      const bool goes_on = !asked || asked(call);
      send_piece(job, *lookout);
      return goes_on;
    };
    observer.planned = [this, &job, lookout, told = observer.planned](const PlanStep& step) {
      if (told) told(step);
      send_piece(job, *lookout);
    };
  }
  if (!journal && !trimmer) return observer;
  // Before each call: what a dead worker leaves is then all up to the call that it died in.
  observer.planning = [this, asked = observer.planning](const PlanCallAhead& call) {
    if (journal) journal->add(call.record, call.time_s);
    if (trimmer) trimmer->trim();
    return !asked || asked(call);
  };
  return observer;
}

Worker::Worker(LookoutMakers lookouts) : internals_(std::make_unique<Internals>()) {
  internals_->lookouts = std::move(lookouts);
}
Worker::~Worker() = default;
Worker::Worker(Worker&&) noexcept = default;
Worker& Worker::operator=(Worker&&) noexcept = default;

JobResult Worker::work(const Job& job) {
  const auto began = std::chrono::steady_clock::now();
  JobResult result;
  result.token = job.token;
  // The flight before must not be taken for this one's.
  if (internals_->journal) internals_->journal->restart();
  if (internals_->trimmer) internals_->trimmer->restart();
  try {
    const MapScene& map = internals_->map_of(job.spec);
    result.world_digest = map.world.digest;
    const LookedAtWorld flown(job, map);
    std::optional<Lookout> lookout = internals_->lookout_of(job, flown.world());
    if (!job.mission) {
      result.map = make_map_record(job.spec, map.scene, job.mission_count, job.listed_missions);
    } else if (!lookout || job.lookout->has_flight) {
      result.trial = internals_->fly(job, map.scene, flown.world(), lookout);
      result.metrics =
          compute_metrics({job.spec, *job.mission, *result.trial,
                           mover_difficulty(job.spec, map.scene, job.mission->mission)});
    }
    if (lookout) result.reported = lookout->report(result.trial ? &*result.trial : nullptr);
  } catch (const InputError& error) {
    result.error = error.what();
  } catch (const std::bad_alloc&) {
    result.error = "out of memory";
    result.is_out_of_memory = true;
  }
  const std::chrono::duration<double> took = std::chrono::steady_clock::now() - began;
  result.wall_time_s = took.count();
  return result;
}

void Worker::keep_journal(FlightJournal journal) { internals_->journal = std::move(journal); }

void Worker::trim_prints() { internals_->trimmer.emplace(STDOUT_FILENO); }

void Worker::send_pieces(std::function<void(const Message&)> send) {
  internals_->send = std::move(send);
}

void Worker::watch(const WorkerOptions& options) {
  const CallClock* clock = &internals_->clock;
  const pid_t parent = ::getppid();
  internals_->watchdog = std::jthread([clock, options, parent](const std::stop_token& stop) {
    // Often enough that a planner which grows by 1 GiB/s passes its limit by a tenth of that, and
    // cheap beside any flight.
    constexpr int kLooksASecond = 10;
    LostTime lost;
    for (int look = 0; !stop.stop_requested(); ++look) {
      std::this_thread::sleep_for(std::chrono::milliseconds(1000 / kLooksASecond));
      if (::getppid() != parent) ::_exit(1);  // a planner may have switched the death signal off
      const double call_s = clock->running_s();
      if (call_s - lost.in_call_s(call_s) > options.plan_timeout_s) end_hanging(kHungExitCode);
      if (options.memory_limit_mib > 0.0 &&
          resident_mib_of_family(options.memory_limit_mib) > options.memory_limit_mib) {
        ::_exit(kMemoryExitCode);
      }
      // A byte each second tells the parent that the process lives, whatever its planner does.
      // EBADF: the planner has closed it. A full pipe is no harm.
      if (look % kLooksASecond == 0 && ::write(options.notes_fd, "", 1) < 0 && errno == EBADF) {
        ::_exit(kPipesExitCode);
      }
    }
  });
}

int run_worker(const WorkerOptions& options, LookoutMakers lookouts) {
  // Files, locks and pipes that the shell, a script or a build left open are not the planner's.
  close_from(std::max({options.in_fd, options.out_fd, options.notes_fd, options.journal_fd}) + 1);
  leave_terminal();
  // The parent decides when to stop; a signal to the whole process group reaches workers, too.
  for (const int number : {SIGINT, SIGTERM, SIGHUP, SIGUSR1}) std::signal(number, SIG_IGN);
  std::signal(SIGPIPE, SIG_IGN);
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  adopt_orphans();  // so that what a planner starts is found below its worker
  // Line by line: what a crash leaves unsaid is half a line at most.
  std::setvbuf(stdout, nullptr, _IOLBF, BUFSIZ);
  // No core files: a sweep may have thousands of crashes.
  constexpr rlimit kNone{0, 0};
  ::setrlimit(RLIMIT_CORE, &kNone);
  keep_from_children({options.in_fd, options.out_fd, options.notes_fd});
  report_crashes(options.notes_fd);
  // Before the watchdog's thread starts and before any planner is loaded: Landlock and seccomp hold
  // for the thread that enters them and what it starts.
  if (!options.sandbox.empty() && text(enter_sandbox(sandbox_rules_from(options.allowed),
                                                     sandbox_support())) != options.sandbox) {
    return kSandboxExitCode;
  }
  const FileIdentity results(options.out_fd), jobs(options.in_fd);
  const pid_t self = ::getpid();
  Worker worker(std::move(lookouts));
  if (options.journal_fd >= 0) worker.keep_journal(FlightJournal(options.journal_fd));
  worker.trim_prints();
  pass_prints_on(STDOUT_FILENO);  // of planners that are programs
  worker.watch(options);
  // No planner was loaded until now: the end of a worker that did not say so is no planner's doing.
  (void)!::write(options.notes_fd, "", 1);
  const auto is_own = [&] {
    // A child that a planner forked and that went on as if it were its parent: it has no say.
    if (::getpid() != self) ::_exit(kPipesExitCode);
    // A planner may have closed them, and opened files of its own that took their numbers.
    return results.is_still(options.out_fd) && jobs.is_still(options.in_fd);
  };
  worker.send_pieces([&](const Message& piece) {
    if (!is_own()) ::_exit(kPipesExitCode);
    if (!send_message(options.out_fd, piece)) ::_exit(1);
  });
  // Until the parent closes the pipe of jobs.
  while (const auto message = receive_message(options.in_fd)) {
    const JobResult result = worker.work(job_from(*message));
    std::fflush(stdout);
    if (!is_own()) return kPipesExitCode;
    if (!send_message(options.out_fd, result_message(result))) return 1;
  }
  return 0;
}

}  // namespace avoidbench
