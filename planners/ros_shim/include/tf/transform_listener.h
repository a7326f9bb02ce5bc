#ifndef TF_TRANSFORM_LISTENER_H
#define TF_TRANSFORM_LISTENER_H

#include <string>

#include "tf/transform_datatypes.h"
#include "tf2_ros/transform_listener.h"

namespace tf {

using TransformException = tf2::TransformException;
using LookupException = tf2::LookupException;
using ConnectivityException = tf2::ConnectivityException;
using ExtrapolationException = tf2::ExtrapolationException;

/// A tf2 buffer with its listener, by tf's names.
class TransformListener {
 public:
  explicit TransformListener(ros::Duration kept = ros::Duration(10.0), bool spin_thread = true)
      : buffer_(kept), listener_(buffer_, spin_thread) {}
  explicit TransformListener(const ros::NodeHandle&, ros::Duration kept = ros::Duration(10.0),
                             bool spin_thread = true)
      : TransformListener(kept, spin_thread) {}

  void lookupTransform(const std::string& target, const std::string& source, const ros::Time& time,
                       StampedTransform& to) const {
    const geometry_msgs::TransformStamped found = buffer_.lookupTransform(target, source, time);
    to = StampedTransform(tf2::transform_of(found), found.header.stamp, target, source);
  }
  bool waitForTransform(const std::string& target, const std::string& source, const ros::Time& time,
                        const ros::Duration& timeout,
                        const ros::Duration& /*pause*/ = ros::Duration(0.01),
                        std::string* error = nullptr) const {
    return buffer_.canTransform(target, source, time, timeout, error);
  }
  bool canTransform(const std::string& target, const std::string& source, const ros::Time& time,
                    std::string* error = nullptr) const {
    return buffer_.canTransform(target, source, time, ros::Duration(), error);
  }
  bool frameExists(const std::string& frame) const { return buffer_._frameExists(frame); }

  void transformPoint(const std::string& target, const geometry_msgs::PointStamped& in,
                      geometry_msgs::PointStamped& out) const {
    buffer_.transform(in, out, target);
  }
  void transformVector(const std::string& target, const geometry_msgs::Vector3Stamped& in,
                       geometry_msgs::Vector3Stamped& out) const {
    buffer_.transform(in, out, target);
  }
  void transformQuaternion(const std::string& target, const geometry_msgs::QuaternionStamped& in,
                           geometry_msgs::QuaternionStamped& out) const {
    buffer_.transform(in, out, target);
  }
  void transformPose(const std::string& target, const geometry_msgs::PoseStamped& in,
                     geometry_msgs::PoseStamped& out) const {
    buffer_.transform(in, out, target);
  }

 private:
  tf2_ros::Buffer buffer_;
  tf2_ros::TransformListener listener_;
};

}  // namespace tf

#endif
