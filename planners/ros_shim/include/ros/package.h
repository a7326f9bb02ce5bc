#ifndef ROS_PACKAGE_H
#define ROS_PACKAGE_H

#include <string>

#include "ros_shim/runtime.h"

namespace ros {
namespace package {

/// The folder that the topics file names under `packages`; "" for others.
inline std::string getPath(const std::string& package) { return ros_shim::package_folder(package); }

}  // namespace package
}  // namespace ros

#endif
