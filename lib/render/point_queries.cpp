#include <algorithm>
#include <tuple>

#include "base/check.hpp"
#include "render/scene_internals.hpp"

namespace avoidbench {
namespace {

using Eigen::Vector3d;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// What Embree's float arithmetic may be off by, for a point so far from the origin: its spheres
/// are widened by this.
double float_slack(const Vector3d& point) { return 1e-4 + 1e-6 * point.cwiseAbs().maxCoeff(); }

/// A sphere around a point that shrinks as nearer surfaces are found, and the way from Embree's
/// callback to a triangle.
struct Search {
  const Scene::Internals& scene;
  Vector3d center_world;
  double slack_m;
  std::uint32_t instance = ~0U;  ///< of the last triangle offered
  Vector3d center_in_planes =
      Vector3d::Zero();       ///< the centre in the frame of that instance's planes
  double planes_scale = 1.0;  ///< metres a unit of that frame

  Search(const Scene::Internals& s, const Vector3d& center)
      : scene(s), center_world(center), slack_m(float_slack(center)), center_in_planes(center) {}

  std::uint32_t enter_instance(const RTCPointQueryFunctionArguments& offered) {
    if (scene.flattened) return offered.geomID;
    const std::uint32_t entered = offered.context->instID[0];
    if (entered != instance) {
      const Placement& placement = scene.placements[entered];
      instance = entered;
      center_in_planes =
          placement.linear_prototype_world * (center_world - placement.position_world);
      planes_scale = placement.scale;
    }
    return entered;
  }

  /// Distance from the centre to the triangle's plane, a lower bound of that to the triangle, less
  /// what it may be off by.
  double lower_bound_m(std::uint32_t entered, std::uint32_t triangle) const {
    const TrianglePlane& p = scene.placements[entered].planes[triangle];
    const double signed_distance = p.nx * center_in_planes.x() + p.ny * center_in_planes.y() +
                                   p.nz * center_in_planes.z() - p.offset;
    return std::abs(signed_distance) * planes_scale * (1.0 - 1e-6) - slack_m;
  }
};

/// Offers `visit` every triangle within `radius_m` of the search's centre, and perhaps some beyond.
/// It returns the radius from there on, in metres, at most the one before.
template <class Visit>
void for_triangles_within(Search& search, double radius_m, Visit visit) {
  struct Callback {
    Search& search;
    Visit& visit;
  } callback{search, visit};
  RTCPointQuery query{};
  query.x = static_cast<float>(search.center_world.x());
  query.y = static_cast<float>(search.center_world.y());
  query.z = static_cast<float>(search.center_world.z());
  query.radius = static_cast<float>(radius_m + search.slack_m);
  RTCPointQueryContext context;
  rtcInitPointQueryContext(&context);
  rtcPointQuery(
      search.scene.top.get(), &query, &context,
      [](RTCPointQueryFunctionArguments* offered) {
        auto& [held_search, held_visit] = *static_cast<Callback*>(offered->userPtr);
        const std::uint32_t instance = held_search.enter_instance(*offered);
        const double radius = held_visit(instance, offered->primID);
        const auto widened = static_cast<float>(radius + held_search.slack_m);
        if (widened >= offered->query->radius) return false;
        offered->query->radius = widened;
        return true;
      },
      &callback);
}

Triangle in_body(Triangle triangle, const Eigen::Matrix3d& R_body_world, const Vector3d& origin) {
  for (Vector3d& corner : triangle) corner = R_body_world * (corner - origin);
  return triangle;
}

struct DistanceBounds {
  double lower, upper;
};

/// Bounds of the distance between the box centred at the origin and the triangle, widened by more
/// than rounding. A few projections to and fro bring a pair of points close to the nearest; the gap
/// along their line is the lower bound.
DistanceBounds distance_bounds(const Vector3d& half, const Triangle& triangle) {
  Vector3d on_box = Vector3d::Zero();
  Vector3d between = Vector3d::Zero();
  for (int i = 0; i < 3; ++i) {
    const Vector3d on_triangle = closest_point(on_box, triangle);
    on_box = on_triangle.cwiseMax(-half).cwiseMin(half);
    between = on_triangle - on_box;
  }
  const double upper = between.norm();
  if (upper < 1e-9) return {0.0, upper + 1e-9};
  const Vector3d direction = between / upper;
  const double near_corner = std::min(
      {direction.dot(triangle[0]), direction.dot(triangle[1]), direction.dot(triangle[2])});
  return {near_corner - half.dot(direction.cwiseAbs()) - 1e-9, upper + 1e-9};
}

}  // namespace

NearestPoint Scene::nearest(const Vector3d& point_world, double limit_m) const {
  AB_CHECK(point_world.allFinite(), point_world.transpose());
  NearestPoint best;
  std::uint32_t best_triangle = ~0U;
  double best_square = kInfinity;
  double radius_m = limit_m;
  Search search(*internals_, point_world);
  for_triangles_within(search, limit_m, [&](std::uint32_t instance, std::uint32_t triangle) {
    if (search.lower_bound_m(instance, triangle) > radius_m) return radius_m;
    const Vector3d point =
        closest_point(point_world, world_triangle(*internals_, instance, triangle));
    const double square = (point - point_world).squaredNorm();
    const bool nearer =
        std::tie(square, instance, triangle) < std::tie(best_square, best.instance, best_triangle);
    if (!nearer || std::sqrt(square) > limit_m) return radius_m;
    best_square = square;
    best_triangle = triangle;
    best = {std::sqrt(square), point, instance};
    radius_m = best.distance_m;
    return radius_m;
  });
  return best;
}

std::optional<BodyContact> Scene::touch(const Vector3d& size_m, const Pose& T_world_body) const {
  const Vector3d half = 0.5 * size_m;
  const Vector3d center = T_world_body.translation();
  AB_CHECK((half.array() >= 0.0).all() && center.allFinite(), size_m.transpose());
  const Eigen::Matrix3d R_body_world = T_world_body.linear().transpose();
  const double radius_m = half.norm();
  std::optional<BodyContact> contact;
  Search search(*internals_, center);
  for_triangles_within(search, radius_m, [&](std::uint32_t instance, std::uint32_t triangle) {
    if (contact && std::tie(contact->instance, contact->triangle) < std::tie(instance, triangle)) {
      return radius_m;
    }
    if (search.lower_bound_m(instance, triangle) > radius_m) return radius_m;
    const Triangle corners =
        in_body(world_triangle(*internals_, instance, triangle), R_body_world, center);
    if (overlaps(half, corners)) contact = BodyContact{instance, triangle};
    return radius_m;
  });
  return contact;
}

double Scene::body_clearance(const Vector3d& size_m, const Pose& T_world_body,
                             double limit_m) const {
  const Vector3d half = 0.5 * size_m;
  const Vector3d center = T_world_body.translation();
  AB_CHECK((half.array() >= 0.0).all() && center.allFinite(), size_m.transpose());
  const Eigen::Matrix3d R_body_world = T_world_body.linear().transpose();
  const double half_diagonal = half.norm();
  double best = kInfinity;
  double bound =
      limit_m;  // the clearance is at most this, but for rounding; or nothing is within the limit
  Search search(*internals_, center);
  const auto radius = [&] { return half_diagonal + bound; };
  for_triangles_within(search, radius(), [&](std::uint32_t instance, std::uint32_t triangle) {
    if (search.lower_bound_m(instance, triangle) > radius()) return radius();
    const Triangle corners =
        in_body(world_triangle(*internals_, instance, triangle), R_body_world, center);
    const DistanceBounds bounds = distance_bounds(half, corners);
    bound = std::min(bound, bounds.upper);
    if (bounds.lower > bound) return radius();
    const double exact = distance(half, corners);
    if (exact <= limit_m) best = std::min(best, exact);
    bound = std::min(bound, exact + 1e-9);
    return radius();
  });
  return best;
}

}  // namespace avoidbench
