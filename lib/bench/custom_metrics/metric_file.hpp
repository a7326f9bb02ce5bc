#pragma once

#include <filesystem>

#include "custom_metrics/computed_metrics.hpp"

namespace avoidbench {

/// The metrics that a file of the user's computes from the finished trials of `database`:
/// - NAME.sql: a SELECT (see query_metrics());
/// - NAME.py: each public function is a metric; it takes a flight (scripts/custom_metrics.py) and
///   returns a number or None. Run by a Python of the machine that has NumPy.
/// Their description and source name the file and its digest. Throws InputError with the file's
/// name.
ComputedMetrics computed_by(const std::filesystem::path& file, const Database& database);

}  // namespace avoidbench
