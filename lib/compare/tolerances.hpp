#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "compare/compare.hpp"

namespace avoidbench {

/// `5%` or `0.05` of the base's mean: what --min-effect takes. Throws InputError.
Tolerance min_effect_from(std::string_view text);

/// Reads a file of tolerances into `settings`: a mapping of metrics (success_rate, those in
/// `metrics`, or `default`) to a share of the base's mean (`10%`), a number in the metric's unit,
/// or `ignore`. Throws InputError with every problem at its place.
void read_tolerances(const std::filesystem::path& file, const std::vector<std::string>& metrics,
                     CompareSettings& settings);

}  // namespace avoidbench
