#ifndef TF_TRANSFORM_BROADCASTER_H
#define TF_TRANSFORM_BROADCASTER_H

#include <vector>

#include "geometry_msgs/TransformStamped.h"
#include "ros/node_handle.h"
#include "tf/transform_datatypes.h"
#include "tf2_msgs/TFMessage.h"

namespace tf {

/// Publishes on /tf.
class TransformBroadcaster {
 public:
  TransformBroadcaster() {
    ros::NodeHandle node;
    publisher_ = node.advertise<tf2_msgs::TFMessage>("/tf", 100);
  }
  void sendTransform(const StampedTransform& transform) {
    geometry_msgs::TransformStamped message;
    message.header.stamp = transform.stamp_;
    message.header.frame_id = transform.frame_id_;
    message.child_frame_id = transform.child_frame_id_;
    message.transform.translation.x = transform.getOrigin().x();
    message.transform.translation.y = transform.getOrigin().y();
    message.transform.translation.z = transform.getOrigin().z();
    quaternionTFToMsg(transform.getRotation(), message.transform.rotation);
    sendTransform(message);
  }
  void sendTransform(const geometry_msgs::TransformStamped& transform) {
    tf2_msgs::TFMessage message;
    message.transforms.push_back(transform);
    publisher_.publish(message);
  }
  void sendTransform(const std::vector<geometry_msgs::TransformStamped>& transforms) {
    tf2_msgs::TFMessage message;
    message.transforms = transforms;
    publisher_.publish(message);
  }

 private:
  ros::Publisher publisher_;
};

}  // namespace tf

#endif
