#include "trial_list.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "base/input_error.hpp"
#include "text/number_text.hpp"
#include "text/visible_text.hpp"

namespace avoidbench {
namespace {

std::string radius_text(const TrialListing& trial) {
  return std::isnan(trial.poisson_radius_m) ? "" : shortest(trial.poisson_radius_m);
}

std::string end_text(const TrialListing& trial) {
  if (std::isnan(trial.end_time_s)) return "";
  return fixed_digits(trial.end_time_s, 2);
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

[[noreturn]] void throw_no_trial(std::vector<TrialListing> all, const std::string& trial) {
  if (!is_number(trial)) {
    throw InputError("no trial whose key begins with '" + trial +
                     "'; a trial is named by its id or the beginning of its key: see --list");
  }
  const std::int64_t wanted = std::atoll(trial.c_str());
  std::stable_sort(all.begin(), all.end(), [&](const TrialListing& a, const TrialListing& b) {
    return std::abs(a.id - wanted) < std::abs(b.id - wanted);
  });
  all.resize(std::min<std::size_t>(3, all.size()));
  throw InputError("no trial " + trial + "; the nearest ids are " + ids_of(all) + ": see --list");
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
  std::string all;
  for (const std::string& one : known) all += (all.empty() ? "" : ", ") + one;
  throw InputError(option + " " + word + ": no trial has it" + did_you_mean(word, known) +
                   "; there are: " + all);
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
  check_word("--planner", choice.planner, sorted_unique(planners));
  check_word("--outcome", choice.outcome, sorted_unique(outcomes));
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
  if (chosen.empty()) throw InputError("no trial matches: --list shows what there is");
  throw InputError(std::to_string(chosen.size()) + " trials match (ids " + ids_of(chosen) +
                   "): name one, or see --list");
}

ReferenceTable trial_table(const std::vector<TrialListing>& trials, const std::string& format) {
  const bool is_for_people = format == "table";
  ReferenceTable table{
      {"id", "planner", "map", "seed", "radius_m", "mission", "outcome", "end_s", "reason"}, {}};
  if (!is_for_people) table.columns.insert(table.columns.begin() + 1, "trial_key");
  for (const TrialListing& one : trials) {
    std::string label = one.planner_label;
    if (is_for_people && label.size() > 16) label = label.substr(0, 15) + "~";
    std::vector<std::string> row{std::to_string(one.id),
                                 label,
                                 one.generator,
                                 std::to_string(one.map_seed),
                                 radius_text(one),
                                 std::to_string(one.mission_index),
                                 std::string(text(one.outcome)),
                                 end_text(one),
                                 one.reason};
    if (!is_for_people) row.insert(row.begin() + 1, one.key);
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
