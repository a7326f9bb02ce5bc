#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "report/selection.hpp"
#include "store/database.hpp"
#include "store/rows.hpp"
#include "table/table.hpp"

namespace avoidbench {

/// Which trials of a database are meant; what is not given holds for all.
struct TrialChoice {
  std::string trial = {};  ///< an id, or the beginning of a key
  std::string planner = {}, outcome = {};
  std::optional<std::uint64_t> map_seed = {};
  std::optional<std::int64_t> mission = {};
  std::vector<Condition> where = {};  ///< all of them hold
};

/// Those of `all` that are meant. `fields` are the names of theirs, with those of the conditions.
/// Throws InputError, with what there is, where a planner, an outcome or a condition's value is of
/// none of them, or no trial has this id or key.
std::vector<TrialListing> chosen_trials(const std::vector<TrialListing>& all,
                                        const TrialChoice& choice,
                                        const std::vector<std::string>& fields = {});

/// The one trial that is meant. Throws InputError, naming some, where there is not exactly one.
TrialListing the_trial(const std::vector<TrialListing>& all, const TrialChoice& choice);
/// The same of trials that were chosen before.
TrialListing the_one_of(const std::vector<TrialListing>& chosen);

/// Which trials of many are listed or exported, and in which order.
struct TrialOrder {
  std::string field = {};            ///< a metric or another field of trials; "": as they are
  std::optional<std::size_t> limit;  ///< at most so many, the first ones
};

/// The places of `values` in order: of a metric the worst first (where more is better the least),
/// of other fields the least first; what has no value last; of equals as they are.
std::vector<std::size_t> worst_first(const std::vector<TableValue>& values, Better better);

/// Of a metric what is better; Better::more for other fields, so that the least comes first.
Better better_of(const std::string& field, const std::vector<MetricRow>& metrics);

/// The fields that a list of trials needs: what the database's sweeps vary, and what it is sorted
/// and chosen by; for Database::list_trials().
std::vector<std::string> listed_fields(const Database& database, const TrialOrder& order = {},
                                       const std::vector<Condition>& where = {});

/// The database's trials with these fields. Throws InputError where a condition's field is a path
/// at which none of them has a value.
std::vector<TrialListing> listed_trials(const Database& database,
                                        const std::vector<std::string>& fields,
                                        const std::vector<Condition>& where);

/// The trials in this order, at most as many as it says. `fields` are those of the trials, with
/// that of the order.
std::vector<TrialListing> in_order(std::vector<TrialListing> trials, const TrialOrder& order,
                                   const std::vector<std::string>& fields,
                                   const std::vector<MetricRow>& metrics);

/// With a column per field. For machines with keys, start and goal; for people within 100 columns,
/// without start and goal if they don't fit.
Table trial_table(const std::vector<TrialListing>& trials, const std::vector<std::string>& fields,
                  bool is_for_people);

/// "reactive, forest seed 1, poisson_radius_m 3.5, mission 2": with what its sweep varies, if the
/// trial was listed with these fields.
std::string trial_text(const TrialListing& trial);

}  // namespace avoidbench
