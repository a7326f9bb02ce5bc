#ifndef MESSAGE_FILTERS_SUBSCRIBER_H
#define MESSAGE_FILTERS_SUBSCRIBER_H

#include <cstdint>
#include <string>

#include "message_filters/simple_filter.h"
#include "ros/ros.h"

namespace message_filters {

class SubscriberBase {
 public:
  virtual ~SubscriberBase() = default;
  virtual void subscribe() = 0;
  virtual void unsubscribe() = 0;
};

template <class M>
class Subscriber : public SubscriberBase, public SimpleFilter<M> {
 public:
  Subscriber() = default;
  Subscriber(ros::NodeHandle& node, const std::string& topic, std::uint32_t queue_size,
             const ros::TransportHints& = ros::TransportHints()) {
    subscribe(node, topic, queue_size);
  }
  Subscriber(const Subscriber&) = delete;
  Subscriber& operator=(const Subscriber&) = delete;

  void subscribe(ros::NodeHandle& node, const std::string& topic, std::uint32_t queue_size,
                 const ros::TransportHints& = ros::TransportHints()) {
    node_ = node;
    topic_ = topic;
    queue_size_ = queue_size;
    subscribe();
  }
  void subscribe() override {
    if (topic_.empty()) return;
    subscriber_ = node_.template subscribe<M>(
        topic_, queue_size_,
        [this](const ros_shim::shared_ptr<const M>& message) { this->signalMessage(message); });
  }
  void unsubscribe() override { subscriber_.shutdown(); }
  std::string getTopic() const { return topic_; }
  const ros::Subscriber& getSubscriber() const { return subscriber_; }

 private:
  ros::NodeHandle node_;
  std::string topic_;
  std::uint32_t queue_size_ = 0;
  ros::Subscriber subscriber_;
};

}  // namespace message_filters

#endif
