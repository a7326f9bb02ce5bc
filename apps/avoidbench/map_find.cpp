#include <algorithm>
#include <cmath>
#include <cstdio>

#include "commands.hpp"
#include "config/sweep_file.hpp"
#include "metrics/find_maps.hpp"
#include "metrics/map_measure.hpp"
#include "output.hpp"
#include "yaml/yaml_values.hpp"

namespace avoidbench {
namespace {

struct FindOptions {
  std::string spec, metric = "traversability", vary = "poisson_radius_m";
  std::vector<std::string> overrides;
  MapTarget target{.within = 0.5, .count = 3};
  std::vector<double> between{1.8, 8.0};
  std::int64_t missions = 5;
};

/// Field of a map out of `maps.area_m=[20, 30]`, to be written below `maps:`.
std::string yaml_line(const std::string& override) {
  const std::size_t equals = override.find('=');
  std::string name = override.substr(0, equals);
  for (const std::string_view prefix : {"maps.", "map."}) {
    if (name.starts_with(prefix)) name.erase(0, prefix.size());
  }
  return "  " + name + ": " + override.substr(std::min(equals + 1, override.size())) + "\n";
}

void print_found(const FindOptions& options, const MapsFound& found) {
  std::int64_t tried = 0;
  for (const MapTried& map : found.tried) tried += map.parameter == found.parameter ? 1 : 0;
  std::string text = "# " + options.metric + " " + number_text(options.target.wanted) + " ± " +
                     number_text(options.target.within) + ": " +
                     std::to_string(found.seeds.size()) + " of " + std::to_string(tried) +
                     " seeds tried\nmaps:\n";
  const TrialSpec trial = read_map(options.spec, options.overrides).trial;
  text += "  generator: " + std::string(kind(trial.map)) + "\n";
  for (const std::string& override : options.overrides) text += yaml_line(override);
  text += "  " + options.vary + ": " + number_text(found.parameter) + "\n  seeds: [";
  std::vector<std::string> seeds;
  for (const std::uint64_t seed : found.seeds) seeds.push_back(std::to_string(seed));
  write_text(text + joined(seeds) + "]\n", "-");
}

void find(const FindOptions& options) {
  const std::vector<std::string> names = map_measure_names();
  if (std::find(names.begin(), names.end(), options.metric) == names.end()) {
    throw InputError("--metric " + options.metric + ": no metric of maps or missions" +
                     did_you_mean(options.metric, names));
  }
  if (!(options.between[0] < options.between[1])) {
    throw InputError("--between: the lower end comes first");
  }
  MapTarget target = options.target;
  target.lowest = options.between[0];
  target.highest = options.between[1];
  target.measure = [&](double parameter, std::uint64_t seed) {
    std::vector<std::string> overrides = options.overrides;
    overrides.push_back(options.vary + "=" + number_text(parameter));
    const double value = map_measure(read_map(options.spec, overrides).trial, seed, options.metric,
                                     options.missions);
    const bool is_near = std::abs(value - options.target.wanted) <= options.target.within;
    std::fprintf(stderr, "%s %g, seed %llu: %s %.4g%s\n", options.vary.c_str(), parameter,
                 static_cast<unsigned long long>(seed), options.metric.c_str(), value,
                 is_near ? ", within" : "");
    return value;
  };
  const MapsFound found = find_maps(target);
  if (found.seeds.empty()) {
    throw InputError("none of seeds 1 to " + std::to_string(options.target.most_seeds) + " has " +
                     options.metric + " within " + number_text(options.target.within) + " of " +
                     number_text(options.target.wanted) + "; try a wider --within");
  }
  print_found(options, found);
}

}  // namespace

void add_maps_find_command(CLI::App& maps) {
  const auto [command, options] = add_command(
      maps, "find", "Find maps of a given difficulty: a parameter and seeds, as YAML for a sweep",
      find);
  command.add_option("map", options.spec, "Generator, sweep file, or file with a map's fields")
      ->required();
  command.add_option("--metric", options.metric, "Metric of maps or missions (avoidbench metrics)");
  command.add_option("--value", options.target.wanted, "Its target value")->required();
  add_number(command, "--within", options.target.within, CLI::PositiveNumber,
             "Allowed deviation from the target");
  command.add_option("--vary", options.vary, "Field to adjust");
  command.add_option("--between", options.between, "Its range")->expected(2);
  add_number(command, "--count", options.target.count, CLI::Range(1, 10'000), "Maps wanted");
  add_number(command, "--seeds", options.target.most_seeds, CLI::Range(1, 1'000'000),
             "Seeds tried: 1 to this");
  add_number(command, "--missions", options.missions, CLI::Range(1, 10'000),
             "Missions per map for metrics of missions");
  add_overrides(command, options.overrides, "bush_ratio=0");
}

}  // namespace avoidbench
