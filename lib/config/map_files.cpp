#include "config/map_files.hpp"

#include "base/digest.hpp"
#include "config/includes.hpp"
#include "config/overrides.hpp"
#include "config/sweep_axes.hpp"

namespace avoidbench {
namespace {

namespace fs = std::filesystem;

/// The value of the key `path`, of the blocks or of `axes`: where a problem with it stands.
const YamlNode& place_of(const YamlNode& root, const std::string& path) {
  const YamlNode* axis = axis_key(root, path);
  return axis != nullptr ? *axis : node_near(root, "maps." + path.substr(path.find('.') + 1));
}

std::string absolute(const std::string& file, const YamlNode& place, Reading& reading) {
  const fs::path given(file);
  // Relative to the file that says so; what the command line gives, to where it was typed.
  const fs::path folder = folder_of(place, ".");
  const fs::path found =
      fs::absolute(given.is_absolute() ? given : folder / given).lexically_normal();
  std::error_code error;
  if (!fs::exists(found, error)) {
    reading.problems.push_back(problem_at(place, "maps.file: no file " + found.string()));
  } else if (!fs::is_regular_file(found, error)) {
    reading.problems.push_back(problem_at(place, "maps.file: is no plain file: " + found.string()));
  }
  return found.string();
}

const Axis* axis_of(const SweepSpec& sweep, const std::string& path) {
  for (const Axis& axis : sweep.axes) {
    if (axis.path == path) return &axis;
  }
  return nullptr;
}

void fill_digest(const FileOfMap& map, const YamlNode& root, Reading& reading) {
  try {
    const std::string digest = file_digest(*map.file);
    if (map.digest->empty()) *map.digest = digest;
    if (*map.digest == digest) return;
    reading.problems.push_back(
        problem_at(place_of(root, "map.file_digest"),
                   "maps.file_digest: is not that of " + *map.file + ", " + digest));
  } catch (const InputError& error) {
    for (const InputProblem& problem : error.problems()) {
      reading.problems.push_back(
          problem_at(place_of(root, "map.file"), "maps.file: " + text(problem)));
    }
  }
}

}  // namespace

void resolve_map_files(const YamlNode& root, SweepSpec& sweep, Reading& reading) {
  const FileOfMap map = file_of(sweep.base.map);
  if (map.file == nullptr || map.file->empty()) return;
  const std::size_t before = reading.problems.size();
  const YamlNode& place = place_of(root, "map.file");
  *map.file = absolute(*map.file, place, reading);
  for (Axis& axis : sweep.axes) {
    if (axis.path != "map.file") continue;
    for (nlohmann::json& value : axis.values) {
      value = absolute(value.get<std::string>(), place, reading);
    }
  }
  if (axis_of(sweep, "map_seed") != nullptr) {
    reading.problems.push_back(
        problem_at(node_near(root, "maps.seeds"),
                   "maps.seeds: a map from a file is the same for every seed; leave one"));
  }
  if (reading.problems.size() > before) return;
  if (axis_of(sweep, "map.file") == nullptr) return fill_digest(map, root, reading);
  if (map.digest->empty()) return;
  reading.problems.push_back(problem_at(place_of(root, "map.file_digest"),
                                        "maps.file_digest: can't be that of several files"));
}

}  // namespace avoidbench
