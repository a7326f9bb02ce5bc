#ifndef ROS_INIT_H
#define ROS_INIT_H

#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "ros_shim/runtime.h"

namespace ros {

namespace init_options {
enum InitOption { NoSigintHandler = 1, AnonymousName = 2, NoRosout = 4 };
}
using InitOption = init_options::InitOption;

/// The node's name is the topics file's, as with roslaunch; the one given here serves where that
/// has none.
inline void init(int&, char**, const std::string& name, std::uint32_t = 0) {
  ros_shim::init_node(name);
}
inline void init(const std::map<std::string, std::string>&, const std::string& name,
                 std::uint32_t = 0) {
  ros_shim::init_node(name);
}
inline void init(const std::vector<std::pair<std::string, std::string>>&, const std::string& name,
                 std::uint32_t = 0) {
  ros_shim::init_node(name);
}
inline bool isInitialized() { return ros_shim::is_node_initialized(); }
inline bool ok() { return ros_shim::is_running(); }
inline bool isShuttingDown() { return !ros_shim::is_running(); }
inline bool isStarted() { return ros_shim::is_node_initialized(); }
inline void start() {}
inline void shutdown() { ros_shim::stop_node(); }
inline void requestShutdown() { ros_shim::stop_node(); }
inline void waitForShutdown() { ros_shim::spin(); }
inline void removeROSArgs(int count, const char* const* values, std::vector<std::string>& out) {
  out.assign(values, values + count);
}

}  // namespace ros

#endif
