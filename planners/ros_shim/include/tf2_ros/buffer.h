#ifndef TF2_ROS_BUFFER_H
#define TF2_ROS_BUFFER_H

#include <algorithm>
#include <memory>
#include <string>

#include "geometry_msgs/TransformStamped.h"
#include "ros/time.h"
#include "ros_shim/frames.h"
#include "ros_shim/runtime.h"
#include "tf2/exceptions.h"
#include "tf2_geometry_msgs/tf2_geometry_msgs.h"

namespace tf2_ros {

/// Frames and where they lie in each other over the last seconds.
class Buffer {
 public:
  explicit Buffer(ros::Duration kept = ros::Duration(10.0), bool /*debug*/ = false)
      : frames_(std::make_shared<ros_shim::Frames>(kept.toNSec())) {}

  /// The source frame in the target frame; Time(0): the newest. Waits for what is not there yet.
  /// Throws what tf2 throws.
  geometry_msgs::TransformStamped lookupTransform(const std::string& target,
                                                  const std::string& source, const ros::Time& time,
                                                  ros::Duration timeout = ros::Duration()) const {
    wait_for(target, source, time, timeout);
    try {
      std::int64_t at_ns = 0;
      const ros_shim::FramePose pose = frames_->lookup(target, source, time.toNSec(), at_ns);
      geometry_msgs::TransformStamped message;
      message.header.stamp.fromNSec(at_ns);
      message.header.frame_id = target;
      message.child_frame_id = source;
      message.transform.translation.x = pose.translation[0];
      message.transform.translation.y = pose.translation[1];
      message.transform.translation.z = pose.translation[2];
      message.transform.rotation.x = pose.rotation[0];
      message.transform.rotation.y = pose.rotation[1];
      message.transform.rotation.z = pose.rotation[2];
      message.transform.rotation.w = pose.rotation[3];
      return message;
    } catch (const ros_shim::FrameError& error) {
      switch (error.kind) {
        case ros_shim::FrameError::unknown:
          throw tf2::LookupException(error.what());
        case ros_shim::FrameError::unconnected:
          throw tf2::ConnectivityException(error.what());
        default:
          throw tf2::ExtrapolationException(error.what());
      }
    }
  }
  bool canTransform(const std::string& target, const std::string& source, const ros::Time& time,
                    ros::Duration timeout = ros::Duration(), std::string* error = nullptr) const {
    wait_for(target, source, time, timeout);
    return is_there(target, source, time, error);
  }
  bool setTransform(const geometry_msgs::TransformStamped& message, const std::string& /*from*/,
                    bool is_static = false) {
    const auto& t = message.transform;
    frames_->set(message.header.frame_id, message.child_frame_id, message.header.stamp.toNSec(),
                 {{t.translation.x, t.translation.y, t.translation.z},
                  {t.rotation.x, t.rotation.y, t.rotation.z, t.rotation.w}},
                 is_static);
    return true;
  }
  template <class Stamped>
  Stamped& transform(const Stamped& in, Stamped& out, const std::string& target,
                     ros::Duration timeout = ros::Duration()) const {
    tf2::doTransform(in, out,
                     lookupTransform(target, in.header.frame_id, in.header.stamp, timeout));
    return out;
  }
  template <class Stamped>
  Stamped transform(const Stamped& in, const std::string& target,
                    ros::Duration timeout = ros::Duration()) const {
    Stamped out;
    return transform(in, out, target, timeout);
  }
  bool _frameExists(const std::string& frame) const { return frames_->exists(frame); }
  void clear() { *frames_ = ros_shim::Frames(frames_->kept_ns()); }
  /// Has no effect: a listener always hears other nodes while its own waits.
  void setUsingDedicatedThread(bool) {}
  bool isUsingDedicatedThread() const { return true; }

 private:
  bool is_there(const std::string& target, const std::string& source, const ros::Time& time,
                std::string* error) const {
    try {
      std::int64_t at_ns = 0;
      frames_->lookup(target, source, time.toNSec(), at_ns);
      return true;
    } catch (const ros_shim::FrameError& problem) {
      if (error != nullptr) *error = problem.what();
      return false;
    }
  }
  void wait_for(const std::string& target, const std::string& source, const ros::Time& time,
                ros::Duration timeout) const {
    constexpr std::int64_t kPause_ns = 10000000;  // as tf2 looks
    const std::int64_t end_ns = ros_shim::now_ns() + timeout.toNSec();
    while (ros_shim::now_ns() < end_ns && ros_shim::is_running() &&
           !is_there(target, source, time, nullptr)) {
      ros_shim::sleep_until_ns(std::min(end_ns, ros_shim::now_ns() + kPause_ns));
    }
  }

  std::shared_ptr<ros_shim::Frames> frames_;
};

}  // namespace tf2_ros

#endif
