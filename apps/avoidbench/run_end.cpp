#include "run_end.hpp"

#include <algorithm>
#include <iostream>
#include <span>

#include "base/visible_text.hpp"
#include "base/words.hpp"
#include "store/trial_table.hpp"
#include "sweep/failure_kinds.hpp"
#include "sweep/planner_tallies.hpp"

namespace avoidbench {

void print_revision(const Database& database, const std::string& sweep,
                    const SweepRevision& revision) {
  constexpr std::size_t kMostChanges = 6;
  const std::string report = "avoidbench report " + database.path().string();
  const std::string number = std::to_string(revision.revision);
  if (!revision.is_new) {
    std::cerr << "warning: " << database.path().string() << " has sweep " << sweep
              << " with these contents as revision " << number << ", and later ones up to "
              << revision.latest << ", which reports show: " << report << " --sweep " << sweep
              << "@" << number << " shows this one\n";
    return;
  }
  std::vector<std::string> changes = revision.changes;
  if (changes.size() > kMostChanges) {
    const std::size_t more = changes.size() - kMostChanges;
    changes.resize(kMostChanges);
    changes.push_back(std::to_string(more) + " more");
  }
  std::cerr << "warning: " << database.path().string() << " has sweep " << sweep
            << " with other contents: this is its revision " << number << " ("
            << visible_line(joined(changes, "; ")) << "). Trials that both ask for are reused; "
            << "reports show the latest revision, " << report << " --sweep " << sweep << "@"
            << revision.revision - 1 << " the former one\n";
}

void print_summary(const RunSummary& summary, int ignored_signals) {
  const Progress& progress = summary.progress;
  if (progress.done_before > 0) {
    std::cerr << counted(progress.done_before, "trial")
              << (progress.done_before == 1 ? " is" : " are") << " already in the database\n";
  }
  if (progress.invalid_missions > 0) {
    const bool is_one = progress.invalid_missions == 1;
    std::cerr << counted(progress.invalid_missions, "trial") << (is_one ? " has" : " have")
              << " an invalid mission (no free start or goal, or no path between them) and "
              << (is_one ? "is" : "are") << " not flown\n";
  }
  for (const std::string& problem : summary.unkept) {
    std::cerr << "warning: no copy of a file that was used is kept: " << problem << '\n';
  }
  for (const auto& [label, count] : summary.left_behind) {
    std::cerr << "warning: planner " << label << " left " << count
              << (count == 1 ? " process behind; it was ended\n"
                             : " processes behind; they were ended\n");
  }
  if (ignored_signals > 0) {
    std::cerr << "warning: " << counted(ignored_signals, "signal")
              << " to stop came from a planner; " << (ignored_signals == 1 ? "it was" : "they were")
              << " ignored\n";
  }
  if (summary.unflown.empty()) return;
  constexpr std::size_t kMostShown = 10;  // of a map that could not be measured, all
  const std::size_t shown = std::min(summary.unflown.size(), kMostShown);
  for (const UnflownTrial& trial : std::span(summary.unflown).first(shown)) {
    std::cerr << "warning: trial " << trial.key.substr(0, 8) << " of " << trial.planner_label
              << " is not stored: its worker was killed " << kMostTries << " times, by "
              << trial.reason << '\n';
  }
  if (shown < summary.unflown.size()) {
    std::cerr << "warning: and so are " << summary.unflown.size() - shown << " more\n";
  }
  std::cerr
      << counted(summary.unflown.size(), "trial")
      << (summary.unflown.size() == 1 ? " was" : " were")
      << " not flown: somebody, the kernel short of memory, or a limit of CPU time "
         "(ulimit -t) killed their\nworkers. Run the same command again, with fewer --jobs or a "
         "lower --memory-limit if memory is short\n";
}

void print_failures(const Database& database, const std::string& sweep, const RunSummary& summary) {
  const std::vector<FailureKind> kinds =
      failure_kinds(database.list_trials(sweep, summary.revision));
  if (kinds.empty()) return;
  const std::string replay = "avoidbench replay " + database.path().string();
  std::cerr << "trials that did not reach the goal, and the command that shows one:\n";
  for (const FailureKind& kind : kinds) {
    const auto words = summary.last_words.find(kind.example.key);
    const std::string printed =
        words == summary.last_words.end() ? "" : "; it printed: " + visible_line(words->second);
    std::cerr << "  " << failure_text(kind) << printed << "; " << replay << " " << kind.example.id
              << '\n';
  }
  std::cerr << "  all of a kind: " << replay << " --list --outcome " << text(kinds.front().outcome)
            << '\n';
}

void warn_of_planners(const Database& database, const std::string& sweep, std::int64_t revision) {
  PlannerTallies tallies(database.metrics());
  visit_trials(database, sweep, revision, {}, [&](const VisitedTrial& trial) {
    tallies.add(trial.planner_key, trial.outcome, trial.metrics);
  });
  std::string spec_json;
  for (const SweepInfo& info : database.read_sweeps()) {
    if (info.name == sweep && info.revision == revision) spec_json = info.spec_json;
  }
  std::vector<std::pair<std::string, std::string>> planners;
  for (const PlannerRow& row : database.read_planners()) {
    planners.emplace_back(planner_key(row), row.label);
  }
  for (const std::string& line : tallies.warnings(planners, spec_json)) {
    std::cerr << "warning: " << line << '\n';
  }
}

/// The command that shows this revision of a sweep, which need not be the latest one.
std::string command_that_reports(const Database& database, const std::string& sweep,
                                 std::int64_t revision) {
  std::string line = "avoidbench report " + database.path().string();
  for (const SweepInfo& other : database.read_sweeps()) {
    if (other.name != sweep || other.revision <= revision) continue;
    return line + " --sweep " + sweep + "@" + std::to_string(revision);
  }
  return line;
}

}  // namespace avoidbench
