#pragma once

#include <string>

#include "replay/replay.hpp"

namespace avoidbench {

/// The names of the columns of legs_csv().
std::string legs_csv_header();

/// The legs of a trial as CSV (RFC 4180), a row each that was begun: where its goal is, when it
/// began and ended, what was flown and what the shortest path has.
std::string legs_csv(const StoredTrial& stored);

}  // namespace avoidbench
