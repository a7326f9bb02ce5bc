#include "export/trial_list.hpp"

#include <algorithm>
#include <cstdlib>
#include <numeric>
#include <set>

#include "base/check.hpp"
#include "base/json_path.hpp"
#include "base/number_text.hpp"
#include "base/option_error.hpp"
#include "base/visible_text.hpp"
#include "base/words.hpp"
#include "report/table_rows.hpp"
#include "store/trial_fields.hpp"
#include "table/table_text.hpp"

namespace avoidbench {
namespace {

/// The ids of some trials: "3, 7, 12, …".
std::string ids_of(const std::vector<TrialListing>& trials) {
  constexpr std::size_t kMost = 8;
  std::string ids;
  for (std::size_t i = 0; i < std::min(kMost, trials.size()); ++i) {
    ids += (i == 0 ? "" : ", ") + std::to_string(trials[i].id);
  }
  return ids + (trials.size() > kMost ? ", …" : "");
}

/// Up to nine digits, so that it fits an id; longer ones are beginnings of keys.
bool is_number(const std::string& text) {
  return !text.empty() && text.size() < 10 &&
         std::all_of(text.begin(), text.end(), [](char c) { return c >= '0' && c <= '9'; });
}

/// The program says how to list what there is.
[[noreturn]] void fail(const std::string& message) { throw OptionError(message, "", "list"); }

/// Of a number that is no id, the nearest ones are offered.
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
    // An id wins: a key may begin with digits too, and is then given with more of them.
    if (is_number(trial) && one.id == std::atoll(trial.c_str())) return {one};
  }
  for (const TrialListing& one : all) {
    // Shorter beginnings would fit too many keys.
    if (trial.size() >= 4 && one.key.starts_with(trial)) found.push_back(one);
  }
  if (found.empty()) throw_no_trial(all, trial);
  return found;
}

/// Throws where a word that was given stands in no trial.
void check_word(const std::string& option, const std::string& word,
                const std::vector<std::string>& known) {
  if (word.empty() || contains(known, word)) return;
  throw OptionError(
      word + ": no trial has it" + did_you_mean(word, known) + "; there are: " + joined(known),
      option);
}

/// "2,1 → 38,12": start and goal in plan, whole metres.
std::string way_text(const Mission& mission) {
  if (mission.start_world.hasNaN() || mission.goal_world.hasNaN()) return "";
  const auto place = [](const Eigen::Vector3d& place_m) {
    return fixed_digits(place_m.x(), 0) + "," + fixed_digits(place_m.y(), 0);
  };
  return place(mission.start_world) + " → " + place(mission.goal_world);
}

/// The fields whose values the list shows by itself.
bool is_of_list(const std::string& field) {
  constexpr std::string_view kOwn[] = {"planner",    "generator", kSeedField, "mission_index",
                                       "end_time_s", "outcome",   "reason"};
  return contains(kOwn, field);
}

/// People see start and goal as one text, programs each coordinate.
std::vector<Column> trial_columns(const std::vector<std::string>& fields, bool is_for_people) {
  const Place words = Place::words;
  std::vector<Column> columns{{.name = "id"}};
  if (!is_for_people) columns.push_back({.name = "trial_key", .place = words});
  columns.insert(
      columns.end(),
      {{.name = "planner", .place = words}, {.name = "map", .place = words}, {.name = "seed"}});
  for (const std::string& field : fields) {
    if (is_of_list(field)) continue;
    columns.push_back({.name = field, .header = short_name(field, fields)});
  }
  columns.push_back({.name = "mission"});
  if (is_for_people) {
    columns.push_back({.name = "way", .header = "from → to, m", .place = words});
  } else {
    for (const char* name :
         {"start_x_m", "start_y_m", "start_z_m", "goal_x_m", "goal_y_m", "goal_z_m"}) {
      columns.push_back({.name = name});
    }
  }
  columns.insert(columns.end(), {{.name = "outcome", .place = words},
                                 {.name = "end_s", .decimals = 2},
                                 {.name = "reason", .place = words}});
  return columns;
}

/// NaN is none.
bool has_value(const TableValue& value) {
  const auto* number = std::get_if<double>(&value);
  return !std::holds_alternative<std::monostate>(value) &&
         (number == nullptr || *number == *number);
}

/// Whole numbers and others have one order.
bool is_less(const TableValue& a, const TableValue& b) {
  const std::optional<double> number_a = number_in(a), number_b = number_in(b);
  if (a.index() != b.index() && number_a && number_b) return *number_a < *number_b;
  // Of two texts, or by the kind of value where they have nothing in common.
  return a < b;
}

bool is_constant(const Table& table, std::size_t at) {
  return std::all_of(table.rows.begin(), table.rows.end(),
                     [&](const Row& row) { return row[at].value == table.rows.front()[at].value; });
}

/// Leaves out what can be missed until a reason of 30 columns fits on a line of 100: what is the
/// same for all trials, then start and goal.
void fit(Table& table, const std::vector<std::string>& fields) {
  constexpr std::size_t kMost = 70, kGap = 2;
  const auto is_too_wide = [&] {
    std::size_t width = 0;
    for (const TextColumn& column : text_columns(table)) width += column.width + kGap;
    // Without the last column, the reason, which is wrapped.
    return width - text_columns(table).back().width - kGap > kMost;
  };
  std::vector<std::string> names{"map"};
  names.insert(names.end(), fields.begin(), fields.end());
  // One after the other, and only as long as it is too wide.
  for (const std::string& name : names) {
    const std::size_t at = column_at(table, name);
    const bool can_go = at < table.columns.size() && table.rows.size() > 1;
    if (can_go && is_too_wide() && is_constant(table, at)) drop_column(table, at);
  }
  if (is_too_wide()) drop_column(table, column_at(table, "way"));
}

}  // namespace

std::vector<TrialListing> chosen_trials(const std::vector<TrialListing>& all,
                                        const TrialChoice& choice,
                                        const std::vector<std::string>& fields) {
  std::set<std::string> planners, outcomes;
  for (const TrialListing& one : all) {
    planners.insert(one.planner_label);
    outcomes.emplace(text(one.outcome));
  }
  check_word("planner", choice.planner, {planners.begin(), planners.end()});
  check_word("outcome", choice.outcome, {outcomes.begin(), outcomes.end()});
  std::vector<TrialListing> chosen = choice.trial.empty() ? all : named(all, choice.trial);
  std::erase_if(chosen, [&](const TrialListing& one) {
    const bool is_meant = (choice.planner.empty() || one.planner_label == choice.planner) &&
                          (choice.outcome.empty() || text(one.outcome) == choice.outcome) &&
                          (!choice.map_seed || one.map_seed == *choice.map_seed) &&
                          (!choice.mission || one.mission_index == *choice.mission);
    return !is_meant;
  });
  for (const Condition& condition : choice.where) {
    const std::size_t field = place_of(condition.field, fields);
    std::set<TableValue> there;
    for (const TrialListing& one : all) there.insert(one.fields[field]);
    check_values(condition, there);
    std::erase_if(chosen,
                  [&](const TrialListing& one) { return !holds(condition, one.fields[field]); });
  }
  return chosen;
}

TrialListing the_trial(const std::vector<TrialListing>& all, const TrialChoice& choice) {
  return the_one_of(chosen_trials(all, choice));
}

TrialListing the_one_of(const std::vector<TrialListing>& chosen) {
  if (chosen.size() == 1) return chosen.front();
  if (chosen.empty()) fail("no trial matches");
  fail(std::to_string(chosen.size()) + " trials match (ids " + ids_of(chosen) + "): name one");
}

std::vector<std::string> listed_fields(const Database& database, const TrialOrder& order,
                                       const std::vector<Condition>& where) {
  std::vector<std::string> fields = axis_fields(database.read_sweeps());
  const auto add = [&](const std::string& field) {
    if (!field.empty() && !contains(fields, field)) fields.push_back(field);
  };
  // What trials are sorted and chosen by is shown.
  add(order.field);
  for (const Condition& condition : where) add(condition.field);
  return fields;
}

std::vector<TrialListing> listed_trials(const Database& database,
                                        const std::vector<std::string>& fields,
                                        const std::vector<Condition>& where) {
  std::vector<TrialListing> trials = database.list_trials(fields);
  for (const Condition& condition : where) {
    refuse_empty_field(database, trials, place_of(condition.field, fields), condition.field);
  }
  return trials;
}

std::vector<std::size_t> worst_first(const std::vector<TableValue>& values, Better better) {
  std::vector<std::size_t> places(values.size());
  std::iota(places.begin(), places.end(), std::size_t{0});
  // Stable: equal values stay in the order of the table. What has no value comes last, since
  // nothing is known of it.
  std::stable_sort(places.begin(), places.end(), [&](std::size_t a, std::size_t b) {
    if (!has_value(values[a]) || !has_value(values[b])) {
      return has_value(values[a]) && !has_value(values[b]);
    }
    return better == Better::more ? is_less(values[a], values[b]) : is_less(values[b], values[a]);
  });
  return places;
}

/// A field that is no metric is sorted as if more were better: from its least value up.
Better better_of(const std::string& field, const std::vector<MetricRow>& metrics) {
  const auto metric = place_in(metrics, field, &MetricRow::name);
  return metric ? metrics[*metric].better : Better::more;
}

std::vector<TrialListing> in_order(std::vector<TrialListing> trials, const TrialOrder& order,
                                   const std::vector<std::string>& fields,
                                   const std::vector<MetricRow>& metrics) {
  if (!order.field.empty()) {
    const std::size_t at = place_of(order.field, fields);
    std::vector<TableValue> values;
    for (const TrialListing& one : trials) values.push_back(one.fields[at]);
    std::vector<TrialListing> sorted;
    for (const std::size_t place : worst_first(values, better_of(order.field, metrics))) {
      sorted.push_back(std::move(trials[place]));
    }
    trials = std::move(sorted);
  }
  if (order.limit && trials.size() > *order.limit) trials.resize(*order.limit);
  return trials;
}

Table trial_table(const std::vector<TrialListing>& trials, const std::vector<std::string>& fields,
                  bool is_for_people) {
  constexpr std::size_t kMostLetters = 16;
  std::vector<std::string> labels;
  for (const TrialListing& one : trials) labels.push_back(one.planner_label);
  // Short for people; labels that differ stay different.
  if (is_for_people) labels = cut_apart(labels, kMostLetters);
  Table table = make_table("trials", "", trial_columns(fields, is_for_people));
  for (std::size_t i = 0; i < trials.size(); ++i) {
    const TrialListing& one = trials[i];
    Row row = make_row(one.id);
    if (!is_for_people) append(row, one.key);
    append(row, make_row(labels[i], one.generator, one.map_seed));
    for (std::size_t k = 0; k < fields.size(); ++k) {
      if (!is_of_list(fields[k])) append(row, Cell{.value = one.fields[k]});
    }
    append(row, one.mission_index);
    if (is_for_people) {
      append(row, way_text(one.mission));
    } else {
      for (const Eigen::Vector3d& place : {one.mission.start_world, one.mission.goal_world}) {
        append(row, make_row(place.x(), place.y(), place.z()));
      }
    }
    append(row, make_row(text(one.outcome), one.end_time_s, one.reason));
    table.rows.push_back(std::move(row));
  }
  if (is_for_people) fit(table, fields);
  return table;
}

std::string trial_text(const TrialListing& trial) {
  return visible_line(trial.planner_label + ", " + trial.generator + " seed " +
                      std::to_string(trial.map_seed) +
                      (trial.setting.empty() ? "" : ", " + trial.setting) + ", mission " +
                      std::to_string(trial.mission_index));
}

}  // namespace avoidbench
