#include "maps/map_spec.hpp"

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "base/input_error.hpp"
#include "base/number_text.hpp"
#include "maps/generators.hpp"

namespace avoidbench {
namespace {

std::string number_text(double value) { return significant_digits(value, 6); }

InputProblem problem(std::string message) {
  InputProblem found;
  found.message = std::move(message);
  return found;
}

/// Collects the numbers outside their ranges; NaN is outside every range.
struct RangeCheck {
  std::vector<InputProblem> problems;

  template <class Number>
  void field(std::string_view name, const Number& value, Range range, std::string_view) {
    const auto number = static_cast<double>(value);
    if (number >= range.lowest && number <= range.highest) return;
    std::string shown = number_text(number);
    if constexpr (std::is_integral_v<Number>) shown = std::to_string(value);
    problems.push_back(problem(std::string(name) + ": " + shown + " is outside [" +
                               number_text(range.lowest) + ", " + number_text(range.highest) +
                               "]"));
  }
  template <std::size_t count>
  void field(std::string_view name, const std::array<double, count>& values, Range range,
             std::string_view doc) {
    for (const double& value : values) field(name, value, range, doc);
  }
};

void check_order(std::string_view name, const std::array<double, 2>& ends,
                 std::vector<InputProblem>& problems) {
  if (ends[0] <= ends[1]) return;
  problems.push_back(problem(std::string(name) + ": the least is above the greatest"));
}

/// A flight height or the like that must be below another field.
void check_below(std::string_view name, double value, std::string_view limit_name, double limit,
                 std::vector<InputProblem>& problems) {
  if (value < limit) return;
  problems.push_back(problem(std::string(name) + ": " + number_text(value) + " is not below " +
                             std::string(limit_name) + ", " + number_text(limit)));
}

/// A field has to be two radii wide, or hardly more than one thing stands in it.
void check_room(std::string_view name, const std::array<double, 2>& area_m,
                std::string_view radius_name, double radius_m,
                std::vector<InputProblem>& problems) {
  const double least_side_m = std::min(area_m[0], area_m[1]);
  if (least_side_m >= 2.0 * radius_m) return;
  problems.push_back(problem(std::string(name) + ": its shorter side, " +
                             number_text(least_side_m) + ", is less than twice " +
                             std::string(radius_name) + ", " + number_text(radius_m)));
}

void check_contradictions(const ForestSpec& spec, std::vector<InputProblem>& problems) {
  check_below("flight_height_m", spec.flight_height_m, "height_m", spec.height_m, problems);
  check_room("area_m", spec.area_m, "poisson_radius_m", spec.poisson_radius_m, problems);
}

void check_contradictions(const HallSpec& spec, std::vector<InputProblem>& problems) {
  check_below("flight_height_m", spec.flight_height_m, "height_m", spec.height_m, problems);
  check_room("area_m", spec.area_m, "poisson_radius_m", spec.poisson_radius_m, problems);
  const auto& [least, greatest] = spec.cylinder_diameter_m;
  if (least > greatest) {
    problems.push_back(problem("cylinder_diameter_m: the least diameter is above the greatest"));
  }
  // Middles are at least that far apart.
  if (greatest >= spec.poisson_radius_m) {
    problems.push_back(
        problem("cylinder_diameter_m: cylinders as wide as poisson_radius_m may "
                "overlap; make them thinner or the radius larger"));
  }
  if (spec.shelf_ratio > 0.0 && 2.0 * greatest >= spec.poisson_radius_m) {
    problems.push_back(
        problem("shelf_ratio: shelves, twice as long as cylinder_diameter_m, may overlap at this "
                "poisson_radius_m"));
  }
  check_order("cylinder_height_m", spec.cylinder_height_m, problems);
  check_order("moving_speed_mps", spec.moving_speed_mps, problems);
  if (spec.crates_ratio + spec.shelf_ratio + spec.pillar_ratio > 1.0) {
    problems.push_back(problem("crates_ratio, shelf_ratio and pillar_ratio are more than 1"));
  }
}

/// What both generators after the original have: a field of obstacles, the flight space as a part
/// of it, and bands.
template <class Spec>
void check_suite(const Spec& spec, std::vector<InputProblem>& problems) {
  check_room("field_area_m", spec.field_area_m, "the greatest Poisson radius",
             spec.radius_origin_m + spec.radius_span_m, problems);
  for (std::size_t axis = 0; axis < 2; ++axis) {
    const double lowest_m = spec.range_origin_m[axis];
    if (lowest_m < spec.field_area_m[axis] && lowest_m + spec.range_m[axis] > 0.0) continue;
    problems.push_back(problem("range_origin_m: the flight space is outside the field"));
    break;
  }
  if (spec.band_width_m > spec.range_m[0]) {
    problems.push_back(problem("band_width_m: wider than the flight space of range_m"));
  }
  check_order("start_band_m", spec.start_band_m, problems);
  check_order("goal_band_m", spec.goal_band_m, problems);
  if (std::max(spec.start_band_m[1], spec.goal_band_m[1]) > spec.range_m[1]) {
    problems.push_back(problem("range_m: the flight space ends before the start or goal band"));
  }
  check_order("goal_height_m", spec.goal_height_m, problems);
  const double height_m = spec.range_m[2];
  check_below("start_height_m", spec.start_height_m, "range_m's height", height_m, problems);
  check_below("goal_height_m", spec.goal_height_m[1], "range_m's height", height_m, problems);
}

void check_contradictions(const AvoidbenchForestSpec& spec, std::vector<InputProblem>& problems) {
  check_suite(spec, problems);
}

void check_contradictions(const AvoidbenchIndoorSpec& spec, std::vector<InputProblem>& problems) {
  check_suite(spec, problems);
  check_order("cylinder_diameter_m", spec.cylinder_diameter_m, problems);
  check_order("cylinder_height_m", spec.cylinder_height_m, problems);
  check_below("cylinder_diameter_m", spec.cylinder_diameter_m[1], "radius_origin_m",
              spec.radius_origin_m, problems);
  check_below("cylinder_height_m", spec.cylinder_height_m[1], "ceiling_m", spec.ceiling_m,
              problems);
  if (spec.range_m[2] > spec.ceiling_m) {
    problems.push_back(problem("ceiling_m: lower than range_m's height"));
  }
}

/// Where along y the obstacles of a hard case may stand.
double stretch_m(const std::array<double, 2>& area_m) {
  return area_m[1] - 2.0 * (band_depth_m(area_m[1]) + kBandGap_m);
}

void check_contradictions(const MazeSpec& spec, std::vector<InputProblem>& problems) {
  check_below("flight_height_m", spec.flight_height_m, "height_m", spec.height_m, problems);
  check_room("area_m", {spec.area_m[0], stretch_m(spec.area_m)}, "corridor_m with its wall",
             spec.corridor_m + kInnerWall_m, problems);
}

void check_contradictions(const GapWallsSpec& spec, std::vector<InputProblem>& problems) {
  check_below("flight_height_m", spec.flight_height_m, "height_m", spec.height_m, problems);
  check_below("gap_width_m", spec.gap_width_m, "a wall's length for each of its gaps",
              spec.area_m[0] / static_cast<double>(spec.gaps_per_wall), problems);
  check_below("gap_height_m", spec.gap_height_m, "height_m", spec.height_m, problems);
  check_order("sill_m", spec.sill_m, problems);
  // A metre for each wall.
  check_below("wall_count", static_cast<double>(spec.wall_count), "the metres between the bands",
              stretch_m(spec.area_m), problems);
}

void check_contradictions(const DeadEndsSpec& spec, std::vector<InputProblem>& problems) {
  check_below("flight_height_m", spec.flight_height_m, "height_m", spec.height_m, problems);
  const double reach_m = trap_reach_m(spec);
  check_below("trap_width_m and trap_depth_m: the trap's diameter", 2.0 * reach_m + spec.passage_m,
              "the hall's width", spec.area_m[0], problems);
  check_below("trap_width_m and trap_depth_m: the trap's diameter", 2.0 * reach_m,
              "the metres between the bands", stretch_m(spec.area_m), problems);
}

void check_contradictions(const PolesSpec& spec, std::vector<InputProblem>& problems) {
  check_below("flight_height_m", spec.flight_height_m, "height_m", spec.height_m, problems);
  check_room("area_m", spec.area_m, "poisson_radius_m", spec.poisson_radius_m, problems);
  check_order("diameter_m", spec.diameter_m, problems);
}

void check_contradictions(const OverhangsSpec& spec, std::vector<InputProblem>& problems) {
  check_below("flight_height_m", spec.flight_height_m, "height_m", spec.height_m, problems);
  check_below("slot_height_m", spec.slot_height_m, "height_m", spec.height_m, problems);
  check_below("thickness_m", 2.0 * spec.thickness_m,
              "the room for each barrier, whose half it fills",
              stretch_m(spec.area_m) / static_cast<double>(spec.barrier_count), problems);
}

/// Every problem at once: ranges of single fields, then what contradicts itself. visit() takes a
/// spec that can be changed, so it is given a copy.
template <class Spec>
void check_spec(const Spec& spec) {
  RangeCheck check;
  Spec copy = spec;
  visit(check, copy);
  check_contradictions(spec, check.problems);
  if (!check.problems.empty()) throw InputError(std::move(check.problems));
}

template <class FileSpec>
void check_file_spec(const FileSpec& spec) {
  std::vector<std::string> found;
  find_problems(spec, found);
  std::vector<InputProblem> problems;
  for (std::string& message : found) problems.push_back(problem(std::move(message)));
  if (!problems.empty()) throw InputError(std::move(problems));
}

void check_spec(const MeshSpec& spec) { check_file_spec(spec); }
void check_spec(const PointCloudSpec& spec) { check_file_spec(spec); }

World make(const MeshSpec& spec, std::uint64_t) { return make_mesh(spec); }
World make(const PointCloudSpec& spec, std::uint64_t) { return make_point_cloud(spec); }
World make(const ForestSpec& spec, std::uint64_t map_seed) { return make_forest(spec, map_seed); }
World make(const HallSpec& spec, std::uint64_t map_seed) { return make_hall(spec, map_seed); }
World make(const AvoidbenchForestSpec& spec, std::uint64_t map_seed) {
  return make_avoidbench_forest(spec, map_seed);
}
World make(const AvoidbenchIndoorSpec& spec, std::uint64_t map_seed) {
  return make_avoidbench_indoor(spec, map_seed);
}
World make(const MazeSpec& spec, std::uint64_t map_seed) { return make_maze(spec, map_seed); }
World make(const GapWallsSpec& spec, std::uint64_t map_seed) {
  return make_gap_walls(spec, map_seed);
}
World make(const DeadEndsSpec& spec, std::uint64_t map_seed) {
  return make_dead_ends(spec, map_seed);
}
World make(const PolesSpec& spec, std::uint64_t map_seed) { return make_poles(spec, map_seed); }
World make(const OverhangsSpec& spec, std::uint64_t map_seed) {
  return make_overhangs(spec, map_seed);
}

}  // namespace

FileOfMap file_of(MapSpec& spec) {
  return std::visit(
      []<class Spec>(Spec& held) -> FileOfMap {
        // Only maps out of files have these fields.
        if constexpr (requires { held.file_digest; }) return {&held.file, &held.file_digest};
        return {};
      },
      spec);
}

void check_map(const MapSpec& spec) {
  std::visit([](const auto& held) { check_spec(held); }, spec);
}

/// Checked here too: specs come from databases and messages as well as from sweep files.
World make_world(const MapSpec& spec, std::uint64_t map_seed) {
  return std::visit(
      [map_seed](const auto& held) {
        check_spec(held);
        return make(held, map_seed);
      },
      spec);
}

}  // namespace avoidbench
