#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "fleet/fleet.hpp"
#include "replay/replay.hpp"
#include "store/database.hpp"
#include "what_if/changes.hpp"

/// Stored trials flown again with one thing changed: which, what became of them.
namespace avoidbench {

/// What is asked of a database's trials.
struct WhatIfRequest {
  std::vector<const Change*> changes;
  std::string trial = {};    ///< key of the only one; "": all that failed, and a control
  std::string planner = {};  ///< label of the only one; "": all
  /// So many successes of each planner are flown, too; nothing: as many as failed.
  std::optional<std::int64_t> control = {};
};

/// A stored trial that is flown again.
struct WhatIfTrial {
  std::int64_t id = 0;
  std::string key, planner_label, map_key;
  Outcome outcome = Outcome::timed_out;
  std::string reason;
  double end_time_s = 0.0;
  std::string record_digest;  ///< of the flight as it is stored; "": it need not come out the same
  bool is_failure() const { return outcome != Outcome::reached_goal; }
};

/// One of them with one change.
struct WhatIfFlight {
  std::size_t trial = 0;  ///< index into WhatIfPlan::trials
  const Change* change = nullptr;
  std::string not_applicable;    ///< why it is not flown; "": it is
  std::optional<WhatIfRow> row;  ///< what became of it, once flown
  bool is_missing() const { return not_applicable.empty() && !row; }
};

/// What is to be flown, and what of it was flown before.
struct WhatIfPlan {
  std::vector<WhatIfTrial> trials;    ///< by planner, then key
  std::vector<WhatIfFlight> flights;  ///< by trial, then in the order of changes()
  std::vector<std::string> warnings;  ///< why flights may differ from the stored ones

  std::size_t missing_count() const;
};

/// Where stored trials and files come from.
struct WhatIfSource {
  /// The trial of this key, checked. Throws InputError.
  std::function<StoredTrial(const Database&, const std::string& key)> read;
  ReplayFiles files;
  std::string program_version;  ///< of what flies
};

/// Chooses the trials: those that did not reach the goal; of those that did, as a control, the
/// first by key, which is as good as random and the same on every machine. Rows of another
/// planner's file than the one that would fly now count as missing. Flies nothing. Throws
/// InputError where a planner can't be had.
WhatIfPlan plan_what_ifs(const Database& database, const WhatIfRequest& request,
                         const WhatIfSource& source);

/// What came of flying.
struct WhatIfRun {
  bool is_stopped = false;
  std::vector<std::string> unflown;  ///< trials whose worker was killed from outside, and how
};

/// Flies what is missing and commits each result as it comes: what was flown before it was stopped
/// or killed is there next time. The rows do not depend on the number of workers. `flown` is told
/// after each. Throws InputError for what stops it as a whole.
WhatIfRun fly_what_ifs(WhatIfPlan& plan, Database& database, const WhatIfSource& source,
                       const FleetOptions& options,
                       const std::function<void(std::size_t done, std::size_t total)>& flown);

}  // namespace avoidbench
