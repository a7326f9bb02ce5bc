#include "movers/movers.hpp"

#include <array>
#include <cmath>
#include <map>

#include "base/check.hpp"
#include "base/input_error.hpp"
#include "base/number_text.hpp"
#include "movers/mover_paths.hpp"
#include "world/scenery.hpp"

namespace avoidbench {
namespace {

constexpr std::array kKinds{MoverKind::person, MoverKind::box, MoverKind::ball, MoverKind::pole};
constexpr std::array kMotions{MoverMotion::walk, MoverMotion::cross, MoverMotion::trefoil,
                              MoverMotion::chase};

MoverKind kind_of(const MoversSpec& spec, std::int64_t index) {
  if (spec.kind != MoverKind::mixed) return spec.kind;
  return kKinds[static_cast<std::size_t>(index) % kKinds.size()];
}

/// Each kind meets each motion: the motion changes where all kinds have had it.
MoverMotion motion_of(const MoversSpec& spec, std::int64_t index) {
  if (spec.motion != MoverMotion::mixed) return spec.motion;
  const auto turn = static_cast<std::size_t>(index);
  return kMotions[(turn + turn / kKinds.size()) % kMotions.size()];
}

MoverPath path_of(const MoverTask& task, MoverMotion motion, RandomStream& draws,
                  std::int64_t index) {
  constexpr int kTries = 500;
  for (int i = 0; i < kTries; ++i) {
    if (std::optional<MoverPath> path = try_path(task, motion, draws)) return *std::move(path);
  }
  throw InputError(
      "movers: no place for number " + std::to_string(index) + ", " +
      std::string(text(task.shape.kind)) + " that is to " + std::string(text(motion)) +
      ", in the flight box at least start_clearance_m, " + shortest(task.spec.start_clearance_m) +
      " m, from the start: take smaller ones, a smaller start_clearance_m or a larger map");
}

void check_order(std::string_view name, const std::array<double, 2>& ends,
                 std::vector<std::string>& problems) {
  if (ends[0] <= ends[1]) return;
  problems.push_back(std::string(name) + ": the least, " + shortest(ends[0]) +
                     ", is above the greatest, " + shortest(ends[1]));
}

}  // namespace

std::vector<std::string> mover_problems(const MoversSpec& movers) {
  std::vector<std::string> problems;
  if (movers.count > 0 && movers.density_1pm2 > 0.0) {
    problems.emplace_back("density_1pm2: replaces count, but both are given");
  }
  check_order("speed_mps", movers.speed_mps, problems);
  check_order("size_m", movers.size_m, problems);
  check_order("height_m", movers.height_m, problems);
  check_order("trefoil_reach_m", movers.trefoil_reach_m, problems);
  return problems;
}

std::int64_t mover_count(const MoversSpec& spec, const World& map) {
  if (spec.count > 0) return spec.count;
  const Eigen::Vector3d size_m = map.flight_bounds.sizes();
  return std::llround(spec.density_1pm2 * size_m.x() * size_m.y());
}

World with_movers(const Scene& map, const MoversSpec& spec, const MoverCourse& course) {
  World world = map.world();
  std::map<MoverKind, std::uint32_t> prototype_of;
  const std::int64_t count = mover_count(spec, world);
  for (std::int64_t i = 0; i < count; ++i) {
    RandomStream draws(stream_seed(course.seed, static_cast<std::uint64_t>(i)));
    const double size_m = draws.uniform(spec.size_m[0], spec.size_m[1]);
    const double speed_mps = draws.uniform(spec.speed_mps[0], spec.speed_mps[1]);
    const MoverKind kind = kind_of(spec, i);
    const MoverTask task{.map = map,
                         .spec = spec,
                         .course = course,
                         .shape = mover_shape(kind, size_m),
                         .speed_mps = speed_mps};
    MoverPath path = path_of(task, motion_of(spec, i), draws, i);
    const auto [prototype, is_new] =
        prototype_of.emplace(kind, static_cast<std::uint32_t>(world.prototypes.size()));
    if (is_new) world.prototypes.push_back(mover_prototype(kind));
    Instance instance;
    instance.prototype = prototype->second;
    instance.obstacle = static_cast<std::uint32_t>(world.obstacles.size());
    instance.T_world_prototype.translation() = path.rest_world.cast<float>();
    instance.T_world_prototype.linear() =
        upright_turn(path.yaw_rad) * static_cast<float>(task.shape.scale);
    if (path.path) {
      world.motions.push_back({.instance = static_cast<std::uint32_t>(world.instances.size()),
                               .path = *std::move(path.path)});
    }
    world.instances.push_back(instance);
    world.obstacles.push_back({.kind = std::string(text(kind)),
                               .position_world = path.rest_world,
                               .width_m = task.shape.width_m});
  }
  return world;
}

}  // namespace avoidbench
