#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstdint>
#include <string>
#include <vector>

namespace avoidbench {

/// Where a vehicle was. Metres; the log's frame has z up: East-North-Up for PX4's logs, whose own
/// is North-East-Down; otherwise the frame that the log says. The body's frame is
/// Forward-Left-Up for PX4's logs, otherwise as the log has it.
struct RecordedPose {
  std::int64_t time_ns = 0;  ///< of the log's clock, whatever that counts from
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  ///< m, in the log's frame
  /// Log frame from body, of length 1; identity where the flight has no attitude.
  Eigen::Quaterniond q = Eigen::Quaterniond::Identity();
};

/// The log of a real vehicle's flight, as it was written: nothing is smoothed or sampled again.
struct RecordedFlight {
  /// "ROS 1 bag", "rosbag2 (SQLite)", "MCAP", "ULog", "TUM" or "EuRoC CSV".
  std::string format;
  std::string topic, type;          ///< "" where the format has none
  std::vector<RecordedPose> poses;  ///< by time, strictly rising; at least one; all finite
  /// m/s, in the log's frame, one a pose; empty where the log has none. Those of nav_msgs/Odometry,
  /// which are in the body's frame, are turned by the pose's attitude.
  std::vector<Eigen::Vector3d> velocities;
  bool has_attitude = true;
  /// What a user should know, a sentence each: "3 poses go back in time and are left out".
  std::vector<std::string> warnings;
};

/// What to read of which file.
struct RecordedFlightChoice {
  /// A file, or the folder of a rosbag2 with its metadata.yaml. What kind it is follows from its
  /// content, not its name.
  std::string file{};
  /// "": the only one that can be read; of a ULog vehicle_local_position with vehicle_attitude,
  /// PX4's estimate as its own controllers use it, and vehicle_odometry where that is not there.
  std::string topic{};
  std::string child_frame{};  ///< of transforms; "": the only one
};

/// Reads the poses of one vehicle:
/// - ROS 1 bags (version 2.0; chunks without compression, bz2, lz4; also without an index),
///   rosbag2's SQLite files and MCAP files (chunks without compression, lz4, zstd; CDR or ROS 1
///   messages), with topics of nav_msgs/Odometry, geometry_msgs/PoseStamped,
///   PoseWithCovarianceStamped, TransformStamped, tf2_msgs/TFMessage, and of ROS 2
///   px4_msgs/VehicleOdometry and VehicleLocalPosition;
/// - PX4's ULog;
/// - TUM's text files, and CSV files as those of EuRoC MAV's ground truth.
/// A pose's time is the stamp of the message's header; where that is zero, the time at which it was
/// recorded. A file whose end is missing, as after a crash, is read as far as it goes, with a
/// warning that says where it ends; damage in the middle is an error.
/// Never holds more than some 300 MB, whatever the file: it is read in one pass, chunks unpacked
/// piece by piece.
///
/// Throws InputError with the line or byte for what is damaged or can't be read; where there is no
/// such topic or child frame, or several that fit and none is chosen, with a list of those there
/// are; where no pose is left; and for more than two million poses.
RecordedFlight read_recorded_flight(const RecordedFlightChoice& choice);

}  // namespace avoidbench
