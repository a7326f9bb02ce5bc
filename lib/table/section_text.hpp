#pragma once

// The formats that people read, of one section each; format_sections() is what others call.

#include <string>
#include <utility>
#include <vector>

#include "table/table.hpp"

namespace avoidbench {

std::string terminal_text(const Section& section, const TextStyle& style);
std::string markdown_text(const Section& section);
std::string latex_text(const Section& section);

/// Every column's doc once (in a brief section Column::brief), then the section's notes:
/// ("PO", "path optimality …").
std::vector<std::pair<std::string, std::string>> legend(const Section& section);

/// The section's warnings; of a brief one with several one line of them all, without details.
std::vector<std::string> shown_warnings(const Section& section);

}  // namespace avoidbench
