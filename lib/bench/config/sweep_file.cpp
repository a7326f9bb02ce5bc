#include "config/sweep_file.hpp"

#include <algorithm>

#include "base/words.hpp"
#include "config/field_reader.hpp"
#include "config/given_values.hpp"
#include "config/map_files.hpp"
#include "config/mission_lists.hpp"
#include "config/planner_entries.hpp"
#include "config/sweep_axes.hpp"
#include "config/sweep_keys.hpp"
#include "map_file/map_file.hpp"
#include "maps/file_maps.hpp"
#include "trial/contradictions.hpp"
#include "yaml/built_in_sweeps.hpp"
#include "yaml/overrides.hpp"
#include "yaml/yaml_values.hpp"

namespace avoidbench {
namespace {

namespace fs = std::filesystem;

constexpr double kMostTrials = 10'000'000;

/// What the file's keys say, as preset_json(sweep_tree()) has the defaults: those of the settings,
/// and those that are the sweep's own where they matter.
nlohmann::json read_keys(MappingReader& mapping, bool with_own, Reading& reading) {
  nlohmann::json keys = preset_json(sweep_tree());
  for (const FieldTree& key : sweep_tree().fields) {
    if (key.name == "include") continue;  // followed before
    // Keys with facts are the sweep's own: no lists stand for axes there.
    const bool is_own = !key.facts.empty();
    const bool is_plain = key.kind != FieldKind::other && key.name != "max_speed_mps";
    reading.lists_are_axes = !is_own;
    if (is_plain && (with_own || !is_own)) {
      read_key(mapping, key, keys);
    } else {
      mapping.take(key.name);  // read elsewhere, or of no interest
    }
  }
  reading.lists_are_axes = false;
  return keys;
}

StopRule stop_rule_from(const nlohmann::json& until, Reading& reading) {
  if (!until.is_string() || until == "") return {};
  try {
    return parse_stop_rule(until.get<std::string>());
  } catch (const InputError& error) {
    reading.problems.push_back(problem_at(reading.at("until").node, error.what()));
    return {};
  }
}

/// Rounds the rates of the base and of the axes to whole ticks, with a warning for each.
void round_rates(Reading& reading, SweepSpec& sweep) {
  for (const auto& rate : rates_hz(sweep.base)) {
    // Not as a structured binding, which clang lets no lambda take.
    const auto& path = rate.first;
    for_each_value(sweep, path, *rate.second, [&](double& rate_hz) {
      const double given_hz = std::exchange(rate_hz, nearest_rate_hz(rate_hz));
      if (rate_hz == given_hz) return;
      sweep.warnings.push_back(
          text(problem_at(reading.at(path).node,
                          path + ": " + number_text(given_hz) +
                              " Hz is not a whole number of ticks of 1/36000 s; rounded to " +
                              number_text(rate_hz) + " Hz")));
    });
  }
}

/// Adds the contradictions of the base and of the axes' combinations.
void add_contradictions(const SweepSpec& sweep, Reading& reading) {
  for_each_combination(sweep, [&](const TrialSpec& trial) {
    for (const Contradiction& found : contradictions(trial)) {
      reading.at(sweep_path(found.path)).add_problem(found.message);
    }
  });
}

/// In doubles, since the product of the axes' sizes may overflow whole numbers.
void check_size(const GivenValue& root, const SweepSpec& sweep) {
  double count = static_cast<double>(sweep.trials) *
                 static_cast<double>(std::max<std::size_t>(1, sweep.planners.size()));
  for (const Axis& axis : sweep.axes) count *= static_cast<double>(axis.values.size());
  if (count <= kMostTrials) return;
  root.add_problem("the sweep has " + number_text(count) + " trials, more than " +
                   number_text(kMostTrials));
}

/// The file of a map or sweep, or that of the built-in sweep of this name.
fs::path map_or_sweep_file(const std::string& given, const std::vector<std::string>& generators) {
  std::error_code error;
  if (fs::exists(given, error)) return given;
  std::vector<std::string> known = generators;
  for (const BuiltInSweep& sweep : built_in_sweeps()) {
    if (sweep.name == given) return sweep.file;
    known.push_back(sweep.name);
  }
  throw InputError("'" + given + "' is neither a file, nor a generator, nor a built-in sweep" +
                   did_you_mean(given, known) + "; generators: " + joined(generators));
}

/// `{generator: …}` as `{maps: {generator: …}}`.
YamlNode under_maps(YamlNode map) {
  YamlNode file;  // as a whole: no line of it
  file.source = map.source;
  return mapping_at(file, "maps", std::move(map));
}

/// Names the generator of `maps: {file: …}` after the file, where it is left out.
void name_generator(YamlNode& root) {
  const std::size_t at = root.index_of("maps");
  if (at == root.keys.size()) return;
  YamlNode& maps = root.items[at];
  const YamlNode* file = maps.find("file");
  if (file == nullptr || file->kind != YamlNode::Kind::scalar) return;
  if (maps.find("generator") != nullptr) return;
  const fs::path found = folder_of(*file, ".") / file->scalar;
  std::error_code error;
  if (!fs::is_regular_file(found, error)) return;  // reported with the other problems
  const MapFileKind kind = map_file_kind(found.string());
  if (kind == MapFileKind::unknown) return;
  const std::string_view generator =
      kind == MapFileKind::mesh ? MeshSpec::kind : PointCloudSpec::kind;
  maps.keys.push_back(node_at(*file, YamlNode::Kind::scalar, "generator"));
  maps.items.push_back(node_at(*file, YamlNode::Kind::scalar, std::string(generator)));
}

/// The overrides with the `maps.` that they may leave out.
std::vector<std::string> from_root(std::vector<std::string> overrides) {
  for (std::string& option : overrides) {
    const FieldTree* key = sweep_tree().find(option.substr(0, option.find_first_of(".=")));
    // What is no block of a sweep is a field of its maps.
    if (key == nullptr || !key->facts.empty()) option = "maps." + option;
  }
  return overrides;
}

}  // namespace

Document read_sweep_document(const fs::path& file, const std::vector<std::string>& overrides) {
  Document document = read_document(sweep_file(file));
  apply_overrides(document.root, overrides);
  name_generator(document.root);
  return document;
}

SweepSpec sweep_of_document(const Document& document) {
  Reading reading;
  if (document.file.has_parent_path()) reading.folder = document.file.parent_path();
  const GivenValue root{document.root, "", reading};
  const YamlNode* flights = document.root.find("flights");
  if (flights != nullptr && document.root.find("recordings") != nullptr) {
    throw InputError(problem_at(*flights, "this is a file of real flights: `import` reads it"));
  }
  MappingReader mapping(root);
  if (!reading.problems.empty()) throw_problems(reading.problems, document.file.string());
  // The values of all fields as JSON, with every problem of theirs in `reading`.
  const nlohmann::json keys = read_keys(mapping, true, reading);
  SweepSpec sweep = sweep_from(keys);
  check_name(root, "sweep", sweep.name);
  sweep.until = stop_rule_from(keys.at("until"), reading);
  for (const auto& [path, values] : reading.axes) sweep.axes.push_back({trial_path(path), values});
  // What follows looks at the values together: only where each by itself is sound.
  const bool is_sound = reading.problems.empty();
  // After the blocks: axes begin from what these say.
  if (const YamlNode* axes = root.node.find("axes")) read_axes(root.at(*axes, "axes"), sweep);
  resolve_files(sweep, reading);
  read_missions(root.node, sweep, reading);
  if (const YamlNode* planners = root.node.find("planners")) {
    const YamlNode* max_speed = root.node.find("max_speed_mps");
    // Of fields that are wrong nobody knows what sensor they make.
    const bool has_sensors = reading.problems.empty();
    sweep.planners = read_planners(root.at(*planners, "planners"), max_speed,
                                   has_sensors ? swept_sensors(sweep) : std::vector<SensorSpec>{},
                                   has_sensors ? goals_demand(sweep) : "");
  } else {
    root.add_problem("lacks 'planners', the list of planners to compare");
  }
  mapping.finish();
  if (is_sound) {
    round_rates(reading, sweep);
    add_contradictions(sweep, reading);
    check_given_values(root.node, sweep, reading);
    settle_missions(root.node, sweep, reading);
  }
  check_size(root, sweep);
  if (!reading.problems.empty()) throw_problems(reading.problems, document.file.string());
  return sweep;
}

SweepSpec read_sweep(const fs::path& file, const std::vector<std::string>& overrides) {
  return sweep_of_document(read_sweep_document(file, overrides));
}

SweepSpec sweep_of_text(const std::string& text, const std::string& name,
                        const std::vector<std::string>& overrides) {
  Document document{.root = parse_yaml(text, name), .file = name, .included = {}};
  apply_overrides(document.root, overrides);
  name_generator(document.root);
  return sweep_of_document(document);
}

MapChoice read_map(const std::string& given, const std::vector<std::string>& overrides) {
  const std::vector<std::string>& generators =
      sweep_tree().find("maps")->find("generator")->choices;
  if (std::find(generators.begin(), generators.end(), given) == generators.end()) {
    const fs::path file = map_or_sweep_file(given, generators);
    if (map_file_kind(file.string()) != MapFileKind::unknown) {
      const YamlNode place;
      const YamlNode name = node_at(place, YamlNode::Kind::scalar, fs::absolute(file).string());
      return map_of_document(
          {.root = under_maps(mapping_at(place, "file", name)), .file = {}, .included = {}},
          overrides);
    }
    return map_of_document(read_document(file), overrides);
  }
  std::vector<std::string> full{"maps.generator=" + given};
  full.insert(full.end(), overrides.begin(), overrides.end());
  const YamlNode map = node_at({}, YamlNode::Kind::mapping);
  return map_of_document({.root = under_maps(map), .file = given, .included = {}}, full);
}

MapChoice map_of_document(const Document& document, const std::vector<std::string>& overrides) {
  YamlNode root = document.root;
  // A map's own file has the generator, or the file, at the top.
  if (root.find("generator") != nullptr || root.find("file") != nullptr) {
    root = under_maps(std::move(root));
  }
  apply_overrides(root, from_root(overrides));
  name_generator(root);

  Reading reading;
  if (document.file.has_parent_path()) reading.folder = document.file.parent_path();
  MappingReader mapping({root, "", reading});
  // A sweep's file serves as well: its own keys are passed over.
  SweepSpec sweep = sweep_from(read_keys(mapping, false, reading));
  resolve_files(sweep, reading);
  read_missions(root, sweep, reading);
  round_rates(reading, sweep);
  mapping.finish();
  if (reading.problems.empty()) add_contradictions(sweep, reading);
  if (!reading.problems.empty()) throw_problems(reading.problems, document.file.string());
  return {std::move(sweep.base), std::move(sweep.missions), std::move(sweep.warnings)};
}

}  // namespace avoidbench
