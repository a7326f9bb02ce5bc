#include "export/trial_list.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "base/option_error.hpp"
#include "report/table_rows.hpp"
#include "table/table_text.hpp"
#include "text/number_text.hpp"
#include "text/visible_text.hpp"
#include "text/words.hpp"

namespace avoidbench {
namespace {

std::string radius_text(const TrialListing& trial) {
  return std::isnan(trial.poisson_radius_m) ? "" : shortest(trial.poisson_radius_m);
}

/// The ids of some trials: "3, 7, 12, …".
std::string ids_of(const std::vector<TrialListing>& trials) {
  constexpr std::size_t kMost = 8;
  std::string ids;
  for (std::size_t i = 0; i < std::min(kMost, trials.size()); ++i) {
    ids += (i == 0 ? "" : ", ") + std::to_string(trials[i].id);
  }
  return ids + (trials.size() > kMost ? ", …" : "");
}

bool is_number(const std::string& text) {
  return !text.empty() && text.size() < 10 &&
         std::all_of(text.begin(), text.end(), [](char c) { return c >= '0' && c <= '9'; });
}

/// The program says how to list what there is.
[[noreturn]] void fail(const std::string& message) { throw OptionError(message, "", "list"); }

[[noreturn]] void throw_no_trial(std::vector<TrialListing> all, const std::string& trial) {
  if (!is_number(trial)) {
    fail("no trial whose key begins with '" + trial +
         "'; a trial is named by its id or the beginning of its key");
  }
  const std::int64_t wanted = std::atoll(trial.c_str());
  std::stable_sort(all.begin(), all.end(), [&](const TrialListing& a, const TrialListing& b) {
    return std::abs(a.id - wanted) < std::abs(b.id - wanted);
  });
  all.resize(std::min<std::size_t>(3, all.size()));
  fail("no trial " + trial + "; the nearest ids are " + ids_of(all));
}

/// The trials of this id, or with this beginning of their key.
std::vector<TrialListing> named(const std::vector<TrialListing>& all, const std::string& trial) {
  std::vector<TrialListing> found;
  for (const TrialListing& one : all) {
    if (is_number(trial) && one.id == std::atoll(trial.c_str())) return {one};
  }
  for (const TrialListing& one : all) {
    if (trial.size() >= 4 && one.key.starts_with(trial)) found.push_back(one);
  }
  if (found.empty()) throw_no_trial(all, trial);
  return found;
}

/// Throws where a word that was given stands in no trial.
void check_word(const std::string& option, const std::string& word,
                const std::vector<std::string>& known) {
  if (word.empty() || std::find(known.begin(), known.end(), word) != known.end()) return;
  throw OptionError(
      word + ": no trial has it" + did_you_mean(word, known) + "; there are: " + joined(known),
      option);
}

std::vector<std::string> sorted_unique(std::vector<std::string> words) {
  std::sort(words.begin(), words.end());
  words.erase(std::unique(words.begin(), words.end()), words.end());
  return words;
}

}  // namespace

std::vector<TrialListing> chosen_trials(const std::vector<TrialListing>& all,
                                        const TrialChoice& choice) {
  std::vector<std::string> planners, outcomes;
  for (const TrialListing& one : all) {
    planners.push_back(one.planner_label);
    outcomes.emplace_back(text(one.outcome));
  }
  check_word("planner", choice.planner, sorted_unique(planners));
  check_word("outcome", choice.outcome, sorted_unique(outcomes));
  std::vector<TrialListing> chosen = choice.trial.empty() ? all : named(all, choice.trial);
  std::erase_if(chosen, [&](const TrialListing& one) {
    const bool is_meant =
        (choice.planner.empty() || one.planner_label == choice.planner) &&
        (choice.outcome.empty() || text(one.outcome) == choice.outcome) &&
        (!choice.map_seed || one.map_seed == *choice.map_seed) &&
        (!choice.mission || one.mission_index == *choice.mission) &&
        (!choice.radius_m || std::abs(one.poisson_radius_m - *choice.radius_m) < 1e-6);
    return !is_meant;
  });
  return chosen;
}

TrialListing the_trial(const std::vector<TrialListing>& all, const TrialChoice& choice) {
  const std::vector<TrialListing> chosen = chosen_trials(all, choice);
  if (chosen.size() == 1) return chosen.front();
  if (chosen.empty()) fail("no trial matches");
  fail(std::to_string(chosen.size()) + " trials match (ids " + ids_of(chosen) + "): name one");
}

Table trial_table(const std::vector<TrialListing>& trials, bool is_for_people) {
  constexpr std::size_t kMostLetters = 16;
  const Place words = Place::words;
  Table table = make_table("trials", "",
                           {{.name = "id"},
                            {.name = "planner", .place = words},
                            {.name = "map", .place = words},
                            {.name = "seed"},
                            {.name = "radius_m"},
                            {.name = "mission"},
                            {.name = "outcome", .place = words},
                            {.name = "end_s", .decimals = 2},
                            {.name = "reason", .place = words}});
  if (!is_for_people) {
    table.columns.insert(table.columns.begin() + 1, {.name = "trial_key", .place = words});
  }
  for (const TrialListing& one : trials) {
    Row row = make_row(one.id);
    if (!is_for_people) append(row, one.key);
    append(row, is_for_people ? cut_to_width(one.planner_label, kMostLetters) : one.planner_label);
    append(row, make_row(one.generator, one.map_seed, one.poisson_radius_m, one.mission_index,
                         text(one.outcome), one.end_time_s, one.reason));
    table.rows.push_back(std::move(row));
  }
  return table;
}

std::string trial_text(const TrialListing& trial) {
  const std::string radius = radius_text(trial);
  return visible_line(trial.planner_label + ", " + trial.generator + " seed " +
                      std::to_string(trial.map_seed) +
                      (radius.empty() ? "" : ", radius " + radius + " m") + ", mission " +
                      std::to_string(trial.mission_index));
}

}  // namespace avoidbench
