#include "world/world.hpp"

#include <span>

#include <cmath>

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
    add(digest, motion.amplitude_world);
    digest.add(motion.period_s).add(motion.phase);
  }
  return digest.hex();
}

Eigen::Vector3d displacement_world(const Motion& motion, double time_s) {
  const double turns = time_s / motion.period_s + motion.phase;
  // Whole turns are taken off first: a large argument would lose digits of its fraction.
  return motion.amplitude_world * math::sin(math::kTau * (turns - std::floor(turns)));
}

double greatest_speed_mps(const Motion& motion) {
  return motion.amplitude_world.norm() * math::kTau / motion.period_s;
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
