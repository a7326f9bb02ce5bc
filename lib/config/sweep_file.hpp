#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "sweep/sweep_spec.hpp"
#include "yaml/includes.hpp"

namespace avoidbench {

/// The sweep in the YAML file, or the built-in sweep of this name ("quick"), with those that it
/// includes, with the command line's `--set path=value` options applied. Every planner is found,
/// loaded and its parameters resolved. Throws InputError with all that is wrong at once, each with
/// its place; defaults_yaml("sweep") shows the format.
/// "-" is standard input.
SweepSpec read_sweep(const std::filesystem::path& file,
                     const std::vector<std::string>& overrides = {});

/// The document that read_sweep reads, with includes and overrides put in, and the sweep of it: for
/// those who want both, since a pipe can be read once.
Document read_sweep_document(const std::filesystem::path& file,
                             const std::vector<std::string>& overrides = {});
SweepSpec sweep_of_document(const Document& document);

/// The same for a sweep that is in no file: `name` stands for it in problems.
SweepSpec sweep_of_text(const std::string& text, const std::string& name,
                        const std::vector<std::string>& overrides = {});

/// A map alone, as `avoidbench maps` takes it.
struct MapChoice {
  TrialSpec trial;  ///< with the map, its seed, the mission rules and what else was given
  std::vector<ListedMission> missions;  ///< where the sweep lists its own
  std::vector<std::string> warnings;
};

/// The map of a sweep file or of a file with a map's fields alone; or, for the bare name of a
/// generator, that generator's default; or of a built-in sweep. Of several values the first.
/// Overrides may leave out `maps.`. Throws InputError as read_sweep does.
MapChoice read_map(const std::string& given, const std::vector<std::string>& overrides = {});

/// The same of a document that is at hand. Files are found from the places of their names, else
/// from its folder.
MapChoice map_of_document(const Document& document, const std::vector<std::string>& overrides = {});

}  // namespace avoidbench
