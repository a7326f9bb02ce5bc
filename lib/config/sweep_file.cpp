#include "config/sweep_file.hpp"

#include <algorithm>
#include <map>
#include <set>
#include <tuple>

#include "base/file_name.hpp"
#include "config/field_reader.hpp"
#include "config/given_values.hpp"
#include "config/map_files.hpp"
#include "config/mission_lists.hpp"
#include "config/planner_entries.hpp"
#include "config/sweep_axes.hpp"
#include "config/sweep_keys.hpp"
#include "trial/contradictions.hpp"
#include "yaml/built_in_sweeps.hpp"
#include "yaml/overrides.hpp"

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
      read_key(mapping, key, keys, reading);
    } else {
      mapping.take(key.name);  // read elsewhere, or of no interest
    }
  }
  reading.lists_are_axes = false;
  return keys;
}

void check_name(const YamlNode& root, const std::string& name, Reading& reading) {
  const YamlNode* node = root.find("sweep");
  if (node == nullptr) {
    reading.problems.push_back(problem_at(root, "lacks 'sweep', the name of the result set"));
  } else if (node->kind == YamlNode::Kind::scalar && safe_file_name(name) != name) {
    // The name becomes that of a file.
    reading.problems.push_back(problem_at(
        *node, "sweep: " + found_text(*node) +
                   " is no name of A-Z a-z 0-9 _ . - that begins with a letter, digit or _"));
  }
}

StopRule stop_rule_from(const nlohmann::json& until, Reading& reading) {
  if (!until.is_string() || until == "") return {};
  try {
    return parse_stop_rule(until.get<std::string>());
  } catch (const InputError& error) {
    reading.problems.push_back(problem_at(reading.place("until"), error.what()));
    return {};
  }
}

/// Rounds the rates of the base and of the axes to whole ticks, with a warning for each.
void round_rates(const Reading& reading, SweepSpec& sweep) {
  for (const auto& rate : rates_hz(sweep.base)) {
    // Not as a structured binding, which clang lets no lambda take.
    const auto& path = rate.first;
    double* const rate_hz = rate.second;
    const auto rounded = [&](double given_hz) {
      const double nearest_hz = nearest_rate_hz(given_hz);
      if (nearest_hz == given_hz) return given_hz;
      sweep.warnings.push_back(text(problem_at(
          reading.place(path), path + ": " + number_text(given_hz) +
                                   " Hz is not a whole number of ticks of 1/36000 s; rounded to " +
                                   number_text(nearest_hz) + " Hz")));
      return nearest_hz;
    };
    if (Axis* axis = axis_of(sweep, path)) {
      for (nlohmann::json& value : axis->values) value = rounded(value.get<double>());
      *rate_hz = axis->values.front().get<double>();
    } else {
      *rate_hz = rounded(*rate_hz);
    }
  }
}

/// Adds the contradictions of the base and of the axes' combinations, each once.
void add_contradictions(const SweepSpec& sweep, Reading& reading) {
  std::set<std::string> seen;
  for_each_combination(sweep, [&](const TrialSpec& trial) {
    for (const Contradiction& found : contradictions(trial)) {
      const bool is_new = seen.insert(found.path + found.message).second;
      if (is_new) reading.add_problem(sweep_path(found.path), found.message);
    }
  });
}

/// In doubles, since the product of the axes' sizes may overflow whole numbers.
void check_size(const YamlNode& root, const SweepSpec& sweep, Reading& reading) {
  double count = static_cast<double>(sweep.trials) *
                 static_cast<double>(std::max<std::size_t>(1, sweep.planners.size()));
  for (const Axis& axis : sweep.axes) count *= static_cast<double>(axis.values.size());
  if (count <= kMostTrials) return;
  reading.problems.push_back(problem_at(
      root,
      "the sweep has " + number_text(count) + " trials, more than " + number_text(kMostTrials)));
}

/// In the order of the file, then those of other files, one after the other; each once.
[[noreturn]] void fail(std::vector<InputProblem> problems, const std::string& main_file) {
  // Other files follow in the order of their first problem; the command line comes last.
  std::map<std::string, std::size_t> file_order{{main_file, 0}};
  for (const InputProblem& problem : problems) {
    const bool is_file = problem.line > 0;  // or an option of the command line
    file_order.emplace(problem.file, is_file ? file_order.size() : problems.size() + 1);
  }
  const auto key = [&](const InputProblem& problem) {
    return std::tuple(file_order.at(problem.file), problem.line, problem.column);
  };
  std::stable_sort(problems.begin(), problems.end(),
                   [&](const auto& a, const auto& b) { return key(a) < key(b); });
  std::set<std::string> seen;
  std::erase_if(problems, [&](const auto& problem) { return !seen.insert(text(problem)).second; });
  throw InputError(std::move(problems));
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
                   did_you_mean(given, known) + "; generators: " + listed(generators));
}

/// `{generator: …}` as `{maps: {generator: …}}`.
YamlNode under_maps(YamlNode map) {
  YamlNode sweep;
  sweep.kind = YamlNode::Kind::mapping;
  sweep.source = map.source;
  sweep.keys.emplace_back();
  sweep.keys.back().kind = YamlNode::Kind::scalar;
  sweep.keys.back().scalar = "maps";
  sweep.items.push_back(std::move(map));
  return sweep;
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

/// `file` is named in problems; other files are found from its folder.
SweepSpec sweep_from_document(const Document& document, const fs::path& file) {
  const YamlNode& root = document.root;
  Reading reading;
  if (file.has_parent_path()) reading.folder = file.parent_path();
  MappingReader mapping(root, "", reading);
  if (!reading.problems.empty()) fail(reading.problems, file.string());
  // The values of all fields as JSON, with every problem of theirs in `reading`.
  const nlohmann::json keys = read_keys(mapping, true, reading);
  SweepSpec sweep = sweep_from(keys);
  check_name(root, sweep.name, reading);
  sweep.until = stop_rule_from(keys.at("until"), reading);
  sweep.axes = axes_of_blocks(reading);
  // What follows looks at the values together: only where each by itself is sound.
  const bool is_sound = reading.problems.empty();
  // After the blocks: axes begin from what these say.
  if (const YamlNode* node = root.find("axes")) read_axes(*node, sweep, reading);
  resolve_files(sweep, reading);
  read_missions(root, sweep, reading);
  if (const YamlNode* planners = root.find("planners")) {
    sweep.planners = read_planners(*planners, root.find("max_speed_mps"), reading);
  } else {
    reading.problems.push_back(
        problem_at(root, "lacks 'planners', the list of planners to compare"));
  }
  mapping.finish();
  if (is_sound) {
    round_rates(reading, sweep);
    add_contradictions(sweep, reading);
    check_given_values(root, sweep, reading);
    settle_missions(root, sweep, reading);
  }
  check_size(root, sweep, reading);
  if (!reading.problems.empty()) fail(reading.problems, file.string());
  return sweep;
}

}  // namespace

Document read_sweep_document(const fs::path& file, const std::vector<std::string>& overrides) {
  Document document = read_document(sweep_file(file));
  apply_overrides(document.root, overrides);
  return document;
}

SweepSpec read_sweep(const fs::path& file, const std::vector<std::string>& overrides) {
  return sweep_of_document(read_sweep_document(file, overrides), file);
}

SweepSpec sweep_of_text(const std::string& text, const std::string& name,
                        const std::vector<std::string>& overrides) {
  Document document{.root = parse_yaml(text, name), .included = {}};
  apply_overrides(document.root, overrides);
  return sweep_from_document(document, name);
}

SweepSpec sweep_of_document(const Document& document, const fs::path& given) {
  return sweep_from_document(document, sweep_file(given));
}

MapChoice read_map(const std::string& given, const std::vector<std::string>& overrides) {
  const std::vector<std::string>& generators = generator_names();
  if (std::find(generators.begin(), generators.end(), given) == generators.end()) {
    const fs::path file = map_or_sweep_file(given, generators);
    return map_of_document(read_document(file), file.string(), file.parent_path(), overrides);
  }
  YamlNode map;
  map.kind = YamlNode::Kind::mapping;
  std::vector<std::string> full{"maps.generator=" + given};
  full.insert(full.end(), overrides.begin(), overrides.end());
  return map_of_document({.root = under_maps(std::move(map)), .included = {}}, given, {}, full);
}

MapChoice map_of_document(const Document& document, const std::string& name, const fs::path& folder,
                          const std::vector<std::string>& overrides) {
  YamlNode root = document.root;
  // A map's own file has the generator at the top.
  if (root.find("generator") != nullptr) root = under_maps(std::move(root));
  apply_overrides(root, from_root(overrides));

  Reading reading;
  if (!folder.empty()) reading.folder = folder;
  MappingReader mapping(root, "", reading);
  // A sweep's file serves as well: its own keys are passed over.
  SweepSpec sweep = sweep_from(read_keys(mapping, false, reading));
  resolve_files(sweep, reading);
  read_missions(root, sweep, reading);
  round_rates(reading, sweep);
  mapping.finish();
  if (reading.problems.empty()) add_contradictions(sweep, reading);
  if (!reading.problems.empty()) fail(reading.problems, name);
  return {std::move(sweep.base), std::move(sweep.missions), std::move(sweep.warnings)};
}

}  // namespace avoidbench
