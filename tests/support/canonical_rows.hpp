#pragma once

#include <string>

#include "store/database.hpp"

namespace avoidbench::test {

/// Every deterministic value of the database as text, one row a line, in an order that does not
/// depend on insertion: equal sweeps give equal texts on every machine. Trajectories and plan calls
/// stand as their digests. Left out are runs, attempts, measured metrics, and the specs, which may
/// name paths (the keys are their digests).
std::string canonical_rows(const Database& database);

}  // namespace avoidbench::test
