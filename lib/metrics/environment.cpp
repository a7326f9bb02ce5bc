#include "metrics/environment.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/math.hpp"
#include "trial/mission.hpp"

namespace avoidbench {
namespace {

/// Distance from `from` along the horizontal unit `direction` to the side of the box.
double distance_to_side_m(const Aabb& box, const Eigen::Vector3d& from,
                          const Eigen::Vector3d& direction) {
  double distance_m = std::numeric_limits<double>::infinity();
  for (int axis = 0; axis < 2; ++axis) {
    if (direction[axis] == 0.0) continue;
    const double side = direction[axis] > 0.0 ? box.max()[axis] : box.min()[axis];
    distance_m = std::min(distance_m, (side - from[axis]) / direction[axis]);
  }
  return std::max(0.0, distance_m);
}

/// Calls visit(x, y) for positions `step_m` apart, centred in the box.
template <class Visit>
void for_each_position(const Aabb& box, double step_m, Visit visit_position) {
  const int nx = std::max(1, static_cast<int>(std::floor(box.sizes().x() / step_m)));
  const int ny = std::max(1, static_cast<int>(std::floor(box.sizes().y() / step_m)));
  for (int iy = 0; iy < ny; ++iy) {
    for (int ix = 0; ix < nx; ++ix) {
      visit_position(box.min().x() + (ix + 0.5) * box.sizes().x() / nx,
                     box.min().y() + (iy + 0.5) * box.sizes().y() / ny);
    }
  }
}

bool is_scenery(const Obstacle& obstacle) {
  return obstacle.kind == "ground" || obstacle.kind == "wall" || obstacle.kind == "ceiling";
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
    if (world.heights_above_ground) from.z() += ground_height_m(scene, x, y);
    const bool is_blocked = is_inside(scene, from) || !grid.is_free(from, body.radius_m);
    for (int i = 0; i < kHeadings; ++i) {
      const double heading_rad = math::kTau * i / kHeadings;
      const Eigen::Vector3d direction(math::cos(heading_rad), math::sin(heading_rad), 0.0);
      const double limit_m = distance_to_side_m(world.flight_bounds, from, direction);
      unhindered_m += limit_m;
      if (!is_blocked) flown_m += grid.free_distance_m(from, direction, limit_m, body.radius_m);
      ++flights;
    }
  });
  return {.value = flown_m / static_cast<double>(flights) / body.diameter_m,
          .normalized_ratio = flown_m / unhindered_m};
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
                       [](const Obstacle& obstacle) { return !is_scenery(obstacle); });
}

double obstacle_density_1pm2(const World& world) {
  const Aabb& flight = world.flight_bounds;
  const auto count =
      std::count_if(world.obstacles.begin(), world.obstacles.end(), [&](const Obstacle& obstacle) {
        const Eigen::Vector3d& foot = obstacle.position_world;
        return !is_scenery(obstacle) && foot.x() >= flight.min().x() &&
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
