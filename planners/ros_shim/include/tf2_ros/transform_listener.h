#ifndef TF2_ROS_TRANSFORM_LISTENER_H
#define TF2_ROS_TRANSFORM_LISTENER_H

#include <string>

#include "ros/node_handle.h"
#include "tf2_msgs/TFMessage.h"
#include "tf2_ros/buffer.h"

namespace tf2_ros {

/// Fills a buffer from /tf and /tf_static, whether its node spins or not: tf2's has a thread.
class TransformListener {
 public:
  explicit TransformListener(Buffer& buffer, bool /*spin_thread*/ = true) : buffer_(&buffer) {
    moving_ = listen("/tf", false);
    static_ = listen("/tf_static", true);
  }
  TransformListener(Buffer& buffer, const ros::NodeHandle&, bool spin_thread = true)
      : TransformListener(buffer, spin_thread) {}
  TransformListener(const TransformListener&) = delete;
  TransformListener& operator=(const TransformListener&) = delete;
  ~TransformListener() {
    ros_shim::unsubscribe(moving_);
    ros_shim::unsubscribe(static_);
  }

 private:
  int listen(const std::string& topic, bool is_static) {
    using Message = tf2_msgs::TFMessage;
    const int number = ros_shim::topic_of(ros_shim::resolved("", topic),
                                          ros::message_traits::DataType<Message>::value());
    const auto take = [this, is_static](const Message& message) {
      for (const auto& one : message.transforms) {
        buffer_->setTransform(one, std::string(), is_static);
      }
    };
    return ros_shim::subscribe_at_once(number, ros_shim::deliver_to<const Message&>(take));
  }

  Buffer* buffer_;
  int moving_ = -1, static_ = -1;
};

}  // namespace tf2_ros

#endif
