#include "world/world.hpp"

#include <algorithm>
#include <span>

#include "base/digest.hpp"
#include "base/math.hpp"
#include "base/number_text.hpp"

namespace avoidbench {
namespace {

void add(Digest& digest, const Eigen::Vector3d& v) { digest.add(v.x()).add(v.y()).add(v.z()); }

template <class T>
void add(Digest& digest, const std::vector<T>& values) {
  // The count first: else numbers could move from one list to the next unseen.
  digest.add(static_cast<std::uint64_t>(values.size()));
  digest.add_array(std::span<const T>(values));
}

/// The first kind of path there was: it has no name before its numbers.
void add(Digest& digest, const Sway& sway) {
  add(digest, sway.amplitude_world);
  digest.add(sway.period_s).add(sway.phase);
}

void add(Digest& digest, const Route& route) {
  digest.add(std::string_view("route")).add(static_cast<std::uint64_t>(route.knots.size()));
  for (const Knot& knot : route.knots) {
    digest.add(knot.time_s).add(knot.turn_rad);
    add(digest, knot.offset_world);
  }
}

void add(Digest& digest, const Trefoil& knot) {
  digest.add(std::string_view("trefoil")).add(knot.reach_m).add(knot.rise_m);
  digest.add(knot.period_s).add(knot.phase).add(knot.heading_rad);
}

template <class T>
std::size_t bytes(const std::vector<T>& values) {
  return values.size() * sizeof(T);
}

}  // namespace

std::string world_digest(const World& world) {
  // Arrays are digested as bytes: they must have no padding.
  static_assert(sizeof(Eigen::Vector3f) == 12 && sizeof(Material) == 1);
  Digest digest;
  // A name for what is digested: other contents need another one.
  digest.add(std::string_view("avoidbench world 1"));
  digest.add(static_cast<std::uint64_t>(world.prototypes.size()));
  for (const Prototype& prototype : world.prototypes) {
    digest.add(std::string_view(prototype.name));
    add(digest, prototype.mesh.vertices);
    add(digest, prototype.mesh.triangles);
    add(digest, prototype.triangle_materials);
  }
  digest.add(static_cast<std::uint64_t>(world.instances.size()));
  for (const Instance& instance : world.instances) {
    digest.add(std::uint64_t{instance.prototype}).add(std::uint64_t{instance.obstacle});
    digest.add_array(std::span<const float>(instance.T_world_prototype.matrix().data(), 16));
  }
  digest.add(static_cast<std::uint64_t>(world.obstacles.size()));
  for (const Obstacle& obstacle : world.obstacles) {
    digest.add(std::string_view(obstacle.kind));
    add(digest, obstacle.position_world);
    digest.add(obstacle.width_m).add(obstacle.texture_opacity);
  }
  const HeightField& ground = world.ground;
  digest.add(ground.low_x_m).add(ground.low_y_m).add(ground.cell_m);
  digest.add(std::uint64_t{ground.columns}).add(std::uint64_t{ground.rows});
  add(digest, ground.heights_m);
  for (const Aabb* box : {&world.bounds, &world.flight_bounds}) {
    add(digest, box->min());
    add(digest, box->max());
  }
  for (const Region* region : {&world.start_region, &world.goal_region}) {
    add(digest, region->lowest);
    add(digest, region->highest);
  }
  digest.add(std::uint64_t{world.heights_above_ground ? 1U : 0U});
  digest.add(world.poisson_radius_m).add(world.mean_obstacle_width_m);
  for (const Motion& motion : world.motions) {
    digest.add(std::uint64_t{motion.instance});
    std::visit([&digest](const auto& path) { add(digest, path); }, motion.path);
  }
  return digest.hex();
}

double greatest_surface_speed_mps(const World& world, const Motion& motion) {
  const Instance& instance = world.instances[motion.instance];
  float reach_m = 0.0F;
  for (const Eigen::Vector3f& vertex : world.prototypes[instance.prototype].mesh.vertices) {
    reach_m = std::max(reach_m, (instance.T_world_prototype.linear() * vertex).head<2>().norm());
  }
  return greatest_speed_mps(motion) + greatest_turn_radps(motion) * static_cast<double>(reach_m);
}

World standing_at(World world, double time_s) {
  for (const Motion& motion : world.motions) {
    Instance& instance = world.instances[motion.instance];
    instance.T_world_prototype = moved(instance.T_world_prototype, motion, time_s);
    world.obstacles[instance.obstacle].position_world += displacement_world(motion, time_s);
  }
  world.motions.clear();
  return world;
}

std::size_t triangle_count(const World& world) {
  std::size_t count = 0;
  for (const Instance& instance : world.instances) {
    count += world.prototypes[instance.prototype].mesh.triangles.size();
  }
  return count;
}

std::size_t memory_bytes(const World& world) {
  std::size_t total = sizeof(World) + bytes(world.prototypes) + bytes(world.instances) +
                      bytes(world.obstacles) + bytes(world.motions) + bytes(world.ground.heights_m);
  for (const Prototype& prototype : world.prototypes) {
    total += bytes(prototype.mesh.vertices) + bytes(prototype.mesh.triangles) +
             bytes(prototype.triangle_materials);
  }
  return total;
}

std::string box_text(const Aabb& box) {
  std::string text;
  for (int axis = 0; axis < 3; ++axis) {
    text += (axis > 0 ? " × [" : "[") + fixed_digits(box.min()[axis], 2) + ", " +
            fixed_digits(box.max()[axis], 2) + "]";
  }
  return text;
}

}  // namespace avoidbench
