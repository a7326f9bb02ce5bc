#include "env/vector_env.hpp"

#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <exception>
#include <stdexcept>
#include <thread>

#include "base/check.hpp"
#include "base/input_error.hpp"
#include "env/episode_source.hpp"
#include "env/path_progress.hpp"
#include "env/thread_pool.hpp"
#include "metrics/metric_table.hpp"
#include "metrics/reference_path.hpp"
#include "trial/flight.hpp"
#include "trial/planner_view.hpp"

namespace avoidbench {
namespace {

/// One flight and what is known of it.
struct Slot {
  std::int64_t next_ordinal = 0;
  Episode episode;
  std::optional<Flight> flight;  ///< points into the episode
  double gained_m = 0.0;         ///< along the reference path, so far
  double reward_sum = 0.0;
  std::int64_t steps = 0;
  bool has_ended = false;
  TrialRecord record;             ///< of the last flight that ended
  std::optional<EpisodeEnd> end;  ///< of the last step
};

/// Lets the caller's poll interrupt work that all threads do.
class Interruption {
 public:
  explicit Interruption(const EnvPoll& poll) : poll_(poll) {}

  /// In the calling thread polls; throws in all threads once that has thrown.
  void heed() {
    if (has_come_) throw std::runtime_error("interrupted");
    if (!poll_ || std::this_thread::get_id() != caller_) return;
    try {
      poll_();
    } catch (...) {
      what_ = std::current_exception();
      has_come_ = true;
      throw;
    }
  }

  /// When all threads are done.
  void rethrow() const {
    if (what_) std::rethrow_exception(what_);
  }

 private:
  const EnvPoll& poll_;
  std::thread::id caller_ = std::this_thread::get_id();
  std::atomic<bool> has_come_ = false;
  std::exception_ptr what_;
};

bool has_crashed(Outcome outcome) {
  return outcome == Outcome::collided || outcome == Outcome::left_bounds;
}

/// Of lidars only where points are seen.
bool are_alike(const ViewShape& a, const ViewShape& b, std::uint32_t needs) {
  return ((needs & AB_INPUT_POINTS) == 0 || a.lidars == b.lidars) && a.cameras == b.cameras &&
         a.height_px == b.height_px && a.width_px == b.width_px && a.imu_samples == b.imu_samples &&
         a.min_range_m == b.min_range_m && a.max_range_m == b.max_range_m;
}

void require(bool is_fine, const std::string& problem) {
  if (!is_fine) throw InputError(problem);
}

void check_numbers(const EnvSpec& spec) {
  require(spec.slots >= 1 && spec.slots <= 65536, "slots must be from 1 to 65536");
  require(spec.threads >= 1 && spec.threads <= 1024, "threads must be from 1 to 1024");
  require(spec.kept_maps >= 1, "kept_maps must be 1 or more");
  require(spec.action.points >= 1 && spec.action.points <= 1000,
          "the points of a trajectory must be from 1 to 1000");
  require(spec.action.horizon_s >= 0.01 && spec.action.horizon_s <= 60.0,
          "the horizon of a trajectory must be from 0.01 to 60 s");
}

/// That the sensor has what is observed.
void check_sensor(const EnvSpec& spec, const ViewShape& shape) {
  const std::uint32_t images = AB_INPUT_DEPTH | AB_INPUT_STEREO | AB_INPUT_COLOR;
  require((spec.needs & images) == 0 || shape.cameras > 0,
          "depth, stereo and color come from cameras, and the sensor has none: observe ranges or "
          "points of its lidars");
  require((spec.needs & AB_INPUT_POINTS) == 0 || !shape.lidars.empty(),
          "points and ranges come from lidars, and the sensor has none: add one as in sensor: "
          "{preset: d435_like, lidars: [velodyne_16]}");
  const bool is_inverse = spec.depth == DepthEncoding::inverse;
  require((spec.needs & AB_INPUT_DEPTH) == 0 || !is_inverse || shape.min_range_m > 0.0,
          "inverse depth is a share of the sensor's min_range_m, which is 0: set it, or use metric "
          "depth");
  require(!spec.sees_ranges || !is_inverse || shape.widest_lidar.min_range_m > 0.0,
          "inverse ranges are a share of the lidars' min_range_m, which is 0: set it, or use "
          "metric depth");
}

}  // namespace

struct VectorEnv::Internals {
  explicit Internals(const EnvSpec& env_spec);

  void require_own_process() const;
  void begin(Slot& slot, std::size_t index, const EnvArrays& arrays, Interruption& interruption);
  void fly(Slot& slot, std::size_t index, std::span<const double> action, const EnvArrays& arrays);
  void look(Slot& slot, std::size_t index, const EnvArrays& arrays);
  double reward_of_step(Slot& slot) const;
  void finish(Slot& slot, std::size_t index);
  void gather_ends();
  /// Does `work` for every slot; where it is interrupted or throws, all slots must be reset.
  void for_each_slot(const std::function<void(std::size_t, Interruption&)>& work,
                     const EnvPoll& poll);

  EnvSpec spec;
  EpisodeSource source;
  ViewShape shape;
  ActionLimits limits;
  double step_s = 0.0;
  pid_t process = ::getpid();
  std::uint64_t seed;
  std::vector<Slot> slots;
  std::vector<EpisodeEnd> ended;
  ThreadPool pool;
};

VectorEnv::Internals::Internals(const EnvSpec& env_spec)
    : spec(env_spec),
      // Checked before anything is allocated, or a thread started, by these numbers.
      source((check_numbers(spec), spec)),
      seed(spec.seed),
      slots(static_cast<std::size_t>(spec.slots)),
      // More threads than slots would have nothing to do.
      pool(static_cast<std::size_t>(std::min(spec.threads, spec.slots))) {
  const TrialSpec& first = *source.trials().front().setting;
  shape = view_shape(first);
  limits = action_limits(spec.action, first.vehicle);
  step_s = 1.0 / first.rates.plan_hz;
  check_sensor(spec, shape);
  const TrialSpec* seen = nullptr;
  for (const PlannedTrial& trial : source.trials()) {
    const TrialSpec& setting = *trial.setting;
    // Trials of a setting mostly follow each other; one that comes again is only checked again.
    if (&setting == seen) continue;
    seen = &setting;
    require(
        !is_measured(setting.latency),
        "latency.mode: measured and replay have no meaning for stepped flights; use fixed or zero");
    require(
        are_alike(view_shape(setting), shape, spec.needs) &&
            setting.rates.plan_hz == first.rates.plan_hz,
        "an axis of the sweep changes the cameras, the lidars, the IMU's rate or rates.plan_hz: "
        "observations need one shape");
    const ActionLimits own = action_limits(spec.action, setting.vehicle);
    require(own.lowest == limits.lowest && own.highest == limits.highest,
            "an axis of the sweep changes the vehicle's limits: actions need one range");
  }
}

void VectorEnv::Internals::require_own_process() const {
  require(process == ::getpid(),
          "this environment was created in another process, and its threads do not exist here: "
          "create it in the process that steps it (multiprocessing: use the start method spawn, or "
          "create it after the fork)");
}

void VectorEnv::Internals::begin(Slot& slot, std::size_t index, const EnvArrays& arrays,
                                 Interruption& interruption) {
  // First, since it points into the episode that is replaced.
  slot.flight.reset();
  slot.episode =
      source.episode(seed, index, slot.next_ordinal, [&interruption] { interruption.heed(); });
  slot.next_ordinal = slot.episode.ordinal + 1;
  slot.gained_m = slot.reward_sum = 0.0;
  slot.steps = 0;
  slot.has_ended = false;
  slot.flight.emplace(begin_flight(slot.episode.spec, slot.episode.map->scene(),
                                   slot.episode.mission->record.mission, spec.needs));
  clear_images(shape, at(arrays.view, shape, index));
  look(slot, index, arrays);
  // A flight that is at its goal where it starts ends in its first step, so that its end is told.
  slot.has_ended = false;
  arrays.terminated[index] = arrays.truncated[index] = 0;
  arrays.reward[index] = 0.0;
  // Its map is made while this episode flies.
  source.prepare(seed, index, slot.next_ordinal);
}

/// Flies to the next observation and writes it, and what came of the step.
void VectorEnv::Internals::look(Slot& slot, std::size_t index, const EnvArrays& arrays) {
  Flight& flight = *slot.flight;
  const PlannerView* view = next_plan(flight);
  slot.has_ended = view == nullptr;
  // The end shows its state, and the images that came since the last plan.
  const PlannerView last =
      slot.has_ended ? planner_view(flight.perception, flight.state) : PlannerView{};
  write_view(slot.has_ended ? last : *view, goal_now_world(flight), shape, spec.depth,
             at(arrays.view, shape, index));
  const bool is_timeout = slot.has_ended && *flight.outcome == Outcome::timed_out;
  arrays.terminated[index] = slot.has_ended && !is_timeout ? 1 : 0;
  arrays.truncated[index] = is_timeout ? 1 : 0;
}

/// Along the reference path, not toward the goal: the way around an obstacle is no loss.
double VectorEnv::Internals::reward_of_step(Slot& slot) const {
  const Flight& flight = *slot.flight;
  const auto& legs = slot.episode.mission->reference_legs;
  double gained_m = arc_length_m(legs[flight.goal_index], flight.state.position_world);
  for (std::size_t i = 0; i < flight.goal_index; ++i) gained_m += path_length_m(legs[i]);
  const double progress_m = gained_m - slot.gained_m;
  slot.gained_m = gained_m;
  double reward = spec.reward.progress_per_m * progress_m - spec.reward.time_per_s * step_s;
  if (slot.has_ended && has_crashed(*flight.outcome)) reward -= spec.reward.crash;
  if (slot.has_ended && *flight.outcome == Outcome::reached_goal) reward += spec.reward.goal;
  return reward;
}

void VectorEnv::Internals::finish(Slot& slot, std::size_t index) {
  const Episode& episode = slot.episode;
  slot.record = end_flight(std::move(*slot.flight));
  const TrialRecord& record = slot.record;
  slot.end = {.slot = index,
              .episode = episode.ordinal,
              .round = episode.round,
              .trial_key = trial_key(episode.spec),
              .map_seed = episode.spec.map_seed,
              .mission_index = episode.spec.mission_index,
              .outcome = record.outcome,
              .reason = record.reason,
              .end_time_s = record.end_time_s,
              .reward_sum = slot.reward_sum,
              .steps = slot.steps,
              .metrics = compute_metrics({episode.spec, episode.mission->record, record,
                                          mover_difficulty(episode.spec, episode.map->scene(),
                                                           episode.mission->record.mission)})};
}

void VectorEnv::Internals::fly(Slot& slot, std::size_t index, std::span<const double> action,
                               const EnvArrays& arrays) {
  Flight& flight = *slot.flight;
  // A flight that is over where it begins takes no command; this step tells its end.
  if (!flight.outcome) {
    answer(flight, plan_result(spec.action, action, flight.view,
                               known_latency_s(slot.episode.spec.latency).value()));
  }
  look(slot, index, arrays);
  arrays.reward[index] = reward_of_step(slot);
  slot.reward_sum += arrays.reward[index];
  ++slot.steps;
  if (slot.has_ended) finish(slot, index);
}

void VectorEnv::Internals::gather_ends() {
  // By slot, whoever was faster.
  for (Slot& slot : slots) {
    if (slot.end) ended.push_back(std::move(*slot.end));
    slot.end.reset();
  }
}

void VectorEnv::Internals::for_each_slot(
    const std::function<void(std::size_t, Interruption&)>& work, const EnvPoll& poll) {
  ended.clear();
  Interruption interruption(poll);
  try {
    pool.for_each(
        slots.size(), [&](std::size_t index) { work(index, interruption); },
        [&] { interruption.heed(); });
  } catch (...) {
    // Some slots are a step ahead of others.
    for (Slot& slot : slots) {
      slot.flight.reset();
      slot.end.reset();
    }
    // What the poll threw, not the "interrupted" of the other threads.
    interruption.rethrow();
    throw;
  }
  gather_ends();
}

VectorEnv::VectorEnv(const EnvSpec& spec) : internals_(std::make_unique<Internals>(spec)) {}

VectorEnv::~VectorEnv() {
  // In a forked process there are no threads to wait for: waiting would take for ever.
  if (internals_->process != ::getpid()) static_cast<void>(internals_.release());
}

const EnvSpec& VectorEnv::spec() const { return internals_->spec; }
const ViewShape& VectorEnv::shape() const { return internals_->shape; }
const ActionLimits& VectorEnv::limits() const { return internals_->limits; }
double VectorEnv::step_s() const { return internals_->step_s; }
std::size_t VectorEnv::trial_count() const { return internals_->source.trials().size(); }
const std::vector<EpisodeEnd>& VectorEnv::ended() const { return internals_->ended; }

const TrialRecord& VectorEnv::record(std::size_t slot) const {
  return internals_->slots.at(slot).record;
}

const TrialSpec& VectorEnv::trial(std::size_t slot) const {
  return internals_->slots.at(slot).episode.spec;
}

std::int64_t VectorEnv::round(std::size_t slot) const {
  return internals_->slots.at(slot).episode.round;
}

const Scene& VectorEnv::scene(std::size_t slot) const {
  return *internals_->slots.at(slot).flight.value().scene;
}

void VectorEnv::reset(std::optional<std::uint64_t> seed, std::span<const std::uint8_t> mask,
                      const EnvArrays& arrays, const EnvPoll& poll) {
  Internals& in = *internals_;
  in.require_own_process();
  require(mask.empty() || mask.size() == in.slots.size(),
          "the mask needs one value per slot: " + std::to_string(in.slots.size()));
  const bool is_whole =
      std::all_of(mask.begin(), mask.end(), [](auto value) { return value != 0; });
  if (seed) {
    require(is_whole, "a seed applies to all slots: it can't be given for some of them");
    in.seed = *seed;
    for (Slot& slot : in.slots) slot.next_ordinal = 0;
  }
  in.for_each_slot(
      [&](std::size_t index, Interruption& interruption) {
        if (mask.empty() || mask[index] != 0) {
          in.begin(in.slots[index], index, arrays, interruption);
        }
      },
      poll);
}

void VectorEnv::step(std::span<const double> actions, bool begins_next, const EnvArrays& arrays,
                     const EnvPoll& poll) {
  Internals& in = *internals_;
  in.require_own_process();
  const std::size_t width = action_width(in.spec.action);
  AB_CHECK(actions.size() == width * in.slots.size(), actions.size());
  // All are looked at before any flies: an error leaves every flight where it was.
  for (std::size_t i = 0; i < in.slots.size(); ++i) {
    const Slot& slot = in.slots[i];
    const std::string name = "slot " + std::to_string(i) + ": ";
    require(slot.flight.has_value(), name + "call reset() before step()");
    if (slot.has_ended) {
      require(begins_next, name + "its episode has ended: reset it before the next step");
      continue;
    }
    const std::string problem = action_problem(in.spec.action, actions.subspan(i * width, width));
    require(problem.empty(), name + problem);
  }
  in.for_each_slot(
      [&](std::size_t index, Interruption& interruption) {
        Slot& slot = in.slots[index];
        if (slot.has_ended) {
          in.begin(slot, index, arrays, interruption);
        } else {
          in.fly(slot, index, actions.subspan(index * width, width), arrays);
        }
      },
      poll);
}

}  // namespace avoidbench
