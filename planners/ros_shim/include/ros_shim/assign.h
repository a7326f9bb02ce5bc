#ifndef ROS_SHIM_ASSIGN_H
#define ROS_SHIM_ASSIGN_H

#include <cstddef>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <vector>

#include "ros/message_traits.h"
#include "ros_shim/pointer.h"
#include "ros_shim/runtime.h"
#include "ros_shim/value.h"

namespace ros_shim {

// A value of a topics file into a field of a message. Throws std::runtime_error where it is of
// another kind.

inline double number_of(const Value& value) {
  if (value.kind == Value::Kind::boolean) return value.boolean ? 1.0 : 0.0;
  if (value.kind == Value::Kind::integer || value.kind == Value::Kind::number) return value.number;
  throw std::runtime_error("a field of a message takes a number");
}

template <class T>
typename std::enable_if<std::is_arithmetic<T>::value>::type assign(T& to, const Value& value) {
  to = static_cast<T>(number_of(value));
}
inline void assign(std::string& to, const Value& value) {
  if (value.kind != Value::Kind::text) {
    throw std::runtime_error("a field of a message takes a text");
  }
  to = value.text;
}
inline void assign(ros::Time& to, const Value& value) { to.fromSec(number_of(value)); }
inline void assign(ros::Duration& to, const Value& value) { to.fromSec(number_of(value)); }

template <class List>
void assign_each(List& to, const Value& value) {
  if (value.kind != Value::Kind::list || value.list.size() != to.size()) {
    throw std::runtime_error("a field of a message takes " + std::to_string(to.size()) + " values");
  }
  for (std::size_t i = 0; i < to.size(); ++i) assign(to[i], value.list[i]);
}
template <class T>
void assign(std::vector<T>& to, const Value& value) {
  to.resize(value.list.size());
  assign_each(to, value);
}
template <class T, std::size_t count>
void assign(array<T, count>& to, const Value& value) {
  assign_each(to, value);
}

/// Now, where the message has a header.
template <class M>
typename std::enable_if<ros::message_traits::HasHeader<M>::value>::type stamp(
    M& message, const std::string& frame) {
  message.header.stamp.fromNSec(now_ns());
  message.header.frame_id = frame;
}
template <class M>
typename std::enable_if<!ros::message_traits::HasHeader<M>::value>::type stamp(M&,
                                                                               const std::string&) {
}

}  // namespace ros_shim

#endif
