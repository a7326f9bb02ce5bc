#ifndef ROS_SERVICE_H
#define ROS_SERVICE_H

#include <cstdint>
#include <string>

#include "ros/message_traits.h"
#include "ros/time.h"
#include "ros_shim/runtime.h"

namespace ros {
namespace service {

/// False where no node offers it, or it says so itself.
template <class Request, class Response>
bool call(const std::string& name, Request& request, Response& response) {
  return ros_shim::call_service(ros_shim::resolved("", name),
                                message_traits::DataType<Request>::value(), &request, &response);
}
template <class Service>
bool call(const std::string& name, Service& service) {
  return call(name, service.request, service.response);
}

inline bool exists(const std::string& name, bool /*print_failure_reason*/) {
  return ros_shim::has_service(ros_shim::resolved("", name));
}

/// Until a node offers it; a negative time: however long it takes.
inline bool waitForService(const std::string& name, Duration timeout = Duration(-1.0)) {
  const std::int64_t wait_ns = timeout.toNSec();
  return ros_shim::wait_for_service(ros_shim::resolved("", name), wait_ns);
}
inline bool waitForService(const std::string& name, std::int32_t timeout_ms) {
  return waitForService(name, Duration(1e-3 * timeout_ms));
}

}  // namespace service
}  // namespace ros

#endif
