#include <algorithm>
#include <chrono>
#include <cmath>
#include <iostream>
#include <map>
#include <memory>
#include <optional>

#include "base/number_text.hpp"
#include "commands.hpp"
#include "config/sweep_file.hpp"
#include "map_file/export_map.hpp"
#include "metrics/environment.hpp"
#include "metrics/map_measure.hpp"
#include "metrics/metric_table.hpp"
#include "output.hpp"
#include "page_output.hpp"
#include "report/table_rows.hpp"
#include "sweep/listed_missions.hpp"
#include "view/map_plan.hpp"
#include "view/map_views.hpp"
#include "world/voxels.hpp"
#include "yaml/yaml_values.hpp"

namespace avoidbench {
namespace {

constexpr int kPlan_px = 960;  ///< the longer side of a plan whose size is not given
constexpr std::int64_t kPageMissions = 10;

struct MapOptions {
  std::string spec;
  std::vector<std::string> overrides;
  std::optional<std::uint64_t> seed;
  MapView view;
  bool has_size = false;  ///< width or height was given
  std::string png = "map.png", page;
  std::int64_t missions = 10;           ///< 0: no metrics
  std::optional<double> point_cloud_m;  ///< resolution of the original's metric
  std::string file, export_as = "mesh";
  double resolution_m = 0.1;
  OutputOptions output;
};

MapChoice choice_of(const MapOptions& options) {
  MapChoice choice = read_map(options.spec, options.overrides);
  if (options.seed) choice.trial.map_seed = *options.seed;
  return choice;
}

/// The map in 3-D with its missions that can be laid out.
void write_map_page(const MapChoice& choice, const World& world, const MapOptions& options) {
  const TrialSpec& trial = choice.trial;
  if (triangle_count(world) > kMostPageTriangles) {
    throw InputError("--page: the map has " + std::to_string(triangle_count(world)) +
                     " triangles, and a page shows " + std::to_string(kMostPageTriangles) +
                     " at most");
  }
  const Scene scene(world);
  const std::vector<Mission> listed = missions_of(choice.missions, trial);
  std::vector<Mission> missions;
  for (std::int64_t i = 0; i < kPageMissions; ++i) {
    if (const auto mission = the_mission(scene, trial, i, listed)) missions.push_back(*mission);
  }
  const std::string title =
      std::string(kind(trial.map)) + ", seed " + std::to_string(trial.map_seed);
  write_page(map_page(world, trial, missions, title, page_origin()), options.page);
}

void show(const MapOptions& options) {
  if (!options.page.empty()) check_page(options.page);
  check_output(options.png, "png");
  const MapChoice choice = choice_of(options);
  const TrialSpec& trial = choice.trial;
  const World world = make_world(trial.map, trial.map_seed);
  if (!options.page.empty()) return write_map_page(choice, world, options);
  MapView view = options.view;
  view.listed_missions = missions_of(choice.missions, trial);
  if (view.name == "top" && !options.has_size) fit_plan(world, kPlan_px, view);
  std::string note;
  Picture picture = render_map(world, trial, view, note);
  std::string caption = std::string(kind(trial.map)) + ", seed " + std::to_string(trial.map_seed);
  if (world.poisson_radius_m > 0.0) {
    // Some radii are 32-bit floats: no more digits than those have.
    const double radius_m = std::round(1e5 * world.poisson_radius_m) / 1e5;
    caption += ", Poisson radius " + number_text(radius_m) + " m";
  }
  add_caption(picture, caption + ", " + (note.empty() ? view.name : note));
  write_png(picture, options.png);
  std::cerr << "wrote " << options.png << '\n';
}

double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

std::string metric_text(double value, std::string_view unit) {
  if (std::isnan(value)) return "–";
  return significant_digits(value, 4) + (unit.empty() ? "" : " " + std::string(unit));
}

/// Whether the metric is one of fields of obstacles, which a map from a file is not.
bool is_of_obstacles(std::string_view metric) {
  return metric == "obstacle_count" || metric == "obstacle_density_1pm2" ||
         metric == "relative_gap_size";
}

/// Metrics of the map, the means of those of its missions, and what the original would say of it.
void add_metrics(const MapChoice& choice, const World& world, const MapOptions& options,
                 Table& table) {
  const TrialSpec& trial = choice.trial;
  const Scene scene(world);
  const std::vector<Mission> listed = missions_of(choice.missions, trial);
  const auto most = static_cast<std::int64_t>(listed.size());
  const std::int64_t count = listed.empty() ? options.missions : std::min(options.missions, most);
  const MapRecord map = make_map_record(trial, scene, count, listed);
  for (const MapMetricDef& metric : map_metric_table()) {
    if (is_from_file(kind(trial.map)) && is_of_obstacles(metric.name)) continue;
    table.rows.push_back(make_row(metric.name, metric_text(metric.value(map), metric.unit)));
  }
  if (options.point_cloud_m) {
    const Traversability measured = traversability_pointcloud(
        world, *options.point_cloud_m, body_measure(to_eigen(trial.vehicle.body_size_m)));
    table.rows.push_back(make_row("traversability_pointcloud", metric_text(measured.value, "")));
    table.rows.push_back(make_row("traversability_pointcloud_normalized_ratio",
                                  metric_text(measured.normalized_ratio, "")));
  }
  std::size_t valid = 0;
  for (const MissionRecord& mission : map.missions) valid += mission.is_valid ? 1 : 0;
  table.rows.push_back(make_row(
      "valid_missions", std::to_string(valid) + " of " + std::to_string(map.missions.size())));
  for (const MissionMetricDef& metric : mission_metric_table()) {
    table.rows.push_back(make_row("mean_" + std::string(metric.name),
                                  metric_text(mission_mean(map, metric.value), metric.unit)));
  }
}

void info(const MapOptions& options) {
  check_output(options.output.output, text(options.output.format));
  const MapChoice choice = choice_of(options);
  const TrialSpec& trial = choice.trial;
  const auto start = std::chrono::steady_clock::now();
  const World world = make_world(trial.map, trial.map_seed);
  const double made_s = seconds_since(start);
  std::map<std::string, std::size_t> counts;
  for (const Obstacle& obstacle : world.obstacles) ++counts[obstacle.kind];
  Table table = make_list({"property", "value"});
  const auto add = [&](const std::string& name, std::string_view value) {
    table.rows.push_back(make_row(name, value));
  };
  add("generator", kind(trial.map));
  add("seed", std::to_string(trial.map_seed));
  for (const auto& [obstacle, count] : counts) add(obstacle + "_count", std::to_string(count));
  add("instance_count", std::to_string(world.instances.size()));
  add("triangle_count", std::to_string(triangle_count(world)));
  add("bounds_m", box_text(world.bounds));
  add("flight_bounds_m", box_text(world.flight_bounds));
  if (!is_from_file(kind(trial.map))) {
    add("mean_obstacle_width_m", fixed_digits(world.mean_obstacle_width_m, 4));
  }
  add("memory_mb", fixed_digits(static_cast<double>(memory_bytes(world)) / 1e6, 1));
  const auto measuring = std::chrono::steady_clock::now();
  if (options.missions > 0) add_metrics(choice, world, options, table);
  const double measured_s = seconds_since(measuring);
  add("digest", world.digest);
  write_table(table, options.output);
  std::cerr << "made in " << fixed_digits(1000.0 * made_s, 0) << " ms, measured in "
            << fixed_digits(1000.0 * measured_s, 0) << " ms\n";
}

void export_map(const MapOptions& options) {
  const TrialSpec trial = choice_of(options).trial;
  const World world = make_world(trial.map, trial.map_seed);
  const auto cells = [&] { return surface_voxels(world, options.resolution_m); };
  if (options.export_as == "mesh") export_mesh(world, options.file);
  if (options.export_as == "cloud") export_point_cloud(cells(), options.file);
  if (options.export_as == "occupancy") export_occupancy(cells(), options.file);
  std::cerr << "wrote " << options.file << '\n';
}

void add_map_options(CLI::App& command, MapOptions& options) {
  command
      .add_option(
          "map", options.spec,
          "Generator (see maps list), sweep file, file with a map's fields, or built-in sweep")
      ->required();
  command.add_option("--seed", options.seed, "Map seed (default: that of the file, else 1)");
  add_overrides(command, options.overrides, "poisson_radius_m=3");
}

}  // namespace

void add_maps_command(CLI::App& app) {
  const auto options = std::make_shared<MapOptions>();
  CLI::App* command = app.add_subcommand("maps", "List generators; draw, measure and export maps");
  command->footer(
      "For a sweep with several maps, the first is used; --set and --seed choose another.\n\n"
      "Examples:\n"
      "  avoidbench maps show forest --set poisson_radius_m=3 --view top --png forest.png\n"
      "  avoidbench maps show hall --page hall.html\n"
      "  avoidbench maps info hall_small --seed 2\n"
      "  avoidbench maps export maze maze.glb\n"
      "  avoidbench maps find forest --metric traversability --value 12 --within 0.5");
  CLI::App* show_command = command->add_subcommand("show", "Draw a map as a PNG file");
  add_map_options(*show_command, *options);
  add_choice(*show_command, "--view", options->view.name, map_view_names(),
             "top (a plan coloured by height, with a mission's reference path), bird, "
             "first_person, or depth (what the mission's camera sees at its start)");
  CLI::Option* png = show_command->add_option("--png", options->png, "File to write");
  add_typed(*show_command, "--page", options->page, "FILE",
            "Write a page instead of a picture: one HTML file with the map in 3-D")
      ->excludes(png);
  add_number(*show_command, "--mission", options->view.mission_index, CLI::Range(0, 1'000'000),
             "Mission of top, first_person and depth");
  CLI::Option* width = add_number(
      *show_command, "--width", options->view.width_px, CLI::Range(64, 8192),
      "Width, pixels; if neither width nor height is given, a plan (top) has the map's shape");
  CLI::Option* height = add_number(*show_command, "--height", options->view.height_px,
                                   CLI::Range(64, 8192), "Height, pixels");
  add_number(*show_command, "--samples", options->view.samples, CLI::Range(1, 8),
             "Rays per side of each pixel");
  show_command->callback([options, width, height] {
    options->has_size = width->count() + height->count() > 0;
    show(*options);
  });
  CLI::App* info_command =
      command->add_subcommand("info", "Counts, bounds, memory, metrics and digest of a map");
  add_map_options(*info_command, *options);
  add_number(*info_command, "--missions", options->missions, CLI::Range(0, 100'000),
             "Missions to measure; 0: no metrics at all");
  add_number(*info_command, "--point-cloud", options->point_cloud_m, CLI::Range(0.02, 5.0),
             "Also compute traversability as the original does, from a point cloud of this "
             "resolution, m (default: off)");
  add_output_options(*info_command, options->output);
  info_command->callback([options] { info(*options); });
  CLI::App* export_command = command->add_subcommand(
      "export", "Write a map for other programs: x, y, z in metres, z up (glTF: y up)");
  add_map_options(*export_command, *options);
  export_command->add_option("file", options->file, "File to write; its extension sets the format")
      ->required();
  add_choice(*export_command, "--as", options->export_as, {"mesh", "cloud", "occupancy"},
             "mesh (.glb, .obj, .ply, .stl), cloud (.ply: centres of the cells that surfaces "
             "touch) or occupancy (.npy with a .json next to it)");
  add_number(*export_command, "--resolution", options->resolution_m, CLI::Range(0.01, 10.0),
             "Size of a cell, m");
  export_command->callback([options] { export_map(*options); });
  add_maps_list_command(*command);
  add_maps_find_command(*command);
}

}  // namespace avoidbench
