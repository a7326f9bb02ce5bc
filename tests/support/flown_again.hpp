#pragma once

#include "base/input_error.hpp"
#include "replay/stored_flight.hpp"
#include "worker/worker.hpp"

namespace avoidbench::test {

/// A stored trial flown again in this process.
struct FlownAgain {
  StoredFlight flight;
  JobEnd end;

  TrialRecord record() const { return record_of(end, flight.job.job.spec.planner); }
  std::vector<std::string> differences() const {
    return avoidbench::differences(flight.stored.row.record, record());
  }
};

inline FlownAgain flown_again(StoredTrial stored, const ReplayFiles& files = {}) {
  ReplayPlanners planners(files);
  FlownAgain flown{.flight = stored_flight(std::move(stored), planners), .end = {}};
  flown.end.answer = Worker().work(flown.flight.job.job);
  if (!flown.end.answer->error.empty()) throw InputError(flown.end.answer->error);
  return flown;
}

}  // namespace avoidbench::test
