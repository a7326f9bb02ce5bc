#ifndef ROS_PUBLISHER_H
#define ROS_PUBLISHER_H

#include <cstdint>
#include <memory>
#include <stdexcept>
#include <string>

#include "ros/message_traits.h"
#include "ros_shim/pointer.h"
#include "ros_shim/runtime.h"

namespace ros {

/// A message goes to each subscriber's queue at once; its callback runs when that node spins.
class Publisher {
 public:
  Publisher() = default;
  /// For NodeHandle::advertise.
  Publisher(int topic, std::string name, const char* type, bool latched)
      : held_(std::make_shared<Held>(topic, std::move(name), type, latched)) {}

  template <class M>
  void publish(const M& message) const {
    send(ros_shim::make_shared<M>(message), message_traits::DataType<M>::value());
  }
  template <class M>
  void publish(const ros_shim::shared_ptr<M>& message) const {
    if (!message) throw std::runtime_error("a null message was published on " + getTopic());
    send(message, message_traits::DataType<M>::value());
  }
  void shutdown() { held_.reset(); }
  std::string getTopic() const { return held_ ? held_->name : std::string(); }
  std::uint32_t getNumSubscribers() const {
    return held_ ? static_cast<std::uint32_t>(ros_shim::subscriber_count(held_->topic)) : 0;
  }
  bool isLatched() const { return held_ && held_->latched; }
  operator void*() const { return held_ ? held_.get() : nullptr; }
  bool operator==(const Publisher& other) const { return held_ == other.held_; }
  bool operator!=(const Publisher& other) const { return held_ != other.held_; }
  bool operator<(const Publisher& other) const { return held_ < other.held_; }

 private:
  /// The topic has this publisher until its last copy goes.
  struct Held {
    int topic;
    std::string name, type;
    bool latched;
    Held(int topic_, std::string name_, const char* type_, bool latched_)
        : topic(topic_), name(std::move(name_)), type(type_), latched(latched_) {
      ros_shim::count_publishers(topic, 1);
    }
    Held(const Held&) = delete;
    Held& operator=(const Held&) = delete;
    ~Held() { ros_shim::count_publishers(topic, -1); }
  };

  void send(ros_shim::AnyMessage message, const char* type) const {
    if (!held_) throw std::runtime_error("publish() on a Publisher that was not advertised");
    if (held_->type != type) {
      throw std::runtime_error("a " + std::string(type) + " was published on " + held_->name +
                               ", which carries " + held_->type);
    }
    ros_shim::publish(held_->topic, std::move(message), held_->latched);
  }

  std::shared_ptr<Held> held_;
};

}  // namespace ros

#endif
