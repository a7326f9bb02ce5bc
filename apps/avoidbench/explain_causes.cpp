#include "explain.hpp"

#include <cmath>
#include <exception>
#include <iostream>
#include <map>
#include <optional>
#include <set>

#include "base/option_error.hpp"
#include "base/visible_text.hpp"
#include "base/words.hpp"
#include "explain/paragraph.hpp"
#include "metrics/metric_table.hpp"
#include "output.hpp"
#include "page/flight_recording.hpp"
#include "replay/explained_trial.hpp"
#include "report/sweep_tables.hpp"
#include "report/table_rows.hpp"
#include "stop_signals.hpp"
#include "store/record_format.hpp"
#include "sweep/cause_counts.hpp"
#include "sweep/schedule.hpp"
#include "table/table_text.hpp"
#include "trial/flown_world.hpp"
#include "view_output.hpp"

namespace avoidbench {
namespace {

constexpr int kExplainUnflown = 1;

using Stored = std::map<std::string, ExplanationRow>;

/// Whether the row is of this flight and by the rules of today, and can be read.
bool is_current(const ExplanationRow& row, const StoredTrial& trial) {
  try {
    facts_from_json(row.facts_json);
  } catch (const std::exception&) {  // somebody else's text
    return false;
  }
  return row.rules_version == kCauseRulesVersion && enum_from_text<Cause>(row.cause).has_value() &&
         row.record_digest == record_digest(trial.row.record);
}

ExplanationRow row_of(const StoredTrial& trial, const CauseFound& explanation) {
  return {.trial_key = trial.row.key,
          .cause = std::string(text(explanation.cause)),
          .facts_json = facts_json(explanation.facts),
          .rules_version = kCauseRulesVersion,
          .record_digest = record_digest(trial.row.record)};
}

/// Opens it for writing, where that can be; else causes are shown and not stored. Never beside a
/// reader: SQLite would leave its log beside the file.
bool reopen_for_writing(Database& database) {
  const std::filesystem::path path = database.path();
  database.close();
  try {
    database = Database::open_for_run(path, metric_table());
    return true;
  } catch (const InputError& error) {
    std::cerr << "warning: causes are not stored: " << error.what() << '\n';
    database = Database::open_for_reading(path);
    return false;
  }
}

/// The failures that are explained, and what is known of them.
struct CauseRun {
  Database& database;
  const std::vector<TrialListing>& failures;
  Stored& stored;
  bool is_writable = false;
  std::size_t explained = 0, unflown = 0;
  std::map<std::size_t, CauseJob> in_flight = {};  ///< by index of the failure
};

/// Flown again where that is needed and can be, else from what is stored.
CauseJob job_for(const StoredTrial& trial, const TrialListing& listing, ReplayPlanners& planners) {
  std::string problem;
  try {
    return cause_job(trial, planners);
  } catch (const OptionError& error) {
    problem = option_message(error);
  } catch (const InputError& error) {
    problem = error.what();
  }
  CauseJob job = cause_job_without_flight(trial, planners.files());
  std::cerr << "warning: trial " << listing.id
            << ": it can't be flown again: " << visible_line(problem) << '\n';
  job.is_incomplete = true;
  return job;
}

/// The failures whose cause is not known by today's rules, last first.
Schedule waiting_causes(const CauseRun& run) {
  Schedule schedule;
  for (std::size_t i = run.failures.size(); i-- > 0;) {
    const TrialListing& listing = run.failures[i];
    const auto known = run.stored.find(listing.key);
    const bool is_told = known != run.stored.end() &&
                         is_current(known->second, possible_trial(run.database, listing.key));
    // Others are not flown: any worker that runs no planner's code takes them.
    const bool is_flown = listing.outcome == Outcome::collided;
    if (!is_told) {
      add_waiting(schedule, i, listing.map_key, is_flown ? listing.planner_label : "");
    }
  }
  return schedule;
}

/// Shows what was found, and stores it where nothing is lacking.
void take_cause(CauseRun& run, std::size_t index, const JobEnd& end) {
  const TrialListing& listing = run.failures[index];
  const CauseJob job = std::move(run.in_flight.extract(index).mapped());
  if (!end.killed_by.empty()) ++run.unflown;
  const ExplainedTrial found = explanation_of(job, end);
  for (const std::string& warning : found.warnings) {
    std::cerr << "warning: trial " << listing.id << ": " << visible_line(warning) << '\n';
  }
  const ExplanationRow row = row_of(job.stored, found.explanation);
  // An explanation that lacks what only a flight tells is shown and not kept.
  const bool is_whole = found.warnings.empty() && !job.is_incomplete;
  if (run.is_writable && is_whole) run.database.add_explanation(row);
  run.stored[listing.key] = row;
  std::cerr << "explained " << ++run.explained << " of at most " << run.failures.size()
            << ": trial " << listing.id << " " << row.cause << '\n';
}

/// Finds the causes of these failures, several at once. What is stored and current stays.
void find_causes(CauseRun& run, ReplayPlanners& planners, const FleetOptions& options) {
  Schedule schedule = waiting_causes(run);
  if (schedule.maps.empty()) return;
  run.is_writable = reopen_for_writing(run.database);
  const auto next = [&](const Memory& memory) -> std::optional<FleetJob> {
    const auto assignment = next_assignment(schedule, memory);
    if (!assignment) return std::nullopt;
    const std::size_t index = *assignment->trial;
    const TrialListing& listing = run.failures[index];
    CauseJob cause = job_for(possible_trial(run.database, listing.key), listing, planners);
    FleetJob job = cause.job;
    job.index = index;
    job.map = assignment->map;
    if (!job.planner_label.empty()) job.planner_label = listing.planner_label;
    run.in_flight.emplace(index, std::move(cause));
    return job;
  };
  fly(
      next, [&](const FleetJob& job, const JobEnd& end) { take_cause(run, job.index, end); },
      options);
}

/// A row a fact that has a value.
struct FactLister {
  Table& table;
  void field(std::string_view name, double value, std::string_view doc) const {
    if (std::isnan(value)) return;
    table.rows.push_back(make_row(name, value, doc));
  }
};

/// A list, whose last column is wrapped: without a title.
Table fact_table(const Facts& facts) {
  Table table = make_table("facts", "",
                           {{.name = "fact", .place = Place::key},
                            {.name = "value", .decimals = 3},
                            {.name = "meaning", .place = Place::words}});
  FactLister lister{table};
  visit(lister, facts);
  return table;
}

/// The flight as it was at the decisive moment.
void write_moment(const StoredFlight& flight, const FleetOptions& options, const std::string& title,
                  double at_s, const std::string& png) {
  FleetJob job = flight.job;
  job.job.lookout = recording_job({.has_moments = true, .at_s = {at_s}}, job.job.spec);
  const JobEnd end = fly_one(job, options);
  if (!end.answer) throw InputError("its flight for the picture did not finish");
  const StoredTrial& stored = flight.stored;
  const World world = flown_world(stored.spec, stored.mission);
  write_sheets(stored, world, *end.answer->trial, recording_from(*end.answer->reported).moments,
               title, png);
}

void show_trial(const TrialListing& listing, const ExplanationRow& row,
                const ExplainOptions& options) {
  const CauseFound explanation{.cause = *enum_from_text<Cause>(row.cause),
                               .facts = facts_from_json(row.facts_json)};
  const std::string title = title_line(listing);
  const std::string sentences =
      visible_line(paragraph(explanation, listing.outcome, listing.reason));
  if (options.output.is_for_people()) {
    constexpr std::size_t kWidth = 100;
    return write_text(title + "\n" + cause_text(explanation.cause) + "\n\n" +
                          wrapped(sentences, kWidth, 0) + "\n\n" +
                          format_table(fact_table(explanation.facts), options.output.format),
                      options.output.output);
  }
  Section section{.name = "explain",
                  .title = title,
                  .tables = {fact_table(explanation.facts)},
                  .notes = {{"cause", cause_text(explanation.cause)}, {"flight", sentences}}};
  write_sections(std::span(&section, 1), options.output);
}

void show_all(const std::vector<TrialListing>& failures, const std::vector<TrialListing>& all,
              const Stored& stored, const ExplainOptions& options) {
  // Labels stand for planners here: those of one label are counted together.
  std::set<std::string> labels;
  for (const TrialListing& trial : all) labels.insert(trial.planner_label);
  std::vector<PlannerRow> planners;
  std::map<std::string, std::string> key_of;
  for (const std::string& label : labels) {
    planners.emplace_back().label = label;
    key_of[label] = planner_key(planners.back());
  }
  std::vector<TrialSummary> trials;
  Table list = make_table("trials", "Failures",
                          {{.name = "trial", .place = Place::key},
                           planner_column(),
                           {.name = "map", .place = Place::key},
                           {.name = "mission_index", .header = "mission", .place = Place::key},
                           {.name = "outcome", .place = Place::key},
                           {.name = "cause", .place = Place::key}});
  list.is_for_people = failures.size() <= 40;
  for (const TrialListing& trial : failures) {
    const auto row = stored.find(trial.key);
    const std::string cause = row != stored.end() ? row->second.cause : std::string();
    TrialSummary& summary = trials.emplace_back();
    summary.key = trial.key;
    summary.planner_key = key_of.at(trial.planner_label);
    summary.mission_index = trial.mission_index;
    summary.outcome = trial.outcome;
    summary.cause = cause;
    list.rows.push_back(make_row(trial.id, trial.planner_label,
                                 trial.generator + " " + std::to_string(trial.map_seed),
                                 trial.mission_index, text(trial.outcome), cause));
  }
  const std::vector<CauseCount> counts = cause_counts(trials, planners);
  Section section{
      .name = "explain",
      .title = counted(failures.size(), "failure") + " of " + counted(all.size(), "trial"),
      .tables = {causes_table(counts, std::vector(labels.begin(), labels.end())), list},
      .notes = cause_notes(counts)};
  section.footer = "One trial: avoidbench explain DB TRIAL --png moment.png; a cure: --what-if";
  write_sections(std::span(&section, 1), options.output);
}

}  // namespace

void explain_causes(const ExplainOptions& options) {
  const std::filesystem::path path = database_of(options.database);
  check_output(options.output.output, text(options.output.format));
  if (!options.png.empty()) check_output(options.png, "png");
  Database database = Database::open_for_reading(path);
  const std::vector<TrialListing> all =
      chosen_trials(database.list_trials(listed_fields(database)), options.choice);
  std::vector<TrialListing> failures = all;
  std::erase_if(failures,
                [](const TrialListing& one) { return one.outcome == Outcome::reached_goal; });
  const bool is_one = !options.choice.trial.empty();
  // Why a real flight failed is in no log of poses; planner_for() says so of one that is named.
  const std::size_t recorded =
      is_one ? 0 : std::erase_if(failures, [](const auto& one) { return one.is_recorded; });
  if (recorded > 0) {
    std::cerr << counted(recorded, "failure") << " of real flights: skipped\n";
  }
  if (failures.empty()) {
    if (is_one) {
      throw InputError("trial " + options.choice.trial +
                       " reached the goal: there is nothing to explain");
    }
    std::cout << "no failure among " << counted(all.size(), "trial") << '\n';
    return;
  }
  if (!options.png.empty() && !is_one) {
    throw OptionError("a picture shows one trial: give TRIAL", "", "png");
  }
  const StopSignals& signals = watch_stop_signals();
  ReplayPlanners planners(files_beside(options.database, database, options.flights));
  Stored stored;
  for (ExplanationRow& row : database.read_explanations()) {
    stored[row.trial_key] = std::move(row);
  }
  CauseRun run{.database = database, .failures = failures, .stored = stored};
  const FleetOptions fleet = fleet_options(options.flights, options.flights.job_count(), &signals);
  find_causes(run, planners, fleet);
  if (signals.stop) {
    end_stopped(signals,
                "stopped: the causes found are stored, the same command resumes from there");
  }
  if (is_one) {
    const TrialListing& listing = failures.front();
    const ExplanationRow& row = stored.at(listing.key);
    show_trial(listing, row, options);
    if (!options.png.empty()) {
      const StoredFlight flight = stored_flight(possible_trial(database, listing.key), planners);
      const CauseFound explanation{.cause = *enum_from_text<Cause>(row.cause),
                                   .facts = facts_from_json(row.facts_json)};
      write_moment(flight, fleet, title_line(listing) + ", " + row.cause,
                   decisive_s(explanation, flight.stored.row.record.end_time_s), options.png);
    }
  } else {
    show_all(failures, all, stored, options);
  }
  if (run.unflown > 0) throw CLI::RuntimeError(kExplainUnflown);
}

}  // namespace avoidbench
