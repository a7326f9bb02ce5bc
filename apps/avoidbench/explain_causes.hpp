#pragma once

#include "explain_options.hpp"

namespace avoidbench {

/// Tells the causes of failures, and stores them: of one trial with its numbers and a picture, of
/// all as a table.
void explain_causes(const ExplainOptions& options);

}  // namespace avoidbench
