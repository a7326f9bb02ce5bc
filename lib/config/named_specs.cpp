#include "config/named_specs.hpp"

#include <set>

#include "yaml/includes.hpp"

namespace avoidbench {
namespace {

namespace fs = std::filesystem;

/// A kind of spec that has files and built-in presets.
template <class Spec>
struct Shelf {
  std::string path;    ///< the key in a sweep file
  std::string folder;  ///< of its files
  std::vector<std::pair<std::string, Spec>> built_in;
};

Shelf<VehicleSpec> vehicles() {
  Shelf<VehicleSpec> shelf{"vehicle", "vehicles", {}};
  for (const VehicleSpec& spec : {hummingbird_spec(), hummingbird_rotors_spec(), firefly_spec()}) {
    shelf.built_in.emplace_back(spec.name, spec);
  }
  return shelf;
}

Shelf<SensorSpec> sensors() {
  Shelf<SensorSpec> shelf{"sensor", "sensors", {}};
  for (const SensorSpec& spec : sensor_presets()) shelf.built_in.emplace_back(spec.name, spec);
  return shelf;
}

/// The file that `name` means, or "" where it is a built-in one or unknown.
fs::path file_of(const std::string& name, const std::string& folder, const fs::path& base_folder) {
  const bool is_path = name.find('/') != std::string::npos || name.ends_with(".yaml");
  if (is_path) return fs::path(name).is_absolute() ? fs::path(name) : base_folder / name;
  std::error_code error;
  for (const fs::path& place : {base_folder / folder, base_folder / ".." / folder}) {
    const fs::path file = (place / (name + ".yaml")).lexically_normal();
    if (fs::is_regular_file(file, error)) return file;
  }
  return {};
}

/// Names of the built-in ones and of the files.
template <class Spec>
std::vector<std::string> known_names(const Shelf<Spec>& shelf, const fs::path& base_folder) {
  std::set<std::string> names;
  for (const auto& [name, spec] : shelf.built_in) names.insert(name);
  std::error_code error;
  for (const fs::path& place : {base_folder / shelf.folder, base_folder / ".." / shelf.folder}) {
    for (const auto& entry : fs::directory_iterator(place, error)) {
      if (entry.path().extension() == ".yaml") names.insert(entry.path().stem().string());
    }
  }
  return {names.begin(), names.end()};
}

template <class Spec>
void read_shelved(const Shelf<Spec>& shelf, const YamlNode& node, const fs::path& base_folder,
                  int level, Spec& spec, Reading& reading);

/// Reads the spec that a name stands for.
template <class Spec>
void read_name(const Shelf<Spec>& shelf, const YamlNode& node, const fs::path& base_folder,
               int level, Spec& spec, Reading& reading) {
  constexpr int kMostLevels = 8;
  const fs::path folder = folder_of(node, base_folder);
  const fs::path file = file_of(node.scalar, shelf.folder, folder);
  if (!file.empty()) {
    if (level >= kMostLevels) {
      reading.problems.push_back(problem_at(node, shelf.path + ": presets lead in a circle"));
      return;
    }
    try {
      const YamlNode root = read_document(file).root;
      const bool lists_were_axes = reading.lists_are_axes;
      reading.lists_are_axes = false;
      read_shelved(shelf, root, file.parent_path(), level + 1, spec, reading);
      reading.lists_are_axes = lists_were_axes;
    } catch (const InputError& error) {
      for (const InputProblem& problem : error.problems()) {
        const bool has_place = problem.line > 0;
        reading.problems.push_back(has_place ? problem
                                             : problem_at(node, shelf.path + ": " + text(problem)));
      }
    }
    return;
  }
  for (const auto& [name, built_in] : shelf.built_in) {
    if (name == node.scalar) {
      spec = built_in;
      return;
    }
  }
  const std::vector<std::string> names = known_names(shelf, folder);
  std::string all;
  for (const std::string& name : names) all += (all.empty() ? "" : ", ") + name;
  reading.problems.push_back(problem_at(node, shelf.path + ": " + found_text(node) + " is no " +
                                                  shelf.path + did_you_mean(node.scalar, names) +
                                                  "; known: " + all));
}

template <class Spec>
void read_shelved(const Shelf<Spec>& shelf, const YamlNode& node, const fs::path& base_folder,
                  int level, Spec& spec, Reading& reading) {
  if (node.kind == YamlNode::Kind::scalar && level == 0) {
    return read_name(shelf, node, base_folder, level, spec, reading);
  }
  SpecReader reader(node, shelf.path, reading);
  if (const YamlNode* preset = reader.take("preset")) {
    if (preset->kind == YamlNode::Kind::scalar) {
      read_name(shelf, *preset, base_folder, level, spec, reading);
    } else {
      reading.problems.push_back(problem_at(
          *preset, shelf.path + ".preset: expected a name, found " + found_text(*preset)));
    }
  }
  visit(reader, spec);
  reader.finish();
}

}  // namespace

void read_vehicle(const YamlNode& node, const fs::path& base_folder, VehicleSpec& vehicle,
                  Reading& reading) {
  read_shelved(vehicles(), node, base_folder, 0, vehicle, reading);
}

void read_sensor(const YamlNode& node, const fs::path& base_folder, SensorSpec& sensor,
                 Reading& reading) {
  read_shelved(sensors(), node, base_folder, 0, sensor, reading);
}

}  // namespace avoidbench
