#ifndef TF2_ROS_STATIC_TRANSFORM_BROADCASTER_H
#define TF2_ROS_STATIC_TRANSFORM_BROADCASTER_H

#include <vector>

#include "geometry_msgs/TransformStamped.h"
#include "ros/node_handle.h"
#include "tf2_msgs/TFMessage.h"

namespace tf2_ros {

/// Publishes on /tf_static what stays for ever, for listeners that come later, too.
class StaticTransformBroadcaster {
 public:
  StaticTransformBroadcaster() {
    ros::NodeHandle node;
    publisher_ = node.advertise<tf2_msgs::TFMessage>("/tf_static", 100, true);
  }
  void sendTransform(const geometry_msgs::TransformStamped& transform) {
    sendTransform(std::vector<geometry_msgs::TransformStamped>{transform});
  }
  void sendTransform(const std::vector<geometry_msgs::TransformStamped>& transforms) {
    for (const geometry_msgs::TransformStamped& one : transforms) {
      auto same = all_.transforms.begin();
      while (same != all_.transforms.end() && same->child_frame_id != one.child_frame_id) ++same;
      if (same == all_.transforms.end()) {
        all_.transforms.push_back(one);
      } else {
        *same = one;
      }
    }
    publisher_.publish(all_);
  }

 private:
  ros::Publisher publisher_;
  tf2_msgs::TFMessage all_;
};

}  // namespace tf2_ros

#endif
