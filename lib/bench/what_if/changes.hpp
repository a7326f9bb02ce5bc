#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "plugin/planner_description.hpp"
#include "trial/flight_change.hpp"
#include "trial/trial_record.hpp"
#include "trial/trial_spec.hpp"

/// What a trial can be flown again with: exactly one thing otherwise, and all else as it was, to
/// the bit, since each source of noise draws from a stream of its own.
namespace avoidbench {

/// A trial as it is to be flown.
struct ChangedTrial {
  TrialSpec spec;
  FlightChange flight = {};
};

/// What a change may look at.
struct FlownTrial {
  const TrialRecord& record;  ///< as it was flown
  const PlannerDescription& planner;
  std::uint32_t needs = planner.needs;  ///< of it and of its filter
};

/// One thing that can be changed.
struct Change {
  std::string_view name;    ///< true_depth
  std::string_view phrase;  ///< "with true depth": in a sentence
  std::string_view doc;     ///< a line for help
  /// Changes the trial. Why it would change nothing for this one, or can't be had: then it is not
  /// flown; "": it is changed.
  std::string (*apply)(const FlownTrial& flown, ChangedTrial& trial);
};

/// All, in the order of tables. The first changes nothing.
std::span<const Change> changes();
inline constexpr std::string_view kNoChange = "nothing";

/// Those of these names, each once, in the order of changes(); "all" is all but the first. Throws
/// OptionError ("what-if") for an unknown one, with a suggestion.
std::vector<const Change*> changes_of(const std::vector<std::string>& names);

}  // namespace avoidbench
