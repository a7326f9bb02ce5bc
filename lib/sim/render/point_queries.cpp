#include <algorithm>
#include <tuple>
#include <vector>

#include "base/check.hpp"
#include "render/scene_internals.hpp"

namespace avoidbench {
namespace {

using Eigen::Vector3d;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// What Embree's float arithmetic may be off by, for a point so far from the origin: its spheres
/// are widened by this.
double float_slack(const Vector3d& point) { return 1e-4 + 1e-6 * point.cwiseAbs().maxCoeff(); }

/// A sphere around a point that shrinks as nearer surfaces are found.
struct Search {
  const Scene::Internals& scene;
  Vector3d center_world;
  double radius_m;
  double slack_m;
  std::uint32_t instance = 0;  ///< whose triangles are offered; where flattened, Embree says
  Vector3d center_in_planes;   ///< the centre in the frame of the instance's planes
  double planes_scale = 1.0;   ///< metres a unit of that frame

  Search(Scene::Internals& s, const Vector3d& center, double radius)
      : scene(s),
        center_world(center),
        radius_m(radius),
        slack_m(float_slack(center)),
        center_in_planes(center) {
    place(s);
  }

  /// Whether the triangle's plane is farther off than the radius.
  bool is_beyond(std::uint32_t entered, std::uint32_t triangle) const {
    const TrianglePlane& p = scene.planes_of[entered][triangle];
    const double height = p.nx * center_in_planes.x() + p.ny * center_in_planes.y() +
                          p.nz * center_in_planes.z() - p.offset;
    // The plane is no farther than the triangle, and it takes six operations to tell; most
    // triangles that Embree offers end here. The factor covers the scale's own rounding.
    return std::abs(height) * planes_scale * (1.0 - 1e-6) - slack_m > radius_m;
  }
};

/// Passes the search's sphere, in the frame where a unit is `scale` metres, to Embree. Returns
/// whether it shrank.
bool shrink(RTCPointQuery* query, const Search& search, double scale) {
  // Embree compares in float: a sphere that is a little too large offers a triangle too many, one
  // too small would miss the nearest.
  const auto radius = static_cast<float>((search.radius_m + search.slack_m) / scale * (1.0 + 1e-6));
  if (radius >= query->radius) return false;
  query->radius = radius;
  return true;
}

void run_query(RTCScene scene, const Vector3d& center, const Search& search, double scale,
               RTCPointQueryFunction function, void* data) {
  RTCPointQuery query{};
  query.x = static_cast<float>(center.x());
  query.y = static_cast<float>(center.y());
  query.z = static_cast<float>(center.z());
  // Infinite at first, so that shrink() sets the true one.
  query.radius = std::numeric_limits<float>::infinity();
  shrink(&query, search, scale);
  RTCPointQueryContext context;
  rtcInitPointQueryContext(&context);
  rtcPointQuery(scene, &query, &context, function, data);
}

/// Whoever is offered the triangles of a search.
template <class Visit>
struct Callback {
  Search& search;
  Visit& visit;
};

/// A query of its own within an instance that is not flattened, in its prototype's frame.
template <class Visit>
void search_instance(std::uint32_t instance, Callback<Visit>& callback) {
  Search& search = callback.search;
  const Placement& placement = search.scene.placements[instance];
  search.instance = instance;
  search.planes_scale = placement.scale;
  search.center_in_planes =
      placement.linear_prototype_world * (search.center_world - placement.position_world);
  const auto offer = [](RTCPointQueryFunctionArguments* offered) {
    auto& [held, held_visit] = *static_cast<Callback<Visit>*>(offered->userPtr);
    if (held.is_beyond(held.instance, offered->primID)) return false;
    held_visit(held.instance, offered->primID);
    return shrink(offered->query, held, held.planes_scale);
  };
  run_query(search.scene.prototype_scenes[instance], search.center_in_planes, search,
            placement.scale, offer, &callback);
}

template <class Visit>
void search_map(Search& search, Callback<Visit>& callback) {
  const MapHierarchy& map = *search.scene.map;
  if (map.flattened) {
    const auto offer = [](RTCPointQueryFunctionArguments* offered) {
      auto& [held, held_visit] = *static_cast<Callback<Visit>*>(offered->userPtr);
      if (held.is_beyond(offered->geomID, offered->primID)) return false;
      held_visit(offered->geomID, offered->primID);
      return shrink(offered->query, held, 1.0);
    };
    run_query(map.top.get(), search.center_world, search, 1.0, offer, &callback);
    return;
  }
  const auto enter = [](RTCPointQueryFunctionArguments* entered) {
    auto& held = *static_cast<Callback<Visit>*>(entered->userPtr);
    search_instance(entered->primID, held);
    // What was found within this instance narrows the search among the others.
    return shrink(entered->query, held.search, 1.0);
  };
  run_query(map.instance_boxes.get(), search.center_world, search, 1.0, enter, &callback);
}

/// A few hundred balls are looked through faster than a hierarchy of them is built again.
template <class Visit>
void search_movers(Search& search, Callback<Visit>& callback) {
  const Scene::Internals& scene = search.scene;
  for (std::size_t i = 0; i < scene.balls.size(); ++i) {
    const auto instance = scene.first_mover + static_cast<std::uint32_t>(i);
    const MoverBall& ball = scene.balls[i];
    const double reach_m = search.radius_m + search.slack_m + ball.radius_m;
    if ((ball.center_world - search.center_world).squaredNorm() > reach_m * reach_m) continue;
    search_instance(instance, callback);
  }
}

/// Offers `visit` every triangle within the search's radius, and perhaps some beyond; it may lessen
/// the radius. Embree 3.13's own way into instances misses triangles of scaled ones, so that here
/// each instance is a query of its own, in its prototype's frame.
template <class Visit>
void for_triangles_within(Search& search, Visit visit) {
  Callback<Visit> callback{search, visit};
  search_map(search, callback);
  search_movers(search, callback);
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
/// along their line is the lower bound. Ends as soon as that is above `most`.
DistanceBounds distance_bounds(const Vector3d& half, const Triangle& triangle, double most) {
  Vector3d on_box = Vector3d::Zero();
  DistanceBounds bounds{0.0, kInfinity};
  for (int i = 0; i < 3 && bounds.lower <= most; ++i) {
    const Vector3d on_triangle = closest_point(on_box, triangle);
    on_box = on_triangle.cwiseMax(-half).cwiseMin(half);
    const Vector3d between = on_triangle - on_box;
    const double upper = between.norm();
    // They touch: the line between them has no direction.
    if (upper < 1e-9) return {0.0, upper + 1e-9};
    const Vector3d direction = between / upper;
    // Along that line: where the triangle begins, less how far the box reaches.
    const double near_corner = std::min(
        {direction.dot(triangle[0]), direction.dot(triangle[1]), direction.dot(triangle[2])});
    bounds = {near_corner - half.dot(direction.cwiseAbs()) - 1e-9, upper + 1e-9};
  }
  return bounds;
}

}  // namespace

NearestPoint Scene::nearest(const Vector3d& point_world, double limit_m) const {
  AB_CHECK(point_world.allFinite(), point_world.transpose());
  NearestPoint best;
  std::uint32_t best_triangle = ~0U;
  double best_square = kInfinity;
  Search search(*internals_, point_world, limit_m);
  for_triangles_within(search, [&](std::uint32_t instance, std::uint32_t triangle) {
    const Vector3d point =
        closest_point(point_world, world_triangle(*internals_, instance, triangle));
    const double square = (point - point_world).squaredNorm();
    const bool nearer =
        // Ties go to the lowest numbers, since Embree's order depends on its hierarchy.
        std::tie(square, instance, triangle) < std::tie(best_square, best.instance, best_triangle);
    if (!nearer || std::sqrt(square) > limit_m) return;
    best_square = square;
    best_triangle = triangle;
    best = {std::sqrt(square), point, instance};
    search.radius_m = best.distance_m;
  });
  return best;
}

void Scene::visit_triangles(const Vector3d& center_world, double radius_m,
                            const std::function<double(const Triangle&)>& visit) const {
  AB_CHECK(center_world.allFinite() && radius_m >= 0.0, center_world.transpose(), radius_m);
  Search search(*internals_, center_world, radius_m);
  for_triangles_within(search, [&](std::uint32_t instance, std::uint32_t triangle) {
    search.radius_m =
        std::min(search.radius_m, visit(world_triangle(*internals_, instance, triangle)));
  });
}

std::optional<BodyContact> Scene::touch(const Vector3d& size_m, const Pose& T_world_body) const {
  const Vector3d half = 0.5 * size_m;
  const Vector3d center = T_world_body.translation();
  AB_CHECK((half.array() >= 0.0).all() && center.allFinite(), size_m.transpose());
  const Eigen::Matrix3d R_body_world = T_world_body.linear().transpose();
  std::optional<BodyContact> contact;
  // All triangles that the ball around the box meets.
  Search search(*internals_, center, half.norm());
  for_triangles_within(search, [&](std::uint32_t instance, std::uint32_t triangle) {
    // Any touching triangle ends the flight; the lowest is named, so that the record does not
    // depend on Embree's order.
    if (contact && std::tie(contact->instance, contact->triangle) < std::tie(instance, triangle)) {
      return;
    }
    const Triangle corners =
        in_body(world_triangle(*internals_, instance, triangle), R_body_world, center);
    if (overlaps(half, corners)) contact = BodyContact{instance, triangle};
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
  // Two passes: bounds from the corners alone first, exact distances for those few whose bounds
  // overlap the best.
  double bound = limit_m;  // the clearance is at most this, or nothing is within the limit
  struct Candidate {
    double lower;
    Triangle corners;
  };
  std::vector<Candidate> candidates;
  Search search(*internals_, center, half_diagonal + bound);
  for_triangles_within(search, [&](std::uint32_t instance, std::uint32_t triangle) {
    const Triangle corners =
        in_body(world_triangle(*internals_, instance, triangle), R_body_world, center);
    const DistanceBounds bounds = distance_bounds(half, corners, bound);
    if (bounds.lower > bound) return;
    candidates.push_back({bounds.lower, corners});
    bound = std::min(bound, bounds.upper);
    search.radius_m = half_diagonal + bound;
  });
  // The exact distance is dear: only for those that may still be the nearest.
  double best = kInfinity;
  for (const Candidate& candidate : candidates) {
    if (candidate.lower > bound) continue;
    const double exact = distance(half, candidate.corners);
    if (exact <= limit_m) best = std::min(best, exact);
    bound = std::min(bound, exact + 1e-9);
  }
  return best;
}

}  // namespace avoidbench
