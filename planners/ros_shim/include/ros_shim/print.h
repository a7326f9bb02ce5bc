#ifndef ROS_SHIM_PRINT_H
#define ROS_SHIM_PRINT_H

#include <cstdint>
#include <ostream>
#include <string>

#include "ros/time.h"

// Messages as text, in ROS's layout: "name: value", members below their message and indented.
namespace ros_shim {

inline void print_value(std::ostream& out, std::uint8_t value) { out << static_cast<int>(value); }
inline void print_value(std::ostream& out, std::int8_t value) { out << static_cast<int>(value); }
template <class T>
void print_value(std::ostream& out, const T& value) {
  out << value;
}

template <class T>
auto print_field(std::ostream& out, const std::string& indent, const char* name, const T& value)
    -> decltype(print_message(out, indent, value)) {
  out << indent << name << ": \n";
  print_message(out, indent + "  ", value);
}
template <class T, class... Plain>
void print_field(std::ostream& out, const std::string& indent, const char* name, const T& value,
                 const Plain&...) {
  out << indent << name << ": ";
  print_value(out, value);
  out << '\n';
}
template <class List>
void print_list(std::ostream& out, const std::string& indent, const char* name, const List& list) {
  out << indent << name << "[]\n";
  std::size_t index = 0;
  for (const auto& value : list) {
    const std::string item = std::string(name) + "[" + std::to_string(index++) + "]";
    print_field(out, indent + "  ", item.c_str(), value);
  }
}

}  // namespace ros_shim

#endif
