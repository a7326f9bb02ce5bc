#ifndef ROS_SUBSCRIBER_H
#define ROS_SUBSCRIBER_H

#include <cstdint>
#include <memory>
#include <string>
#include <utility>

#include "ros_shim/runtime.h"

namespace ros {

/// Callbacks come until its last copy goes.
class Subscriber {
 public:
  Subscriber() = default;
  /// For NodeHandle::subscribe.
  Subscriber(int subscription, int topic, std::string name)
      : held_(std::make_shared<Held>(subscription, topic, std::move(name))) {}
  void shutdown() { held_.reset(); }
  std::string getTopic() const { return held_ ? held_->name : std::string(); }
  std::uint32_t getNumPublishers() const {
    return held_ ? static_cast<std::uint32_t>(ros_shim::publisher_count(held_->topic)) : 0;
  }
  operator void*() const { return held_ ? held_.get() : nullptr; }
  bool operator==(const Subscriber& other) const { return held_ == other.held_; }
  bool operator!=(const Subscriber& other) const { return held_ != other.held_; }
  bool operator<(const Subscriber& other) const { return held_ < other.held_; }

 private:
  struct Held {
    int subscription, topic;
    std::string name;
    Held(int subscription_, int topic_, std::string name_)
        : subscription(subscription_), topic(topic_), name(std::move(name_)) {}
    Held(const Held&) = delete;
    Held& operator=(const Held&) = delete;
    ~Held() { ros_shim::unsubscribe(subscription); }
  };
  std::shared_ptr<Held> held_;
};

}  // namespace ros

#endif
