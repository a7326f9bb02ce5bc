#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "base/fields.hpp"

/// The messages of ROS 2 that flights are written as. Each struct has the name and, by its visit(),
/// the fields of the message's definition, from which ros2_schema.hpp makes the definition's text
/// and cdr_writer.hpp the bytes: they can't contradict each other. tests/export/check_mcap.py
/// compares them with ROS's own.
namespace avoidbench {

struct RosTime {
  static constexpr const char* kName = "builtin_interfaces/msg/Time";
  std::int32_t sec = 0;
  std::uint32_t nanosec = 0;
};
template <class Visitor, ConstOr<RosTime> M>
void visit(Visitor& v, M& m) {
  v.field("sec", m.sec);
  v.field("nanosec", m.nanosec);
}

struct RosDuration {
  static constexpr const char* kName = "builtin_interfaces/msg/Duration";
  std::int32_t sec = 0;
  std::uint32_t nanosec = 0;
};
template <class Visitor, ConstOr<RosDuration> M>
void visit(Visitor& v, M& m) {
  v.field("sec", m.sec);
  v.field("nanosec", m.nanosec);
}

struct RosHeader {
  static constexpr const char* kName = "std_msgs/msg/Header";
  RosTime stamp{};
  std::string frame_id{};
};
template <class Visitor, ConstOr<RosHeader> M>
void visit(Visitor& v, M& m) {
  v.field("stamp", m.stamp);
  v.field("frame_id", m.frame_id);
}

struct RosColor {
  static constexpr const char* kName = "std_msgs/msg/ColorRGBA";
  float r = 0.0F, g = 0.0F, b = 0.0F, a = 0.0F;
};
template <class Visitor, ConstOr<RosColor> M>
void visit(Visitor& v, M& m) {
  v.field("r", m.r);
  v.field("g", m.g);
  v.field("b", m.b);
  v.field("a", m.a);
}

struct RosFloat64 {
  static constexpr const char* kName = "std_msgs/msg/Float64";
  double data = 0.0;
};
template <class Visitor, ConstOr<RosFloat64> M>
void visit(Visitor& v, M& m) {
  v.field("data", m.data);
}

struct RosString {
  static constexpr const char* kName = "std_msgs/msg/String";
  std::string data{};
};
template <class Visitor, ConstOr<RosString> M>
void visit(Visitor& v, M& m) {
  v.field("data", m.data);
}

struct RosPoint {
  static constexpr const char* kName = "geometry_msgs/msg/Point";
  double x = 0.0, y = 0.0, z = 0.0;
};
template <class Visitor, ConstOr<RosPoint> M>
void visit(Visitor& v, M& m) {
  v.field("x", m.x);
  v.field("y", m.y);
  v.field("z", m.z);
}

struct RosVector3 {
  static constexpr const char* kName = "geometry_msgs/msg/Vector3";
  double x = 0.0, y = 0.0, z = 0.0;
};
template <class Visitor, ConstOr<RosVector3> M>
void visit(Visitor& v, M& m) {
  v.field("x", m.x);
  v.field("y", m.y);
  v.field("z", m.z);
}

struct RosQuaternion {
  static constexpr const char* kName = "geometry_msgs/msg/Quaternion";
  double x = 0.0, y = 0.0, z = 0.0, w = 1.0;
};
template <class Visitor, ConstOr<RosQuaternion> M>
void visit(Visitor& v, M& m) {
  v.field("x", m.x);
  v.field("y", m.y);
  v.field("z", m.z);
  v.field("w", m.w);
}

struct RosPose {
  static constexpr const char* kName = "geometry_msgs/msg/Pose";
  RosPoint position{};
  RosQuaternion orientation{};
};
template <class Visitor, ConstOr<RosPose> M>
void visit(Visitor& v, M& m) {
  v.field("position", m.position);
  v.field("orientation", m.orientation);
}

struct RosTransform {
  static constexpr const char* kName = "geometry_msgs/msg/Transform";
  RosVector3 translation{};
  RosQuaternion rotation{};
};
template <class Visitor, ConstOr<RosTransform> M>
void visit(Visitor& v, M& m) {
  v.field("translation", m.translation);
  v.field("rotation", m.rotation);
}

struct RosTwist {
  static constexpr const char* kName = "geometry_msgs/msg/Twist";
  RosVector3 linear{}, angular{};
};
template <class Visitor, ConstOr<RosTwist> M>
void visit(Visitor& v, M& m) {
  v.field("linear", m.linear);
  v.field("angular", m.angular);
}

struct RosAccel {
  static constexpr const char* kName = "geometry_msgs/msg/Accel";
  RosVector3 linear{}, angular{};
};
template <class Visitor, ConstOr<RosAccel> M>
void visit(Visitor& v, M& m) {
  v.field("linear", m.linear);
  v.field("angular", m.angular);
}

struct RosPointStamped {
  static constexpr const char* kName = "geometry_msgs/msg/PointStamped";
  RosHeader header{};
  RosPoint point{};
};
template <class Visitor, ConstOr<RosPointStamped> M>
void visit(Visitor& v, M& m) {
  v.field("header", m.header);
  v.field("point", m.point);
}

struct RosPoseStamped {
  static constexpr const char* kName = "geometry_msgs/msg/PoseStamped";
  RosHeader header{};
  RosPose pose{};
};
template <class Visitor, ConstOr<RosPoseStamped> M>
void visit(Visitor& v, M& m) {
  v.field("header", m.header);
  v.field("pose", m.pose);
}

struct RosTwistStamped {
  static constexpr const char* kName = "geometry_msgs/msg/TwistStamped";
  RosHeader header{};
  RosTwist twist{};
};
template <class Visitor, ConstOr<RosTwistStamped> M>
void visit(Visitor& v, M& m) {
  v.field("header", m.header);
  v.field("twist", m.twist);
}

struct RosAccelStamped {
  static constexpr const char* kName = "geometry_msgs/msg/AccelStamped";
  RosHeader header{};
  RosAccel accel{};
};
template <class Visitor, ConstOr<RosAccelStamped> M>
void visit(Visitor& v, M& m) {
  v.field("header", m.header);
  v.field("accel", m.accel);
}

struct RosTransformStamped {
  static constexpr const char* kName = "geometry_msgs/msg/TransformStamped";
  RosHeader header{};
  std::string child_frame_id{};
  RosTransform transform{};
};
template <class Visitor, ConstOr<RosTransformStamped> M>
void visit(Visitor& v, M& m) {
  v.field("header", m.header);
  v.field("child_frame_id", m.child_frame_id);
  v.field("transform", m.transform);
}

struct RosPoseWithCovariance {
  static constexpr const char* kName = "geometry_msgs/msg/PoseWithCovariance";
  RosPose pose{};
  std::array<double, 36> covariance{};
};
template <class Visitor, ConstOr<RosPoseWithCovariance> M>
void visit(Visitor& v, M& m) {
  v.field("pose", m.pose);
  v.field("covariance", m.covariance);
}

struct RosTwistWithCovariance {
  static constexpr const char* kName = "geometry_msgs/msg/TwistWithCovariance";
  RosTwist twist{};
  std::array<double, 36> covariance{};
};
template <class Visitor, ConstOr<RosTwistWithCovariance> M>
void visit(Visitor& v, M& m) {
  v.field("twist", m.twist);
  v.field("covariance", m.covariance);
}

struct RosOdometry {
  static constexpr const char* kName = "nav_msgs/msg/Odometry";
  RosHeader header{};
  std::string child_frame_id{};
  RosPoseWithCovariance pose{};
  RosTwistWithCovariance twist{};
};
template <class Visitor, ConstOr<RosOdometry> M>
void visit(Visitor& v, M& m) {
  v.field("header", m.header);
  v.field("child_frame_id", m.child_frame_id);
  v.field("pose", m.pose);
  v.field("twist", m.twist);
}

struct RosPath {
  static constexpr const char* kName = "nav_msgs/msg/Path";
  RosHeader header{};
  std::vector<RosPoseStamped> poses{};
};
template <class Visitor, ConstOr<RosPath> M>
void visit(Visitor& v, M& m) {
  v.field("header", m.header);
  v.field("poses", m.poses);
}

struct RosTransforms {
  static constexpr const char* kName = "tf2_msgs/msg/TFMessage";
  std::vector<RosTransformStamped> transforms{};
};
template <class Visitor, ConstOr<RosTransforms> M>
void visit(Visitor& v, M& m) {
  v.field("transforms", m.transforms);
}

struct RosImage {
  static constexpr const char* kName = "sensor_msgs/msg/Image";
  RosHeader header{};
  std::uint32_t height = 0, width = 0;
  std::string encoding{};
  std::uint8_t is_bigendian = 0;
  std::uint32_t step = 0;
  std::vector<std::uint8_t> data{};
};
template <class Visitor, ConstOr<RosImage> M>
void visit(Visitor& v, M& m) {
  v.field("header", m.header);
  v.field("height", m.height);
  v.field("width", m.width);
  v.field("encoding", m.encoding);
  v.field("is_bigendian", m.is_bigendian);
  v.field("step", m.step);
  v.field("data", m.data);
}

struct RosRegion {
  static constexpr const char* kName = "sensor_msgs/msg/RegionOfInterest";
  std::uint32_t x_offset = 0, y_offset = 0, height = 0, width = 0;
  bool do_rectify = false;
};
template <class Visitor, ConstOr<RosRegion> M>
void visit(Visitor& v, M& m) {
  v.field("x_offset", m.x_offset);
  v.field("y_offset", m.y_offset);
  v.field("height", m.height);
  v.field("width", m.width);
  v.field("do_rectify", m.do_rectify);
}

struct RosCameraInfo {
  static constexpr const char* kName = "sensor_msgs/msg/CameraInfo";
  RosHeader header{};
  std::uint32_t height = 0, width = 0;
  std::string distortion_model{};
  std::vector<double> d{};
  std::array<double, 9> k{}, r{};
  std::array<double, 12> p{};
  std::uint32_t binning_x = 0, binning_y = 0;
  RosRegion roi{};
};
template <class Visitor, ConstOr<RosCameraInfo> M>
void visit(Visitor& v, M& m) {
  v.field("header", m.header);
  v.field("height", m.height);
  v.field("width", m.width);
  v.field("distortion_model", m.distortion_model);
  v.field("d", m.d);
  v.field("k", m.k);
  v.field("r", m.r);
  v.field("p", m.p);
  v.field("binning_x", m.binning_x);
  v.field("binning_y", m.binning_y);
  v.field("roi", m.roi);
}

struct RosPointField {
  static constexpr const char* kName = "sensor_msgs/msg/PointField";
  std::string name{};
  std::uint32_t offset = 0;
  std::uint8_t datatype = 0;
  std::uint32_t count = 0;
};
template <class Visitor, ConstOr<RosPointField> M>
void visit(Visitor& v, M& m) {
  v.field("name", m.name);
  v.field("offset", m.offset);
  v.field("datatype", m.datatype);
  v.field("count", m.count);
}

struct RosPointCloud {
  static constexpr const char* kName = "sensor_msgs/msg/PointCloud2";
  RosHeader header{};
  std::uint32_t height = 0, width = 0;
  std::vector<RosPointField> fields{};
  bool is_bigendian = false;
  std::uint32_t point_step = 0, row_step = 0;
  std::vector<std::uint8_t> data{};
  bool is_dense = false;
};
template <class Visitor, ConstOr<RosPointCloud> M>
void visit(Visitor& v, M& m) {
  v.field("header", m.header);
  v.field("height", m.height);
  v.field("width", m.width);
  v.field("fields", m.fields);
  v.field("is_bigendian", m.is_bigendian);
  v.field("point_step", m.point_step);
  v.field("row_step", m.row_step);
  v.field("data", m.data);
  v.field("is_dense", m.is_dense);
}

struct RosImu {
  static constexpr const char* kName = "sensor_msgs/msg/Imu";
  RosHeader header{};
  RosQuaternion orientation{};
  std::array<double, 9> orientation_covariance{};
  RosVector3 angular_velocity{};
  std::array<double, 9> angular_velocity_covariance{};
  RosVector3 linear_acceleration{};
  std::array<double, 9> linear_acceleration_covariance{};
};
template <class Visitor, ConstOr<RosImu> M>
void visit(Visitor& v, M& m) {
  v.field("header", m.header);
  v.field("orientation", m.orientation);
  v.field("orientation_covariance", m.orientation_covariance);
  v.field("angular_velocity", m.angular_velocity);
  v.field("angular_velocity_covariance", m.angular_velocity_covariance);
  v.field("linear_acceleration", m.linear_acceleration);
  v.field("linear_acceleration_covariance", m.linear_acceleration_covariance);
}

struct RosCompressedImage {
  static constexpr const char* kName = "sensor_msgs/msg/CompressedImage";
  RosHeader header{};
  std::string format{};
  std::vector<std::uint8_t> data{};
};
template <class Visitor, ConstOr<RosCompressedImage> M>
void visit(Visitor& v, M& m) {
  v.field("header", m.header);
  v.field("format", m.format);
  v.field("data", m.data);
}

struct RosUvCoordinate {
  static constexpr const char* kName = "visualization_msgs/msg/UVCoordinate";
  float u = 0.0F, v = 0.0F;
};
template <class Visitor, ConstOr<RosUvCoordinate> M>
void visit(Visitor& v, M& m) {
  v.field("u", m.u);
  v.field("v", m.v);
}

struct RosMeshFile {
  static constexpr const char* kName = "visualization_msgs/msg/MeshFile";
  std::string filename{};
  std::vector<std::uint8_t> data{};
};
template <class Visitor, ConstOr<RosMeshFile> M>
void visit(Visitor& v, M& m) {
  v.field("filename", m.filename);
  v.field("data", m.data);
}

struct RosMarker {
  static constexpr const char* kName = "visualization_msgs/msg/Marker";
  RosHeader header{};
  std::string ns{};
  std::int32_t id = 0, type = 0, action = 0;
  RosPose pose{};
  RosVector3 scale{};
  RosColor color{};
  RosDuration lifetime{};
  bool frame_locked = false;
  std::vector<RosPoint> points{};
  std::vector<RosColor> colors{};
  std::string texture_resource{};
  RosCompressedImage texture{};
  std::vector<RosUvCoordinate> uv_coordinates{};
  std::string text{}, mesh_resource{};
  RosMeshFile mesh_file{};
  bool mesh_use_embedded_materials = false;
};
template <class Visitor, ConstOr<RosMarker> M>
void visit(Visitor& v, M& m) {
  v.field("header", m.header);
  v.field("ns", m.ns);
  v.field("id", m.id);
  v.field("type", m.type);
  v.field("action", m.action);
  v.field("pose", m.pose);
  v.field("scale", m.scale);
  v.field("color", m.color);
  v.field("lifetime", m.lifetime);
  v.field("frame_locked", m.frame_locked);
  v.field("points", m.points);
  v.field("colors", m.colors);
  v.field("texture_resource", m.texture_resource);
  v.field("texture", m.texture);
  v.field("uv_coordinates", m.uv_coordinates);
  v.field("text", m.text);
  v.field("mesh_resource", m.mesh_resource);
  v.field("mesh_file", m.mesh_file);
  v.field("mesh_use_embedded_materials", m.mesh_use_embedded_materials);
}

struct RosMarkers {
  static constexpr const char* kName = "visualization_msgs/msg/MarkerArray";
  std::vector<RosMarker> markers{};
};
template <class Visitor, ConstOr<RosMarkers> M>
void visit(Visitor& v, M& m) {
  v.field("markers", m.markers);
}

struct RosLog {
  static constexpr const char* kName = "rcl_interfaces/msg/Log";
  RosTime stamp{};
  std::uint8_t level = 0;
  std::string name{}, msg{}, file{}, function{};
  std::uint32_t line = 0;
};
template <class Visitor, ConstOr<RosLog> M>
void visit(Visitor& v, M& m) {
  v.field("stamp", m.stamp);
  v.field("level", m.level);
  v.field("name", m.name);
  v.field("msg", m.msg);
  v.field("file", m.file);
  v.field("function", m.function);
  v.field("line", m.line);
}

struct RosTrajectoryPoint {
  static constexpr const char* kName = "trajectory_msgs/msg/MultiDOFJointTrajectoryPoint";
  std::vector<RosTransform> transforms{};
  std::vector<RosTwist> velocities{}, accelerations{};
  RosDuration time_from_start{};
};
template <class Visitor, ConstOr<RosTrajectoryPoint> M>
void visit(Visitor& v, M& m) {
  v.field("transforms", m.transforms);
  v.field("velocities", m.velocities);
  v.field("accelerations", m.accelerations);
  v.field("time_from_start", m.time_from_start);
}

struct RosTrajectory {
  static constexpr const char* kName = "trajectory_msgs/msg/MultiDOFJointTrajectory";
  RosHeader header{};
  std::vector<std::string> joint_names{};
  std::vector<RosTrajectoryPoint> points{};
};
template <class Visitor, ConstOr<RosTrajectory> M>
void visit(Visitor& v, M& m) {
  v.field("header", m.header);
  v.field("joint_names", m.joint_names);
  v.field("points", m.points);
}

}  // namespace avoidbench
