#ifndef ROS_SERVICE_CLIENT_H
#define ROS_SERVICE_CLIENT_H

#include <string>

#include "ros/service.h"

namespace ros {

/// Calls a service of a node in the same library and waits until it has answered.
class ServiceClient {
 public:
  ServiceClient() = default;
  /// For NodeHandle::serviceClient.
  explicit ServiceClient(const std::string& name) : name_(name) {}

  template <class Request, class Response>
  bool call(Request& request, Response& response) {
    return isValid() && service::call(name_, request, response);
  }
  template <class Service>
  bool call(Service& service) {
    return call(service.request, service.response);
  }
  bool isValid() const { return !name_.empty(); }
  bool isPersistent() const { return false; }
  std::string getService() const { return name_; }
  bool exists() { return isValid() && service::exists(name_, false); }
  bool waitForExistence(Duration timeout = Duration(-1.0)) {
    return isValid() && service::waitForService(name_, timeout);
  }
  void shutdown() { name_.clear(); }
  operator void*() const {
    return isValid() ? const_cast<void*>(static_cast<const void*>(this)) : nullptr;
  }
  bool operator==(const ServiceClient& other) const { return name_ == other.name_; }
  bool operator!=(const ServiceClient& other) const { return name_ != other.name_; }
  bool operator<(const ServiceClient& other) const { return name_ < other.name_; }

 private:
  std::string name_;
};

}  // namespace ros

#endif
