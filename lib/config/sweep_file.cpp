#include "config/sweep_file.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <tuple>

#include "base/file_name.hpp"
#include "config/cross_checks.hpp"
#include "config/map_files.hpp"
#include "config/named_specs.hpp"
#include "config/planner_entries.hpp"
#include "config/sweep_axes.hpp"
#include "yaml/overrides.hpp"
#include "yaml/yaml_reader.hpp"

namespace avoidbench {
namespace {

namespace fs = std::filesystem;

constexpr double kMostTrials = 10'000'000;

void read_name(const YamlNode& root, const YamlNode* node, std::string& name, Reading& reading) {
  if (node == nullptr) {
    reading.problems.push_back(problem_at(root, "lacks 'sweep', the name of the result set"));
    return;
  }
  const std::size_t before = reading.problems.size();
  read_scalar(*node, "sweep", name, Range{}, reading.problems);
  if (reading.problems.size() == before && safe_file_name(name) != name) {
    reading.problems.push_back(problem_at(
        *node, "sweep: " + found_text(*node) +
                   " is no name of A-Z a-z 0-9 _ . - that begins with a letter, digit or _"));
  }
}

void read_until(const YamlNode* node, StopRule& rule, Reading& reading) {
  if (node == nullptr) return;
  std::string text;
  const std::size_t before = reading.problems.size();
  read_scalar(*node, "until", text, Range{}, reading.problems);
  if (reading.problems.size() != before || text.empty()) return;
  try {
    rule = parse_stop_rule(text);
  } catch (const InputError& error) {
    reading.problems.push_back(problem_at(*node, error.what()));
  }
}

/// The seed and the blocks of a TrialSpec. Lists become axes, their paths starting with the block's
/// key.
void read_blocks(SpecReader& reader, const fs::path& folder, TrialSpec& trial, Reading& reading) {
  reading.lists_are_axes = true;
  reader.field("seed", trial.seed, "");
  if (const YamlNode* node = reader.take("maps")) read_maps(*node, trial, reading);
  if (const YamlNode* node = reader.take("vehicle")) {
    read_vehicle(*node, folder, trial.vehicle, reading);
  }
  if (const YamlNode* node = reader.take("sensor"))
    read_sensor(*node, folder, trial.sensor, reading);
  if (const YamlNode* node = reader.take("imu")) read_spec(*node, "imu", trial.imu, reading);
  if (const YamlNode* node = reader.take("odometry")) {
    read_spec(*node, "odometry", trial.odometry, reading);
  }
  if (const YamlNode* node = reader.take("latency")) {
    read_spec(*node, "latency", trial.latency, reading);
  }
  if (const YamlNode* node = reader.take("wind")) read_spec(*node, "wind", trial.wind, reading);
  if (const YamlNode* node = reader.take("mission")) {
    read_spec(*node, "mission", trial.mission, reading);
  }
  if (const YamlNode* node = reader.take("rates")) read_spec(*node, "rates", trial.rates, reading);
  reading.lists_are_axes = false;
}

/// Rounds the rates of the base and of the axes to whole ticks, with a warning for each.
void round_rates(const YamlNode& root, SweepSpec& sweep) {
  const auto rounded = [&](const std::string& path, double rate_hz) {
    const double nearest_hz = nearest_rate_hz(rate_hz);
    if (nearest_hz == rate_hz) return rate_hz;
    const YamlNode* axis = axis_key(root, path);
    const YamlNode& place = axis != nullptr ? *axis : node_near(root, path);
    sweep.warnings.push_back(
        text(problem_at(place, path + ": " + number_text(rate_hz) +
                                   " Hz is not a whole number of ticks of 1/36000 s; rounded to " +
                                   number_text(nearest_hz) + " Hz")));
    return nearest_hz;
  };
  for (const auto& [path, rate_hz] : rates_hz(sweep.base)) {
    bool is_axis = false;
    for (Axis& axis : sweep.axes) {
      if (axis.path != path) continue;
      is_axis = true;
      for (nlohmann::json& value : axis.values) value = rounded(path, value.get<double>());
      *rate_hz = axis.values.front().get<double>();
    }
    if (!is_axis) *rate_hz = rounded(path, *rate_hz);
  }
}

/// Adds the contradictions of the base and of the axes' combinations, each once.
void add_contradictions(const YamlNode& root, const SweepSpec& sweep, Reading& reading) {
  std::set<std::string> seen;
  const auto check = [&](const TrialSpec& trial) {
    for (const Contradiction& found : contradictions(trial)) {
      if (!seen.insert(found.path + found.message).second) continue;
      const bool is_map = found.path.starts_with("map.");
      const std::string path = is_map ? "maps" + found.path.substr(3) : found.path;
      const YamlNode* axis = axis_key(root, found.path);
      const YamlNode& place = axis != nullptr ? *axis : node_near(root, path);
      reading.problems.push_back(problem_at(place, path + ": " + found.message));
    }
  };
  for_each_combination(sweep, check);
}

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

}  // namespace

Document read_sweep_document(const fs::path& file, const std::vector<std::string>& overrides) {
  Document document = read_document(file);
  apply_overrides(document.root, overrides);
  return document;
}

SweepSpec read_sweep(const fs::path& file, const std::vector<std::string>& overrides) {
  const YamlNode root = read_sweep_document(file, overrides).root;
  const fs::path folder = file.has_parent_path() ? file.parent_path() : fs::path(".");

  Reading reading;
  SweepSpec sweep;
  SpecReader reader(root, "", reading);
  if (!reading.problems.empty()) fail(reading.problems, file.string());
  read_name(root, reader.take("sweep"), sweep.name, reading);
  reader.field("trials", sweep.trials, Range{1, 1e6}, "");
  read_until(reader.take("until"), sweep.until, reading);
  read_blocks(reader, folder, sweep.base, reading);
  sweep.axes = axes_of_blocks(reading);
  const std::size_t block_problems = reading.problems.size();
  if (const YamlNode* node = reader.take("axes")) read_axes(*node, sweep, reading);
  resolve_map_files(root, sweep, reading);
  resolve_wind_file(root, sweep, reading);
  resolve_latency_file(root, sweep, reading);
  const YamlNode* planners = reader.take("planners");
  const YamlNode* max_speed = reader.take("max_speed_mps");
  if (planners != nullptr) {
    sweep.planners = read_planners(*planners, max_speed, reading);
  } else {
    reading.problems.push_back(
        problem_at(root, "lacks 'planners', the list of planners to compare"));
  }
  reader.finish();
  if (block_problems == 0) {
    round_rates(root, sweep);
    add_contradictions(root, sweep, reading);
  }
  check_size(root, sweep, reading);
  if (!reading.problems.empty()) fail(reading.problems, file.string());
  return sweep;
}

MapChoice read_map(const std::string& file_or_generator,
                   const std::vector<std::string>& overrides) {
  YamlNode root;
  root.kind = YamlNode::Kind::mapping;
  const std::vector<std::string> generators = generator_names();
  const bool is_generator =
      std::find(generators.begin(), generators.end(), file_or_generator) != generators.end();
  std::error_code error;
  if (!is_generator && !fs::exists(file_or_generator, error)) {
    std::string all;
    for (const std::string& name : generators) all += (all.empty() ? "" : ", ") + name;
    throw InputError("'" + file_or_generator + "' is neither a file nor a generator" +
                     did_you_mean(file_or_generator, generators) + "; generators: " + all);
  }
  if (!is_generator) root = read_document(file_or_generator).root;
  const bool is_map_alone = root.find("generator") != nullptr || is_generator;
  if (is_map_alone) {  // {generator: …} becomes {maps: {generator: …}}
    YamlNode sweep;
    sweep.kind = YamlNode::Kind::mapping;
    sweep.source = root.source;
    YamlNode key;
    key.kind = YamlNode::Kind::scalar;
    key.scalar = "maps";
    sweep.keys.push_back(key);
    sweep.items.push_back(std::move(root));
    root = std::move(sweep);
  }
  std::vector<std::string> full = overrides;
  const std::vector<std::string> blocks{"maps", "mission",  "seed",    "vehicle", "sensor",
                                        "imu",  "odometry", "latency", "wind",    "rates"};
  for (std::string& option : full) {
    const std::string first = option.substr(0, option.find_first_of(".="));
    if (std::find(blocks.begin(), blocks.end(), first) == blocks.end()) option = "maps." + option;
  }
  if (is_generator) full.insert(full.begin(), "maps.generator=" + file_or_generator);
  apply_overrides(root, full);

  Reading reading;
  MapChoice choice;
  SpecReader reader(root, "", reading);
  const fs::path folder = fs::path(file_or_generator).parent_path();
  read_blocks(reader, folder.empty() ? fs::path(".") : folder, choice.trial, reading);
  SweepSpec sweep;
  sweep.base = choice.trial;
  resolve_map_files(root, sweep, reading);
  resolve_wind_file(root, sweep, reading);
  resolve_latency_file(root, sweep, reading);
  round_rates(root, sweep);
  choice.trial = sweep.base;
  choice.warnings = sweep.warnings;
  for (const char* other : {"sweep", "trials", "until", "axes", "planners", "max_speed_mps"})
    reader.take(other);
  reader.finish();
  if (reading.problems.empty()) add_contradictions(root, sweep, reading);
  if (!reading.problems.empty()) fail(reading.problems, file_or_generator);
  return choice;
}

}  // namespace avoidbench
