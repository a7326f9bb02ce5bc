#include "config/map_files.hpp"

#include "base/digest.hpp"
#include "config/sweep_axes.hpp"
#include "wind/wind_field.hpp"
#include "yaml/includes.hpp"
#include "yaml/overrides.hpp"

namespace avoidbench {
namespace {

namespace fs = std::filesystem;

/// A field of TrialSpec as a sweep file names it.
std::string shown(const std::string& path) {
  return path.starts_with("map.") ? "maps." + path.substr(4) : path;
}

/// The value of the key `path`, of the blocks or of `axes`: where a problem with it stands.
const YamlNode& place_of(const YamlNode& root, const std::string& path) {
  const YamlNode* axis = axis_key(root, path);
  return axis != nullptr ? *axis : node_near(root, shown(path));
}

std::string absolute(const std::string& path, const std::string& file, const YamlNode& place,
                     Reading& reading) {
  const fs::path given(file);
  // Relative to the file that says so; what the command line gives, to where it was typed.
  const fs::path folder = folder_of(place, ".");
  const fs::path found =
      fs::absolute(given.is_absolute() ? given : folder / given).lexically_normal();
  std::error_code error;
  if (!fs::exists(found, error)) {
    reading.problems.push_back(problem_at(place, shown(path) + ": no file " + found.string()));
  } else if (!fs::is_regular_file(found, error)) {
    reading.problems.push_back(
        problem_at(place, shown(path) + ": is no plain file: " + found.string()));
  }
  return found.string();
}

const Axis* axis_of(const SweepSpec& sweep, const std::string& path) {
  for (const Axis& axis : sweep.axes) {
    if (axis.path == path) return &axis;
  }
  return nullptr;
}

void add_problems(const InputError& error, const std::string& path, const YamlNode& root,
                  Reading& reading) {
  for (const InputProblem& problem : error.problems()) {
    reading.problems.push_back(
        problem_at(place_of(root, path), shown(path) + ": " + text(problem)));
  }
}

/// `block` is "map" or "wind.field".
void fill_digest(const std::string& block, const std::string& file, std::string& file_digest_field,
                 const YamlNode& root, Reading& reading) {
  try {
    const std::string digest = file_digest(file);
    if (file_digest_field.empty()) file_digest_field = digest;
    if (file_digest_field == digest) return;
    const std::string path = block + ".file_digest";
    reading.problems.push_back(
        problem_at(place_of(root, path), shown(path) + ": is not that of " + file + ", " + digest));
  } catch (const InputError& error) {
    add_problems(error, block + ".file", root, reading);
  }
}

}  // namespace

void resolve_map_files(const YamlNode& root, SweepSpec& sweep, Reading& reading) {
  const FileOfMap map = file_of(sweep.base.map);
  if (map.file == nullptr || map.file->empty()) return;
  const std::size_t before = reading.problems.size();
  const std::string path = "map.file";
  const YamlNode& place = place_of(root, path);
  *map.file = absolute(path, *map.file, place, reading);
  for (Axis& axis : sweep.axes) {
    if (axis.path != path) continue;
    for (nlohmann::json& value : axis.values) {
      value = absolute(path, value.get<std::string>(), place, reading);
    }
  }
  if (axis_of(sweep, "map_seed") != nullptr) {
    reading.problems.push_back(
        problem_at(node_near(root, "maps.seeds"),
                   "maps.seeds: a map from a file is the same for every seed; leave one"));
  }
  if (reading.problems.size() > before) return;
  if (axis_of(sweep, "map.file") == nullptr) {
    return fill_digest("map", *map.file, *map.digest, root, reading);
  }
  if (map.digest->empty()) return;
  reading.problems.push_back(problem_at(place_of(root, "map.file_digest"),
                                        "maps.file_digest: can't be that of several files"));
}

void resolve_wind_file(const YamlNode& root, SweepSpec& sweep, Reading& reading) {
  const std::string path = "wind.field.file";
  const YamlNode& place = place_of(root, path);
  const auto resolve = [&](const std::string& file) {
    if (file.empty()) return file;
    const std::size_t before = reading.problems.size();
    std::string found = absolute(path, file, place, reading);
    if (reading.problems.size() > before) return found;
    try {
      read_wind_field(found, "");
    } catch (const InputError& error) {
      add_problems(error, path, root, reading);
    }
    return found;
  };
  WindFieldSpec& field = sweep.base.wind.field;
  const bool is_axis = axis_of(sweep, path) != nullptr;
  const std::size_t before = reading.problems.size();
  if (!is_axis) field.file = resolve(field.file);
  for (Axis& axis : sweep.axes) {
    if (axis.path != path) continue;
    for (nlohmann::json& value : axis.values) value = resolve(value.get<std::string>());
    field.file = axis.values.front().get<std::string>();
  }
  if (reading.problems.size() > before) return;
  if (!is_axis && !field.file.empty()) {
    return fill_digest("wind.field", field.file, field.file_digest, root, reading);
  }
  if (!is_axis || field.file_digest.empty()) return;
  reading.problems.push_back(problem_at(place_of(root, "wind.field.file_digest"),
                                        "wind.field.file_digest: can't be that of several files"));
}

void resolve_latency_file(const YamlNode& root, SweepSpec& sweep, Reading& reading) {
  const std::string path = "latency.database";
  const YamlNode& place = place_of(root, path);
  const auto resolve = [&](const std::string& file) {
    return file.empty() ? file : absolute(path, file, place, reading);
  };
  sweep.base.latency.database = resolve(sweep.base.latency.database);
  for (Axis& axis : sweep.axes) {
    if (axis.path != path) continue;
    for (nlohmann::json& value : axis.values) value = resolve(value.get<std::string>());
    sweep.base.latency.database = axis.values.front().get<std::string>();
  }
}

}  // namespace avoidbench
