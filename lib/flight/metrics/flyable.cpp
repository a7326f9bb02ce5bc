#include "metrics/flyable.hpp"

#include <algorithm>

#include "base/input_error.hpp"
#include "base/number_text.hpp"
#include "metrics/map_record.hpp"

namespace avoidbench {
namespace {

/// The missions that can be flown: with a way between start and goal.
std::int64_t flyable_missions(const TrialSpec& trial, std::int64_t mission_count) {
  const World world = make_world(trial.map, trial.map_seed);
  const MapRecord record = make_map_record(trial, Scene(world), mission_count);
  return std::count_if(record.missions.begin(), record.missions.end(),
                       [](const MissionRecord& mission) { return mission.is_valid; });
}

/// Null where the map is not read from a file.
UpAxis* up_axis_of(MapSpec& map) {
  return std::visit(
      [](auto& spec) -> UpAxis* {
        if constexpr (requires { spec.up_axis; }) return &spec.up_axis;
        return nullptr;
      },
      map);
}

std::string size_text(const Eigen::Vector3d& size_m) {
  return fixed_digits(size_m.x(), 1) + " × " + fixed_digits(size_m.y(), 1) + " × " +
         fixed_digits(size_m.z(), 1) + " m";
}

/// Another axis of the file with which most missions are as `count` counts them; "" if there is
/// none.
template <class Count>
std::string other_axis(TrialSpec trial, std::int64_t mission_count, Count count) {
  UpAxis& axis = *up_axis_of(trial.map);
  const UpAxis given = axis;
  for (const auto& [other, name] : EnumText<UpAxis>::entries) {
    if (other == given) continue;
    axis = other;
    try {
      const std::int64_t good = count(trial, mission_count);
      if (2 * good < mission_count) continue;
      return "; with up_axis: " + std::string(name) + " " + std::to_string(good) + " of " +
             std::to_string(mission_count) + " can: if the file's " + std::string(name) +
             " axis points up" + (other == UpAxis::y ? ", as in most glTF and OBJ files" : "") +
             ", set that";
    } catch (const InputError&) {
      continue;  // no map that way up
    }
  }
  return "";
}

}  // namespace

std::int64_t placed_missions(const TrialSpec& trial, std::int64_t mission_count) {
  const World world = make_world(trial.map, trial.map_seed);
  const Scene scene(world);
  std::int64_t count = 0;
  for (std::int64_t index = 0; index < mission_count; ++index) {
    count += make_mission(scene, trial.mission, trial.seed, index) ? 1 : 0;
  }
  return count;
}

std::string unflyable_hint(const TrialSpec& trial, std::int64_t mission_count) {
  constexpr std::int64_t kTried = 5;
  const std::int64_t tried = std::clamp<std::int64_t>(mission_count, 1, kTried);
  // Two causes with unlike remedies: no place for a start or goal, or no way between them.
  const bool is_placed = placed_missions(trial, tried) > 0;
  std::string hint = is_placed ? "no way leads from a start to its goal"
                               : "no start or goal has " + shortest(trial.mission.free_radius_m) +
                                     " m of free space around it (mission.free_radius_m)";
  TrialSpec copy = trial;
  std::string axis;
  // With a file's map the wrong axis may point up.
  if (const UpAxis* up = up_axis_of(copy.map)) {
    const World world = make_world(trial.map, trial.map_seed);
    hint += "; the map spans " + size_text(world.bounds.sizes()) +
            " with up_axis: " + std::string(text(*up));
    axis = is_placed ? other_axis(trial, tried, flyable_missions)
                     : other_axis(trial, tried, placed_missions);
  }
  if (!axis.empty()) return hint + axis;
  return hint + (is_placed ? "; open the map, or move the start and goal regions"
                           : "; make the map sparser, the radius smaller, or the start and goal "
                             "regions larger");
}

}  // namespace avoidbench
