#pragma once

#include <filesystem>
#include <optional>
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

/// What `avoidbench limit` is asked for.
struct LimitRequest {
  std::string over;  ///< "max_speed_mps=1..10", "wind.mean_world_mps[0]=0..10"
  double success_rate = 0.9;
  double reach_mps = 0.0;       ///< see LimitRule
  std::optional<double> width;  ///< of the interval, in units of the field; a tenth of the range
  std::int64_t most_trials = 400;
  bool is_paired = false;
  LimitDirection direction = LimitDirection::unknown;  ///< of success along the range
};

/// The sweep with values of one field over a range, and the rule by which a few of its trials are
/// flown. Its name gets `_limit_FIELD`, since its trials are no sample of one setting. Throws
/// InputError as read_sweep() does, and where the field is no number or the range is none.
SweepSpec read_limit_sweep(const std::filesystem::path& file,
                           const std::vector<std::string>& overrides, const LimitRequest& request);

}  // namespace avoidbench
