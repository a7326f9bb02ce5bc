#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iostream>
#include <limits>
#include <memory>
#include <optional>
#include <set>
#include <sstream>

#include "base/input_error.hpp"
#include "base/random.hpp"
#include "commands.hpp"
#include "config/sweep_file.hpp"
#include "line_chart.hpp"
#include "reference_table.hpp"
#include "render/depth.hpp"
#include "sensing/camera.hpp"
#include "sensing/depth_statistics.hpp"
#include "trial/mission.hpp"
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
  std::string over;   ///< a field and values to measure at
  std::string chart;  ///< file of their picture
  std::string kind;   ///< of the obstacles that are looked at; "": all
  TableOptions table;
};

/// Of the numbers among what is added.
struct Mean {
  double sum = 0.0, count = 0.0;
  void add(double value) {
    if (std::isnan(value)) return;
    sum += value;
    count += 1.0;
  }
  double value() const { return sum / count; }
};

std::string fixed(double value, int digits) {
  if (std::isnan(value)) return "–";
  char text[48];
  std::snprintf(text, sizeof text, "%.*f", digits, value);
  return text;
}

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

Mission mission_of(const Scene& scene, const TrialSpec& trial, std::int64_t index) {
  const auto mission = make_mission(scene, trial.mission, trial.seed, index);
  if (!mission) {
    throw InputError("mission " + std::to_string(index) +
                     ": no start or goal with mission.free_radius_m of free space");
  }
  return *mission;
}

void show(const SensorOptions& options) {
  const TrialSpec trial = trial_of(options, options.sensors.front());
  const World world = make_world(trial.map, trial.map_seed);
  const Scene scene(world);
  Pose T_world_body;
  if (options.pose.empty()) {
    const Mission mission = mission_of(scene, trial, options.mission_index);
    T_world_body = make_pose(mission.start_world, yaw_rotation(mission.start_yaw_rad));
  } else {
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

/// Poses of a level body along the straight lines of missions, away from what is near.
std::vector<Pose> poses_of(const Scene& scene, const TrialSpec& trial, std::int64_t missions) {
  std::vector<Pose> poses;
  constexpr double kFree_m = 0.6;
  for (std::int64_t i = 0; i < missions; ++i) {
    const auto mission = make_mission(scene, trial.mission, trial.seed, i);
    if (!mission) continue;
    for (const double part : {0.0, 0.25, 0.5, 0.75}) {
      const Eigen::Vector3d place =
          mission->start_world + part * (mission->goal_world - mission->start_world);
      if (scene.nearest(place, kFree_m).distance_m < kFree_m) continue;
      poses.push_back(make_pose(place, yaw_rotation(mission->start_yaw_rad)));
    }
  }
  return poses;
}

/// What was measured of one sensor on one map.
struct Measured {
  SensorSpec sensor;
  std::vector<DepthSample> samples;
  double fattening_px = 0.0, error_size_px = 0.0;
};

DepthStatistics overall(const Measured& measured) {
  return depth_statistics(measured.samples, false, 0.0, measured.sensor.max_range_m,
                          disparity_at_1m_px(measured.sensor));
}

/// Rows by distance, overall and near edges; `value` stands in front where it is swept.
void add_rows(const Measured& measured, double bin_m, const std::string& value,
              ReferenceTable& table) {
  const auto add = [&](const std::string& where, bool edges, double from_m, double to_m) {
    const DepthStatistics s = depth_statistics(measured.samples, edges, from_m, to_m,
                                               disparity_at_1m_px(measured.sensor));
    if (s.pixel_count == 0) return;
    std::vector<std::string> row{measured.sensor.name,
                                 where,
                                 std::to_string(s.pixel_count),
                                 fixed(100.0 * s.valid_ratio, 1),
                                 fixed(s.disparity_bias_px, 3),
                                 fixed(s.disparity_sigma_px, 3),
                                 fixed(100.0 * s.outlier_ratio, 1),
                                 fixed(s.depth_sigma_m, 3),
                                 fixed(s.expected_depth_sigma_m, 3)};
    if (!value.empty()) row.insert(row.begin(), value);
    table.rows.push_back(std::move(row));
  };
  const double range_m = measured.sensor.max_range_m;
  for (int i = 0; i * bin_m < range_m; ++i) {
    const double from_m = i * bin_m;
    const double to_m = std::min(from_m + bin_m, range_m);
    add(number_text(from_m) + "-" + number_text(to_m) + " m", false, from_m, to_m);
  }
  add("all ~" + fixed(measured.error_size_px, 1) + " px", false, 0.0, range_m);
  add("edges +" + fixed(measured.fattening_px, 1) + " px", true, 0.0, range_m);
}

/// Forgets the truth of pixels that show something else than obstacles of this kind.
void keep_kind(const World& world, const std::string& kind,
               const std::vector<std::uint32_t>& instances, std::vector<float>& truth_m) {
  if (kind.empty()) return;
  for (std::size_t i = 0; i < truth_m.size(); ++i) {
    if (instances[i] == kNoInstance) continue;
    const std::uint32_t obstacle = world.instances[instances[i]].obstacle;
    const bool is_kind =
        obstacle < world.obstacles.size() && world.obstacles[obstacle].kind == kind;
    if (!is_kind) truth_m[i] = std::numeric_limits<float>::infinity();
  }
}

/// Throws InputError where the map has no obstacles of the kind that is asked for.
void check_kind(const World& world, const std::string& kind) {
  if (kind.empty()) return;
  std::set<std::string> kinds;
  for (const Obstacle& obstacle : world.obstacles) kinds.insert(obstacle.kind);
  if (kinds.contains(kind)) return;
  const std::vector<std::string> known(kinds.begin(), kinds.end());
  std::string all;
  for (const std::string& name : known) all += (all.empty() ? "" : ", ") + name;
  throw InputError("--of " + kind + ": the map has none" + did_you_mean(kind, known) +
                   "; it has: " + all);
}

/// One sensor on its trial's map.
Measured measured(const TrialSpec& trial, const SensorOptions& options) {
  const SensorSpec& sensor = trial.sensor;
  const World world = make_world(trial.map, trial.map_seed);
  check_kind(world, options.kind);
  const Scene scene(world);
  Pinhole ideal = sensor_camera(sensor);
  ideal.min_range_m = 0.0;
  ideal.max_range_m = std::numeric_limits<double>::infinity();
  const int width = static_cast<int>(sensor.width_px);
  const double at_1m_px = disparity_at_1m_px(sensor);
  Camera camera(sensor);
  CameraImages images;
  std::vector<float> truth_m(static_cast<std::size_t>(sensor.width_px * sensor.height_px));
  std::vector<std::uint32_t> instances(truth_m.size());
  Measured result{.sensor = sensor, .samples = {}};
  Mean edges, sizes;
  std::uint64_t index = 0;
  for (const Pose& T_world_body : poses_of(scene, trial, options.missions)) {
    for (const MountingSpec& mounting : mountings(sensor)) {
      const Pose T_world_camera = T_world_body * T_body_camera(mounting);
      camera.expose(scene, T_world_camera, {}, {.depth = true}, stream_seed(trial.seed, index++),
                    images);
      render_depth(scene, ideal, T_world_camera, truth_m, instances);
      keep_kind(world, options.kind, instances, truth_m);
      constexpr int kEdge_px = 8;
      add_samples(truth_m, images.depth_m, width, at_1m_px, kEdge_px, result.samples);
      edges.add(fattening_px(truth_m, images.depth_m, width, at_1m_px, kEdge_px));
      sizes.add(error_size_px(truth_m, images.depth_m, width, at_1m_px));
    }
  }
  result.fattening_px = edges.value();
  result.error_size_px = sizes.value();
  return result;
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
    if (!value) throw InputError("--over " + over + ": '" + text + "' is no number");
    values.push_back(*value);
  }
  if (values.size() < 2) {
    throw InputError("--over " + over + ": expected PATH=VALUE,VALUE,… with two values at least");
  }
  return {over.substr(0, equals), values};
}

void measure(const SensorOptions& options) {
  const auto [path, values] = swept(options.over);
  if (!options.chart.empty() && values.empty()) {
    throw InputError("--png needs --over: a chart shows how errors change with a value");
  }
  ReferenceTable table{{"sensor", "where", "pixels", "valid_pct", "bias_px", "sigma_px",
                        "outlier_pct", "sigma_m", "z2_bf_m"},
                       {}};
  if (!values.empty())
    table.columns.insert(table.columns.begin(), path.substr(path.rfind('.') + 1));
  std::vector<ChartPanel> panels{{"valid pixels (%)", {}},
                                 {"disparity errors beyond 1 px (%)", {}},
                                 {"standard deviation of the others (px)", {}}};
  for (const std::string& name : options.sensors) {
    for (ChartPanel& panel : panels) panel.lines.push_back({name, {}});
    const std::size_t count = std::max<std::size_t>(1, values.size());
    for (std::size_t i = 0; i < count; ++i) {
      SensorOptions at_value = options;
      const std::string value = values.empty() ? "" : number_text(values[i]);
      if (!value.empty()) at_value.overrides.push_back(path + "=" + value);
      const Measured result = measured(trial_of(at_value, name), at_value);
      add_rows(result, options.bin_m, value, table);
      if (values.empty()) continue;
      const DepthStatistics s = overall(result);
      panels[0].lines.back().points.emplace_back(values[i], 100.0 * s.valid_ratio);
      panels[1].lines.back().points.emplace_back(values[i], 100.0 * s.outlier_ratio);
      panels[2].lines.back().points.emplace_back(values[i], s.disparity_sigma_px);
    }
  }
  write_table(table, options.table);
  if (options.chart.empty()) return;
  write_png(line_chart(panels, path), options.chart);
  std::cerr << "wrote " << options.chart << '\n';
}

void list(const TableOptions& options) {
  ReferenceTable table{{"sensor", "kind", "pixels", "fov_x_deg", "rate_hz", "delay_ms",
                        "baseline_m", "range_m", "cameras"},
                       {}};
  for (const SensorSpec& s : sensor_presets()) {
    table.rows.push_back({s.name, std::string(kind(s.method)),
                          std::to_string(s.width_px) + "x" + std::to_string(s.height_px),
                          number_text(s.fov_x_deg), number_text(s.rate_hz), number_text(s.delay_ms),
                          number_text(s.baseline_m),
                          number_text(s.min_range_m) + "-" + number_text(s.max_range_m),
                          std::to_string(1 + s.more_mountings.size())});
  }
  write_table(table, options);
}

void add_map_options(CLI::App& command, const std::shared_ptr<SensorOptions>& options) {
  command.add_option("--map", options->map, "Map or sweep file, or a generator's name")
      ->capture_default_str()
      ->type_name("FILE|NAME");
  command.add_option("--seed", options->seed, "Map seed (default: the map's first)");
  command
      .add_option("--set", options->overrides,
                  "Override one value, as in maps.texture_opacity=0.5 or sensor.width_px=640; "
                  "repeatable (default: none)")
      ->type_name("PATH=VALUE")
      ->allow_extra_args(false);
}

}  // namespace

void add_sensors_command(CLI::App& app) {
  const auto options = std::make_shared<SensorOptions>();
  CLI::App* command = app.add_subcommand("sensors", "List cameras, show and measure what they see");
  command->require_subcommand(1);
  command->footer(
      "Examples:\n"
      "  avoidbench sensors list\n"
      "  avoidbench sensors show stereo_sgm --map hall --png stereo.png\n"
      "  avoidbench sensors show my_camera.yaml --map forest --pose 20,5,2,90\n"
      "  avoidbench sensors measure stereo_sgm depth_noisy --map hall --set "
      "maps.texture_opacity=0.5\n"
      "  avoidbench sensors measure stereo_sgm --map hall --of cylinder "
      "--over maps.texture_opacity=1,0.5,0.25,0 --png opacity.png");

  CLI::App* list_command = command->add_subcommand("list", "The sensors that are built in");
  add_table_options(*list_command, options->table);
  list_command->callback([options] { list(options->table); });

  CLI::App* show_command = command->add_subcommand(
      "show", "Picture of what a sensor sees: left, right, disparity, depth, truth, error");
  show_command->add_option("sensor", options->sensors, "A built-in sensor's name, or a file")
      ->required()
      ->expected(1)
      ->type_name("NAME|FILE");
  add_map_options(*show_command, options);
  show_command
      ->add_option("--pose", options->pose,
                   "Where the body is: x,y,z in metres and yaw in degrees "
                   "(default: the start of --mission)")
      ->delimiter(',')
      ->expected(3, 4)
      ->type_name("X,Y,Z[,YAW]");
  show_command->add_option("--mission", options->mission_index, "Which mission's start")
      ->check(CLI::NonNegativeNumber)
      ->capture_default_str();
  show_command->add_option("--view", options->view, "All pictures, or one of them")
      ->check(CLI::IsMember(sensor_view_names()))
      ->capture_default_str();
  show_command->add_option("--png", options->png, "File to write")->capture_default_str();
  show_command->callback([options] { show(*options); });

  CLI::App* measure_command = command->add_subcommand(
      "measure", "Errors of sensors against the truth, by distance, along missions of a map");
  measure_command->footer(
      "Columns: valid_pct not NaN; bias_px, sigma_px mean and standard deviation of disparity "
      "errors "
      "up to 1 px, outlier_pct those beyond;\nsigma_m that deviation in depth, z2_bf_m what "
      "follows "
      "for it from sigma_px by Z^2/(baseline * focal length).\nRows: by distance away from steps "
      "in "
      "depth; all ~N px: errors within N px are alike; edges +N px: near things look N px wider.");
  measure_command->add_option("sensors", options->sensors, "Built-in sensors' names, or files")
      ->required()
      ->type_name("NAME|FILE");
  add_map_options(*measure_command, options);
  measure_command->add_option("--missions", options->missions, "Missions, with four views each")
      ->check(CLI::Range(1, 10000))
      ->capture_default_str();
  measure_command->add_option("--bin", options->bin_m, "Width of the rows' distance ranges, m")
      ->check(CLI::Range(0.1, 1000.0))
      ->capture_default_str();
  measure_command
      ->add_option(
          "--of", options->kind,
          "Look at obstacles of this kind alone, as `maps info` counts them: cylinder, tree, "
          "… (default: everything)")
      ->type_name("KIND");
  measure_command
      ->add_option("--over", options->over,
                   "Measure at several values of a field, as in maps.texture_opacity=1,0.5,0 "
                   "(default: at the map's own)")
      ->type_name("PATH=VALUES");
  measure_command
      ->add_option("--png", options->chart, "Chart over these values to write (default: none)")
      ->type_name("FILE");
  add_table_options(*measure_command, options->table);
  measure_command->callback([options] { measure(*options); });
}

}  // namespace avoidbench
