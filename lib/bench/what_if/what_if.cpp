#include "what_if/what_if.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <utility>

#include "base/input_error.hpp"
#include "base/words.hpp"
#include "replay/stored_flight.hpp"
#include "store/record_format.hpp"
#include "sweep/schedule.hpp"
#include "worker/worker_death.hpp"

namespace avoidbench {
namespace {

/// A trial made ready to be flown with a change.
struct PreparedFlight {
  Job job;
  std::string not_applicable;
};

/// The times that a machine took for the calls of a stored flight, over and over for as long as the
/// flight may last: a flight with a change may have more calls, at other moments.
std::vector<double> repeated_latencies(const std::vector<double>& recorded_s,
                                       const TrialSpec& spec) {
  const auto most = static_cast<std::size_t>(spec.mission.time_limit_s * spec.rates.plan_hz) + 2;
  std::vector<double> all = recorded_s;
  while (!recorded_s.empty() && all.size() < most) {
    all.push_back(recorded_s[all.size() % recorded_s.size()]);
  }
  return all;
}

PreparedFlight prepared(const StoredTrial& stored, const Change& change,
                        const ReplayPlanner& planner, std::vector<std::string>& warnings) {
  PreparedFlight flight{.job = stored_job(stored, planner, warnings), .not_applicable = {}};
  ChangedTrial trial{.spec = flight.job.spec};
  flight.not_applicable =
      change.apply({stored.row.record, planner.description, needs_of(trial.spec.planner)}, trial);
  flight.job.spec = std::move(trial.spec);
  flight.job.change = trial.flight;
  if (!is_measured(flight.job.spec.latency)) {
    flight.job.recorded_latency_s.reset();
  } else if (change.name != kNoChange && flight.job.recorded_latency_s) {
    flight.job.recorded_latency_s =
        repeated_latencies(*flight.job.recorded_latency_s, flight.job.spec);
  }
  return flight;
}

/// What flown_digest() is of what it was found as.
std::string digest_of(const ReplayPlanner& planner) {
  PlannerChoice found;
  found.file_digest = planner.description.file_digest;
  if (planner.filter) found.filter.emplace().file_digest = planner.filter->file_digest;
  return flown_digest(found);
}

/// Whether the same flight must come out: not where a machine's time decided at which call it
/// ended, and not where a worker left no path.
bool must_repeat(const TrialRecord& record) {
  const bool is_hang = record.outcome == Outcome::planner_hung && record.reason != kCallTimeout;
  const bool is_death =
      record.outcome == Outcome::planner_hung || record.outcome == Outcome::planner_crashed;
  return !is_hang && !(is_death && record.samples.empty());
}

/// The trials that are asked for: failures, and of each planner the first successes by key.
std::vector<TrialListing> chosen_for(const Database& database, const WhatIfRequest& request) {
  std::vector<TrialListing> all = database.list_trials();
  std::erase_if(all, [&](const TrialListing& trial) {
    return (!request.trial.empty() && trial.key != request.trial) ||
           (!request.planner.empty() && trial.planner_label != request.planner);
  });
  std::sort(all.begin(), all.end(), [](const TrialListing& a, const TrialListing& b) {
    return std::tie(a.planner_label, a.key) < std::tie(b.planner_label, b.key);
  });
  if (!request.trial.empty()) return all;
  std::erase_if(all, [](const TrialListing& trial) { return trial.is_recorded; });
  const auto failed = [](const TrialListing& trial) {
    return trial.outcome != Outcome::reached_goal;
  };
  std::map<std::string, std::int64_t> left;  // of the control, by planner
  for (const TrialListing& trial : all) left[trial.planner_label] += failed(trial) ? 1 : 0;
  if (request.control) {
    for (auto& [label, count] : left) count = *request.control;
  }
  std::erase_if(all, [&](const TrialListing& trial) {
    return !failed(trial) && left[trial.planner_label]-- <= 0;
  });
  return all;
}

}  // namespace

std::size_t WhatIfPlan::missing_count() const {
  return static_cast<std::size_t>(std::count_if(
      flights.begin(), flights.end(), [](const WhatIfFlight& one) { return one.is_missing(); }));
}

WhatIfPlan plan_what_ifs(const Database& database, const WhatIfRequest& request,
                         const WhatIfSource& source) {
  std::map<std::pair<std::string, std::string>, WhatIfRow> rows;
  for (WhatIfRow& row : database.read_what_ifs()) {
    const std::pair key(row.trial_key, row.change);
    rows.emplace(key, std::move(row));
  }
  WhatIfPlan plan;
  std::set<std::string> warnings;
  std::int64_t of_other_program = 0;
  ReplayPlanners planners(source.files);
  for (const TrialListing& listing : chosen_for(database, request)) {
    const StoredTrial stored = source.read(database, listing.key);
    const TrialRecord& record = stored.row.record;
    const bool is_of_this_program = trial_key(stored.spec) == listing.key;
    of_other_program += is_of_this_program ? 0 : 1;
    const ReplayPlanner& planner = planners.of(stored.spec.planner);
    const std::string digest = digest_of(planner);
    const bool is_repeated =
        is_of_this_program && must_repeat(record) && digest == flown_digest(stored.spec.planner);
    plan.trials.push_back({.id = listing.id,
                           .key = listing.key,
                           .planner_label = listing.planner_label,
                           .map_key = stored.row.map_key,
                           .outcome = record.outcome,
                           .reason = record.reason,
                           .end_time_s = record.end_time_s,
                           .record_digest = is_repeated ? record_digest(record) : ""});
    for (const Change* change : request.changes) {
      std::vector<std::string> found;
      PreparedFlight flight = prepared(stored, *change, planner, found);
      warnings.insert(found.begin(), found.end());
      WhatIfFlight& planned = plan.flights.emplace_back();
      planned.trial = plan.trials.size() - 1;
      planned.change = change;
      planned.not_applicable = std::move(flight.not_applicable);
      const auto row = rows.find({listing.key, std::string(change->name)});
      const bool is_there = planned.not_applicable.empty() && row != rows.end() &&
                            row->second.planner_digest == digest;
      if (is_there) planned.row = row->second;
    }
  }
  plan.warnings.assign(warnings.begin(), warnings.end());
  if (of_other_program > 0) {
    plan.warnings.push_back(
        counted(of_other_program, "trial") +
        " of a program whose results differ (see CHANGELOG.md, Results change): flown again they "
        "may end differently regardless of the change");
  }
  return plan;
}

WhatIfRun fly_what_ifs(WhatIfPlan& plan, Database& database, const WhatIfSource& source,
                       const FleetOptions& options,
                       const std::function<void(std::size_t, std::size_t)>& flown) {
  Schedule schedule;
  std::size_t missing = 0, done = 0;
  for (std::size_t i = plan.flights.size(); i-- > 0;) {
    if (!plan.flights[i].is_missing()) continue;
    const WhatIfTrial& trial = plan.trials[plan.flights[i].trial];
    add_waiting(schedule, i, trial.map_key, trial.planner_label);
    ++missing;
  }
  WhatIfRun run;
  ReplayPlanners planners(source.files);
  const auto next = [&](const Memory& memory) -> std::optional<FleetJob> {
    const auto assignment = next_assignment(schedule, memory);
    if (!assignment) return std::nullopt;
    const std::size_t index = *assignment->trial;
    const WhatIfFlight& planned = plan.flights[index];
    const WhatIfTrial& trial = plan.trials[planned.trial];
    const StoredTrial stored = with_files(source.read(database, trial.key), source.files);
    std::vector<std::string> warnings;  // told by the plan
    const ReplayPlanner& planner = planners.of(stored.spec.planner);
    PreparedFlight flight = prepared(stored, *planned.change, planner, warnings);
    FleetJob job = fleet_job(index, std::move(flight.job));
    job.map = assignment->map;
    job.planner_label = trial.planner_label;
    return job;
  };
  const auto ended = [&](const FleetJob& job, JobEnd end) {
    WhatIfFlight& planned = plan.flights[job.index];
    const WhatIfTrial& trial = plan.trials[planned.trial];
    if (end.answer && !end.answer->error.empty()) throw InputError(end.answer->error);
    flown(++done, missing);
    if (!end.killed_by.empty()) {
      run.unflown.push_back("trial " + std::to_string(trial.id) + " " +
                            std::string(planned.change->phrase) + ": its workers were killed, by " +
                            end.killed_by);
      return;
    }
    const TrialRecord record = record_of(end, job.job.spec.planner);
    planned.row = {.trial_key = trial.key,
                   .change = std::string(planned.change->name),
                   .outcome = record.outcome,
                   .reason = record.reason,
                   .end_time_s = record.end_time_s,
                   .program_version = source.program_version,
                   .planner_digest = flown_digest(job.job.spec.planner),
                   .record_digest = record_digest(record)};
    database.add_what_if(*planned.row);
  };
  fly(next, ended, options);
  run.is_stopped = done < missing;
  return run;
}

}  // namespace avoidbench
