#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <string_view>

namespace avoidbench {

/// Why a stored text is not what it should be, in a few words.
struct BadText : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Throws InputError: "FILE: damaged: table TABLE, row KEY: what".
[[noreturn]] void throw_damaged(const std::filesystem::path& path, std::string_view table,
                                std::string_view key, std::string_view what);

bool is_utf8(std::string_view text);

/// The text with U+FFFD for each byte that is no part of UTF-8.
std::string as_utf8(std::string_view text);

/// The JSON object of a stored text. Throws BadText where it is none or is nested deeper than any
/// spec, so that who copies it needs little stack.
nlohmann::json stored_object(const std::string& text);

/// A sweep's spec, as stored_object(). What it says of axes, planners, trials and the rule to stop
/// has the types that readers count on, and a sweep has less than 10^15 trials. Parts may lack.
nlohmann::json stored_sweep(const std::string& text);

}  // namespace avoidbench
