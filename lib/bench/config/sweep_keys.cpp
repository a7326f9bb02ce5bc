#include "config/sweep_keys.hpp"

#include <algorithm>
#include <array>
#include <iterator>
#include <utility>

#include "base/words.hpp"

namespace avoidbench {
namespace {

using Facts = std::vector<std::pair<std::string, std::string>>;

/// A key of sweep files that is no field of a spec.
FieldTree own_key(std::string name, FieldKind kind, std::string doc, Facts facts) {
  FieldTree tree;
  tree.name = std::move(name);
  tree.kind = kind;
  tree.doc = std::move(doc);
  tree.facts = std::move(facts);
  return tree;
}

FieldTree mission_list_key() {
  FieldTree key = own_key(
      "list", FieldKind::other,
      "Your own missions instead of generated ones: start and goal, x y z in metres in the map's "
      "frame, or goals, a list of places to reach in order; yaw_deg at the start, by default "
      "toward the first goal; map, if each map has its own missions: a file's name, or a seed.",
      {{"type",
        "a list of {start: [x, y, z], goal: [x, y, z] or goals: [[x, y, z], …], yaw_deg: number, "
        "map: name}"},
       {"default", "missions are generated, in the map's start and goal regions"},
       {"example", "mission: {list: [{start: [2, 1, 1.5], goal: [20, 12, 1.5]}]}"},
       {"or", "mission: {list: [{start: [2, 1, 1.5], goal: [20, 12, 2], yaw_deg: 90}]}"},
       {"axis", "no: all missions are flown for each setting"},
       {"see", "docs/sweep_files.md, Missions of your own"}});
  using Position = std::array<double, 3>;
  const Range places_m{-kFarthestPlace_m, kFarthestPlace_m};
  FieldTree element;
  element.fields = {
      FieldCollector::described("map", std::string(), {}, "Its map; default: every map."),
      FieldCollector::described("start", Position{}, places_m, "Where it begins, hovering, m."),
      FieldCollector::described("goal", Position{}, places_m, "The goal, m."),
      FieldCollector::described("goals", std::vector<Position>{}, places_m,
                                "Instead of goal: several goals, in order, m."),
      FieldCollector::described(
          "yaw_deg", 0.0, Range{-360, 360},
          "Heading at the start, from x toward y; default: to the first goal.")};
  key.fields.push_back(std::move(element));
  return key;
}

/// The keys of sweep files that are no fields of a spec.
std::vector<FieldTree> own_keys() {
  return {
      own_key("include", FieldKind::other,
              "A file, or a list of them, whose keys apply where this file does not set them; "
              "relative to this file's folder.",
              {{"type", "a file, or a list of them"},
               {"example", "include: base.yaml"},
               {"or", "include: [forest.yaml, windy.yaml]"},
               {"merging",
                "mappings merge key by key, other values are replaced; later files win over "
                "earlier ones, this file over all"},
               {"to take out", "write the key with ~ for its value"}}),
      own_key("until", FieldKind::text,
              "When a planner has flown enough, as in 'success_rate ci<0.05': its rate is known to "
              "± 0.05 (95 %). Checked after each tenth of the trials; default: all are flown.",
              {{"type", "a rule"},
               {"default", "none: all trials are flown"},
               {"axis", "no: it is the sweep's"},
               {"example", "until: success_rate ci<0.05"}}),
      own_key(
          "planners", FieldKind::other,
          "The planners to compare: names, or {plugin: NAME or ./FILE, label, parameters: {name: "
          "value or list}, camera, filter, max_speed_mps}.",
          {{"type", "a name or mapping, or a list of them"},
           {"example", "planners: [straight_line, reactive]"},
           {"or", "planners: [{plugin: ./my_planner.so, label: mine}, ./my_planner.py]"},
           {"filter", "planners: [{plugin: ego, filter: stopping_distance}]"},
           {"axis", "planners: [{plugin: reactive, parameters: {margin_m: [0.3, 0.6]}}]"},
           {"see",
            "avoidbench planners list, planners describe NAME, config explain NAME.PARAMETER"}}),
      own_key("max_speed_mps", FieldKind::number,
              "Speed limit of all planners that are given none; a list compares speeds. Default: "
              "each planner's own.",
              {{"type", "number in m/s"},
               {"default", "each planner's own"},
               {"example", "max_speed_mps: 3"},
               {"axis", "max_speed_mps: [2, 4]"}}),
      mission_list_key(),
      own_key("file", FieldKind::other,
              "The same from a table: a CSV file with the columns start_x_m, start_y_m, start_z_m, "
              "goal_x_m, goal_y_m, goal_z_m and optionally yaw_deg, map and those of further "
              "goals, goal2_x_m, goal2_y_m, goal2_z_m, goal3_x_m ….",
              {{"type", "a file, relative to the one that names it"},
               {"default", "none"},
               {"example", "mission: {file: missions.csv}"},
               {"axis", "no: all missions are flown for each setting"},
               {"see", "docs/sweep_files.md, Missions of your own"}}),
      own_key("axes", FieldKind::other,
              "Any field above by its path, with the values to try: each combination of axes is "
              "flown.",
              {{"type", "a mapping of paths to values"},
               {"example", "axes: {wind.mean_world_mps: [[0, 0, 0], [4, 0, 0]]}"},
               {"or", "axes: {vehicle.mass_kg: {from: 0.7, to: 0.9, count: 3}}"},
               {"not", "maps.generator, sensor.kind, trials, planners"}})};
}

/// A block with the key `preset` for these specs; the first is the default.
template <class Spec>
FieldTree with_preset(FieldTree block, const std::vector<Spec>& built_in) {
  FieldTree key =
      own_key("preset", FieldKind::other,
              "The values of keys that are not given: a built-in name, or the name of a file.", {});
  for (const Spec& spec : built_in) {
    key.choices.push_back(spec.name);
    key.named.push_back(spec_to_json(spec));
  }
  key.preset = key.choices.front();
  block.fields.insert(block.fields.begin(), std::move(key));
  return block;
}

/// Elements of more_cameras and lidars may be names, too.
FieldTree make_sensor_tree() {
  const std::vector<SensorSpec> built_in = sensor_presets();
  FieldTree tree = with_preset<SensorSpec>(
      field_tree("sensor", SensorSpec{}, "A sensor: fields that differ from `preset`."), built_in);
  for (FieldTree& field : tree.fields) {
    if (field.name == "lidars") {
      field.facts = {
          {"type", "a list of names and mappings, with the keys of a lidar"},
          {"default", "[]"},
          {"example",
           "sensor: {preset: mid360_like, lidars: [{preset: mid360_like, pitch_deg: 20}]}"},
          {"or", "sensor: {preset: d435_like, lidars: [velodyne_16]}"},
          {"axis", "a list of such values"},
          {"see", "docs/lidar.md"}};
      field.fields.front() = with_preset(std::move(field.fields.front()), lidar_presets());
    }
    if (field.name != "more_cameras") continue;
    field.facts = {{"type", "a list of names and mappings, with the keys of a sensor"},
                   {"default", "[]"},
                   {"example", "sensor: {more_cameras: [{preset: d435_like, yaw_deg: 90}]}"},
                   {"or", "sensor: {more_cameras: [d435_like, oak_d_like]}"},
                   {"axis", "a list of such values"},
                   {"see", "docs/sensors.md, Rigs"}};
    // The list's element: a camera that may begin with a preset, too.
    std::vector<CameraSpec> cameras;
    std::copy_if(built_in.begin(), built_in.end(), std::back_inserter(cameras),
                 [](const SensorSpec& sensor) { return !camera_kinds(sensor).empty(); });
    field.fields.front() = with_preset(std::move(field.fields.front()), cameras);
  }
  return tree;
}

/// Two keys stand for others: what they settle can't be given beside them.
FieldTree make_vehicle_tree() {
  FieldTree tree = with_preset<VehicleSpec>(
      field_tree("vehicle", hummingbird_spec(), "A vehicle: fields that differ from `preset`."),
      vehicle_presets());
  for (FieldTree& field : tree.fields) {
    // 0 would make no example, nor would the range's half.
    const auto tell = [&field](const std::string& type, const std::string& one,
                               const std::string& several) {
      const std::string key = field.name + ": ";
      field.facts = {{"type", type},
                     {"default", "0: it follows from the fields that are given"},
                     {"example", "vehicle: {" + key + one + "}"},
                     {"axis", "vehicle: {" + key + several + "}"},
                     {"or", "axes: {vehicle." + key + several + "}"},
                     {"not", "beside " + joined(field.settles)},
                     {"see", "docs/vehicles.md"}};
    };
    if (field.name == "thrust_to_weight") {
      field.settles = {"max_rotor_speed_radps", "max_acceleration_mps2", "max_tilt_rad",
                       "max_jerk_mps3"};
      tell("number, 0 or 1.05 to 15", "4", "{from: 2, to: 5, count: 4}");
    } else if (field.name == "angular_acceleration_radps2") {
      field.settles = {"inertia_kgm2", "max_jerk_mps3"};
      tell("number, rad/s², 0 or 5 to 10000", "80", "[40, 80, 160]");
    }
  }
  return tree;
}

FieldTree make_sweep_tree() {
  // The fields of SweepSpec and the files' own keys, rearranged as sweep files have them.
  std::vector<FieldTree> fields = field_tree("", SweepSpec{}, "").fields;
  for (FieldTree& key : own_keys()) fields.push_back(std::move(key));
  const auto take = [&](std::string_view name) {
    const auto found = std::find_if(fields.begin(), fields.end(),
                                    [&](const FieldTree& field) { return field.name == name; });
    FieldTree taken = std::move(*found);
    fields.erase(found);
    return taken;
  };
  for (const std::string_view filled_in : kFilledIn) take(filled_in);
  FieldTree name = take("sweep"), trials = take("trials"), maps = take("map");
  FieldTree seeds = take("map_seed"), missions = take("list"), mission_file = take("file");
  name.preset = {};
  name.facts = {{"type", "text"}, {"example", "sweep: my_sweep"}};
  trials.facts = {{"type", "whole number"},
                  {"range", "1 to 1000000"},
                  {"default", "10"},
                  {"axis", "no: all missions are flown for each setting"},
                  {"example", "trials: 30"}};
  seeds.name = "seeds";
  seeds.doc = "Map seeds as a list, or how many of them, from 1; each is a map.";
  seeds.facts = {{"type", "how many, or a list or range of them"},
                 {"default", "[1]"},
                 {"example", "maps: {seeds: 3}"},
                 {"axis", "maps: {seeds: [1, 5, 9]}"},
                 {"or", "axes: {maps.seeds: [1, 5, 9]}"}};
  maps.name = "maps";
  maps.fields.push_back(std::move(seeds));

  FieldTree sweep;
  sweep.doc = "A sweep: maps × missions × planners.";
  sweep.fields = {std::move(name), take("include"),  take("seed"),          std::move(trials),
                  take("until"),   take("planners"), take("max_speed_mps"), std::move(maps)};
  for (FieldTree& field : fields) {
    // Those of the trees for files of their own, which know presets.
    if (field.name == "vehicle") field.fields = vehicle_tree().fields;
    if (field.name == "sensor") field.fields = sensor_tree().fields;
    if (field.name == "mission") {
      field.fields.push_back(missions);
      field.fields.push_back(mission_file);
    }
    sweep.fields.push_back(std::move(field));
  }
  return sweep;
}

}  // namespace

const FieldTree& sweep_tree() {
  static const FieldTree tree = make_sweep_tree();
  return tree;
}

const FieldTree& vehicle_tree() {
  static const FieldTree tree = make_vehicle_tree();
  return tree;
}

const FieldTree& sensor_tree() {
  static const FieldTree tree = make_sensor_tree();
  return tree;
}

/// From keys of files to a spec: `maps` is `map` there, and its seeds the field beside it.
SweepSpec sweep_from(nlohmann::json keys) {
  keys["map"] = std::move(keys.at("maps"));
  keys["map_seed"] = keys["map"].at("seeds");
  // Keys that are null were not said: the spec's own value stays.
  nlohmann::json all = spec_to_json(SweepSpec{});
  for (const auto& [name, value] : keys.items()) {
    if (!value.is_null()) all[name] = value;
  }
  return spec_from_json<SweepSpec>(all);
}

FieldTree parameter_tree(const ParameterDef& parameter) {
  FieldTree tree;
  tree.name = parameter.name;
  tree.doc = parameter.doc;
  if (parameter.kind == AB_NUMBER || parameter.kind == AB_INTEGER) {
    tree.kind = parameter.kind == AB_NUMBER ? FieldKind::number : FieldKind::whole;
    tree.range = Range{parameter.lowest, parameter.highest};
    tree.preset = parameter.preset;
  } else {
    tree.kind = parameter.kind == AB_CHOICE ? FieldKind::choice : FieldKind::text;
    tree.choices = parameter.choices;
    tree.preset = parameter.preset_text;
  }
  return tree;
}

std::string trial_path(const std::string& path) {
  if (path == "maps.seed" || path == "maps.seeds") return "map_seed";
  if (path.starts_with("maps.")) return "map." + path.substr(5);
  return path;
}

std::string sweep_path(const std::string& path) {
  if (path == "map" || path.starts_with("map.")) return "maps" + path.substr(3);
  if (path == "map_seed" || path == "maps.seed") return "maps.seeds";
  return path;
}

std::string unit_of(std::string_view name) {
  // The first ending that fits counts, so longer ones stand before their own endings (_per_sqrt_s
  // before _s).
  static constexpr std::array<std::pair<std::string_view, std::string_view>, 24> kUnits{{
      {"_per_sqrt_s", "/√s"},
      {"_radps2", "rad/s²"},
      {"_radps", "rad/s"},
      {"_mps3", "m/s³"},
      {"_mps2", "m/s²"},
      {"_mps", "m/s"},
      {"_kgpm", "kg/m"},
      {"_kgps", "kg/s"},
      {"_kgm2", "kg m²"},
      {"_kgm", "kg m"},
      {"_ns2", "N s²"},
      {"_percent", "%"},
      {"_pct", "%"},
      {"_deg", "deg"},
      {"_rad", "rad"},
      {"_kg", "kg"},
      {"_hz", "Hz"},
      {"_px", "px"},
      {"_ms", "ms"},
      {"_pa", "Pa"},
      {"_m", "m"},
      {"_s", "s"},
      {"_n", "N"},
      {"_e", "electrons"},
  }};
  for (const auto& [ending, unit] : kUnits) {
    if (!name.ends_with(ending)) continue;
    // deg_per_sqrt_s: what stands above the root is the unit before.
    const std::string above =
        ending == "_per_sqrt_s" ? unit_of(name.substr(0, name.size() - ending.size())) : "";
    return above + std::string(unit);
  }
  return name == "ms" ? "ms" : "";
}

}  // namespace avoidbench
