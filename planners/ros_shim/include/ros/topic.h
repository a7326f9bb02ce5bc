#ifndef ROS_TOPIC_H
#define ROS_TOPIC_H

#include <limits>
#include <string>

#include "ros/node_handle.h"

namespace ros {
namespace topic {

/// The topic's next message; null where none comes within `timeout` (0: however long it takes).
template <class M>
ros_shim::shared_ptr<const M> waitForMessage(const std::string& topic, NodeHandle& node,
                                             Duration timeout = Duration()) {
  ros_shim::shared_ptr<const M> message;
  const Subscriber subscriber = node.subscribe<M>(
      topic, 1, [&message](const ros_shim::shared_ptr<const M>& came) { message = came; });
  const std::int64_t end_ns = timeout.isZero() ? std::numeric_limits<std::int64_t>::max()
                                               : ros_shim::now_ns() + timeout.toNSec();
  ros_shim::spin_until([&message] { return message != nullptr; }, end_ns);
  return message;
}
template <class M>
ros_shim::shared_ptr<const M> waitForMessage(const std::string& topic,
                                             Duration timeout = Duration()) {
  NodeHandle node;
  return waitForMessage<M>(topic, node, timeout);
}

}  // namespace topic
}  // namespace ros

#endif
