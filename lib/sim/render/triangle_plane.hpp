#pragma once

#include "render/lanes.hpp"

/// The planes that triangles lie in. Plain data and no inline function that the linker might keep:
/// files compiled for AVX2 include this.
namespace avoidbench {

/// normal · p = offset on the triangle; the normal is a unit vector, or zero where the triangle has
/// no area.
struct alignas(32) TrianglePlane {
  double nx, ny, nz, offset;
};

/// A camera in the frame of planes: for each of x, y, z that part of its axes right, down and
/// forward (unit vectors), and of its position [m], the latter with its sign turned.
struct alignas(32) CameraAxes {
  double x[4], y[4], z[4];
};

/// The plane a·u + b·v + c = h/depth in a camera's frame, where (u, v, 1) is a pixel's ray.
struct PlaneInCamera {
  double a, b, c, h;
};

namespace {

/// a, b, c and h of a PlaneInCamera.
AB_LANE Doubles seen_by(const CameraAxes& camera, const TrianglePlane& plane) {
  // The normal's parts along right, down, forward, and minus the position's: h is the offset less
  // that.
  const Doubles along = all_lanes(plane.nx) * load_four(camera.x) +
                        all_lanes(plane.ny) * load_four(camera.y) +
                        all_lanes(plane.nz) * load_four(camera.z);
  return fourth_from(along + load_four(&plane.nx), along);
}

AB_LANE PlaneInCamera as_plane(Doubles parts) {
  PlaneInCamera plane;
  store_four(&plane.a, parts);
  return plane;
}

}  // namespace
}  // namespace avoidbench
