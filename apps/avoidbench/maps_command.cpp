#include <algorithm>
#include <chrono>
#include <cmath>
#include <iostream>
#include <map>
#include <memory>
#include <optional>

#include "base/input_error.hpp"
#include "commands.hpp"
#include "config/sweep_file.hpp"
#include "config/yaml_values.hpp"
#include "map_list.hpp"
#include "map_views.hpp"
#include "reference_table.hpp"

namespace avoidbench {
namespace {

struct MapOptions {
  std::string spec;
  std::vector<std::string> overrides;
  std::optional<std::uint64_t> seed;
  MapView view;
  std::string png = "map.png";
  TableOptions table;
};

TrialSpec trial_of(const MapOptions& options) {
  TrialSpec trial = read_map(options.spec, options.overrides).trial;
  if (options.seed) trial.map_seed = *options.seed;
  return trial;
}

std::string fixed(double value, int digits) {
  char text[48];
  std::snprintf(text, sizeof text, "%.*f", digits, value);
  return text;
}

void show(const MapOptions& options) {
  const std::vector<std::string> views = map_view_names();
  if (std::find(views.begin(), views.end(), options.view.name) == views.end()) {
    throw InputError("--view " + options.view.name + ": unknown" +
                     did_you_mean(options.view.name, views) +
                     "; it is one of top, bird, first_person, depth");
  }
  const TrialSpec trial = trial_of(options);
  const World world = make_world(trial.map, trial.map_seed);
  Picture picture = render_map(world, trial, options.view);
  std::string caption = std::string(kind(trial.map)) + ", seed " + std::to_string(trial.map_seed);
  if (world.poisson_radius_m > 0.0) {
    // Some radii are 32-bit floats: no more digits than those have.
    const double radius_m = std::round(1e5 * world.poisson_radius_m) / 1e5;
    caption += ", Poisson radius " + number_text(radius_m) + " m";
  }
  add_caption(picture, caption + ", " + options.view.name);
  write_png(picture, options.png);
  std::cerr << "wrote " << options.png << '\n';
}

std::string box_text(const Aabb& box) {
  std::string text;
  for (int axis = 0; axis < 3; ++axis) {
    text += (axis > 0 ? " × [" : "[") + fixed(box.min()[axis], 2) + ", " +
            fixed(box.max()[axis], 2) + "]";
  }
  return text;
}

void info(const MapOptions& options) {
  const TrialSpec trial = trial_of(options);
  const auto before = std::chrono::steady_clock::now();
  const World world = make_world(trial.map, trial.map_seed);
  const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - before;
  std::map<std::string, std::size_t> counts;
  for (const Obstacle& obstacle : world.obstacles) ++counts[obstacle.kind];
  ReferenceTable table{{"property", "value"}, {}};
  const auto add = [&](const std::string& name, const std::string& value) {
    table.rows.push_back({name, value});
  };
  add("generator", std::string(kind(trial.map)));
  add("seed", std::to_string(trial.map_seed));
  for (const auto& [obstacle, count] : counts) add(obstacle + "_count", std::to_string(count));
  add("instance_count", std::to_string(world.instances.size()));
  add("triangle_count", std::to_string(triangle_count(world)));
  add("bounds_m", box_text(world.bounds));
  add("flight_bounds_m", box_text(world.flight_bounds));
  add("mean_obstacle_width_m", fixed(world.mean_obstacle_width_m, 4));
  add("memory_mb", fixed(static_cast<double>(memory_bytes(world)) / 1e6, 1));
  add("digest", world.digest);
  write_table(table, options.table);
  std::cerr << "made in " << fixed(1000.0 * elapsed.count(), 0) << " ms\n";
}

void add_map_options(CLI::App& command, MapOptions& options) {
  command
      .add_option("map", options.spec,
                  "Generator (see maps list), sweep file, or file with a map's fields")
      ->required();
  command.add_option("--seed", options.seed, "Map seed (default: that of the file, else 1)");
  command
      .add_option("--set", options.overrides,
                  "Override one value, as in poisson_radius_m=3; repeatable (default: none)")
      ->type_name("NAME=VALUE")
      ->allow_extra_args(false);
}

}  // namespace

void add_maps_command(CLI::App& app) {
  const auto options = std::make_shared<MapOptions>();
  CLI::App* command =
      app.add_subcommand("maps", "The maps there are, pictures and figures of them");
  command->footer(
      "Of a sweep's several maps the first is taken; --set and --seed choose another.\n\n"
      "Examples:\n"
      "  avoidbench maps show forest --set poisson_radius_m=3 --view top --png forest.png\n"
      "  avoidbench maps info configs/sweeps/hall_small.yaml --seed 2");
  CLI::App* show_command = command->add_subcommand("show", "Draw a map as a PNG file");
  add_map_options(*show_command, *options);
  show_command
      ->add_option(
          "--view", options->view.name,
          "top, bird, first_person, or depth (what the mission's camera sees at its start)")
      ->capture_default_str();
  show_command->add_option("--png", options->png, "File to write")->capture_default_str();
  show_command
      ->add_option("--mission", options->view.mission_index, "Mission of first_person and depth")
      ->check(CLI::Range(0, 1'000'000))
      ->capture_default_str();
  show_command->add_option("--width", options->view.width_px, "Width, pixels")
      ->check(CLI::Range(64, 8192))
      ->capture_default_str();
  show_command->add_option("--height", options->view.height_px, "Height, pixels")
      ->check(CLI::Range(64, 8192))
      ->capture_default_str();
  show_command->add_option("--samples", options->view.samples, "Rays a side of each pixel")
      ->check(CLI::Range(1, 8))
      ->capture_default_str();
  show_command->callback([options] { show(*options); });
  CLI::App* info_command =
      command->add_subcommand("info", "Counts, bounds, triangles and digest of a map");
  add_map_options(*info_command, *options);
  add_table_options(*info_command, options->table);
  info_command->callback([options] { info(*options); });
  add_maps_list_command(*command);
}

}  // namespace avoidbench
