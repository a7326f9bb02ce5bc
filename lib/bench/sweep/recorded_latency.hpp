#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "store/database.hpp"
#include "sweep/sweep_spec.hpp"
#include "trial/trial_spec.hpp"

/// Latencies that an earlier run measured, for trials that fly it again.
namespace avoidbench {

/// Reads the latencies of measured trials; keeps databases open.
class RecordedLatencies {
 public:
  /// Of each call, s, that the trial was flown with which is `spec` but for `measured` latency of
  /// the same scale; none of one whose worker crashed. Nothing where the database says that its
  /// mission can't be flown. Throws InputError where it lacks the trial.
  std::optional<std::vector<double>> of(const TrialSpec& spec);

 private:
  std::map<std::string, Database> databases_;  // by file
};

/// Of a stored flight: those that it was flown with; nothing where its spec says them already.
std::optional<std::vector<double>> recorded_latencies(const TrialSpec& spec,
                                                      const TrialRecord& record);

/// SHA-256 of them, as TrialSpec::latency_digest.
std::string latency_digest(const std::vector<double>& latencies_s);

/// What has no meaning in its mode of latency at its default, so that trials which fly alike have
/// one key; of the database only the digest of what it says stays.
TrialSpec without_unused_latency(TrialSpec spec);

/// Whether times of the machine that flies it decide about flights of the sweep.
bool measures_latency(const SweepSpec& sweep);

}  // namespace avoidbench
