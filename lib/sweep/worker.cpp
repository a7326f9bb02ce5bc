#include "sweep/worker.hpp"

#include <unistd.h>

#include <atomic>
#include <chrono>
#include <csignal>
#include <map>
#include <thread>

#include "base/input_error.hpp"
#include "base/spec_json.hpp"
#include "metrics/metric_table.hpp"
#include "sweep/sweep_spec.hpp"
#include "trial/planner_view.hpp"
#include "trial/run_trial.hpp"

namespace avoidbench {
namespace {

/// A map with its BVH. On the heap, since the scene keeps the world's address.
struct Place {
  explicit Place(const TrialSpec& spec)
      : world(make_world(spec.map, spec.map_seed)), scene(world) {}
  World world;
  Scene scene;
};

std::string place_key(const TrialSpec& spec) {
  return spec_to_json(spec.map).dump() + std::to_string(spec.map_seed);
}

/// All that a planner's instance is made from.
std::string instance_key(const TrialSpec& spec) {
  return spec_to_json(spec.planner).dump() + spec_to_json(spec.vehicle).dump() +
         spec_to_json(spec.sensor).dump() + spec_to_json(spec.rates).dump();
}

}  // namespace

struct Worker::Internals {
  std::string place_key;
  std::unique_ptr<Place> place;
  std::map<std::string, PlannerLibrary> libraries;   // by file
  std::map<std::string, PlannerInstance> instances;  // by instance_key
  CallClock clock;
  std::jthread watchdog;

  const Place& place_of(const TrialSpec& spec);
  PlannerInstance& instance_of(const TrialSpec& spec);
  TrialRecord fly(const Job& job, const Scene& scene);
};

const Place& Worker::Internals::place_of(const TrialSpec& spec) {
  const std::string key = avoidbench::place_key(spec);
  if (place == nullptr || key != place_key) {
    place.reset();  // two large maps need not fit beside each other
    place = std::make_unique<Place>(spec);
    place_key = key;
  }
  return *place;
}

PlannerInstance& Worker::Internals::instance_of(const TrialSpec& spec) {
  const std::string key = instance_key(spec);
  if (const auto kept = instances.find(key); kept != instances.end()) return kept->second;
  auto library = libraries.find(spec.planner.file);
  if (library == libraries.end()) {
    library = libraries.emplace(spec.planner.file, PlannerLibrary::load(spec.planner.file)).first;
  }
  if (library->second.description().file_digest != spec.planner.file_digest) {
    throw InputError(
        {.file = spec.planner.file, .message = "the planner's file changed during the run"});
  }
  PlannerInstance made(library->second, planner_setup(spec), parameter_values(spec.planner),
                       &clock);
  return instances.emplace(key, std::move(made)).first->second;
}

TrialRecord Worker::Internals::fly(const Job& job, const Scene& scene) {
  PlannerInstance* planner = nullptr;
  try {
    planner = &instance_of(job.spec);
  } catch (const InputError& error) {
    TrialRecord record;
    record.outcome = Outcome::planner_error;
    record.reason = error.what();
    return record;
  }
  return run_trial(job.spec, scene, job.mission->mission, *planner);
}

Worker::Worker() : internals_(std::make_unique<Internals>()) {}
Worker::~Worker() = default;
Worker::Worker(Worker&&) noexcept = default;
Worker& Worker::operator=(Worker&&) noexcept = default;

JobResult Worker::work(const Job& job) {
  JobResult result;
  try {
    const Place& place = internals_->place_of(job.spec);
    if (!job.mission) {
      result.map = make_map_record(job.spec, place.scene, job.mission_count);
    } else {
      result.trial = internals_->fly(job, place.scene);
      result.metrics = compute_metrics({job.spec, *job.mission, *result.trial});
    }
  } catch (const InputError& error) {
    result.error = error.what();
  } catch (const std::bad_alloc&) {
    result.error = "out of memory";
  }
  return result;
}

void Worker::end_process_after(double plan_timeout_s) {
  const CallClock* clock = &internals_->clock;
  internals_->watchdog = std::jthread([clock, plan_timeout_s](const std::stop_token& stop) {
    while (!stop.stop_requested()) {
      std::this_thread::sleep_for(std::chrono::milliseconds(100));
      if (clock->running_s() > plan_timeout_s) ::_exit(kHungExitCode);
    }
  });
}

int run_worker(int in_fd, int out_fd, double plan_timeout_s) {
  // The parent decides when to stop; a signal to the whole process group reaches workers, too.
  for (const int number : {SIGINT, SIGTERM, SIGUSR1}) std::signal(number, SIG_IGN);
  std::signal(SIGPIPE, SIG_IGN);
  ::dup2(STDERR_FILENO, STDOUT_FILENO);  // what a planner prints is not a result
  Worker worker;
  worker.end_process_after(plan_timeout_s);
  while (const auto message = receive_message(in_fd)) {
    if (!send_message(out_fd, result_message(worker.work(job_from(*message))))) return 1;
  }
  return 0;
}

}  // namespace avoidbench
