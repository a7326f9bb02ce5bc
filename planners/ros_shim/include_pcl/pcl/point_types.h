#ifndef PCL_POINT_TYPES_H
#define PCL_POINT_TYPES_H

#include <cstdint>

// Stand-ins for the usual points of PCL, for planners that need its clouds alone; NEEDS pcl takes
// the real one.
namespace pcl {

struct PointXYZ {
  float x = 0.0F, y = 0.0F, z = 0.0F;
  PointXYZ() = default;
  PointXYZ(float x_, float y_, float z_) : x(x_), y(y_), z(z_) {}
};
struct PointXYZI {
  float x = 0.0F, y = 0.0F, z = 0.0F, intensity = 0.0F;
  PointXYZI() = default;
  explicit PointXYZI(float intensity_) : intensity(intensity_) {}
  PointXYZI(float x_, float y_, float z_, float intensity_ = 0.0F)
      : x(x_), y(y_), z(z_), intensity(intensity_) {}
};
struct PointXYZRGB {
  float x = 0.0F, y = 0.0F, z = 0.0F;
  std::uint8_t b = 0, g = 0, r = 0, a = 255;
  PointXYZRGB() = default;
  PointXYZRGB(std::uint8_t r_, std::uint8_t g_, std::uint8_t b_) : b(b_), g(g_), r(r_) {}
};
struct PointXYZRGBA : PointXYZRGB {
  using PointXYZRGB::PointXYZRGB;
};
struct PointXY {
  float x = 0.0F, y = 0.0F;
};
struct PointNormal {
  float x = 0.0F, y = 0.0F, z = 0.0F, normal_x = 0.0F, normal_y = 0.0F, normal_z = 0.0F;
  float curvature = 0.0F;
};
struct PointXYZINormal : PointNormal {
  float intensity = 0.0F;
};

}  // namespace pcl

#endif
