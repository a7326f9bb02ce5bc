#ifndef ROS_PARAM_H
#define ROS_PARAM_H

#include <string>

#include "ros_shim/runtime.h"
#include "ros_shim/value.h"

// Parameters without a NodeHandle: "~a" is private to the node.
namespace ros {
namespace param {

template <class T>
bool get(const std::string& name, T& out) {
  const std::string full = ros_shim::resolved("", name);
  ros_shim::Value value;
  if (!ros_shim::find_parameter(full, value)) return false;
  if (ros_shim::read(value, out)) return true;
  ros_shim::note_wrong_kind(full);
  return false;
}
template <class T>
bool getCached(const std::string& name, T& out) {
  return get(name, out);
}
template <class T>
bool param(const std::string& name, T& out, const T& preset) {
  if (get(name, out)) return true;
  out = preset;
  return false;
}
template <class T>
T param(const std::string& name, const T& preset) {
  T value{};
  return get(name, value) ? value : preset;
}
template <class T>
void set(const std::string& name, const T& value) {
  ros_shim::set_parameter(ros_shim::resolved("", name), ros_shim::value_of(value));
}
inline bool has(const std::string& name) {
  ros_shim::Value value;
  return ros_shim::find_parameter(ros_shim::resolved("", name), value);
}
inline bool del(const std::string& name) {
  return ros_shim::delete_parameter(ros_shim::resolved("", name));
}

}  // namespace param
}  // namespace ros

#endif
