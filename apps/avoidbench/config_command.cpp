#include <iostream>
#include <memory>

#include "base/input_error.hpp"
#include "commands.hpp"
#include "config/defaults.hpp"
#include "config/sweep_file.hpp"
#include "reference_table.hpp"

namespace avoidbench {
namespace {

/// What can be printed: a sweep, the vehicles and sensors that are built in.
std::vector<std::string> preset_names() {
  std::vector<std::string> names{"sweep", "hummingbird", "hummingbird_rotors", "firefly"};
  for (const SensorSpec& sensor : sensor_presets()) names.push_back(sensor.name);
  return names;
}

std::string joined(const std::vector<std::string>& names) {
  std::string all;
  for (const std::string& name : names) all += (all.empty() ? "" : ", ") + name;
  return all;
}

std::string preset_yaml(const std::string& name) {
  if (name == "sweep") return sweep_defaults_yaml();
  if (name == "hummingbird") return vehicle_yaml(hummingbird_spec());
  if (name == "hummingbird_rotors") return vehicle_yaml(hummingbird_rotors_spec());
  if (name == "firefly") return vehicle_yaml(firefly_spec());
  for (const SensorSpec& sensor : sensor_presets()) {
    if (name == sensor.name) return sensor_yaml(sensor);
  }
  const std::vector<std::string> names = preset_names();
  throw InputError("nothing built in is named '" + name + "'" + did_you_mean(name, names) +
                   "; it is one of " + joined(names));
}

void check(const std::string& file, const std::vector<std::string>& overrides) {
  const SweepSpec sweep = read_sweep(file, overrides);
  for (const std::string& warning : sweep.warnings) std::cerr << "warning: " << warning << "\n";
  std::size_t settings = 1;
  for (const Axis& axis : sweep.axes) settings *= axis.values.size();
  const auto missions = static_cast<std::size_t>(sweep.trials);
  std::string text =
      sweep.name + ": " + std::to_string(settings * missions * sweep.planners.size()) +
      " trials = " + std::to_string(settings) + " settings × " + std::to_string(missions) +
      " missions × " + std::to_string(sweep.planners.size()) + " planners\n";
  for (const Axis& axis : sweep.axes) {
    text += "  " + axis.path + ": " + nlohmann::json(axis.values).dump() + "\n";
  }
  for (const PlannerChoice& planner : sweep.planners) text += "  planner " + planner.label + "\n";
  write_text(text, "-");
}

}  // namespace

void add_config_command(CLI::App& app) {
  struct Options {
    std::string preset = "sweep";
    std::string output = "-";
    std::string file;
    std::vector<std::string> overrides;
  };
  const auto options = std::make_shared<Options>();
  CLI::App* command = app.add_subcommand("config", "Print defaults, check sweep files");
  command->footer(
      "Examples:\n"
      "  avoidbench config defaults > my_sweep.yaml\n"
      "  avoidbench config defaults firefly\n"
      "  avoidbench config check my_sweep.yaml --set maps.poisson_radius_m=3");
  CLI::App* defaults = command->add_subcommand(
      "defaults", "Everything that a file can say, at its default, with docs and ranges, as YAML");
  defaults
      ->add_option("what", options->preset,
                   "A sweep, or a vehicle or sensor that is built in: " + joined(preset_names()))
      ->capture_default_str();
  defaults->add_option("--output", options->output, "File to write, - for standard output")
      ->capture_default_str();
  defaults->callback([options] { write_text(preset_yaml(options->preset), options->output); });
  CLI::App* check_command = command->add_subcommand(
      "check", "Read a sweep file and print what it would fly, or all that is wrong with it");
  check_command->add_option("sweep", options->file, "Sweep file (YAML)")
      ->required()
      ->type_name("FILE");
  check_command
      ->add_option(
          "--set", options->overrides,
          "Override one value, as in maps.poisson_radius_m=3.0; repeatable (default: none)")
      ->type_name("PATH=VALUE")
      ->allow_extra_args(false);
  check_command->callback([options] { check(options->file, options->overrides); });
}

}  // namespace avoidbench
