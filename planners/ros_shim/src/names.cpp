#include <cstdarg>
#include <cstdio>
#include <stdexcept>

#include "core.hpp"
#include "ros/node_handle.h"
#include "ros/this_node.h"

// Names, parameters and the log.
namespace ros_shim {
namespace {

bool is_name_character(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' ||
         c == '/';
}

void require_name(const std::string& name) {
  for (std::size_t i = 0; i < name.size(); ++i) {
    const char c = name[i];
    const bool is_digit = c >= '0' && c <= '9';
    const bool fits =
        i == 0 ? (is_name_character(c) && !is_digit) || c == '~' : is_name_character(c);
    if (!fits) {
      throw std::invalid_argument("\"" + name + "\" is no name in ROS: character " +
                                  std::to_string(i + 1));
    }
  }
}

/// Without double slashes and without one at the end.
std::string clean(const std::string& name) {
  std::string out;
  for (const char c : name) {
    if (c == '/' && !out.empty() && out.back() == '/') continue;
    out += c;
  }
  while (out.size() > 1 && out.back() == '/') out.pop_back();
  return out;
}

bool is_below(const std::string& name, const std::string& space) {
  if (space == "/") return true;
  return name.size() > space.size() && name.compare(0, space.size(), space) == 0 &&
         name[space.size()] == '/';
}

/// Adds `value` to a map at the path `rest` ("a/b").
void put(Value& into, const std::string& rest, const Value& value) {
  into.kind = Value::Kind::map;
  const std::size_t slash = rest.find('/');
  const std::string key = rest.substr(0, slash);
  for (auto& [name, item] : into.map) {
    if (name != key) continue;
    if (slash != std::string::npos) put(item, rest.substr(slash + 1), value);
    return;
  }
  into.map.emplace_back(key, Value());
  if (slash == std::string::npos) {
    into.map.back().second = value;
  } else {
    put(into.map.back().second, rest.substr(slash + 1), value);
  }
}

}  // namespace

const std::string& node_name() { return core().current->full_name; }

std::string resolved(const std::string& space, const std::string& name) {
  require_name(name);
  const Node& node = *core().current;
  const std::string own = node.spec.space.empty() ? "/" : node.spec.space;
  std::string full;
  if (!name.empty() && name[0] == '/') {
    full = clean(name);
  } else if (!name.empty() && name[0] == '~') {
    full = clean(node.full_name + "/" + name.substr(1));
  } else {
    full = clean((space.empty() ? own : space) + "/" + name);
  }
  const auto found = node.remappings.find(full);
  return found != node.remappings.end() ? found->second : full;
}

bool find_parameter(const std::string& name, Value& out) {
  const std::map<std::string, Value>& all = core().parameters;
  const auto found = all.find(name);
  if (found != all.end()) {
    out = found->second;
    return true;
  }
  Value map;
  for (const auto& [full, value] : all) {
    if (is_below(full, name)) put(map, full.substr(name == "/" ? 1 : name.size() + 1), value);
  }
  if (map.kind == Value::Kind::none) return false;
  out = map;
  return true;
}

void set_parameter(const std::string& name, const Value& value) {
  delete_parameter(name);
  if (value.kind != Value::Kind::map) {
    core().parameters[name] = value;
    return;
  }
  for (const auto& [key, item] : value.map) {
    set_parameter(name == "/" ? "/" + key : name + "/" + key, item);
  }
}

bool delete_parameter(const std::string& name) {
  std::map<std::string, Value>& all = core().parameters;
  bool any = all.erase(name) > 0;
  for (auto item = all.begin(); item != all.end();) {
    const bool goes = is_below(item->first, name);
    any = any || goes;
    item = goes ? all.erase(item) : std::next(item);
  }
  return any;
}

std::vector<std::string> parameter_names() {
  std::vector<std::string> names;
  for (const auto& item : core().parameters) names.push_back(item.first);
  return names;
}

void note_wrong_kind(const std::string& name) {
  log(Level::warning, "parameter " + name + " is of another kind than is asked for: not taken");
}

Value Value::list_of(std::vector<Value> values) {
  Value made;
  made.kind = Kind::list;
  made.list = std::move(values);
  return made;
}

Value Value::map_of(std::vector<std::pair<std::string, Value>> values) {
  Value made;
  made.kind = Kind::map;
  made.map = std::move(values);
  return made;
}

bool read(const Value& value, bool& out) {
  if (value.kind != Value::Kind::boolean) return false;
  out = value.boolean;
  return true;
}

bool read(const Value& value, int& out) {
  if (value.kind == Value::Kind::integer) {
    out = value.integer;
    return true;
  }
  const bool is_whole = value.kind == Value::Kind::number && value.number >= -2147483648.0 &&
                        value.number <= 2147483647.0 &&
                        value.number == static_cast<double>(static_cast<int>(value.number));
  if (is_whole) out = static_cast<int>(value.number);
  return is_whole;
}

bool read(const Value& value, double& out) {
  if (value.kind != Value::Kind::number && value.kind != Value::Kind::integer) return false;
  out = value.number;
  return true;
}

bool read(const Value& value, float& out) {
  double number = 0.0;
  if (!read(value, number)) return false;
  out = static_cast<float>(number);
  return true;
}

bool read(const Value& value, std::string& out) {
  if (value.kind != Value::Kind::text) return false;
  out = value.text;
  return true;
}

bool read(const Value& value, Value& out) {
  out = value;
  return true;
}

// log

void log(Level level, const std::string& text) {
  if (level == Level::debug) return;
  const Core& core = core_of_any_thread();
  if (core.write_log) core.write_log(level, "[" + core.current->full_name.substr(1) + "] " + text);
}

std::string formatted(const char* format, ...) {
  std::va_list arguments, again;
  va_start(arguments, format);
  va_copy(again, arguments);
  const int length = std::vsnprintf(nullptr, 0, format, arguments);
  va_end(arguments);
  std::string text(static_cast<std::size_t>(length > 0 ? length : 0), '\0');
  if (length > 0) std::vsnprintf(&text[0], text.size() + 1, format, again);
  va_end(again);
  return text;
}

bool is_due(double& last_s, double seconds) {
  const double now_s = 1e-9 * static_cast<double>(now_ns());
  if (now_s < last_s + seconds) return false;
  last_s = now_s;
  return true;
}

std::string package_folder(const std::string& package) {
  const auto found = core().packages.find(package);
  return found != core().packages.end() ? found->second : "";
}

}  // namespace ros_shim

namespace ros {

bool NodeHandle::searchParam(const std::string& name, std::string& found) const {
  std::string space = space_;
  while (true) {
    const std::string full = space == "/" ? "/" + name : space + "/" + name;
    ros_shim::Value value;
    if (ros_shim::find_parameter(full, value)) {
      found = full;
      return true;
    }
    if (space == "/" || space.empty()) return false;
    const std::size_t slash = space.rfind('/');
    space = slash == 0 ? "/" : space.substr(0, slash);
  }
}

namespace this_node {
std::string getNamespace() {
  const std::string& space = ros_shim::core().current->spec.space;
  return space.empty() ? "/" : space;
}
}  // namespace this_node

namespace names {
std::string append(const std::string& left, const std::string& right) {
  if (left.empty() || left.back() == '/') return left + right;
  return left + "/" + right;
}
}  // namespace names

}  // namespace ros
