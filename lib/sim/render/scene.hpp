#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <optional>

#include "geometry/box_triangle.hpp"
#include "geometry/pose.hpp"
#include "world/world.hpp"

namespace avoidbench {

/// Where a ray first meets a surface.
struct RayHit {
  double distance_m = std::numeric_limits<double>::infinity();  ///< +inf: nothing within the limit
  std::uint32_t instance = 0;                                   ///< index into World::instances
  std::uint32_t triangle = 0;                              ///< index into the prototype's triangles
  Eigen::Vector3d normal_world = Eigen::Vector3d::Zero();  ///< unit, by the triangle's corner order
};

/// The surface point nearest to a query.
struct NearestPoint {
  double distance_m = std::numeric_limits<double>::infinity();  ///< +inf: nothing within the limit
  Eigen::Vector3d point_world = Eigen::Vector3d::Zero();
  std::uint32_t instance = 0;
};

/// A touch of the body with a surface.
struct BodyContact {
  std::uint32_t instance = 0;
  std::uint32_t triangle = 0;
};

/// The bounding volume hierarchy of a World, by Embree. Shareable between threads as long as its
/// time is not set; keeps a reference to the world, which must outlive it. What moves is put in its
/// place by the first question after set_time(): moments at which nobody asks cost nothing.
class Scene {
 public:
  explicit Scene(const World& world);
  explicit Scene(World&&) = delete;
  /// The same, but with the hierarchy flattened where the world has at most `flatten_triangles`
  /// triangles over all instances (0: never). Changes speed and memory; depths agree to 1e-5 m,
  /// point queries to the bit.
  Scene(const World& world, std::size_t flatten_triangles);
  /// Of a world that is the map of `map` and movers after its instances: shares the map's
  /// hierarchy.
  Scene(const World& world, const Scene& map);
  Scene(World&&, const Scene& map) = delete;
  ~Scene();
  Scene(Scene&&) noexcept;
  Scene& operator=(Scene&&) noexcept;

  const World& world() const;

  /// Puts what moves in the world (World::motions) where it stands at `time_s`; a new scene is at
  /// 0. Not while another thread asks the scene, nor may two ask it at once until the first has an
  /// answer.
  void set_time(double time_s);

  /// First surface along `direction` (need not be unit; distance_m is in metres all the same)
  /// within `limit_m`.
  RayHit first_hit(const Eigen::Vector3d& origin_world, const Eigen::Vector3d& direction_world,
                   double limit_m = std::numeric_limits<double>::infinity()) const;

  /// Whether anything lies between two points.
  bool occluded(const Eigen::Vector3d& from_world, const Eigen::Vector3d& to_world) const;

  /// The nearest surface point within `limit_m`, exact to double rounding of float vertices.
  NearestPoint nearest(const Eigen::Vector3d& point_world,
                       double limit_m = std::numeric_limits<double>::infinity()) const;

  /// Offers `visit` every triangle, with its corners in the world, that has a point within
  /// `radius_m` of `center_world`, and perhaps some beyond, in no order to rely on. It returns the
  /// radius that is of interest from then on.
  void visit_triangles(const Eigen::Vector3d& center_world, double radius_m,
                       const std::function<double(const Triangle& corners_world)>& visit) const;

  /// A triangle that touches the box of `size_m` (body FLU, centred) posed at T_world_body, or
  /// nothing; of several, that of the lowest instance and triangle.
  std::optional<BodyContact> touch(const Eigen::Vector3d& size_m, const Pose& T_world_body) const;

  /// Least distance from the box to any surface within `limit_m`; 0 where they touch; +inf where
  /// nothing is that near.
  double body_clearance(const Eigen::Vector3d& size_m, const Pose& T_world_body,
                        double limit_m) const;

  struct Internals;
  const Internals& internals() const;  ///< for this room's other files; at the scene's time

 private:
  std::unique_ptr<Internals> internals_;
};

}  // namespace avoidbench
