#include "movers/mover_paths.hpp"

#include <algorithm>
#include <cmath>

#include "base/math.hpp"

namespace avoidbench {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kTurnRate_radps = math::kPi;  ///< of people who turn on the spot
constexpr double kTurnBack_s = 1.0;            ///< at the ends of a way to and fro
constexpr double kCrossReach_m = 10.0;         ///< to either side of the line

/// The ground, or the floor of the flight box where that is higher.
double floor_m(const MoverTask& task, double x_m, double y_m) {
  const World& world = task.map.world();
  return std::max(ground_height_m(world, x_m, y_m), world.flight_bounds.min().z());
}

/// Where the origins of movers may be, seen from above.
Eigen::AlignedBox2d area_of(const MoverTask& task) {
  const Aabb& box = task.map.world().flight_bounds;
  const Vector2d inset = Vector2d::Constant(0.5 * task.shape.width_m);
  return {Vector2d(box.min().head<2>()) + inset, Vector2d(box.max().head<2>()) - inset};
}

Vector2d drawn_place(const Eigen::AlignedBox2d& area, RandomStream& draws) {
  const double x = draws.uniform(area.min().x(), area.max().x());
  const double y = draws.uniform(area.min().y(), area.max().y());
  return {x, y};
}

bool is_clear_of_start(const MoverTask& task, const Vector3d& place) {
  const double distance_m = (place - task.course.start_world).head<2>().norm();
  return distance_m - 0.5 * task.shape.width_m >= task.spec.start_clearance_m;
}

/// An origin that flies keeps within the flight box and above the ground.
double within_heights(const MoverTask& task, double z_m, double floor_z_m) {
  const double half_m = 0.5 * task.shape.height_m;
  const double top_m = task.map.world().flight_bounds.max().z() - half_m;
  return std::max(std::min(z_m, top_m), floor_z_m + half_m);
}

/// Above (x, y): on the ground, or `height_m` above it.
Vector3d origin_at(const MoverTask& task, const Vector2d& place, double height_m) {
  const double floor_z_m = floor_m(task, place.x(), place.y());
  if (task.shape.is_grounded) return {place.x(), place.y(), floor_z_m};
  return {place.x(), place.y(), within_heights(task, floor_z_m + height_m, floor_z_m)};
}

/// Whether a mover can go straight between two places without touching the map: balls of its width
/// along the way, each as far from the last as that one was free.
bool is_free_way(const MoverTask& task, const Vector2d& from, const Vector2d& to, double height_m) {
  constexpr double kLook_m = 3.0, kLeastStep_m = 0.1;
  const double radius_m =
      0.5 * std::max(task.shape.width_m, task.shape.is_grounded ? 0.0 : task.shape.height_m);
  const double length_m = (to - from).norm();
  // Of a person at 0.5 and 1.5 m, of a pole up to 3.5 m; of what flies at its middle.
  const double highest_m = task.shape.is_grounded ? task.shape.height_m : 0.5;
  for (int i = 0; 0.5 + i < highest_m + 0.25; ++i) {
    const double above_m = task.shape.is_grounded ? 0.5 + i : 0.0;
    double way_m = 0.0;
    while (true) {
      const Vector2d place =
          length_m > 0.0 ? Vector2d(from + way_m / length_m * (to - from)) : from;
      const Vector3d middle = origin_at(task, place, height_m) + Vector3d(0.0, 0.0, above_m);
      const double free_m = std::min(task.map.nearest(middle, kLook_m).distance_m, kLook_m);
      if (free_m < radius_m) return false;
      if (way_m >= length_m) break;
      way_m = std::min(length_m, way_m + std::max(free_m - radius_m, kLeastStep_m));
    }
  }
  return true;
}

/// On ground that is not flat: knots a quarter of a second apart, at its height.
std::variant<Sway, Route, Trefoil> on_ground(const MoverTask& task, const Vector3d& rest,
                                             std::variant<Sway, Route, Trefoil> path) {
  constexpr double kStep_s = 0.25;
  if (!task.shape.is_grounded || task.map.world().ground.columns == 0) return path;
  std::vector<double> times_s;
  const auto steps = static_cast<int>(std::ceil(task.course.time_limit_s / kStep_s));
  for (int i = 0; i <= steps; ++i) times_s.push_back(i * kStep_s);
  if (const auto* route = std::get_if<Route>(&path)) {
    for (const Knot& knot : route->knots) times_s.push_back(knot.time_s);
  }
  std::sort(times_s.begin(), times_s.end());
  times_s.erase(std::unique(times_s.begin(), times_s.end()), times_s.end());
  const Motion motion{.instance = 0, .path = std::move(path)};
  Route followed;
  for (const double time_s : times_s) {
    const MotionState state = state_at(motion, time_s);
    const Vector3d place = rest + state.offset_world;
    followed.knots.push_back({time_s,
                              {state.offset_world.x(), state.offset_world.y(),
                               floor_m(task, place.x(), place.y()) - rest.z()},
                              state.turn_rad});
  }
  return followed;
}

std::optional<MoverPath> stand(const MoverTask& task, RandomStream& draws) {
  const double height_m = draws.uniform(task.spec.height_m[0], task.spec.height_m[1]);
  const double yaw_rad = draws.uniform(0.0, math::kTau);
  const Vector2d place = drawn_place(area_of(task), draws);
  const Vector3d rest = origin_at(task, place, height_m);
  if (!is_clear_of_start(task, rest) || !is_free_way(task, place, place, height_m)) {
    return std::nullopt;
  }
  return MoverPath{.rest_world = rest, .yaw_rad = yaw_rad, .path = {}};
}

/// The next place of a walk, or nothing where none of a few has a free way.
std::optional<Vector2d> next_place(const MoverTask& task, const Vector2d& from, double height_m,
                                   RandomStream& draws) {
  constexpr int kPlaces = 12;
  constexpr double kShortest_m = 2.0, kLongest_m = 10.0;
  const Eigen::AlignedBox2d area = area_of(task);
  for (int i = 0; i < kPlaces; ++i) {
    const double heading_rad = draws.uniform(0.0, math::kTau);
    const double length_m = draws.uniform(kShortest_m, kLongest_m);
    const Vector2d to = from + length_m * Vector2d(math::cos(heading_rad), math::sin(heading_rad));
    if (area.contains(to) && is_free_way(task, from, to, height_m)) return to;
  }
  return std::nullopt;
}

/// `to_rad` by less than a turn from `from_rad`.
double nearest_turn(double from_rad, double to_rad) {
  return from_rad + math::kTau * std::round((from_rad - to_rad) / math::kTau) + (to_rad - from_rad);
}

std::optional<MoverPath> walk(const MoverTask& task, RandomStream& draws) {
  std::optional<MoverPath> made = stand(task, draws);
  if (!made) return std::nullopt;
  constexpr double kLeastWait_s = 0.01;
  const double height_m =
      made->rest_world.z() - floor_m(task, made->rest_world.x(), made->rest_world.y());
  const bool is_person = task.shape.kind == MoverKind::person;
  Vector2d place = made->rest_world.head<2>();
  double turn_rad = 0.0, time_s = 0.0;
  Route route;
  route.knots.push_back({0.0, Vector3d::Zero(), 0.0});
  while (time_s < task.course.time_limit_s) {
    double wait_s = std::max(kLeastWait_s, draws.uniform(0.0, task.spec.pause_s));
    const std::optional<Vector2d> next = next_place(task, place, height_m, draws);
    if (!next) {  // looks again from where it stands
      time_s += std::max(1.0, wait_s);
      continue;
    }
    const Vector2d way = *next - place;
    double turned_rad = turn_rad;
    if (is_person) {
      turned_rad = nearest_turn(turn_rad, math::atan2(way.y(), way.x()) - made->yaw_rad);
      wait_s = std::max(wait_s, std::abs(turned_rad - turn_rad) / kTurnRate_radps);
    }
    const auto offset = [&](const Vector2d& at) {
      return Vector3d(origin_at(task, at, height_m) - made->rest_world);
    };
    // Where it has looked for a place several times, it turns when it has found one.
    if (time_s > route.knots.back().time_s) {
      route.knots.push_back({time_s, offset(place), turn_rad});
    }
    route.knots.push_back({time_s + wait_s, offset(place), turned_rad});
    time_s += wait_s + way.norm() / task.speed_mps;
    route.knots.push_back({time_s, offset(*next), turned_rad});
    place = *next;
    turn_rad = turned_rad;
  }
  made->path = on_ground(task, made->rest_world, std::move(route));
  return made;
}

/// A straight stretch on which something goes to and fro.
struct Stretch {
  Vector3d middle_world = Vector3d::Zero();  ///< passed in `direction` at `middle_s`
  Vector3d direction = Vector3d::UnitX();
  double low_m = 0.0, high_m = 0.0;  ///< its ends, from the middle along the direction
  double middle_s = 0.0;
  bool waits_before = false;  ///< stands in the middle until then
};

/// Knots with offsets from the stretch's middle.
Route to_and_fro(const MoverTask& task, const Stretch& stretch) {
  const double half_turn_rad = task.shape.kind == MoverKind::person ? math::kPi : 0.0;
  const double length_s = (stretch.high_m - stretch.low_m) / task.speed_mps;
  const auto knot = [&](double time_s, double at_m, int half_turns) {
    return Knot{time_s, at_m * stretch.direction, half_turns * half_turn_rad};
  };
  std::vector<Knot> before;  // the latest first
  int turns = 0;
  double time_s = stretch.middle_s + stretch.low_m / task.speed_mps;
  for (bool is_low = true; !stretch.waits_before; is_low = !is_low) {
    const double end_m = is_low ? stretch.low_m : stretch.high_m;
    if (time_s < stretch.middle_s) before.push_back(knot(time_s, end_m, turns));
    before.push_back(knot(time_s - kTurnBack_s, end_m, --turns));
    if (time_s < 0.0) break;
    time_s -= kTurnBack_s + length_s;
  }
  Route route;
  route.knots.assign(before.rbegin(), before.rend());
  route.knots.push_back(knot(stretch.middle_s, 0.0, 0));
  turns = 0;
  time_s = stretch.middle_s + stretch.high_m / task.speed_mps;
  for (bool is_low = false;; is_low = !is_low) {
    const double end_m = is_low ? stretch.low_m : stretch.high_m;
    if (time_s > stretch.middle_s) route.knots.push_back(knot(time_s, end_m, turns));
    route.knots.push_back(knot(time_s + kTurnBack_s, end_m, ++turns));
    if (time_s > task.course.time_limit_s) return route;
    time_s += kTurnBack_s + length_s;
  }
}

/// A mover whose transform stands in the stretch's middle.
std::optional<MoverPath> mover_on(const MoverTask& task, const Stretch& stretch) {
  constexpr double kShortest_m = 1.0;
  if (stretch.high_m - stretch.low_m < kShortest_m) return std::nullopt;
  Route route = to_and_fro(task, stretch);
  const Motion motion{.instance = 0, .path = route};
  if (!is_clear_of_start(task, stretch.middle_world + displacement_world(motion, 0.0))) {
    return std::nullopt;
  }
  return MoverPath{.rest_world = stretch.middle_world,
                   .yaw_rad = math::atan2(stretch.direction.y(), stretch.direction.x()),
                   .path = on_ground(task, stretch.middle_world, std::move(route))};
}

/// How far one can go from `from` in a direction within the area, at most `most_m`.
double reach_m(const Eigen::AlignedBox2d& area, const Vector2d& from, const Vector2d& direction,
               double most_m) {
  double reach = most_m;
  for (Eigen::Index axis = 0; axis < 2; ++axis) {
    const double slope = direction[axis];
    if (slope == 0.0) continue;
    const double side = slope > 0.0 ? area.max()[axis] : area.min()[axis];
    reach = std::min(reach, (side - from[axis]) / slope);
  }
  return std::max(reach, 0.0);
}

std::optional<MoverPath> cross(const MoverTask& task, RandomStream& draws) {
  const double share = draws.uniform(0.15, 0.95);
  const double side = draws.uniform() < 0.5 ? -1.0 : 1.0;
  const Vector3d line = task.course.goal_world - task.course.start_world;
  const double length_m = line.head<2>().norm();
  const Vector3d middle = task.course.start_world + share * line;
  const Eigen::AlignedBox2d area = area_of(task);
  if (!(length_m > 0.0) || !area.contains(Vector2d(middle.head<2>()))) return std::nullopt;
  const Vector2d across = side / length_m * Vector2d(-line.y(), line.x());
  const Vector2d place = middle.head<2>();
  const double floor_z_m = floor_m(task, place.x(), place.y());
  const double z_m =
      task.shape.is_grounded ? floor_z_m : within_heights(task, middle.z(), floor_z_m);
  return mover_on(task, {.middle_world = {place.x(), place.y(), z_m},
                         .direction = {across.x(), across.y(), 0.0},
                         .low_m = -reach_m(area, place, -across, kCrossReach_m),
                         .high_m = reach_m(area, place, across, kCrossReach_m),
                         .middle_s = share * line.norm() / task.course.speed_limit_mps});
}

std::optional<MoverPath> chase(const MoverTask& task, RandomStream& draws) {
  constexpr double kRing_m = 5.0, kLatest_s = 3.0;
  const double heading_rad = draws.uniform(0.0, math::kTau);
  const double nearest_m = task.spec.start_clearance_m + 0.5 * task.shape.width_m;
  const double from_start_m = draws.uniform(nearest_m, nearest_m + kRing_m);
  const double delay_s = draws.uniform(0.0, kLatest_s);
  const Vector3d& start = task.course.start_world;
  const Vector2d place = Vector2d(start.head<2>()) +
                         from_start_m * Vector2d(math::cos(heading_rad), math::sin(heading_rad));
  if (!area_of(task).contains(place)) return std::nullopt;
  const double floor_z_m = floor_m(task, place.x(), place.y());
  const Vector3d from(
      place.x(), place.y(),
      task.shape.is_grounded ? floor_z_m : within_heights(task, start.z(), floor_z_m));
  Vector3d way = task.course.goal_world - from;
  if (task.shape.is_grounded) way.z() = 0.0;
  const double length_m = way.norm();
  if (!(length_m > 0.0)) return std::nullopt;
  return mover_on(task, {.middle_world = from,
                         .direction = way / length_m,
                         .low_m = 0.0,
                         .high_m = length_m,
                         .middle_s = delay_s,
                         .waits_before = true});
}

std::optional<MoverPath> trefoil(const MoverTask& task, RandomStream& draws) {
  const double wanted_m = draws.uniform(task.spec.trefoil_reach_m[0], task.spec.trefoil_reach_m[1]);
  const double height_m = draws.uniform(task.spec.height_m[0], task.spec.height_m[1]);
  const double yaw_rad = draws.uniform(0.0, math::kTau);
  Trefoil knot;
  knot.phase = draws.uniform();
  knot.heading_rad = draws.uniform(0.0, math::kTau);
  Eigen::AlignedBox2d area = area_of(task);
  knot.reach_m = std::min(wanted_m, 0.5 * area.sizes().minCoeff());
  const Vector2d inset = Vector2d::Constant(knot.reach_m);
  const Vector2d place = drawn_place({area.min() + inset, area.max() - inset}, draws);
  const Vector3d rest = origin_at(task, place, height_m);
  if (!task.shape.is_grounded) {
    const double half_m = 0.5 * task.shape.height_m;
    const double below_m = rest.z() - half_m - floor_m(task, place.x(), place.y());
    const double above_m = task.map.world().flight_bounds.max().z() - half_m - rest.z();
    knot.rise_m = std::max(0.0, std::min({0.25 * knot.reach_m, below_m, above_m}));
  }
  // A knot of one second tells how long it must take.
  knot.period_s = 1.0;
  knot.period_s = greatest_speed_mps({.instance = 0, .path = knot}) / task.speed_mps;
  const Motion motion{.instance = 0, .path = knot};
  if (!is_clear_of_start(task, rest + displacement_world(motion, 0.0))) return std::nullopt;
  return MoverPath{.rest_world = rest, .yaw_rad = yaw_rad, .path = on_ground(task, rest, knot)};
}

}  // namespace

std::optional<MoverPath> try_path(const MoverTask& task, MoverMotion motion, RandomStream& draws) {
  if (area_of(task).isEmpty()) return std::nullopt;
  switch (motion) {
    case MoverMotion::stand:
      return stand(task, draws);
    case MoverMotion::walk:
      return walk(task, draws);
    case MoverMotion::cross:
      return cross(task, draws);
    case MoverMotion::trefoil:
      return trefoil(task, draws);
    case MoverMotion::chase:
      return chase(task, draws);
    case MoverMotion::mixed:
      break;
  }
  return std::nullopt;
}

}  // namespace avoidbench
