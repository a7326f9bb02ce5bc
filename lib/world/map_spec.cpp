#include "world/map_spec.hpp"

#include <algorithm>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "base/input_error.hpp"
#include "world/generators.hpp"

namespace avoidbench {
namespace {

InputProblem problem(std::string message) {
  InputProblem found;
  found.message = std::move(message);
  return found;
}

/// Collects the numbers outside their ranges; NaN is outside every range.
struct RangeCheck {
  std::vector<InputProblem> problems;

  void field(std::string_view name, const double& value, Range range, std::string_view) {
    if (value >= range.lowest && value <= range.highest) return;
    std::ostringstream message;
    message << name << ": " << value << " is outside [" << range.lowest << ", " << range.highest
            << ']';
    problems.push_back(problem(message.str()));
  }
  void field(std::string_view name, std::array<double, 2>& values, Range range,
             std::string_view doc) {
    for (const double& value : values) field(name, value, range, doc);
  }
};

void check_contradictions(const ForestSpec&, std::vector<InputProblem>&) {}

void check_contradictions(const HallSpec& spec, std::vector<InputProblem>& problems) {
  const auto& [least, greatest] = spec.cylinder_diameter_m;
  if (least > greatest) {
    problems.push_back(problem("cylinder_diameter_m: the least diameter is above the greatest"));
  }
  if (greatest >= spec.poisson_radius_m) {
    problems.push_back(
        problem("cylinder_diameter_m: cylinders as wide as poisson_radius_m may "
                "overlap; make them thinner or the radius larger"));
  }
}

template <class Spec>
void check_spec(const Spec& spec) {
  RangeCheck check;
  Spec copy = spec;
  visit(check, copy);
  std::vector<InputProblem>& problems = check.problems;
  if (spec.flight_height_m >= spec.height_m) {
    std::ostringstream message;
    message << "flight_height_m: " << spec.flight_height_m << " is not below height_m, "
            << spec.height_m;
    problems.push_back(problem(message.str()));
  }
  const double least_side_m = std::min(spec.area_m[0], spec.area_m[1]);
  if (least_side_m < 2.0 * spec.poisson_radius_m) {
    std::ostringstream message;
    message << "area_m: its shorter side, " << least_side_m
            << ", is less than twice poisson_radius_m, " << spec.poisson_radius_m;
    problems.push_back(problem(message.str()));
  }
  check_contradictions(spec, problems);
  if (!problems.empty()) throw InputError(std::move(problems));
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

}  // namespace

FileOfMap file_of(MapSpec& spec) {
  return std::visit(
      []<class Spec>(Spec& held) -> FileOfMap {
        if constexpr (requires { held.file_digest; }) return {&held.file, &held.file_digest};
        return {};
      },
      spec);
}

void check_map(const MapSpec& spec) {
  std::visit([](const auto& held) { check_spec(held); }, spec);
}

World make_world(const MapSpec& spec, std::uint64_t map_seed) {
  return std::visit(
      [map_seed](const auto& held) {
        check_spec(held);
        return make(held, map_seed);
      },
      spec);
}

}  // namespace avoidbench
