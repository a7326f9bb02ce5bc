#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "base/math.hpp"
#include "base/random.hpp"
#include "maps/generators.hpp"
#include "world/poisson_disc.hpp"
#include "world/scenery.hpp"
#include "world/solids.hpp"

namespace avoidbench {
namespace {

constexpr double kWall_m = kInnerWall_m;
constexpr double kSlabSink_m = 0.05;  // into floor, ceiling and walls, so that no faces coincide
constexpr int kPoleSides = 8;

/// The closed hall that every hard case stands in, with its bands.
template <class Spec>
World empty_hall(const Spec& spec) {
  World world;
  world.flight_bounds =
      Aabb(Eigen::Vector3d::Zero(), Eigen::Vector3d(spec.area_m[0], spec.area_m[1], spec.height_m));
  world.bounds = world.flight_bounds;
  add_shell(world.flight_bounds, world);
  set_hall_bands(spec.area_m, spec.flight_height_m, world);
  return world;
}

/// Where along y obstacles may stand: between the bands.
struct Stretch {
  double low_m, high_m;
};

Stretch between_bands(const std::array<double, 2>& area_m) {
  const double first_m = band_depth_m(area_m[1]) + kBandGap_m;
  return {first_m, area_m[1] - first_m};
}

/// An upright piece of wall over [low, high] in x and y.
void add_partition(const Eigen::Vector2d& low, const Eigen::Vector2d& high, double bottom_m,
                   double top_m, World& world) {
  add_slab(world, "partition", "partition", Material::brick, {low.x(), low.y(), bottom_m},
           {high.x(), high.y(), top_m});
}

// ---- maze

/// A labyrinth's walls: east[c, r] closes cell (c, r) to the right, north[c, r] away from the
/// start.
struct Labyrinth {
  std::size_t columns, rows;
  std::vector<bool> east, north;

  std::size_t at(std::size_t column, std::size_t row) const { return row * columns + column; }
};

/// Opens the wall between two neighbouring cells.
void open_wall(Labyrinth& maze, std::size_t from, std::size_t to) {
  // Neighbours in a row differ by 1, in a column by the number of columns.
  const auto [low, high] = std::minmax(from, to);
  (high - low == maze.columns ? maze.north : maze.east)[low] = false;
}

/// Depth-first search from the first cell: every cell is reached by exactly one way.
void carve(Labyrinth& maze, RandomStream& draws) {
  std::vector<bool> is_reached(maze.columns * maze.rows, false);
  // The way back to the first cell, as a stack: recursion would be as deep as the maze is long.
  std::vector<std::size_t> way{0};
  is_reached[0] = true;
  while (!way.empty()) {
    const std::size_t cell = way.back();
    const std::size_t column = cell % maze.columns, row = cell / maze.columns;
    std::array<std::size_t, 4> open{};
    std::size_t count = 0;
    const auto consider = [&](bool exists, std::size_t neighbour) {
      if (exists && !is_reached[neighbour]) open[count++] = neighbour;
    };
    consider(column > 0, cell - 1);
    consider(column + 1 < maze.columns, cell + 1);
    consider(row > 0, cell - maze.columns);
    consider(row + 1 < maze.rows, cell + maze.columns);
    // A dead end: back to the last cell that has a neighbour left.
    if (count == 0) {
      way.pop_back();
      continue;
    }
    const std::size_t next = open[draws.below(count)];
    open_wall(maze, cell, next);
    is_reached[next] = true;
    way.push_back(next);
  }
}

/// Opens each wall that is left, except the outer ones, with this probability.
void open_loops(Labyrinth& maze, double ratio, RandomStream& draws) {
  for (std::size_t row = 0; row < maze.rows; ++row) {
    for (std::size_t column = 0; column < maze.columns; ++column) {
      const std::size_t cell = maze.at(column, row);
      // Both are drawn at each cell, so that the outer walls don't shift the sequence.
      const bool opens_east = draws.uniform() < ratio;
      const bool opens_north = draws.uniform() < ratio;
      if (opens_east && column + 1 < maze.columns) maze.east[cell] = false;
      if (opens_north && row + 1 < maze.rows) maze.north[cell] = false;
    }
  }
}

/// Calls `add(first, last)` for each longest run of closed walls, `last` exclusive.
template <class IsClosed, class Add>
void for_runs(std::size_t count, const IsClosed& is_closed, const Add& add) {
  for (std::size_t first = 0; first < count;) {
    if (!is_closed(first)) {
      ++first;
      continue;
    }
    std::size_t last = first;
    while (last < count && is_closed(last)) ++last;
    add(static_cast<double>(first), static_cast<double>(last));
    first = last;
  }
}

void add_labyrinth(const Labyrinth& maze, const Eigen::Vector2d& corner,
                   const Eigen::Vector2d& cell_m, std::array<std::size_t, 2> entrances,
                   double height_m, World& world) {
  // Walls reach half their thickness beyond their lines, which closes corners.
  const Eigen::Vector2d half(0.5 * kWall_m, 0.5 * kWall_m);
  const auto add = [&](const Eigen::Vector2d& from, const Eigen::Vector2d& to) {
    add_partition(corner + from.cwiseProduct(cell_m) - half,
                  corner + to.cwiseProduct(cell_m) + half, -kSlabSink_m, height_m + kSlabSink_m,
                  world);
  };
  for (std::size_t line = 0; line <= maze.rows; ++line) {  // across the flight's direction
    const auto y = static_cast<double>(line);
    const auto is_closed = [&](std::size_t column) {
      if (line == 0) return column != entrances[0];
      if (line == maze.rows) return column != entrances[1];
      return static_cast<bool>(maze.north[maze.at(column, line - 1)]);
    };
    for_runs(maze.columns, is_closed, [&](double first, double last) {
      add({first, y}, {last, y});
    });
  }
  for (std::size_t line = 1; line < maze.columns; ++line) {  // the hall's walls close the sides
    const auto x = static_cast<double>(line);
    const auto is_closed = [&](std::size_t row) {
      return static_cast<bool>(maze.east[maze.at(line - 1, row)]);
    };
    for_runs(maze.rows, is_closed, [&](double first, double last) { add({x, first}, {x, last}); });
  }
}

// ---- dead ends

/// A U around the origin, open toward -y.
Prototype trap_prototype(const DeadEndsSpec& spec) {
  const double x = 0.5 * spec.trap_width_m, y = 0.5 * spec.trap_depth_m, t = kWall_m;
  const double low = -kSlabSink_m, high = spec.height_m + kSlabSink_m;
  Prototype trap;
  trap.name = "trap";
  add_box(trap, {-x - t, -y, low}, {-x, y, high}, Material::concrete);
  add_box(trap, {x, -y, low}, {x + t, y, high}, Material::concrete);
  add_box(trap, {-x - t, y, low}, {x + t, y + t, high}, Material::concrete);
  return trap;
}

// ---- poles

/// A straight round rod; ends relative to the foot of its pole [m].
void add_rod(Prototype& prototype, const Eigen::Vector3d& from, const Eigen::Vector3d& to,
             double diameter_m, Material material) {
  const std::array<TubeRing, 2> rings{TubeRing{.centre = from, .radius_m = 0.5 * diameter_m},
                                      TubeRing{.centre = to, .radius_m = 0.5 * diameter_m}};
  add_tube(prototype, rings, kPoleSides, material);
}

/// From a branch's root to its tip: 0.5 to 1.8 m, 20° down to 60° up.
Eigen::Vector3d draw_branch(RandomStream& draws) {
  const double length_m = draws.uniform(0.5, 1.8);
  const double azimuth = draws.uniform(0.0, 2.0 * std::numbers::pi);
  const double elevation = draws.uniform(-20.0, 60.0) * math::kDegree;
  const double level_m = length_m * math::cos(elevation);
  return {level_m * math::cos(azimuth), level_m * math::sin(azimuth),
          length_m * math::sin(elevation)};
}

/// A pole from floor to ceiling, or a bare stem with branches at heights where vehicles fly.
Prototype pole(const PolesSpec& spec, double diameter_m, bool is_branched, RandomStream& draws) {
  Prototype prototype;
  prototype.name = is_branched ? "bare stem" : "pole";
  const Material material = is_branched ? Material::bark : Material::painted_metal;
  add_rod(prototype, {0.0, 0.0, -kSlabSink_m}, {0.0, 0.0, spec.height_m + kSlabSink_m}, diameter_m,
          material);
  if (!is_branched) return prototype;
  // Two to four.
  const std::uint64_t count = 2 + draws.below(3);
  for (std::uint64_t i = 0; i < count; ++i) {
    const Eigen::Vector3d root(0.0, 0.0, draws.uniform(0.2, 0.8) * spec.height_m);
    const double thickness = draws.uniform(0.5, 0.9);
    add_rod(prototype, root, root + draw_branch(draws), thickness * diameter_m, material);
  }
  return prototype;
}

}  // namespace

World make_maze(const MazeSpec& spec, std::uint64_t map_seed) {
  World world = empty_hall(spec);
  const Stretch stretch = between_bands(spec.area_m);
  const double pitch_m = spec.corridor_m + kWall_m;
  // The hall's own walls stand outside its area, those inside take half of their thickness.
  const auto cells = [pitch_m](double size_m) {
    return static_cast<std::size_t>(std::max(2.0, std::floor(size_m / pitch_m)));
  };
  const Eigen::Vector2d size_m(spec.area_m[0], stretch.high_m - stretch.low_m);
  Labyrinth maze{.columns = cells(size_m.x()), .rows = cells(size_m.y()), .east = {}, .north = {}};
  maze.east.assign(maze.columns * maze.rows, true);
  maze.north = maze.east;
  RandomStream ways = stream(map_seed, "ways");
  carve(maze, ways);
  RandomStream loops = stream(map_seed, "loops");
  open_loops(maze, spec.loop_ratio, loops);
  RandomStream entrances = stream(map_seed, "entrances");
  const std::size_t in = entrances.below(maze.columns);
  const std::size_t out = entrances.below(maze.columns);
  // Cells share the area evenly: corridors are at least as wide as asked for.
  const Eigen::Vector2d cell_m(size_m.x() / static_cast<double>(maze.columns),
                               size_m.y() / static_cast<double>(maze.rows));
  add_labyrinth(maze, {0.0, stretch.low_m}, cell_m, {in, out}, spec.height_m, world);
  world.digest = world_digest(world);
  return world;
}

World make_gap_walls(const GapWallsSpec& spec, std::uint64_t map_seed) {
  World world = empty_hall(spec);
  const Stretch stretch = between_bands(spec.area_m);
  const double part_m = spec.area_m[0] / static_cast<double>(spec.gaps_per_wall);
  const double gap_m = spec.gap_width_m;
  const double high = spec.height_m + kSlabSink_m;
  RandomStream places = stream(map_seed, "gaps");
  RandomStream sills = stream(map_seed, "sills");
  for (std::int64_t wall = 0; wall < spec.wall_count; ++wall) {
    const double share = (static_cast<double>(wall) + 0.5) / static_cast<double>(spec.wall_count);
    const double y = stretch.low_m + share * (stretch.high_m - stretch.low_m);
    // From gap to gap: the pieces of wall between them, and at last the one up to the hall's side.
    double from_x = -kSlabSink_m;
    for (std::int64_t gap = 0; gap < spec.gaps_per_wall; ++gap) {
      // One in each equal part of the wall.
      const double x = part_m * static_cast<double>(gap) + places.uniform(0.0, part_m - gap_m);
      add_partition({from_x, y - 0.5 * kWall_m}, {x, y + 0.5 * kWall_m}, -kSlabSink_m, high, world);
      from_x = x + gap_m;
      // Drawn in any case, so that gap_height_m does not change where the gaps are.
      const double sill = sills.uniform(spec.sill_m[0], spec.sill_m[1]);
      if (spec.gap_height_m <= 0.0) continue;
      // A gap never reaches above the ceiling: its sill comes down instead.
      const double bottom_m = std::min(sill, spec.height_m - spec.gap_height_m);
      const Eigen::Vector2d low(x, y - 0.5 * kWall_m), far(from_x, y + 0.5 * kWall_m);
      if (bottom_m > 0.0) add_partition(low, far, -kSlabSink_m, bottom_m, world);
      if (bottom_m + spec.gap_height_m < spec.height_m) {
        add_partition(low, far, bottom_m + spec.gap_height_m, high, world);
      }
    }
    add_partition({from_x, y - 0.5 * kWall_m}, {spec.area_m[0] + kSlabSink_m, y + 0.5 * kWall_m},
                  -kSlabSink_m, high, world);
  }
  world.digest = world_digest(world);
  return world;
}

double trap_reach_m(const DeadEndsSpec& spec) {
  const double x = 0.5 * spec.trap_width_m + kWall_m, y = 0.5 * spec.trap_depth_m + kWall_m;
  return std::sqrt(x * x + y * y);
}

World make_dead_ends(const DeadEndsSpec& spec, std::uint64_t map_seed) {
  World world = empty_hall(spec);
  const Stretch stretch = between_bands(spec.area_m);
  const auto prototype = static_cast<std::uint32_t>(world.prototypes.size());
  world.prototypes.push_back(trap_prototype(spec));
  // The farthest corner of a trap from its middle: within that circle it may turn as it likes.
  const double reach_m = trap_reach_m(spec);
  const double inset_m = reach_m + 0.5 * spec.passage_m;
  RandomStream positions = stream(map_seed, "positions");
  RandomStream turns = stream(map_seed, "turns");
  // The whole circle, and half a passage between it and the hall's sides.
  const Eigen::Vector2d corner(inset_m, stretch.low_m + reach_m);
  const Eigen::Vector2d size_m(spec.area_m[0] - 2.0 * inset_m,
                               stretch.high_m - stretch.low_m - 2.0 * reach_m);
  for (const Eigen::Vector2d& place :
       // Between any two circles a passage is left.
       poisson_disc({size_m.x(), size_m.y()}, 2.0 * reach_m + spec.passage_m, positions)) {
    const double yaw = turns.uniform(-spec.yaw_deg, spec.yaw_deg) * math::kDegree;
    Obstacle trap{.kind = "trap", .width_m = spec.trap_width_m + 2.0 * kWall_m};
    trap.position_world = {corner.x() + place.x(), corner.y() + place.y(), 0.0};
    Instance instance;
    instance.prototype = prototype;
    instance.obstacle = static_cast<std::uint32_t>(world.obstacles.size());
    instance.T_world_prototype.linear() = upright_turn(yaw);
    instance.T_world_prototype.translation() = trap.position_world.cast<float>();
    world.instances.push_back(instance);
    world.obstacles.push_back(trap);
  }
  world.digest = world_digest(world);
  return world;
}

World make_poles(const PolesSpec& spec, std::uint64_t map_seed) {
  World world = empty_hall(spec);
  // A stream for each question: another branch_ratio changes no place and no diameter.
  RandomStream positions = stream(map_seed, "positions");
  RandomStream diameters = stream(map_seed, "diameters");
  RandomStream kinds = stream(map_seed, "kinds");
  RandomStream branches = stream(map_seed, "branches");
  double width_sum_m = 0.0, count = 0.0;
  for (const Eigen::Vector2d& foot :
       poisson_disc({spec.area_m[0], spec.area_m[1]}, spec.poisson_radius_m, positions)) {
    const double diameter_m = diameters.uniform(spec.diameter_m[0], spec.diameter_m[1]);
    const bool is_branched = kinds.uniform() < spec.branch_ratio;
    Obstacle obstacle{.kind = is_branched ? "bare stem" : "pole", .width_m = diameter_m};
    obstacle.position_world = {foot.x(), foot.y(), 0.0};
    add_obstacle(world, pole(spec, diameter_m, is_branched, branches), obstacle);
    width_sum_m += obstacle.width_m;
    count += 1.0;
  }
  world.mean_obstacle_width_m = width_sum_m / count;
  world.poisson_radius_m = spec.poisson_radius_m;
  world.digest = world_digest(world);
  return world;
}

World make_overhangs(const OverhangsSpec& spec, std::uint64_t map_seed) {
  World world = empty_hall(spec);
  const Stretch stretch = between_bands(spec.area_m);
  RandomStream kinds = stream(map_seed, "kinds");
  RandomStream positions = stream(map_seed, "positions");
  // By chance the first one is to be flown under or over; then by turns.
  bool is_under = kinds.uniform() < 0.5;
  for (std::int64_t i = 0; i < spec.barrier_count; ++i) {
    // Within the middle of its equal part, so that two barriers never touch.
    const double share = (static_cast<double>(i) + positions.uniform(0.3, 0.7)) /
                         static_cast<double>(spec.barrier_count);
    const double y = stretch.low_m + share * (stretch.high_m - stretch.low_m);
    const Eigen::Vector2d low(-kSlabSink_m, y - 0.5 * spec.thickness_m);
    const Eigen::Vector2d high(spec.area_m[0] + kSlabSink_m, y + 0.5 * spec.thickness_m);
    if (is_under) {
      add_partition(low, high, spec.slot_height_m, spec.height_m + kSlabSink_m, world);
    } else {
      add_partition(low, high, -kSlabSink_m, spec.height_m - spec.slot_height_m, world);
    }
    is_under = !is_under;
  }
  world.digest = world_digest(world);
  return world;
}

}  // namespace avoidbench
