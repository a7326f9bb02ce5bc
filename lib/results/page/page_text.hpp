#pragma once

#include <cstddef>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>

namespace avoidbench {

/// The program of a page, made by apps/page: what stands before a page's data and behind it.
struct PageProgram {
  std::string_view head;  ///< up to the title's text
  std::string_view body;  ///< from the title's end to the beginning of the data
  std::string_view tail;  ///< from the end of the data
};

/// Text for between two tags: & < > and quotes as entities.
std::string html_text(std::string_view text);

/// JSON that no browser takes for markup: < > & and the separators of lines as escapes. Bytes that
/// are no UTF-8 are replaced.
std::string script_safe(const nlohmann::ordered_json& json);

/// How much room a part of the data takes in the file, bytes.
std::size_t size_in_page(const nlohmann::ordered_json& json);

/// The whole file.
std::string page_text(const PageProgram& program, std::string_view title,
                      const nlohmann::ordered_json& data);

}  // namespace avoidbench
