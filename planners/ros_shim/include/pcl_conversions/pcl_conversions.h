#ifndef PCL_CONVERSIONS_PCL_CONVERSIONS_H
#define PCL_CONVERSIONS_PCL_CONVERSIONS_H

#include <pcl/point_cloud.h>
#include <pcl/point_types.h>

#include <cstdint>
#include <cstring>
#include <string>
#include <type_traits>

#include "ros/time.h"
#include "sensor_msgs/Image.h"  // as ROS's own does, and sources rely on it
#include "sensor_msgs/PointCloud2.h"
#include "std_msgs/Header.h"

// Clouds as messages and back: x, y, z, and intensity where a point has it. Over the stand-in's
// clouds and over PCL's.
namespace pcl_conversions {

inline std::uint64_t toPCL(const ros::Time& stamp) {
  return static_cast<std::uint64_t>(stamp.toNSec()) / 1000;
}
inline ros::Time fromPCL(std::uint64_t stamp) {
  return ros::Time().fromNSec(static_cast<std::int64_t>(stamp) * 1000);
}
template <class PclHeader = pcl::PCLHeader>
PclHeader toPCL(const std_msgs::Header& header) {
  PclHeader made;
  made.seq = header.seq;
  made.stamp = toPCL(header.stamp);
  made.frame_id = header.frame_id;
  return made;
}
inline std_msgs::Header fromPCL(const pcl::PCLHeader& header) {
  std_msgs::Header made;
  made.seq = header.seq;
  made.stamp = fromPCL(static_cast<std::uint64_t>(header.stamp));
  made.frame_id = header.frame_id;
  return made;
}

namespace detail {

template <class P, class = void>
struct HasIntensity : std::false_type {};
template <class P>
struct HasIntensity<P, decltype(static_cast<void>(std::declval<P&>().intensity))> : std::true_type {
};

template <class P>
float intensity_of(const P& point, std::true_type) {
  return point.intensity;
}
template <class P>
float intensity_of(const P&, std::false_type) {
  return 0.0F;
}
template <class P>
void set_intensity(P& point, float value, std::true_type) {
  point.intensity = value;
}
template <class P>
void set_intensity(P&, float, std::false_type) {}

/// A number of the message, whatever its type; 0 where the cloud has no such field.
struct FieldReader {
  int offset = -1, type = 0;
  FieldReader(const sensor_msgs::PointCloud2& cloud, const char* name) {
    for (const auto& field : cloud.fields) {
      if (field.name != name) continue;
      offset = static_cast<int>(field.offset);
      type = field.datatype;
    }
  }
  float read(const std::uint8_t* point) const {
    if (offset < 0) return 0.0F;
    switch (type) {
      case sensor_msgs::PointField::FLOAT32:
        return value<float>(point);
      case sensor_msgs::PointField::FLOAT64:
        return value<double>(point);
      case sensor_msgs::PointField::UINT8:
        return value<std::uint8_t>(point);
      case sensor_msgs::PointField::UINT16:
        return value<std::uint16_t>(point);
      case sensor_msgs::PointField::UINT32:
        return value<std::uint32_t>(point);
      case sensor_msgs::PointField::INT8:
        return value<std::int8_t>(point);
      case sensor_msgs::PointField::INT16:
        return value<std::int16_t>(point);
      default:
        return value<std::int32_t>(point);
    }
  }
  template <class T>
  float value(const std::uint8_t* point) const {
    T read{};
    std::memcpy(&read, point + offset, sizeof read);
    return static_cast<float>(read);
  }
};

inline void add_field(sensor_msgs::PointCloud2& message, const char* name, std::uint32_t offset) {
  sensor_msgs::PointField field;
  field.name = name;
  field.offset = offset;
  field.datatype = sensor_msgs::PointField::FLOAT32;
  field.count = 1;
  message.fields.push_back(field);
}

}  // namespace detail
}  // namespace pcl_conversions

namespace pcl {

template <class PointT>
void toROSMsg(const PointCloud<PointT>& cloud, sensor_msgs::PointCloud2& message) {
  namespace detail = pcl_conversions::detail;
  using WithIntensity = detail::HasIntensity<PointT>;
  message = sensor_msgs::PointCloud2();
  message.header = pcl_conversions::fromPCL(cloud.header);
  const bool is_grid = std::size_t{cloud.width} * cloud.height == cloud.points.size();
  message.width = is_grid ? cloud.width : static_cast<std::uint32_t>(cloud.points.size());
  message.height = is_grid ? cloud.height : 1;
  const char* const names[] = {"x", "y", "z", "intensity"};
  const std::uint32_t count = WithIntensity::value ? 4 : 3;
  for (std::uint32_t i = 0; i < count; ++i) detail::add_field(message, names[i], 4 * i);
  message.point_step = 4 * count;
  message.row_step = message.point_step * message.width;
  message.is_dense = cloud.is_dense ? 1 : 0;
  message.data.resize(std::size_t{message.point_step} * cloud.points.size());
  std::uint8_t* to = message.data.data();
  for (const PointT& point : cloud.points) {
    const float values[] = {point.x, point.y, point.z,
                            detail::intensity_of(point, WithIntensity())};
    std::memcpy(to, values, message.point_step);
    to += message.point_step;
  }
}

template <class PointT>
void fromROSMsg(const sensor_msgs::PointCloud2& message, PointCloud<PointT>& cloud) {
  namespace detail = pcl_conversions::detail;
  cloud.header = pcl_conversions::toPCL(message.header);
  cloud.width = message.width;
  cloud.height = message.height;
  cloud.is_dense = message.is_dense != 0;
  cloud.points.resize(std::size_t{message.width} * message.height);
  const detail::FieldReader x(message, "x"), y(message, "y"), z(message, "z");
  const detail::FieldReader intensity(message, "intensity");
  for (std::size_t i = 0; i < cloud.points.size(); ++i) {
    const std::size_t row = i / message.width, column = i % message.width;
    const std::uint8_t* from =
        message.data.data() + row * message.row_step + column * message.point_step;
    cloud.points[i].x = x.read(from);
    cloud.points[i].y = y.read(from);
    cloud.points[i].z = z.read(from);
    detail::set_intensity(cloud.points[i], intensity.read(from), detail::HasIntensity<PointT>());
  }
}

}  // namespace pcl

#endif
