#pragma once

#include <Eigen/Core>
#include <vector>

#include "render/embree.hpp"
#include "render/ray_test.hpp"
#include "render/triangle_plane.hpp"

/// Which triangle a ray meets first. Embree only finds candidates: it holds triangles as boxes that
/// are larger than its rounding. Whether a ray meets a triangle, and where, is decided here in
/// double, the same on every processor and with every version of Embree; of triangles at one
/// distance, the one of the lowest instance and number is met.
namespace avoidbench {

struct Placement;

/// A mesh as Embree's rays meet it, in the frame of its planes. Must not move in memory once it has
/// a geometry.
struct TracedMesh {
  std::vector<TracedTriangle> triangles;
  const TrianglePlane* planes = nullptr;  ///< one a triangle
  /// By which boxes are larger, in the mesh's frame; set before the scene is committed.
  float box_slack = 0.0F;
};

/// Of boxes in a frame with `scale` metres a unit: more than Embree's rounding of rays and boxes
/// within `reach_m` of the world's origin.
inline float box_slack(double reach_m, double scale) {
  return static_cast<float>((1e-4 + 4e-6 * reach_m) / scale);
}

/// Corner by corner, with what the test needs.
TracedTriangle traced_triangle(const Eigen::Vector3f& a, const Eigen::Vector3f& b,
                               const Eigen::Vector3f& c);

/// A geometry of the mesh's boxes, committed.
embree::GeometryHandle make_traced_geometry(const TracedMesh& mesh);

/// Traces packets through `scene`, whose instances are placed by `placements`. Sets the hit of each
/// ray that meets something nearer than its end, and its end to the distance there. Lanes whose end
/// lies before their beginning are inactive. Within a ScopedFlushToZero.
void trace(RTCScene scene, const Placement* placements, RTCRayHit8& packet);
void trace(RTCScene scene, const Placement* placements,
           RTCRayHit8 (&packets)[embree::kStreamPackets]);

/// Gives rays that meet anything an end of -inf.
void occlude(RTCScene scene, const Placement* placements, RTCRay8& packet);
void occlude(RTCScene scene, const Placement* placements,
             RTCRay8 (&packets)[embree::kStreamPackets]);

}  // namespace avoidbench
