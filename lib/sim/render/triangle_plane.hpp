#pragma once

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

/// Of a list of cameras: the first is in the world's frame, in which the planes of the first
/// `flattened_count` instances are, and then there is one for each of the others.
[[gnu::always_inline]] inline unsigned camera_of(unsigned instance, unsigned flattened_count) {
  return instance < flattened_count ? 0 : instance - flattened_count + 1;
}

[[gnu::always_inline]] inline PlaneInCamera seen_by(const CameraAxes& camera,
                                                    const TrianglePlane& plane) {
  // The normal's parts along right, down, forward, and minus the position's: h is the offset less
  // that. Compilers make one or two registers of the loop.
  double along[4];
  for (int i = 0; i < 4; ++i) {
    along[i] = plane.nx * camera.x[i] + plane.ny * camera.y[i] + plane.nz * camera.z[i];
  }
  return {along[0], along[1], along[2], along[3] + plane.offset};
}

}  // namespace
}  // namespace avoidbench
