#pragma once

#include <string>

#include "page/page.hpp"

namespace avoidbench {

/// Throws InputError if the file can't be written. For before any work.
void check_page(const std::string& file);

/// What made a page, with the command that asked for it.
PageOrigin page_origin();

/// Writes the page and says so on stderr.
void write_page(const nlohmann::ordered_json& data, const std::string& file);

}  // namespace avoidbench
