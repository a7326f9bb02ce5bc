#include "suite/suite_spec.hpp"

#include <algorithm>
#include <cctype>
#include <optional>

#include "base/data_folder.hpp"
#include "base/digest.hpp"
#include "base/input_error.hpp"
#include "base/input_file.hpp"
#include "base/words.hpp"
#include "yaml/yaml_reader.hpp"
#include "yaml/yaml_values.hpp"

namespace avoidbench {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kHexDigits = 64;
constexpr std::uint64_t kMostKeyBytes = 10'000;

bool is_sha256(std::string_view text) {
  return text.size() == kHexDigits &&
         text.find_first_not_of("0123456789abcdef") == std::string_view::npos;
}

/// The value of a key that has to be there.
std::optional<GivenValue> needed(MappingReader& mapping, const GivenValue& block,
                                 std::string_view name) {
  std::optional<GivenValue> given = mapping.take(name);
  if (!given) block.add_problem("lacks '" + std::string(name) + "'");
  return given;
}

std::string needed_text(MappingReader& mapping, const GivenValue& block, std::string_view name) {
  const auto given = needed(mapping, block, name);
  return given ? read_text(*given).value_or("") : "";
}

template <class Whole>
Whole needed_whole(MappingReader& mapping, const GivenValue& block, std::string_view name,
                   Range range) {
  const auto given = needed(mapping, block, name);
  return given ? read_whole<Whole>(*given, range).value_or(Whole{}) : Whole{};
}

std::string sha256_in(const GivenValue& given) {
  const std::string digits = read_text(given).value_or("");
  if (!is_sha256(digits)) given.add_expected("the 64 hexadecimal digits of a SHA-256");
  return digits;
}

std::string needed_sha256(MappingReader& mapping, const GivenValue& block, std::string_view name) {
  const auto given = needed(mapping, block, name);
  return given ? sha256_in(*given) : "";
}

/// The elements of a list that has to be there.
std::vector<GivenValue> needed_list(MappingReader& mapping, const GivenValue& block,
                                    std::string_view name) {
  const auto given = needed(mapping, block, name);
  return given && check_list(*given) ? given->elements() : std::vector<GivenValue>{};
}

/// A name that becomes part of paths.
std::string needed_name(MappingReader& mapping, const GivenValue& block, std::string_view name) {
  const auto given = needed(mapping, block, name);
  if (!given) return "";
  const std::string word = read_text(*given).value_or("");
  if (!is_name(word) || word.starts_with(".")) given->add_expected("a name of A-Z a-z 0-9 _ . -");
  return word;
}

constexpr Range kCounts{1, 10000};

SplitSeeds read_seeds(const GivenValue& given) {
  constexpr Range kSeeds{0, 4503599627370495};
  MappingReader mapping(given);
  SplitSeeds seeds;
  seeds.seed = needed_whole<std::uint64_t>(mapping, given, "seed", kSeeds);
  seeds.first_map_seed = needed_whole<std::uint64_t>(mapping, given, "first_map_seed", kSeeds);
  seeds.missions = needed_whole<std::int64_t>(mapping, given, "missions", kCounts);
  mapping.finish();
  return seeds;
}

FrozenMaps read_frozen(const GivenValue& given) {
  MappingReader mapping(given);
  FrozenMaps frozen;
  frozen.maps_sha256 = needed_sha256(mapping, given, "maps_sha256");
  frozen.missions_sha256 = needed_sha256(mapping, given, "missions_sha256");
  mapping.finish();
  return frozen;
}

SuiteSweep read_suite_sweep(const GivenValue& given, const std::vector<std::string>& tracks) {
  MappingReader mapping(given);
  SuiteSweep sweep;
  sweep.name = needed_name(mapping, given, "sweep");
  sweep.map_count = needed_whole<std::int64_t>(mapping, given, "maps", kCounts);
  if (const auto files = needed(mapping, given, "file_sha256")) {
    MappingReader by_track(*files);
    bool has_any = false;
    for (const std::string& track : tracks) {
      const auto digits = by_track.take(track);
      sweep.file_sha256.push_back(digits ? sha256_in(*digits) : "");
      has_any = has_any || digits;
    }
    if (!has_any) files->add_expected("the SHA-256 of the sweep's file for a track");
    by_track.finish();
  }
  if (const auto dev = needed(mapping, given, "dev")) sweep.dev = read_frozen(*dev);
  if (const auto open = needed(mapping, given, "public")) sweep.open = read_frozen(*open);
  mapping.finish();
  return sweep;
}

SuiteCell read_cell(const GivenValue& given, const std::vector<std::string>& tracks) {
  MappingReader mapping(given);
  SuiteCell cell;
  cell.name = needed_name(mapping, given, "cell");
  for (const GivenValue& sweep : needed_list(mapping, given, "sweeps")) {
    cell.sweeps.push_back(read_suite_sweep(sweep, tracks));
  }
  mapping.finish();
  return cell;
}

void read_splits(const GivenValue& given, SuiteSpec& suite) {
  MappingReader mapping(given);
  if (const auto dev = needed(mapping, given, "dev")) suite.dev = read_seeds(*dev);
  if (const auto open = needed(mapping, given, "public")) suite.open = read_seeds(*open);
  if (const auto sealed = needed(mapping, given, "sealed")) {
    MappingReader keys(*sealed);
    suite.sealed_key_sha256 = needed_sha256(keys, *sealed, "key_sha256");
    suite.sealed_missions = needed_whole<std::int64_t>(keys, *sealed, "missions", kCounts);
    keys.finish();
  }
  mapping.finish();
}

void read_tracks(const GivenValue& given, SuiteSpec& suite) {
  MappingReader mapping(given);
  for (const YamlNode& key : given.node.keys) {
    suite.tracks.push_back(key.scalar);
    suite.track_docs.push_back(needed_text(mapping, given, key.scalar));
    if (is_name(key.scalar)) continue;
    const GivenValue name{key, given.path, given.reading};
    name.add_expected("a name of A-Z a-z 0-9 _ . -");
  }
}

/// The file of a sweep in a track, "" where it has none.
const std::string& file_sha256_in(const SuiteSpec& suite, const SuiteSweep& sweep,
                                  const std::string& track) {
  return sweep.file_sha256.at(place_in(suite.tracks, track).value());
}

/// All that is frozen for a track, as text of one form.
std::string frozen_text(const SuiteSpec& suite, const std::string& track) {
  const auto seeds_text = [](const SplitSeeds& seeds) {
    return std::to_string(seeds.seed) + " " + std::to_string(seeds.first_map_seed) + " " +
           std::to_string(seeds.missions) + "\n";
  };
  std::string text = suite.name + "/" + track + "\n" + seeds_text(suite.dev) +
                     seeds_text(suite.open) + suite.sealed_key_sha256 + " " +
                     std::to_string(suite.sealed_missions) + "\n";
  for (const SuiteCell& cell : suite.cells) {
    for (const SuiteSweep& sweep : cell.sweeps) {
      const std::vector<std::string> words = {cell.name,
                                              sweep.name,
                                              std::to_string(sweep.map_count),
                                              file_sha256_in(suite, sweep, track),
                                              sweep.dev.maps_sha256,
                                              sweep.dev.missions_sha256,
                                              sweep.open.maps_sha256,
                                              sweep.open.missions_sha256};
      text += joined(words, " ") + "\n";
    }
  }
  return text;
}

std::uint64_t sealed_seed(const std::string& key, const std::string& message) {
  // 52 bits: whole in a double, which is what JSON's readers have.
  constexpr std::size_t kDigits = 13;
  return std::stoull(hmac_sha256(key, message).substr(0, kDigits), nullptr, 16);
}

}  // namespace

SuiteSpec read_suite(const fs::path& folder) {
  const fs::path file = folder / "suite.yaml";
  const YamlNode root = read_yaml(file);
  Reading reading;
  const GivenValue given{root, "", reading};
  MappingReader mapping(given);
  SuiteSpec suite;
  suite.folder = folder;
  suite.name = needed_name(mapping, given, "suite");
  if (const auto tracks = needed(mapping, given, "tracks")) read_tracks(*tracks, suite);
  if (const auto splits = needed(mapping, given, "splits")) read_splits(*splits, suite);
  for (const GivenValue& cell : needed_list(mapping, given, "cells")) {
    suite.cells.push_back(read_cell(cell, suite.tracks));
  }
  mapping.finish();
  if (!reading.problems.empty()) throw InputError(std::move(reading.problems));
  return suite;
}

std::vector<SuiteSpec> built_in_suites() {
  std::vector<fs::path> folders;
  const fs::path all = data_folder() / "configs/suites";
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(all, error)) {
    if (fs::exists(entry.path() / "suite.yaml", error)) folders.push_back(entry.path());
  }
  std::sort(folders.begin(), folders.end());
  std::vector<SuiteSpec> suites;
  for (const fs::path& folder : folders) suites.push_back(read_suite(folder));
  return suites;
}

SuiteTrack track_of(const SuiteSpec& suite, const std::string& track) {
  SuiteTrack chosen{suite, track, ""};
  for (SuiteCell& cell : chosen.suite.cells) {
    std::erase_if(cell.sweeps, [&](const SuiteSweep& sweep) {
      return file_sha256_in(suite, sweep, track).empty();
    });
  }
  std::erase_if(chosen.suite.cells, [](const SuiteCell& cell) { return cell.sweeps.empty(); });
  chosen.sha256 = sha256(frozen_text(chosen.suite, track));
  return chosen;
}

SuiteTrack suite_track(const std::string& given) {
  const fs::path path = given;
  const std::string track = path.filename().string();
  const fs::path folder = path.parent_path();
  std::error_code error;
  std::vector<std::string> known;
  for (const SuiteSpec& suite : built_in_suites()) {
    for (const std::string& name : suite.tracks) {
      known.push_back(suite.name + "/" + name);
      if (known.back() == given) return track_of(suite, name);
    }
  }
  if (fs::exists(folder / "suite.yaml", error)) {
    SuiteSpec suite = read_suite(folder);
    if (contains(suite.tracks, track)) return track_of(suite, track);
    known.clear();
    for (const std::string& name : suite.tracks) known.push_back((folder / name).string());
  }
  throw InputError("'" + given + "' is not a track of a suite" + did_you_mean(given, known) +
                   "; tracks: " + joined(known));
}

std::string read_suite_key(const fs::path& file, const SuiteSpec& suite) {
  std::string key = read_input_file(file, kMostKeyBytes);
  const auto is_blank = [](char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\n'; };
  while (!key.empty() && is_blank(key.back())) key.pop_back();
  key.erase(key.begin(), std::find_if_not(key.begin(), key.end(), is_blank));
  // No part of the key is told: a log may be read by others.
  if (!is_sha256(key)) {
    refuse_file(file, "is not a key: expected 64 hexadecimal digits (0-9, a-f)");
  }
  if (const std::string hash = sha256(key); hash != suite.sealed_key_sha256) {
    refuse_file(file, "is not the key of " + suite.name + ": its SHA-256 is " + hash +
                          ", expected " + suite.sealed_key_sha256);
  }
  return key;
}

SweepSeeds seeds_of(const SuiteSpec& suite, const SuiteCell& cell, const SuiteSweep& sweep,
                    Split split, const std::string& key) {
  SweepSeeds seeds;
  const std::string place = cell.name + "/" + sweep.name;
  const SplitSeeds& known = split == Split::dev ? suite.dev : suite.open;
  const bool is_sealed = split == Split::sealed;
  seeds.seed = is_sealed ? sealed_seed(key, place + "/missions") : known.seed;
  seeds.missions = is_sealed ? suite.sealed_missions : known.missions;
  for (std::int64_t i = 0; i < sweep.map_count; ++i) {
    seeds.map_seeds.push_back(is_sealed ? sealed_seed(key, place + "/map/" + std::to_string(i))
                                        : known.first_map_seed + static_cast<std::uint64_t>(i));
  }
  return seeds;
}

fs::path frozen_file(const SuiteTrack& chosen, const SuiteSweep& sweep) {
  const fs::path file = chosen.suite.folder / chosen.track / (sweep.name + ".yaml");
  const std::string& frozen = file_sha256_in(chosen.suite, sweep, chosen.track);
  if (const std::string found = file_digest(file); found != frozen) {
    refuse_file(file, "is not the sweep that " + chosen.suite.name + " froze: its SHA-256 is " +
                          found + ", expected " + frozen + "; a changed suite gets another name");
  }
  return file;
}

}  // namespace avoidbench
