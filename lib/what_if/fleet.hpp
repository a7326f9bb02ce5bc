#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "replay/apart.hpp"

namespace avoidbench {

/// How flights are flown several at once.
struct FleetOptions {
  ApartOptions apart;
  int jobs = 1;
  double grace_s = 30.0;                        ///< after `stop`, for what flies
  const std::atomic<bool>* stop = nullptr;      ///< set: begin nothing more
  const std::atomic<bool>* stop_now = nullptr;  ///< set: end what flies
};

/// A flight that waits for a worker.
struct FleetFlight {
  std::size_t index = 0;  ///< the caller's
  Job job;
  std::uint32_t needs = 0;  ///< the planner's
};

/// Flies what `next` gives, until that is nothing, in as many worker processes at once as wanted,
/// and tells `ended` of each as it ends: a planner's crash or hang is a result like others. A
/// process flies one planner only, and one flight only of a planner that keeps what it knows in
/// globals. A flight whose worker was killed from outside is flown once more; if that happens again
/// ApartFlight::killed_by says so. When it returns, no process is left of those that it and its
/// planners started. False where it was stopped before the end. What `next`, `ended` or a flight
/// that can't be begun throws ends it.
bool fly_fleet(const std::function<std::optional<FleetFlight>()>& next,
               const std::function<void(std::size_t, ApartFlight)>& ended,
               const FleetOptions& options);

}  // namespace avoidbench
