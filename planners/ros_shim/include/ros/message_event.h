#ifndef ROS_MESSAGE_EVENT_H
#define ROS_MESSAGE_EVENT_H

#include <string>
#include <type_traits>
#include <utility>

#include "ros/time.h"
#include "ros_shim/pointer.h"

namespace ros {

/// A message with who sent it and when it came. `M` is const or not.
template <class M>
class MessageEvent {
 public:
  using Message = typename std::remove_const<M>::type;
  using ConstMessage = const Message;
  using MessagePtr = ros_shim::shared_ptr<Message>;
  using ConstMessagePtr = ros_shim::shared_ptr<ConstMessage>;

  MessageEvent() = default;
  explicit MessageEvent(ConstMessagePtr message) : message_(std::move(message)) {}
  MessageEvent(ConstMessagePtr message, std::string publisher, Time receipt_time)
      : message_(std::move(message)), publisher_(std::move(publisher)), receipt_(receipt_time) {}

  ros_shim::shared_ptr<M> getMessage() const { return given(static_cast<M*>(nullptr)); }
  const ConstMessagePtr& getConstMessage() const { return message_; }
  const std::string& getPublisherName() const { return publisher_; }
  Time getReceiptTime() const { return receipt_; }

 private:
  ConstMessagePtr given(ConstMessage*) const { return message_; }
  /// Who may change the message gets a copy: other subscribers have the same one.
  MessagePtr given(Message*) const { return ros_shim::make_shared<Message>(*message_); }

  ConstMessagePtr message_;
  std::string publisher_;
  Time receipt_;
};

}  // namespace ros

#endif
