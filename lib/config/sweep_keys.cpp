#include "config/sweep_keys.hpp"

#include <array>
#include <utility>

#include "trial/trial_spec.hpp"

namespace avoidbench {
namespace {

FieldTree own_key(std::string name, FieldKind kind, std::string doc, nlohmann::json preset = {}) {
  FieldTree tree;
  tree.name = std::move(name);
  tree.kind = kind;
  tree.doc = std::move(doc);
  tree.preset = std::move(preset);
  return tree;
}

std::vector<FieldTree> head() {
  std::vector<FieldTree> keys;
  keys.push_back(own_key("sweep", FieldKind::text, "Name of the result set: A-Z a-z 0-9 _ . -"));
  keys.push_back(own_key("include", FieldKind::other,
                         "A file, or a list of them, whose keys hold where this file says nothing; "
                         "relative to this file's folder."));
  keys.push_back(
      own_key("trials", FieldKind::whole, "Missions per map, the same for every planner.", 10));
  keys.back().range = Range{1, 1e6};
  keys.push_back(
      own_key("until", FieldKind::text,
              "When a planner has flown enough, as in 'success_rate ci<0.05': its rate is "
              "known to ± 0.05 (95 %). Looked at after each tenth of the trials; left "
              "out: all are flown."));
  keys.push_back(own_key("planners", FieldKind::other,
                         "The planners to compare: names, or {plugin: NAME or ./FILE.so, label, "
                         "parameters: {name: value or list}, max_speed_mps}."));
  keys.push_back(own_key("max_speed_mps", FieldKind::number,
                         "Speed limit of all planners that are given none; a list compares speeds. "
                         "Left out: each planner's own."));
  return keys;
}

/// Adds the key `preset`.
void add_preset(const std::vector<std::string>& built_in, FieldTree& tree) {
  FieldTree key = own_key(
      "preset", FieldKind::other,
      "What holds where no key says otherwise: built in, or the name of a file.", built_in.front());
  key.choices = built_in;
  tree.fields.insert(tree.fields.begin(), std::move(key));
}

}  // namespace

FieldTree sweep_tree() {
  FieldTree sweep;
  sweep.doc = "A sweep: maps × missions × planners.";
  sweep.fields = head();
  const FieldTree trial = field_tree("", TrialSpec{}, "");
  FieldTree seeds = *trial.find("map_seed");
  seeds.name = "seeds";
  seeds.doc = "Map seeds as a list, or how many of them, from 1; each is a map.";
  for (const FieldTree& field : trial.fields) {
    if (field.name == "map_seed" || field.name == "mission_index" || field.name == "planner" ||
        field.name == "latency_digest") {
      continue;
    }
    FieldTree& key = sweep.fields.emplace_back(field);
    if (field.name == "vehicle") key.fields = vehicle_tree().fields;
    if (field.name == "sensor") key.fields = sensor_tree().fields;
    if (field.name != "map") continue;
    key.name = "maps";
    key.fields.push_back(seeds);
  }
  sweep.fields.push_back(own_key("axes", FieldKind::other,
                                 "Any field above by its path, with the values to try: each "
                                 "combination of axes is flown."));
  return sweep;
}

FieldTree vehicle_tree() {
  FieldTree tree =
      field_tree("vehicle", hummingbird_spec(), "A vehicle: fields that differ from `preset`.");
  add_preset({hummingbird_spec().name, hummingbird_rotors_spec().name, firefly_spec().name}, tree);
  return tree;
}

FieldTree sensor_tree() {
  FieldTree tree =
      field_tree("sensor", SensorSpec{}, "A sensor: fields that differ from `preset`.");
  std::vector<std::string> names;
  for (const SensorSpec& sensor : sensor_presets()) names.push_back(sensor.name);
  add_preset(names, tree);
  return tree;
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

std::string unit_of(std::string_view name) {
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
