#ifndef ROS_SHIM_VALUE_H
#define ROS_SHIM_VALUE_H

#include <map>
#include <string>
#include <utility>
#include <vector>

namespace ros_shim {

/// A value of the parameter server: a bool, a number, a text, a list or a map of values.
struct Value {
  enum class Kind { none, boolean, integer, number, text, list, map };
  Kind kind = Kind::none;
  bool boolean = false;
  int integer = 0;
  double number = 0.0;
  std::string text;
  std::vector<Value> list;
  std::vector<std::pair<std::string, Value>> map;  ///< by name, rising

  Value() = default;
  Value(bool value) : kind(Kind::boolean), boolean(value) {}
  Value(int value) : kind(Kind::integer), integer(value), number(value) {}
  Value(double value) : kind(Kind::number), number(value) {}
  Value(const char* value) : kind(Kind::text), text(value) {}
  Value(std::string value) : kind(Kind::text), text(std::move(value)) {}
  static Value list_of(std::vector<Value> values);
  static Value map_of(std::vector<std::pair<std::string, Value>> values);
};

// As roscpp converts: whole numbers serve as numbers; numbers as whole numbers where they are
// whole; nothing else. False, and `out` as it was, for another kind.
bool read(const Value& value, bool& out);
bool read(const Value& value, int& out);
bool read(const Value& value, double& out);
bool read(const Value& value, float& out);
bool read(const Value& value, std::string& out);
bool read(const Value& value, Value& out);
template <class T>
bool read(const Value& value, std::vector<T>& out) {
  if (value.kind != Value::Kind::list) return false;
  std::vector<T> items;
  for (const Value& item : value.list) {
    T one{};
    if (!read(item, one)) return false;
    items.push_back(one);
  }
  out = items;
  return true;
}
template <class T>
bool read(const Value& value, std::map<std::string, T>& out) {
  if (value.kind != Value::Kind::map) return false;
  std::map<std::string, T> items;
  for (const auto& item : value.map) {
    T one{};
    if (!read(item.second, one)) return false;
    items[item.first] = one;
  }
  out = items;
  return true;
}

inline Value value_of(bool value) { return Value(value); }
inline Value value_of(int value) { return Value(value); }
inline Value value_of(double value) { return Value(value); }
inline Value value_of(float value) { return Value(static_cast<double>(value)); }
inline Value value_of(const char* value) { return Value(value); }
inline Value value_of(const std::string& value) { return Value(value); }
inline Value value_of(const Value& value) { return value; }
template <class T>
Value value_of(const std::vector<T>& values) {
  std::vector<Value> items;
  for (const T& one : values) items.push_back(value_of(one));
  return Value::list_of(std::move(items));
}
template <class T>
Value value_of(const std::map<std::string, T>& values) {
  std::vector<std::pair<std::string, Value>> items;
  for (const auto& one : values) items.emplace_back(one.first, value_of(one.second));
  return Value::map_of(std::move(items));
}

// The parameter server, by resolved name ("/planner/fsm/flight_type"). A map is the same as the
// names below it.
bool find_parameter(const std::string& resolved_name, Value& out);
void set_parameter(const std::string& resolved_name, const Value& value);
bool delete_parameter(const std::string& resolved_name);
std::vector<std::string> parameter_names();
/// The parameter is there but of another kind than the node asks for.
void note_wrong_kind(const std::string& resolved_name);

}  // namespace ros_shim

#endif
