#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "export/flown_piece.hpp"
#include "export/mcap_writer.hpp"
#include "export/ros2_messages.hpp"
#include "geometry/pose.hpp"
#include "trial/trial_record.hpp"
#include "world/world.hpp"

/// What is known of a flight, as messages of ROS 2. Frames: "map" is the world (ENU, z up),
/// "base_link" the body (FLU), "camera_N_optical" a camera (RDF), "lidar_N" a lidar (FLU),
/// "mover_N" something that moves.
namespace avoidbench {

inline constexpr const char* kMapFrame = "map";
inline constexpr const char* kBodyFrame = "base_link";
std::string camera_frame(std::size_t camera);
std::string lidar_frame(std::size_t lidar);
std::string mover_frame(std::size_t mover);

/// Simulated time, s and not negative, to the nearest ns.
McapTime mcap_time(double time_s);
RosTime ros_time(McapTime time);
RosHeader ros_header(const std::string& frame, McapTime time);
inline Eigen::Vector3d to_vector(const double (&v)[3]) { return {v[0], v[1], v[2]}; }
RosPoint ros_point(const Eigen::Vector3d& v);
RosVector3 ros_vector(const Eigen::Vector3d& v);
RosQuaternion ros_quaternion(const Eigen::Quaterniond& q);

/// Where frame `child` is in `parent`.
RosTransformStamped ros_transform(const std::string& parent, const std::string& child,
                                  McapTime time, const Eigen::Vector3d& position,
                                  const Eigen::Quaterniond& q_parent_child);

/// Pose in the map, velocities in the body's frame, as nav_msgs/Odometry wants them.
RosOdometry ros_odometry(McapTime time, const Eigen::Vector3d& position_world,
                         const Eigen::Quaterniond& q_world_body,
                         const Eigen::Vector3d& velocity_world,
                         const Eigen::Vector3d& rates_body_radps);

/// The flown path, ten poses a second and the last.
RosPath ros_path(std::span<const Sample> samples);

RosImage ros_image(const SeenPicture& picture, const CameraSetup& camera);
/// Of the left eye or of the right one, whose place is said by P alone.
RosCameraInfo ros_camera_info(const SeenPicture& picture, const CameraSetup& camera);
/// What a depth image shows, in the camera's frame: of each few rows and columns one pixel, so that
/// there are at most kMostDepthPoints.
inline constexpr int kMostDepthPoints = 10'000;
RosPointCloud ros_depth_points(const SeenPicture& picture, const CameraSetup& camera);
/// A sweep in the lidar's frame: x, y, z, time [s, after the stamp], intensity.
RosPointCloud ros_sweep(const SeenCloud& cloud);
RosImu ros_imu(const SeenImu& sample);

/// A trajectory's points in the map, each with the time when the vehicle is to be there.
RosPath ros_command_path(const FlownPiece& piece);
/// The same with all that the command says.
RosTrajectory ros_command_trajectory(const FlownPiece& piece);

/// A marker of this type that stays, with nothing in it.
enum class MarkerType : std::int32_t { cube = 1, sphere = 2, triangles = 11 };
RosMarker ros_marker(const std::string& frame, McapTime time, const std::string& ns,
                     std::int32_t id, MarkerType type);

/// What of the world stands, a list of triangles for each material. Of more than `most_triangles`
/// those nearest to the path; `left_out` gets the number of the others.
RosMarkers ros_map(const World& world, McapTime time, std::span<const Sample> samples,
                   std::size_t most_triangles, std::size_t& left_out);
/// What moves, each in a frame of its own.
RosMarkers ros_movers(const World& world, McapTime time);
/// Where these frames are.
std::vector<RosTransformStamped> ros_mover_transforms(const World& world, McapTime time);

}  // namespace avoidbench
