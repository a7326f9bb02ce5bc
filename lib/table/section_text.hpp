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

/// Every column's doc once, then the section's notes: ("PO", "path optimality …").
std::vector<std::pair<std::string, std::string>> legend(const Section& section);

}  // namespace avoidbench
