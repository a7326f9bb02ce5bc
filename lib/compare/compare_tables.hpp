#pragma once

#include "compare/compare.hpp"
#include "compare/compare_exact.hpp"
#include "table/table.hpp"

namespace avoidbench {

/// Flips, or differences, that people are shown; all are in the JSON.
inline constexpr std::size_t kShownTrials = 20;

/// What a comparison found, for people: verdict in the title, figures, trials that flipped.
Section comparison_section(const Comparison& comparison);
Section comparison_section(const ExactComparison& comparison);

/// The same of exact comparisons for a terminal: a paragraph a trial, since bits take many digits.
std::string exact_text(const ExactComparison& comparison);

}  // namespace avoidbench
