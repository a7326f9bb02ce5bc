#include "replay_verify.hpp"

#include <algorithm>
#include <iostream>
#include <map>
#include <optional>
#include <utility>

#include "base/option_error.hpp"
#include "base/visible_text.hpp"
#include "base/words.hpp"
#include "database_choice.hpp"
#include "replay/sample.hpp"
#include "sweep/schedule.hpp"

namespace avoidbench {
namespace {

/// What came of verifying.
struct Verified {
  std::size_t flown = 0, with_copy = 0, unflown = 0;
  std::map<std::size_t, std::string> lines;  ///< of those that differ, by their number
};

std::string difference_lines(const TrialListing& trial, const StoredFlight& flight,
                             const JobEnd& end) {
  const TrialRecord flown = record_of(end, flight.job.job.spec.planner);
  const std::vector<std::string> found = differences(flight.stored.row.record, flown);
  if (found.empty()) return "";
  std::string text = "trial " + std::to_string(trial.id) + " (" + trial.key.substr(0, 8) + ", " +
                     visible_line(trial.planner_label) + ") differs:\n";
  for (const std::string& line : found) text += "  " + visible_line(line) + '\n';
  for (const std::string& line : flight.warnings) text += "  note: " + line + '\n';
  const std::string map = other_map_warning(flight.stored, end);
  return text + (map.empty() ? "" : "  note: " + map + '\n');
}

/// Flies these trials, each when a worker is free for it.
Verified fly_all(const Database& database, const std::vector<TrialListing>& trials,
                 ReplayPlanners& planners, const FleetOptions& options) {
  Schedule schedule;
  // A worker flies the last first. A run flew the first first: a planner that carries something
  // from one trial to the next then flies otherwise, and does not pass for one that repeats.
  for (std::size_t i = 0; i < trials.size(); ++i) {
    add_waiting(schedule, i, trials[i].map_key, trials[i].planner_label);
  }
  Verified verified;
  std::map<std::size_t, StoredFlight> in_flight;
  const auto next = [&](const Memory& memory) -> std::optional<FleetJob> {
    const auto assignment = next_assignment(schedule, memory);
    if (!assignment) return std::nullopt;
    const std::size_t index = *assignment->trial;
    StoredFlight flight = stored_flight(possible_trial(database, trials[index].key), planners);
    FleetJob job = std::move(flight.job);
    job.index = index;
    job.map = assignment->map;
    job.planner_label = trials[index].planner_label;
    flight.job.job.spec.planner = job.job.spec.planner;
    in_flight.emplace(index, std::move(flight));
    return job;
  };
  const auto ended = [&](const FleetJob& job, const JobEnd& end) {
    if (end.answer && !end.answer->error.empty()) throw InputError(end.answer->error);
    const StoredFlight flight = std::move(in_flight.extract(job.index).mapped());
    if (!end.killed_by.empty()) {
      ++verified.unflown;
      std::cerr << "warning: trial " << trials[job.index].id
                << " was not flown: its worker was killed " << kMostTries << " times, by "
                << end.killed_by << '\n';
    } else {
      ++verified.flown;
      verified.with_copy += flight.is_with_kept_planner ? 1 : 0;
      const std::string text = difference_lines(trials[job.index], flight, end);
      if (!text.empty()) verified.lines[job.index] = text;
    }
  };
  fly(next, ended, options);
  return verified;
}

}  // namespace

bool is_of_worker(Outcome outcome) {
  return outcome == Outcome::planner_crashed || outcome == Outcome::planner_hung;
}

void verify_trials(const VerifyChoice& choice, ReplayPlanners& planners,
                   const FleetOptions& options, const StopSignals& signals) {
  const std::vector<TrialListing>& all = choice.trials;
  const bool has_several = std::any_of(all.begin(), all.end(), [&](const TrialListing& one) {
    return one.planner_label != all.front().planner_label;
  });
  const std::string& library = planners.files().planner;
  if (!library.empty() && has_several) {
    throw OptionError(library + ": the trials are of several planners: choose one with --planner",
                      "library");
  }
  std::vector<TrialListing> sampled;
  std::copy_if(all.begin(), all.end(), std::back_inserter(sampled),
               [&](const TrialListing& one) { return is_sampled(one.key, choice.share); });
  const std::size_t passed_over =
      std::erase_if(sampled, [](const TrialListing& one) { return is_of_worker(one.outcome); });
  const std::size_t recorded =
      std::erase_if(sampled, [](const TrialListing& one) { return one.is_recorded; });
  const Verified verified = fly_all(choice.database, sampled, planners, options);
  for (const auto& [index, text] : verified.lines) std::cout << text;
  std::cout << counted(verified.flown, "trial") << " flown again, " << verified.lines.size()
            << " different\n";
  if (passed_over > 0) {
    std::cout << passed_over << " crashed or hung and were not flown: see avoidbench run --rerun\n";
  }
  if (recorded > 0) {
    std::cout << recorded << (recorded == 1 ? " is a real flight" : " are real flights")
              << ", which can't be flown again\n";
  }
  if (verified.with_copy > 0) {
    std::cerr << verified.with_copy
              << " of them with copies of planners that the run kept: their files are gone or have "
                 "changed\n";
  }
  if (sampled.empty() && passed_over + recorded == 0) {
    std::cerr << "the sample has no trial: make it larger\n";
  }
  if (verified.flown + verified.unflown < sampled.size()) {
    std::cout << std::flush;
    end_stopped(signals, "stopped: " + std::to_string(sampled.size() - verified.flown) +
                             " more were left to fly");
  }
  if (!verified.lines.empty() || verified.unflown > 0) throw CLI::RuntimeError(kExitDiffers);
}

}  // namespace avoidbench
