#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "page/page.hpp"

namespace avoidbench {

/// Throws InputError if the file can't be written. For before any work.
void check_page(const std::string& file);

/// What made a page, with the command that asked for it.
PageOrigin page_origin();

/// Writes the page and says so on stderr.
void write_page(const nlohmann::ordered_json& data, const std::string& file);

/// Writes the page at once, without a word: whoever opens the file has the former page or all of
/// this one. Throws InputError where it can't be written.
void replace_page(const nlohmann::ordered_json& data, const std::filesystem::path& file);

/// Says on stderr that the page is there, and what it lacks.
void say_written(const nlohmann::ordered_json& data, const std::filesystem::path& file);

/// The data of the page of one sweep in a database, `sweep` as NAME or NAME@REVISION, and of the
/// `run` that flies it.
nlohmann::ordered_json page_of_run(const std::string& database, const std::string& sweep,
                                   const PageOrigin& origin, nlohmann::ordered_json run);

/// How much room a page of so many trials has for its data beside its program, bytes: of
/// `limit_mb`, or of what is usual.
std::size_t page_room(std::optional<double> limit_mb, std::size_t trial_count);

}  // namespace avoidbench
