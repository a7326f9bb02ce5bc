#pragma once

#include "sweep/sweep_spec.hpp"
#include "yaml/yaml_reader.hpp"

namespace avoidbench {

/// Adds a problem for each value that was given and can't mean anything beside the others: a
/// latency's `ms` in mode zero, a goal larger than the free space around it, a flight that is over
/// before the first command. These are no contradictions() of a trial, since it depends on what was
/// given: stored trials, and fields left at their defaults, may have them.
void check_given_values(const YamlNode& root, const SweepSpec& sweep, Reading& reading);

/// Throws them as an InputError, each once: in the order of the main file, then those of other
/// files, one after the other, then those of the command line.
[[noreturn]] void throw_problems(std::vector<InputProblem> problems, const std::string& main_file);

/// Adds a problem unless the key `key` is there and `name`, its value, can be a result set's.
void check_name(const GivenValue& root, const std::string& key, const std::string& name);

/// Whether the free space around starts and goals holds the goal and ends above the floor.
bool fits_free_space(const TrialSpec& trial);

}  // namespace avoidbench
