#ifndef ROS_SERVICE_SERVER_H
#define ROS_SERVICE_SERVER_H

#include <memory>
#include <string>
#include <utility>

#include "ros_shim/runtime.h"

namespace ros {

/// The service is there until the last copy goes.
class ServiceServer {
 public:
  ServiceServer() = default;
  /// For NodeHandle::advertiseService.
  ServiceServer(int service, std::string name)
      : held_(std::make_shared<Held>(service, std::move(name))) {}

  std::string getService() const { return held_ ? held_->name : std::string(); }
  void shutdown() { held_.reset(); }
  operator void*() const { return held_ ? held_.get() : nullptr; }
  bool operator==(const ServiceServer& other) const { return held_ == other.held_; }
  bool operator!=(const ServiceServer& other) const { return held_ != other.held_; }
  bool operator<(const ServiceServer& other) const { return held_ < other.held_; }

 private:
  struct Held {
    int service;
    std::string name;
    Held(int service_, std::string name_) : service(service_), name(std::move(name_)) {}
    Held(const Held&) = delete;
    Held& operator=(const Held&) = delete;
    ~Held() { ros_shim::withdraw_service(service); }
  };
  std::shared_ptr<Held> held_;
};

}  // namespace ros

#endif
