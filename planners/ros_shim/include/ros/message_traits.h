#ifndef ROS_MESSAGE_TRAITS_H
#define ROS_MESSAGE_TRAITS_H

#include <string>
#include <type_traits>

#include "ros/time.h"

namespace ros {
namespace message_traits {

/// The generated headers specialise it: "nav_msgs/Odometry".
template <class M>
struct DataType;
template <class M>
struct DataType<const M> : DataType<M> {};

template <class M, class = void>
struct HasHeader : std::false_type {};
template <class M>
struct HasHeader<M, decltype(static_cast<void>(std::declval<M&>().header.stamp))> : std::true_type {
};
template <class M>
bool hasHeader() {
  return HasHeader<M>::value;
}
template <class M>
const char* datatype() {
  return DataType<M>::value();
}
template <class M>
const char* datatype(const M&) {
  return DataType<M>::value();
}

template <class M>
struct TimeStamp {
  static Time value(const M& message) { return message.header.stamp; }
};
template <class M>
struct FrameId {
  static std::string value(const M& message) { return message.header.frame_id; }
};
template <class M>
struct IsMessage : std::true_type {};

}  // namespace message_traits
}  // namespace ros

#endif
