#include "metrics/environment.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "base/math.hpp"
#include "trial/mission.hpp"
#include "world/scenery.hpp"
#include "world/voxels.hpp"

namespace avoidbench {
namespace {

/// Distance from `from` along the horizontal unit `direction` to the side of the box.
double distance_to_side_m(const Aabb& box, const Eigen::Vector3d& from,
                          const Eigen::Vector3d& direction) {
  double distance_m = std::numeric_limits<double>::infinity();
  for (int axis = 0; axis < 2; ++axis) {
    // Never meets the sides of this axis.
    if (direction[axis] == 0.0) continue;
    const double side = direction[axis] > 0.0 ? box.max()[axis] : box.min()[axis];
    distance_m = std::min(distance_m, (side - from[axis]) / direction[axis]);
  }
  return std::max(0.0, distance_m);
}

/// Calls visit(x, y) for positions `step_m` apart, centred in the box.
template <class Visit>
void for_each_position(const Aabb& box, double step_m, Visit visit_position) {
  // Rounded down, so that they are not closer than step_m.
  const int nx = std::max(1, static_cast<int>(std::floor(box.sizes().x() / step_m)));
  const int ny = std::max(1, static_cast<int>(std::floor(box.sizes().y() / step_m)));
  for (int iy = 0; iy < ny; ++iy) {
    for (int ix = 0; ix < nx; ++ix) {
      visit_position(box.min().x() + (ix + 0.5) * box.sizes().x() / nx,
                     box.min().y() + (iy + 0.5) * box.sizes().y() / ny);
    }
  }
}

/// Whether the centre of an occupied cell lies within one cell's size of `point`.
bool has_point_near(const VoxelGrid& points, const Eigen::Vector3d& point) {
  const Eigen::Vector3d scaled = (point - points.lowest_world) / points.size_m;
  const std::array<std::size_t, 3> counts{points.columns, points.rows, points.layers};
  std::array<std::int64_t, 3> low{}, high{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto cell = static_cast<std::int64_t>(std::floor(scaled[static_cast<int>(axis)]));
    // A centre within one cell's size is that of a neighbour at most.
    low[axis] = std::max<std::int64_t>(0, cell - 1);
    high[axis] = std::min(static_cast<std::int64_t>(counts[axis]) - 1, cell + 1);
  }
  for (auto layer = low[2]; layer <= high[2]; ++layer) {
    for (auto row = low[1]; row <= high[1]; ++row) {
      for (auto column = low[0]; column <= high[0]; ++column) {
        const auto i = static_cast<std::size_t>(column), j = static_cast<std::size_t>(row),
                   k = static_cast<std::size_t>(layer);
        const bool is_near = (points.centre_world(i, j, k) - point).norm() <= points.size_m;
        if (is_near && points.is_occupied[points.at(i, j, k)] != 0) return true;
      }
    }
  }
  return false;
}

/// Mean of the original's free distances from one position [m].
double stepped_distance_m(const VoxelGrid& points, const Aabb& box, const Eigen::Vector3d& from) {
  // As the original's code has them.
  constexpr int kHeadings = 8;
  if (has_point_near(points, from)) return 0.0;
  double sum_m = 0.0;
  for (int i = 0; i < kHeadings; ++i) {
    const double heading_rad = math::kTau * i / kHeadings;
    // Headings are counted from y, as there.
    const Eigen::Vector3d step(points.size_m * math::sin(heading_rad),
                               points.size_m * math::cos(heading_rad), 0.0);
    int count = 1;
    // In steps of the grid, until a point is near or the box ends.
    while (!has_point_near(points, from + count * step)) {
      ++count;
      if (box.contains(from + count * step)) continue;
      --count;
      break;
    }
    sum_m += count * points.size_m;
  }
  return sum_m / kHeadings;
}

}  // namespace

BodyMeasure body_measure(const Eigen::Vector3d& body_size_m) {
  return {.radius_m = 0.5 * std::min(body_size_m.x(), body_size_m.y()),
          .diameter_m = math::hypot(body_size_m.x(), body_size_m.y())};
}

Traversability traversability(const Scene& scene, ClearanceGrid& grid, const BodyMeasure& body) {
  constexpr int kHeadings = 16;
  constexpr double kStep_m = 1.0;
  const World& world = scene.world();
  const double height_m = 0.5 * (world.start_region.lowest.z() + world.start_region.highest.z());
  double flown_m = 0.0, unhindered_m = 0.0;
  std::int64_t flights = 0;
  for_each_position(world.flight_bounds, kStep_m, [&](double x, double y) {
    Eigen::Vector3d from(x, y, height_m);
    if (world.heights_above_ground) from.z() += ground_height_m(world, x, y);
    // Inside a closed obstacle the nearest surface may be far: distances alone would call it free.
    const bool is_blocked = is_inside(scene, from) || !grid.is_free(from, body.radius_m);
    for (int i = 0; i < kHeadings; ++i) {
      const double heading_rad = math::kTau * i / kHeadings;
      const Eigen::Vector3d direction(math::cos(heading_rad), math::sin(heading_rad), 0.0);
      const double limit_m = distance_to_side_m(world.flight_bounds, from, direction);
      // What the same flights would be on the empty map.
      unhindered_m += limit_m;
      if (!is_blocked) flown_m += grid.free_distance_m(from, direction, limit_m, body.radius_m);
      ++flights;
    }
  });
  return {.value = flown_m / static_cast<double>(flights) / body.diameter_m,
          .normalized_ratio = flown_m / unhindered_m};
}

Traversability traversability_pointcloud(const World& world, double resolution_m,
                                         const BodyMeasure& body) {
  const Aabb& box = world.flight_bounds;
  const VoxelGrid points = surface_voxels(world, resolution_m);
  // The same grid without points: the empty map in the original's own steps.
  VoxelGrid none = points;
  std::fill(none.is_occupied.begin(), none.is_occupied.end(), std::uint8_t{0});
  // The original leaves a margin of half a metre and more at each side.
  std::array<int, 3> counts{};
  Eigen::Vector3d first;
  for (int axis = 0; axis < 3; ++axis) {
    const double size_m = box.sizes()[axis];
    const bool is_thin = std::floor(size_m) <= 1.0;
    counts[static_cast<std::size_t>(axis)] = is_thin ? 1 : static_cast<int>(std::floor(size_m)) - 1;
    first[axis] = box.min()[axis] + 0.5 * (is_thin ? size_m : size_m - std::floor(size_m) + 1.0);
  }
  double flown_m = 0.0, unhindered_m = 0.0, count = 0.0;
  for (int ix = 0; ix < counts[0]; ++ix) {
    for (int iy = 0; iy < counts[1]; ++iy) {
      for (int iz = 0; iz < counts[2]; ++iz) {
        const Eigen::Vector3d from = first + Eigen::Vector3d(ix, iy, iz);
        flown_m += stepped_distance_m(points, box, from);
        unhindered_m += stepped_distance_m(none, box, from);
        count += 1.0;
      }
    }
  }
  return {.value = flown_m / count / body.diameter_m, .normalized_ratio = flown_m / unhindered_m};
}

double free_volume_ratio(const Scene& scene, ClearanceGrid& grid, const BodyMeasure& body) {
  const Aabb& box = scene.world().flight_bounds;
  const int layers = std::max(1, static_cast<int>(std::floor(box.sizes().z() / 0.5)));
  std::int64_t free = 0, all = 0;
  for_each_position(box, 1.0, [&](double x, double y) {
    for (int iz = 0; iz < layers; ++iz) {
      const Eigen::Vector3d place(x, y, box.min().z() + (iz + 0.5) * box.sizes().z() / layers);
      ++all;
      if (grid.is_free(place, body.radius_m) && !is_inside(scene, place)) ++free;
    }
  });
  return static_cast<double>(free) / static_cast<double>(all);
}

std::int64_t obstacle_count(const World& world) {
  return std::count_if(world.obstacles.begin(), world.obstacles.end(),
                       [](const Obstacle& obstacle) { return !is_scenery(obstacle.kind); });
}

double obstacle_density_1pm2(const World& world) {
  const Aabb& flight = world.flight_bounds;
  const auto count =
      std::count_if(world.obstacles.begin(), world.obstacles.end(), [&](const Obstacle& obstacle) {
        const Eigen::Vector3d& foot = obstacle.position_world;
        return !is_scenery(obstacle.kind) && foot.x() >= flight.min().x() &&
               foot.y() >= flight.min().y() && foot.x() <= flight.max().x() &&
               foot.y() <= flight.max().y();
      });
  return static_cast<double>(count) / (flight.sizes().x() * flight.sizes().y());
}

double relative_gap_size(const World& world, const BodyMeasure& body) {
  if (world.poisson_radius_m <= 0.0) return std::numeric_limits<double>::quiet_NaN();
  return (world.poisson_radius_m - world.mean_obstacle_width_m) / body.diameter_m;
}

}  // namespace avoidbench
