#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "env/actions.hpp"
#include "env/env_spec.hpp"
#include "env/observations.hpp"
#include "trial/trial_record.hpp"

namespace avoidbench {

/// Where a step is written: arrays that the caller owns, of one value or view a slot, slot after
/// slot. Only `view` may have nulls.
struct EnvArrays {
  ViewArrays view;
  double* reward = nullptr;
  std::uint8_t* terminated = nullptr;  ///< 1: the goal is reached, or the vehicle crashed
  std::uint8_t* truncated = nullptr;   ///< 1: the time is up
};

/// One episode that has ended: a trial.
struct EpisodeEnd {
  std::size_t slot = 0;
  std::int64_t episode = 0;  ///< Episode::ordinal
  std::int64_t round = 0;    ///< Episode::round
  std::string trial_key;     ///< of the spec, as a sweep's trial of this policy has it
  std::uint64_t map_seed = 0;
  std::int64_t mission_index = 0;
  Outcome outcome = Outcome::timed_out;
  std::string reason;
  double end_time_s = 0.0, reward_sum = 0.0;
  std::int64_t steps = 0;
  std::vector<double> metrics;  ///< as metric_table(); NaN: of no meaning here
};

/// Called now and then in the calling thread; what it throws interrupts the call.
using EnvPoll = std::function<void()>;

/// Many flights, stepped together: in each slot one, and after it the next. Episodes are trials,
/// flown as run_trial() flies them, with the latency that the sweep says. The same spec, seed and
/// actions give the same bytes, for any number of threads. One thread at a time; and only the
/// process that made it: in one that was forked, functions throw InputError.
class VectorEnv {
 public:
  /// Throws InputError for a spec that can't be stepped: a measured latency, axes by which
  /// observations or actions change their size or meaning, cameras of different sizes, images of a
  /// sensor without cameras or points of one without lidars, a number out of range.
  explicit VectorEnv(const EnvSpec& spec);
  ~VectorEnv();
  VectorEnv(const VectorEnv&) = delete;
  VectorEnv& operator=(const VectorEnv&) = delete;

  const EnvSpec& spec() const;
  const ViewShape& shape() const;
  const ActionLimits& limits() const;
  double step_s() const;            ///< simulated time between two observations
  std::size_t trial_count() const;  ///< trials of the sweep

  /// Begins an episode in each slot, or in those whose `mask` is not 0: with a seed the first ones
  /// of that seed (its slots must be all), without the next ones.
  void reset(std::optional<std::uint64_t> seed, std::span<const std::uint8_t> mask,
             const EnvArrays& arrays, const EnvPoll& poll = {});

  /// Flies each slot to its next observation. `actions`: slots × action_width(). A slot whose
  /// episode has ended begins the next one instead, with a reward of 0, if `begins_next`; else it
  /// must have been reset. Throws InputError where an action is not finite (then nothing was
  /// flown), and where the slots were not reset.
  void step(std::span<const double> actions, bool begins_next, const EnvArrays& arrays,
            const EnvPoll& poll = {});

  /// The episodes that ended in the last step, by slot.
  const std::vector<EpisodeEnd>& ended() const;

  /// The last flight that ended in the slot, and what flies there now or ended in the last step.
  const TrialRecord& record(std::size_t slot) const;
  const TrialSpec& trial(std::size_t slot) const;
  std::int64_t round(std::size_t slot) const;  ///< Episode::round of the same
  const Scene& scene(std::size_t slot) const;

 private:
  struct Internals;
  std::unique_ptr<Internals> internals_;
};

}  // namespace avoidbench
