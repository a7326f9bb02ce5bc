#ifndef ROS_THIS_NODE_H
#define ROS_THIS_NODE_H

#include <string>

#include "ros_shim/runtime.h"

namespace ros {
namespace this_node {

inline const std::string& getName() { return ros_shim::node_name(); }
/// "/" or the group that the topics file puts the node in.
std::string getNamespace();

}  // namespace this_node

namespace names {
inline std::string resolve(const std::string& name, bool = true) {
  return ros_shim::resolved("", name);
}
inline std::string resolve(const std::string& space, const std::string& name, bool = true) {
  return ros_shim::resolved(space, name);
}
std::string append(const std::string& left, const std::string& right);
}  // namespace names

}  // namespace ros

#endif
