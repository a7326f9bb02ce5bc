#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "base/enum_text.hpp"
#include "yaml/yaml_tree.hpp"

namespace avoidbench {

/// The maps of a suite: to tune on, to be quoted, and those whose key is kept back.
enum class Split { dev, open, sealed };
template <>
struct EnumText<Split> {
  static constexpr std::pair<Split, std::string_view> entries[] = {
      {Split::dev, "dev"}, {Split::open, "public"}, {Split::sealed, "sealed"}};
};

/// What must not change of a split's maps; empty for `sealed`, whose maps nobody knows.
struct FrozenMaps {
  std::string maps_sha256, missions_sha256;
};

/// One sweep of a cell: a file of the same name for each track that has it.
struct SuiteSweep {
  std::string name;                      ///< of the sweep: forest_5.0
  std::int64_t map_count = 0;            ///< in each split
  std::vector<std::string> file_sha256;  ///< one a track; "" where the track is without it
  FrozenMaps dev, open;                  ///< the same for all tracks
};

/// Missions that are scored together.
struct SuiteCell {
  std::string name;
  std::vector<SuiteSweep> sweeps;
};

/// The seeds of a split whose maps are known: missions are drawn from `seed`, map i of a sweep from
/// first_map_seed + i.
struct SplitSeeds {
  std::uint64_t seed = 0, first_map_seed = 0;
  std::int64_t missions = 0;  ///< a map
};

/// A frozen suite: FOLDER/suite.yaml, and FOLDER/TRACK/SWEEP.yaml of each track and sweep.
struct SuiteSpec {
  std::string name;
  std::filesystem::path folder;
  std::vector<std::string> tracks, track_docs;
  SplitSeeds dev, open;
  std::int64_t sealed_missions = 0;
  std::string sealed_key_sha256;  ///< of the key's 64 digits
  std::vector<SuiteCell> cells;
};

/// Throws InputError, with the place of all that is wrong.
SuiteSpec read_suite(const std::filesystem::path& folder);

/// The suites that come with the program, by name.
std::vector<SuiteSpec> built_in_suites();

/// One track of a suite.
struct SuiteTrack {
  SuiteSpec suite;  ///< with the cells and sweeps of this track alone
  std::string track;
  std::string sha256;  ///< of all that is frozen for the track: other tracks may come later
};

/// `track` has to be one of the suite's.
SuiteTrack track_of(const SuiteSpec& suite, const std::string& track);

/// What "avoidbench-1/depth", or "FOLDER/depth" for a suite of one's own, names. Throws InputError
/// with what there is.
SuiteTrack suite_track(const std::string& given);

/// A key of sealed maps: 64 hexadecimal digits, as the file has them, blanks and line ends around
/// them left out. Throws InputError where the file holds something else, or another key than the
/// suite's.
std::string read_suite_key(const std::filesystem::path& file, const SuiteSpec& suite);

/// The seeds with which a split flies a sweep.
struct SweepSeeds {
  std::uint64_t seed = 0;
  std::vector<std::uint64_t> map_seeds;
  std::int64_t missions = 0;  ///< a map
};

/// `key` is that of `sealed`, "" for others. Sealed seeds are the first 52 bits of HMAC-SHA256 with
/// the key's digits of "CELL/SWEEP/map/INDEX", and of "CELL/SWEEP/missions".
SweepSeeds seeds_of(const SuiteSpec& suite, const SuiteCell& cell, const SuiteSweep& sweep,
                    Split split, const std::string& key);

/// The frozen file of a sweep. Throws InputError where it is not the one that was frozen.
std::filesystem::path frozen_file(const SuiteTrack& chosen, const SuiteSweep& sweep);

}  // namespace avoidbench
