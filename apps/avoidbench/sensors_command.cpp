#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <iostream>
#include <optional>
#include <span>
#include <sstream>

#include "base/input_error.hpp"
#include "base/number_text.hpp"
#include "base/words.hpp"
#include "commands.hpp"
#include "config/sweep_file.hpp"
#include "output.hpp"
#include "report/table_rows.hpp"
#include "trial/sensor_errors.hpp"
#include "view/map_views.hpp"
#include "view/sensor_sheet.hpp"
#include "yaml/yaml_values.hpp"

namespace avoidbench {
namespace {

struct SensorOptions {
  std::vector<std::string> sensors;
  std::string map = "forest";
  std::vector<std::string> overrides;
  std::optional<std::uint64_t> seed;
  std::int64_t mission_index = 0, missions = 5;
  std::vector<double> pose;  ///< x, y, z, yaw in degrees
  std::string png = "sensor.png", view = "sheet";
  double bin_m = 3.0;
  std::string over;  ///< a field and values to measure at
  std::string kind;  ///< of the obstacles that are looked at; "": all
  OutputOptions output;
};

/// The map with this sensor, a preset's name or a file.
TrialSpec trial_of(const SensorOptions& options, const std::string& sensor) {
  std::vector<std::string> overrides = options.overrides;
  std::string found = sensor;
  if (sensor.find('/') != std::string::npos || sensor.ends_with(".yaml")) {
    found = std::filesystem::absolute(sensor).string();
  }
  overrides.insert(overrides.begin(), "sensor=" + found);
  const MapChoice choice = read_map(options.map, overrides);
  for (const std::string& warning : choice.warnings) std::cerr << "warning: " << warning << "\n";
  TrialSpec trial = choice.trial;
  if (options.seed) trial.map_seed = *options.seed;
  return trial;
}

void show_sensor(const SensorOptions& options) {
  check_output(options.png, "png");
  const TrialSpec trial = trial_of(options, options.sensors.front());
  const World world = make_world(trial.map, trial.map_seed);
  const Scene scene(world);
  Pose T_world_body;
  if (options.pose.empty()) {
    T_world_body = start_pose(scene, trial, options.mission_index);
  } else {
    if (options.pose.size() < 3 || options.pose.size() > 4) {
      throw InputError("--pose: expected X,Y,Z or X,Y,Z,YAW, got " +
                       counted(options.pose.size(), "number"));
    }
    const double yaw_deg = options.pose.size() > 3 ? options.pose[3] : 0.0;
    T_world_body = make_pose({options.pose[0], options.pose[1], options.pose[2]},
                             yaw_rotation(yaw_deg * math::kDegree));
  }
  const SensorSheet sheet =
      make_sensor_sheet(trial.sensor, scene, T_world_body, trial.seed, options.view);
  write_png(sheet.picture, options.png);
  std::cout << sheet.summary;
  std::cerr << "wrote " << options.png << '\n';
}

// Columns of cameras alone, and of lidars alone.
constexpr std::array<std::string_view, 4> kOfCameras{"pixels", "bias_px", "sigma_px", "z2_bf_m"};
constexpr std::array<std::string_view, 3> kOfLidars{"shots", "bias_m", "miss_pct"};

/// Columns of errors, behind that of the value where one is swept.
Table errors_table(const std::string& swept_field) {
  Table table = make_table("errors", "",
                           {{.name = "sensor", .place = Place::words},
                            {.name = "where", .place = Place::words},
                            {.name = "pixels"},
                            {.name = "shots"},
                            {.name = "valid_pct", .decimals = 1},
                            {.name = "bias_px", .decimals = 3},
                            {.name = "sigma_px", .decimals = 3},
                            {.name = "outlier_pct", .decimals = 1},
                            {.name = "bias_m", .decimals = 4},
                            {.name = "sigma_m", .decimals = 3},
                            {.name = "z2_bf_m", .decimals = 3},
                            {.name = "miss_pct", .decimals = 1}});
  if (!swept_field.empty()) table.columns.insert(table.columns.begin(), {.name = swept_field});
  return table;
}

/// Asks for a row of each range of distances up to `range_m`: its name, from, to.
template <class Add>
void add_bins(double bin_m, double range_m, const Add& add) {
  for (int i = 0; i * bin_m < range_m; ++i) {
    const double from_m = i * bin_m;
    const double to_m = std::min(from_m + bin_m, range_m);
    add(number_text(from_m) + "-" + number_text(to_m) + " m", from_m, to_m);
  }
}

/// Rows by distance, overall and near edges; `value` stands in front where one is swept.
void add_camera_rows(const SensorErrors& errors, double bin_m, const Row& value, Table& table) {
  const auto add = [&](const std::string& where, bool edges, double from_m, double to_m) {
    const DepthStatistics s = errors.statistics(edges, from_m, to_m);
    if (s.pixel_count == 0) return;
    table.rows.push_back(make_row(value, errors.sensor.name, where, s.pixel_count, Cell{},
                                  100.0 * s.valid_ratio, s.disparity_bias_px, s.disparity_sigma_px,
                                  100.0 * s.outlier_ratio, Cell{}, s.depth_sigma_m,
                                  s.expected_depth_sigma_m, Cell{}));
  };
  const auto pixels = [](double size_px) {
    return std::isnan(size_px) ? std::string("–") : fixed_digits(size_px, 1);
  };
  const double range_m = errors.sensor.max_range_m;
  add_bins(bin_m, range_m, [&](const std::string& where, double from_m, double to_m) {
    add(where, false, from_m, to_m);
  });
  add("all ~" + pixels(errors.error_size_px) + " px", false, 0.0, range_m);
  add("edges +" + pixels(errors.fattening_px) + " px", true, 0.0, range_m);
}

/// Rows of a lidar by distance, overall, and of shots at nothing that is in range.
void add_lidar_rows(const std::string& name, const LidarErrors& errors, double bin_m,
                    const Row& value, Table& table) {
  const auto add = [&](const std::string& where, const LidarStatistics& s) {
    if (s.shot_count == 0) return;
    table.rows.push_back(make_row(value, name, where, Cell{}, s.shot_count, 100.0 * s.return_ratio,
                                  Cell{}, Cell{}, 100.0 * s.outlier_ratio, s.bias_m, s.sigma_m,
                                  Cell{}, 100.0 * s.miss_share));
  };
  const double least_m = errors.lidar.min_range_m, range_m = errors.lidar.max_range_m;
  const double outlier_m = outlier_error_m(errors.lidar);
  add_bins(bin_m, range_m, [&](const std::string& where, double from_m, double to_m) {
    add(where, lidar_statistics(errors.shots, std::max(from_m, least_m), to_m, outlier_m));
  });
  add("all", lidar_statistics(errors.shots, least_m, range_m, outlier_m));
  add("nothing in range", statistics_beside(errors.shots, least_m, range_m));
}

/// Rows of the sensor's cameras and of each of its lidars.
void add_rows(const SensorErrors& errors, double bin_m, const Row& value, Table& table) {
  add_camera_rows(errors, bin_m, value, table);
  const bool is_lidar = errors.lidars.size() == 1 && rig_cameras(errors.sensor).empty();
  for (std::size_t i = 0; i < errors.lidars.size(); ++i) {
    const std::string name = errors.sensor.name + (is_lidar ? "" : " lidar " + std::to_string(i));
    add_lidar_rows(name, errors.lidars[i], bin_m, value, table);
  }
}

/// Takes these columns out where no row has a value in the first of them.
void drop_unused(Table& table, std::span<const std::string_view> names) {
  const std::size_t first = column_at(table, names.front());
  const bool is_used = std::any_of(table.rows.begin(), table.rows.end(), [&](const Row& row) {
    return !std::holds_alternative<std::monostate>(row[first].value);
  });
  if (is_used || table.rows.empty()) return;
  for (const std::string_view name : names) drop_column(table, column_at(table, name));
}

/// "maps.texture_opacity=1,0.5,0" as its path and values; no values where nothing is swept.
std::pair<std::string, std::vector<double>> swept(const std::string& over) {
  if (over.empty()) return {};
  const std::size_t equals = over.find('=');
  std::vector<double> values;
  std::istringstream list(equals == std::string::npos ? "" : over.substr(equals + 1));
  for (std::string text; std::getline(list, text, ',');) {
    YamlNode scalar;
    scalar.kind = YamlNode::Kind::scalar;
    scalar.scalar = text;
    const std::optional<double> value = number_of(scalar);
    if (!value) throw InputError("--over " + over + ": '" + text + "' is not a number");
    values.push_back(*value);
  }
  if (values.size() < 2) {
    throw InputError("--over " + over + ": expected PATH=VALUE,VALUE,… with two values at least");
  }
  return {over.substr(0, equals), values};
}

void measure(const SensorOptions& options) {
  check_output(options.output.output, text(options.output.format));
  const auto [path, values] = swept(options.over);
  Table table = errors_table(path.substr(path.rfind('.') + 1));
  for (const std::string& name : options.sensors) {
    for (std::size_t i = 0; i < std::max<std::size_t>(1, values.size()); ++i) {
      SensorOptions at_value = options;
      Row value;
      if (!values.empty()) {
        at_value.overrides.push_back(path + "=" + number_text(values[i]));
        append(value, values[i]);
      }
      add_rows(measure_sensor(trial_of(at_value, name), options.missions, options.kind),
               options.bin_m, value, table);
    }
  }
  drop_unused(table, kOfLidars);
  drop_unused(table, kOfCameras);
  write_table(table, options.output);
}

void list_sensors(const OutputOptions& options) {
  Table table = make_list({"sensor", "kind", "pixels", "fov_x_deg", "rate_hz", "delay_ms",
                           "baseline_m", "range_m", "cameras"});
  for (const SensorSpec& s : sensor_presets()) {
    if (rig_cameras(s).empty()) {
      const LidarSpec& lidar = s.lidars.front();
      table.rows.push_back(
          make_row(s.name, kind(lidar.scan), std::to_string(shots_per_sweep(lidar)) + " shots",
                   "360", number_text(lidar.rate_hz), number_text(lidar.delay_ms), "–",
                   number_text(lidar.min_range_m) + "-" + number_text(lidar.max_range_m), 0));
      continue;
    }
    table.rows.push_back(make_row(
        s.name, kind(s.method), std::to_string(s.width_px) + "x" + std::to_string(s.height_px),
        number_text(s.fov_x_deg), number_text(s.rate_hz), number_text(s.delay_ms),
        number_text(s.baseline_m), number_text(s.min_range_m) + "-" + number_text(s.max_range_m),
        1 + s.more_mountings.size()));
  }
  write_table(table, options);
}

void add_map_options(CLI::App& command, SensorOptions& options) {
  add_typed(command, "--map", options.map, "FILE|NAME", "Map or sweep file, or a generator's name");
  command.add_option("--seed", options.seed, "Map seed (default: the map's first)");
  add_overrides(command, options.overrides, "maps.texture_opacity=0.5 or sensor.width_px=640");
}

}  // namespace

void add_sensors_command(CLI::App& app) {
  CLI::App* command =
      app.add_subcommand("sensors", "List cameras and lidars, show and measure what they see");
  command->require_subcommand(1);
  command->footer(
      "Examples:\n"
      "  avoidbench sensors list\n"
      "  avoidbench sensors show stereo_sgm --map hall --png stereo.png\n"
      "  avoidbench sensors show my_camera.yaml --map forest --pose 20,5,2,90\n"
      "  avoidbench sensors show mid360_like --map forest --png sweep.png\n"
      "  avoidbench sensors measure stereo_sgm depth_noisy --map hall --set "
      "maps.texture_opacity=0.5\n"
      "  avoidbench sensors measure stereo_sgm --map hall --of cylinder "
      "--over maps.texture_opacity=1,0.5,0.25,0 --format csv");

  const auto [list_command, list_options] =
      add_command(*command, "list", "The sensors that are built in", list_sensors);
  add_output_options(list_command, list_options);

  const auto [show_command, show_options] =
      add_command(*command, "show",
                  "Picture of what a sensor sees: left, right, disparity, depth, truth, error; of "
                  "lidars a sweep",
                  show_sensor);
  add_typed(show_command, "sensor", show_options.sensors, "NAME|FILE",
            "A built-in sensor's name, or a file")
      ->required()
      ->expected(1);
  add_map_options(show_command, show_options);
  add_repeatable(show_command, "--pose", show_options.pose, "X,Y,Z[,YAW]",
                 "Where the body is: x,y,z in metres and yaw in degrees "
                 "(default: the start of --mission)")
      ->delimiter(',');
  add_number(show_command, "--mission", show_options.mission_index, CLI::NonNegativeNumber,
             "Which mission's start");
  add_choice(show_command, "--view", show_options.view, sensor_view_names(),
             "All pictures (sheet), or one of them: left, right, color, disparity, depth, truth or "
             "error");
  show_command.add_option("--png", show_options.png, "File to write");

  const auto [measure_command, measure_options] = add_command(
      *command, "measure",
      "Errors of sensors against the truth, by distance, along missions of a map", measure);
  measure_command.footer(
      "Columns of cameras: valid_pct not NaN; bias_px, sigma_px mean and standard deviation of "
      "disparity errors up to 1 px, outlier_pct those beyond;\nsigma_m that deviation in depth, "
      "z2_bf_m what follows for it from sigma_px by Z^2/(baseline * focal length).\nRows: by "
      "distance away from steps in depth; all ~N px: errors within N px are alike; edges +N px: "
      "near things look N px wider.\n"
      "Columns of lidars: valid_pct of the shots come back; outlier_pct of those err by more than "
      "5 range_sigma_m and 0.1 m;\n"
      "bias_m, sigma_m mean and standard deviation of the others' errors; miss_pct of all misses "
      "are among these shots.\n"
      "Rows: by distance to the first surface along the reported direction; nothing in range: "
      "returns here are false.");
  add_typed(measure_command, "sensors", measure_options.sensors, "NAME|FILE",
            "Built-in sensors' names, or files")
      ->required();
  add_map_options(measure_command, measure_options);
  add_number(measure_command, "--missions", measure_options.missions, CLI::Range(1, 10000),
             "Missions, with four views each");
  add_number(measure_command, "--bin", measure_options.bin_m, CLI::Range(0.1, 1000.0),
             "Width of the rows' distance ranges, m");
  add_typed(measure_command, "--of", measure_options.kind, "KIND",
            "Measure only obstacles of this kind, as `maps info` counts them: cylinder, tree, … "
            "(default: everything)");
  add_typed(measure_command, "--over", measure_options.over, "PATH=VALUES",
            "Measure at several values of a field, as in maps.texture_opacity=1,0.5,0 "
            "(default: at the map's own)");
  add_output_options(measure_command, measure_options.output);
}

}  // namespace avoidbench
