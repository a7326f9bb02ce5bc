#pragma once

#include <algorithm>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

/// Fields of specs are named by dotted paths: "map.poisson_radius_m", "sensor.cameras.0.fov_x_deg".
namespace avoidbench {

/// "sensor", "cameras", "0", "fov_x_deg". A part may be empty.
inline std::vector<std::string_view> parts_of_path(std::string_view path) {
  std::vector<std::string_view> parts;
  while (true) {
    const std::size_t dot = path.find('.');
    parts.push_back(path.substr(0, dot));
    if (dot == std::string_view::npos) return parts;
    path.remove_prefix(dot + 1);
  }
}

/// The field's place in the JSON of a spec.
inline nlohmann::json::json_pointer json_place(std::string_view path) {
  nlohmann::json::json_pointer place;
  for (const std::string_view part : parts_of_path(path)) place /= std::string(part);
  return place;
}

/// "poisson_radius_m" of "map.poisson_radius_m".
inline std::string last_part(std::string_view path) {
  return std::string(parts_of_path(path).back());
}

/// The last part of the path if none of the other `paths` ends so, else all of it.
template <class Paths>
std::string short_name(const std::string& path, const Paths& paths) {
  const std::string last = last_part(path);
  const bool is_shared = std::any_of(paths.begin(), paths.end(), [&](const std::string& other) {
    return other != path && last_part(other) == last;
  });
  return is_shared ? path : last;
}

}  // namespace avoidbench
