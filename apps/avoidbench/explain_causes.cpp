#include "explain.hpp"

#include <atomic>
#include <cmath>
#include <exception>
#include <iostream>
#include <mutex>
#include <optional>
#include <set>
#include <thread>

#include "base/option_error.hpp"
#include "diagnosis/cause_counts.hpp"
#include "explain/paragraph.hpp"
#include "metrics/metric_table.hpp"
#include "output.hpp"
#include "replay/explained_trial.hpp"
#include "report/sweep_tables.hpp"
#include "report/table_rows.hpp"
#include "store/record_format.hpp"
#include "table/table_text.hpp"
#include "text/visible_text.hpp"
#include "text/words.hpp"
#include "view_output.hpp"
#include "worker/worker_process.hpp"

namespace avoidbench {
namespace {

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

/// Opened for writing, where it can be; what is told is shown in any case.
std::optional<Database> writable(const std::filesystem::path& path) {
  try {
    return Database::open_for_run(path, metric_table());
  } catch (const InputError& error) {
    std::cerr << "warning: causes are not stored: " << error.what() << '\n';
    return std::nullopt;
  }
}

/// Tells the causes of these trials, `jobs` at once, each in a child process; one thread at a time
/// uses the databases. What is stored and current stays.
void tell(const std::vector<TrialListing>& trials, std::size_t jobs, const ReplayFiles& files,
          const Database& database, std::optional<Database>& target, Stored& stored) {
  std::mutex mutex;
  std::atomic<std::size_t> next = 0;
  std::int64_t new_count = 0;
  std::exception_ptr failure;
  const auto tell_one = [&](const TrialListing& trial) {
    std::optional<StoredTrial> read;
    {
      const std::lock_guard lock(mutex);
      read = possible_trial(database, trial.key);
      const auto known = stored.find(trial.key);
      if (known != stored.end() && is_current(known->second, *read)) return;
    }
    const ExplainedTrial told = explain_trial_apart(*read, files);
    const std::lock_guard lock(mutex);
    ++new_count;
    for (const std::string& warning : told.warnings) {
      std::cerr << "warning: trial " << trial.id << ": " << visible_line(warning) << '\n';
    }
    // An explanation that lacks what only a flight tells is shown and not kept.
    const ExplanationRow row = row_of(*read, told.explanation);
    if (target && told.warnings.empty()) target->add_explanation(row);
    stored[trial.key] = row;
    std::cerr << "told " << new_count << " of at most " << trials.size() << ": trial " << trial.id
              << " " << row.cause << '\n';
  };
  const auto work = [&] {
    try {
      for (std::size_t i = next++; i < trials.size(); i = next++) tell_one(trials[i]);
    } catch (...) {
      const std::lock_guard lock(mutex);
      if (!failure) failure = std::current_exception();
      next = trials.size();  // nobody begins another one
    }
  };
  std::vector<std::thread> threads;
  for (std::size_t i = 0; i < std::min(jobs, trials.size()); ++i) threads.emplace_back(work);
  for (std::thread& thread : threads) thread.join();
  if (failure) std::rethrow_exception(failure);
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
void write_moment(const StoredTrial& stored, const ReplayFiles& files, const std::string& title,
                  double at_s, const std::string& png) {
  const Replay replay(stored, files);
  MomentRecorder recorder({at_s}, 0.0, replay.stored().spec);
  TrialObserver observer;
  observer.planned = [&](const PlanStep& step) { recorder.planned(step); };
  std::vector<std::string> log;
  const TrialRecord record = replay.fly(observer, log);
  write_sheets(replay.stored(), replay.world(), record, recorder.finish(record.end_time_s), title,
               png);
}

void show_trial(const Database& database, const TrialListing& listing, const ExplanationRow& row,
                const ReplayFiles& files, const ExplainOptions& options) {
  const StoredTrial stored = possible_trial(database, listing.key);
  const CauseFound explanation{.cause = *enum_from_text<Cause>(row.cause),
                               .facts = facts_from_json(row.facts_json)};
  const std::string title = title_line(listing);
  const std::string sentences =
      visible_line(paragraph(explanation, listing.outcome, listing.reason));
  if (options.output.is_for_people()) {
    constexpr std::size_t kWidth = 100;
    write_text(title + "\n" + cause_text(explanation.cause) + "\n\n" +
                   wrapped(sentences, kWidth, 0) + "\n\n" +
                   format_table(fact_table(explanation.facts), options.output.format),
               options.output.output);
  } else {
    Section section{.name = "explain",
                    .title = title,
                    .tables = {fact_table(explanation.facts)},
                    .notes = {{"cause", cause_text(explanation.cause)}, {"flight", sentences}}};
    write_sections(std::span(&section, 1), options.output);
  }
  if (options.png.empty()) return;
  write_moment(stored, files, title + ", " + row.cause,
               decisive_s(explanation, stored.row.record.end_time_s), options.png);
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
  enter_worker_environment();  // which may begin the program again
  const Database database = Database::open_for_reading(path);
  const std::vector<TrialListing> all = chosen_trials(database.list_trials(), options.choice);
  std::vector<TrialListing> failures = all;
  std::erase_if(failures,
                [](const TrialListing& one) { return one.outcome == Outcome::reached_goal; });
  const bool is_one = !options.choice.trial.empty();
  if (failures.empty()) {
    if (is_one) {
      throw InputError("trial " + options.choice.trial +
                       " reached the goal: there is nothing to explain");
    }
    std::cout << "no failure among " << counted(all.size(), "trial") << '\n';
    return;
  }
  if (!options.png.empty() && !is_one) {
    throw OptionError("a picture is of one trial: give TRIAL", "", "png");
  }
  const ReplayFiles files = files_beside(options.database, database, options.files);
  std::optional<Database> target = writable(path);
  Stored stored;
  for (ExplanationRow& row : database.read_explanations()) stored[row.trial_key] = std::move(row);
  tell(failures, static_cast<std::size_t>(options.job_count()), files, database, target, stored);
  target.reset();
  if (!is_one) return show_all(failures, all, stored, options);
  const TrialListing& listing = failures.front();
  show_trial(database, listing, stored.at(listing.key), files, options);
}

}  // namespace avoidbench
