#include "export/flight_messages.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <utility>

namespace avoidbench {
namespace {

constexpr std::uint8_t kFloat32 = 7;  // sensor_msgs/PointField.FLOAT32
constexpr double kPath_hz = 10.0;

RosPose ros_pose(const Eigen::Vector3d& position, const Eigen::Quaterniond& q) {
  return {.position = ros_point(position), .orientation = ros_quaternion(q)};
}

/// A cloud of points that are floats named so, in this order.
RosPointCloud cloud_of_floats(RosHeader header, std::span<const char* const> names,
                              std::vector<std::uint8_t> data) {
  RosPointCloud cloud{.header = std::move(header)};
  std::uint32_t offset = 0;
  for (const char* name : names) {
    cloud.fields.push_back({.name = name, .offset = offset, .datatype = kFloat32, .count = 1});
    offset += sizeof(float);
  }
  cloud.height = 1;
  cloud.width = static_cast<std::uint32_t>(data.size() / offset);
  cloud.point_step = offset;
  cloud.row_step = static_cast<std::uint32_t>(data.size());
  cloud.data = std::move(data);
  cloud.is_dense = true;
  return cloud;
}

template <class Value>
std::vector<std::uint8_t> bytes_of(const std::vector<Value>& values) {
  const auto* const begin = reinterpret_cast<const std::uint8_t*>(values.data());
  return {begin, begin + values.size() * sizeof(Value)};
}

const char* encoding_of(PictureKind kind) {
  switch (kind) {
    case PictureKind::depth:
      return "32FC1";
    case PictureKind::color:
      return "rgb8";
    default:
      return "mono8";
  }
}

RosDuration ros_duration(double time_s) {
  const RosTime time = ros_time(mcap_time(time_s));
  return {.sec = time.sec, .nanosec = time.nanosec};
}

}  // namespace

std::string camera_frame(std::size_t camera) {
  return "camera_" + std::to_string(camera) + "_optical";
}
std::string lidar_frame(std::size_t lidar) { return "lidar_" + std::to_string(lidar); }
std::string mover_frame(std::size_t mover) { return "mover_" + std::to_string(mover); }

McapTime mcap_time(double time_s) {
  return static_cast<McapTime>(std::llround(std::max(time_s, 0.0) * 1e9));
}

RosTime ros_time(McapTime time) {
  constexpr McapTime kSecond = 1'000'000'000;
  return {.sec = static_cast<std::int32_t>(time / kSecond),
          .nanosec = static_cast<std::uint32_t>(time % kSecond)};
}

RosHeader ros_header(const std::string& frame, McapTime time) {
  return {.stamp = ros_time(time), .frame_id = frame};
}

RosPoint ros_point(const Eigen::Vector3d& v) { return {.x = v.x(), .y = v.y(), .z = v.z()}; }
RosVector3 ros_vector(const Eigen::Vector3d& v) { return {.x = v.x(), .y = v.y(), .z = v.z()}; }
RosQuaternion ros_quaternion(const Eigen::Quaterniond& q) {
  return {.x = q.x(), .y = q.y(), .z = q.z(), .w = q.w()};
}

RosTransformStamped ros_transform(const std::string& parent, const std::string& child,
                                  McapTime time, const Eigen::Vector3d& position,
                                  const Eigen::Quaterniond& q_parent_child) {
  return {.header = ros_header(parent, time),
          .child_frame_id = child,
          .transform = {.translation = ros_vector(position),
                        .rotation = ros_quaternion(q_parent_child)}};
}

RosOdometry ros_odometry(McapTime time, const Eigen::Vector3d& position_world,
                         const Eigen::Quaterniond& q_world_body,
                         const Eigen::Vector3d& velocity_world,
                         const Eigen::Vector3d& rates_body_radps) {
  RosOdometry odometry{.header = ros_header(kMapFrame, time), .child_frame_id = kBodyFrame};
  odometry.pose.pose = ros_pose(position_world, q_world_body);
  odometry.twist.twist.linear = ros_vector(q_world_body.conjugate() * velocity_world);
  odometry.twist.twist.angular = ros_vector(rates_body_radps);
  return odometry;
}

RosPath ros_path(std::span<const Sample> samples) {
  RosPath path;
  double next_s = 0.0;
  for (const Sample& sample : samples) {
    if (sample.time_s < next_s && &sample != &samples.back()) continue;
    next_s = sample.time_s + 1.0 / kPath_hz;
    path.poses.push_back({.header = ros_header(kMapFrame, mcap_time(sample.time_s)),
                          .pose = ros_pose(sample.position_world, sample.q_world_body)});
  }
  return path;
}

RosImage ros_image(const SeenPicture& picture, const CameraSetup& camera) {
  const auto height = static_cast<std::uint32_t>(camera.height_px);
  return {.header = ros_header(camera_frame(picture.camera), mcap_time(picture.time_s)),
          .height = height,
          .width = static_cast<std::uint32_t>(camera.width_px),
          .encoding = encoding_of(picture.kind),
          .step = static_cast<std::uint32_t>(picture.bytes.size() / height),
          .data = picture.bytes};
}

RosCameraInfo ros_camera_info(const SeenPicture& picture, const CameraSetup& camera) {
  const double fx = camera.fx_px, fy = camera.fy_px, cx = camera.cx_px, cy = camera.cy_px;
  const double right_m = picture.kind == PictureKind::right ? camera.baseline_m : 0.0;
  return {.header = ros_header(camera_frame(picture.camera), mcap_time(picture.time_s)),
          .height = static_cast<std::uint32_t>(camera.height_px),
          .width = static_cast<std::uint32_t>(camera.width_px),
          .distortion_model = "plumb_bob",
          .d = std::vector<double>(5, 0.0),
          .k = {fx, 0.0, cx, 0.0, fy, cy, 0.0, 0.0, 1.0},
          .r = {1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0},
          .p = {fx, 0.0, cx, -fx * right_m, 0.0, fy, cy, 0.0, 0.0, 0.0, 1.0, 0.0}};
}

RosPointCloud ros_depth_points(const SeenPicture& picture, const CameraSetup& camera) {
  int step = 1;
  const auto count = [&](int length) { return (length + step - 1) / step; };
  while (count(camera.width_px) * count(camera.height_px) > kMostDepthPoints) ++step;
  std::vector<float> points;
  for (int v = 0; v < camera.height_px; v += step) {
    for (int u = 0; u < camera.width_px; u += step) {
      float depth_m = 0.0F;
      const std::size_t pixel =
          static_cast<std::size_t>(v) * static_cast<std::size_t>(camera.width_px) +
          static_cast<std::size_t>(u);
      std::memcpy(&depth_m, picture.bytes.data() + pixel * sizeof depth_m, sizeof depth_m);
      if (!std::isfinite(depth_m)) continue;
      points.push_back(static_cast<float>((u - camera.cx_px) / camera.fx_px) * depth_m);
      points.push_back(static_cast<float>((v - camera.cy_px) / camera.fy_px) * depth_m);
      points.push_back(depth_m);
    }
  }
  constexpr const char* kNames[] = {"x", "y", "z"};
  return cloud_of_floats(ros_header(camera_frame(picture.camera), mcap_time(picture.time_s)),
                         kNames, bytes_of(points));
}

RosPointCloud ros_sweep(const SeenCloud& cloud) {
  // As ab_lidar_point has them.
  constexpr const char* kNames[] = {"x", "y", "z", "time", "intensity"};
  static_assert(sizeof(ab_lidar_point) == 5 * sizeof(float));
  return cloud_of_floats(ros_header(lidar_frame(cloud.lidar), mcap_time(cloud.time_s)), kNames,
                         bytes_of(cloud.points));
}

RosImu ros_imu(const SeenImu& sample) {
  RosImu imu{.header = ros_header(kBodyFrame, mcap_time(sample.time_s))};
  imu.orientation_covariance[0] = -1.0;  // it measures no orientation
  imu.angular_velocity = ros_vector(sample.rates_body);
  imu.linear_acceleration = ros_vector(sample.specific_force_body_mps2);
  return imu;
}

RosPath ros_command_path(const FlownPiece& piece) {
  RosPath path{.header = ros_header(kMapFrame, mcap_time(piece.time_s))};
  for (const ab_point& point : piece.points) {
    const McapTime time = mcap_time(piece.effect_s + point.time_s);
    path.poses.push_back(
        {.header = ros_header(kMapFrame, time),
         .pose = ros_pose(to_vector(point.position_world_m), yaw_rotation(point.yaw_rad))});
  }
  return path;
}

RosTrajectory ros_command_trajectory(const FlownPiece& piece) {
  RosTrajectory trajectory{.header = ros_header(kMapFrame, mcap_time(piece.effect_s)),
                           .joint_names = {kBodyFrame}};
  for (const ab_point& point : piece.points) {
    const Eigen::Quaterniond q = yaw_rotation(point.yaw_rad);
    trajectory.points.push_back(
        {.transforms = {{.translation = ros_vector(to_vector(point.position_world_m)),
                         .rotation = ros_quaternion(q)}},
         .velocities = {{.linear = ros_vector(to_vector(point.velocity_world_mps)),
                         .angular = {.z = point.yaw_rate_radps}}},
         .accelerations = {{.linear = ros_vector(to_vector(point.acceleration_world_mps2))}},
         .time_from_start = ros_duration(point.time_s)});
  }
  return trajectory;
}

}  // namespace avoidbench
