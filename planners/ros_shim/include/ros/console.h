#ifndef ROS_CONSOLE_H
#define ROS_CONSOLE_H

#include <sstream>
#include <string>

#include "ros_shim/runtime.h"

// Lines go to the log of avoidbench with the node's name; DEBUG is off and not evaluated, as in ROS
// where nobody turns it on.

#define ROS_SHIM_PRINT(level, ...) \
  ::ros_shim::log(::ros_shim::Level::level, ::ros_shim::formatted(__VA_ARGS__))
#define ROS_SHIM_STREAM(level, what)                                \
  do {                                                              \
    std::ostringstream ros_shim_line;                               \
    ros_shim_line << what;                                          \
    ::ros_shim::log(::ros_shim::Level::level, ros_shim_line.str()); \
  } while (false)
#define ROS_SHIM_IF(condition, statement) \
  do {                                    \
    if (condition) {                      \
      statement;                          \
    }                                     \
  } while (false)
#define ROS_SHIM_ONCE(statement)       \
  do {                                 \
    static bool ros_shim_done = false; \
    if (!ros_shim_done) {              \
      ros_shim_done = true;            \
      statement;                       \
    }                                  \
  } while (false)
// The first line comes at once; with DELAYED a period after the first call.
#define ROS_SHIM_THROTTLE(period, first, statement)                         \
  do {                                                                      \
    static double ros_shim_last_s = first;                                  \
    if (::ros_shim::is_due(ros_shim_last_s, static_cast<double>(period))) { \
      statement;                                                            \
    }                                                                       \
  } while (false)
#define ROS_SHIM_LONG_AGO (-1e9)
#define ROS_SHIM_NOW (1e-9 * static_cast<double>(::ros_shim::now_ns()))

#define ROS_DEBUG(...) ROS_SHIM_IF(false, ROS_SHIM_PRINT(debug, __VA_ARGS__))
#define ROS_INFO(...) ROS_SHIM_PRINT(info, __VA_ARGS__)
#define ROS_WARN(...) ROS_SHIM_PRINT(warning, __VA_ARGS__)
#define ROS_ERROR(...) ROS_SHIM_PRINT(error, __VA_ARGS__)
#define ROS_FATAL(...) ROS_SHIM_PRINT(fatal, __VA_ARGS__)

#define ROS_DEBUG_STREAM(what) ROS_SHIM_IF(false, ROS_SHIM_STREAM(debug, what))
#define ROS_INFO_STREAM(what) ROS_SHIM_STREAM(info, what)
#define ROS_WARN_STREAM(what) ROS_SHIM_STREAM(warning, what)
#define ROS_ERROR_STREAM(what) ROS_SHIM_STREAM(error, what)
#define ROS_FATAL_STREAM(what) ROS_SHIM_STREAM(fatal, what)

#define ROS_DEBUG_COND(condition, ...) ROS_SHIM_IF(condition, ROS_DEBUG(__VA_ARGS__))
#define ROS_DEBUG_ONCE(...) ROS_SHIM_ONCE(ROS_DEBUG(__VA_ARGS__))
#define ROS_DEBUG_THROTTLE(period, ...) \
  ROS_SHIM_THROTTLE(period, ROS_SHIM_LONG_AGO, ROS_DEBUG(__VA_ARGS__))
#define ROS_DEBUG_DELAYED_THROTTLE(period, ...) \
  ROS_SHIM_THROTTLE(period, ROS_SHIM_NOW, ROS_DEBUG(__VA_ARGS__))
#define ROS_DEBUG_NAMED(name, ...) ROS_DEBUG(__VA_ARGS__)
#define ROS_DEBUG_COND_NAMED(condition, name, ...) ROS_DEBUG_COND(condition, __VA_ARGS__)
#define ROS_DEBUG_ONCE_NAMED(name, ...) ROS_DEBUG_ONCE(__VA_ARGS__)
#define ROS_DEBUG_THROTTLE_NAMED(period, name, ...) ROS_DEBUG_THROTTLE(period, __VA_ARGS__)
#define ROS_DEBUG_STREAM_COND(condition, what) ROS_SHIM_IF(condition, ROS_DEBUG_STREAM(what))
#define ROS_DEBUG_STREAM_ONCE(what) ROS_SHIM_ONCE(ROS_DEBUG_STREAM(what))
#define ROS_DEBUG_STREAM_THROTTLE(period, what) \
  ROS_SHIM_THROTTLE(period, ROS_SHIM_LONG_AGO, ROS_DEBUG_STREAM(what))
#define ROS_DEBUG_STREAM_DELAYED_THROTTLE(period, what) \
  ROS_SHIM_THROTTLE(period, ROS_SHIM_NOW, ROS_DEBUG_STREAM(what))
#define ROS_DEBUG_STREAM_NAMED(name, what) ROS_DEBUG_STREAM(what)
#define ROS_DEBUG_STREAM_COND_NAMED(condition, name, what) ROS_DEBUG_STREAM_COND(condition, what)
#define ROS_DEBUG_STREAM_ONCE_NAMED(name, what) ROS_DEBUG_STREAM_ONCE(what)
#define ROS_DEBUG_STREAM_THROTTLE_NAMED(period, name, what) ROS_DEBUG_STREAM_THROTTLE(period, what)

#define ROS_INFO_COND(condition, ...) ROS_SHIM_IF(condition, ROS_INFO(__VA_ARGS__))
#define ROS_INFO_ONCE(...) ROS_SHIM_ONCE(ROS_INFO(__VA_ARGS__))
#define ROS_INFO_THROTTLE(period, ...) \
  ROS_SHIM_THROTTLE(period, ROS_SHIM_LONG_AGO, ROS_INFO(__VA_ARGS__))
#define ROS_INFO_DELAYED_THROTTLE(period, ...) \
  ROS_SHIM_THROTTLE(period, ROS_SHIM_NOW, ROS_INFO(__VA_ARGS__))
#define ROS_INFO_NAMED(name, ...) ROS_INFO(__VA_ARGS__)
#define ROS_INFO_COND_NAMED(condition, name, ...) ROS_INFO_COND(condition, __VA_ARGS__)
#define ROS_INFO_ONCE_NAMED(name, ...) ROS_INFO_ONCE(__VA_ARGS__)
#define ROS_INFO_THROTTLE_NAMED(period, name, ...) ROS_INFO_THROTTLE(period, __VA_ARGS__)
#define ROS_INFO_STREAM_COND(condition, what) ROS_SHIM_IF(condition, ROS_INFO_STREAM(what))
#define ROS_INFO_STREAM_ONCE(what) ROS_SHIM_ONCE(ROS_INFO_STREAM(what))
#define ROS_INFO_STREAM_THROTTLE(period, what) \
  ROS_SHIM_THROTTLE(period, ROS_SHIM_LONG_AGO, ROS_INFO_STREAM(what))
#define ROS_INFO_STREAM_DELAYED_THROTTLE(period, what) \
  ROS_SHIM_THROTTLE(period, ROS_SHIM_NOW, ROS_INFO_STREAM(what))
#define ROS_INFO_STREAM_NAMED(name, what) ROS_INFO_STREAM(what)
#define ROS_INFO_STREAM_COND_NAMED(condition, name, what) ROS_INFO_STREAM_COND(condition, what)
#define ROS_INFO_STREAM_ONCE_NAMED(name, what) ROS_INFO_STREAM_ONCE(what)
#define ROS_INFO_STREAM_THROTTLE_NAMED(period, name, what) ROS_INFO_STREAM_THROTTLE(period, what)

#define ROS_WARN_COND(condition, ...) ROS_SHIM_IF(condition, ROS_WARN(__VA_ARGS__))
#define ROS_WARN_ONCE(...) ROS_SHIM_ONCE(ROS_WARN(__VA_ARGS__))
#define ROS_WARN_THROTTLE(period, ...) \
  ROS_SHIM_THROTTLE(period, ROS_SHIM_LONG_AGO, ROS_WARN(__VA_ARGS__))
#define ROS_WARN_DELAYED_THROTTLE(period, ...) \
  ROS_SHIM_THROTTLE(period, ROS_SHIM_NOW, ROS_WARN(__VA_ARGS__))
#define ROS_WARN_NAMED(name, ...) ROS_WARN(__VA_ARGS__)
#define ROS_WARN_COND_NAMED(condition, name, ...) ROS_WARN_COND(condition, __VA_ARGS__)
#define ROS_WARN_ONCE_NAMED(name, ...) ROS_WARN_ONCE(__VA_ARGS__)
#define ROS_WARN_THROTTLE_NAMED(period, name, ...) ROS_WARN_THROTTLE(period, __VA_ARGS__)
#define ROS_WARN_STREAM_COND(condition, what) ROS_SHIM_IF(condition, ROS_WARN_STREAM(what))
#define ROS_WARN_STREAM_ONCE(what) ROS_SHIM_ONCE(ROS_WARN_STREAM(what))
#define ROS_WARN_STREAM_THROTTLE(period, what) \
  ROS_SHIM_THROTTLE(period, ROS_SHIM_LONG_AGO, ROS_WARN_STREAM(what))
#define ROS_WARN_STREAM_DELAYED_THROTTLE(period, what) \
  ROS_SHIM_THROTTLE(period, ROS_SHIM_NOW, ROS_WARN_STREAM(what))
#define ROS_WARN_STREAM_NAMED(name, what) ROS_WARN_STREAM(what)
#define ROS_WARN_STREAM_COND_NAMED(condition, name, what) ROS_WARN_STREAM_COND(condition, what)
#define ROS_WARN_STREAM_ONCE_NAMED(name, what) ROS_WARN_STREAM_ONCE(what)
#define ROS_WARN_STREAM_THROTTLE_NAMED(period, name, what) ROS_WARN_STREAM_THROTTLE(period, what)

#define ROS_ERROR_COND(condition, ...) ROS_SHIM_IF(condition, ROS_ERROR(__VA_ARGS__))
#define ROS_ERROR_ONCE(...) ROS_SHIM_ONCE(ROS_ERROR(__VA_ARGS__))
#define ROS_ERROR_THROTTLE(period, ...) \
  ROS_SHIM_THROTTLE(period, ROS_SHIM_LONG_AGO, ROS_ERROR(__VA_ARGS__))
#define ROS_ERROR_DELAYED_THROTTLE(period, ...) \
  ROS_SHIM_THROTTLE(period, ROS_SHIM_NOW, ROS_ERROR(__VA_ARGS__))
#define ROS_ERROR_NAMED(name, ...) ROS_ERROR(__VA_ARGS__)
#define ROS_ERROR_COND_NAMED(condition, name, ...) ROS_ERROR_COND(condition, __VA_ARGS__)
#define ROS_ERROR_ONCE_NAMED(name, ...) ROS_ERROR_ONCE(__VA_ARGS__)
#define ROS_ERROR_THROTTLE_NAMED(period, name, ...) ROS_ERROR_THROTTLE(period, __VA_ARGS__)
#define ROS_ERROR_STREAM_COND(condition, what) ROS_SHIM_IF(condition, ROS_ERROR_STREAM(what))
#define ROS_ERROR_STREAM_ONCE(what) ROS_SHIM_ONCE(ROS_ERROR_STREAM(what))
#define ROS_ERROR_STREAM_THROTTLE(period, what) \
  ROS_SHIM_THROTTLE(period, ROS_SHIM_LONG_AGO, ROS_ERROR_STREAM(what))
#define ROS_ERROR_STREAM_DELAYED_THROTTLE(period, what) \
  ROS_SHIM_THROTTLE(period, ROS_SHIM_NOW, ROS_ERROR_STREAM(what))
#define ROS_ERROR_STREAM_NAMED(name, what) ROS_ERROR_STREAM(what)
#define ROS_ERROR_STREAM_COND_NAMED(condition, name, what) ROS_ERROR_STREAM_COND(condition, what)
#define ROS_ERROR_STREAM_ONCE_NAMED(name, what) ROS_ERROR_STREAM_ONCE(what)
#define ROS_ERROR_STREAM_THROTTLE_NAMED(period, name, what) ROS_ERROR_STREAM_THROTTLE(period, what)

#define ROS_FATAL_COND(condition, ...) ROS_SHIM_IF(condition, ROS_FATAL(__VA_ARGS__))
#define ROS_FATAL_ONCE(...) ROS_SHIM_ONCE(ROS_FATAL(__VA_ARGS__))
#define ROS_FATAL_THROTTLE(period, ...) \
  ROS_SHIM_THROTTLE(period, ROS_SHIM_LONG_AGO, ROS_FATAL(__VA_ARGS__))
#define ROS_FATAL_DELAYED_THROTTLE(period, ...) \
  ROS_SHIM_THROTTLE(period, ROS_SHIM_NOW, ROS_FATAL(__VA_ARGS__))
#define ROS_FATAL_NAMED(name, ...) ROS_FATAL(__VA_ARGS__)
#define ROS_FATAL_COND_NAMED(condition, name, ...) ROS_FATAL_COND(condition, __VA_ARGS__)
#define ROS_FATAL_ONCE_NAMED(name, ...) ROS_FATAL_ONCE(__VA_ARGS__)
#define ROS_FATAL_THROTTLE_NAMED(period, name, ...) ROS_FATAL_THROTTLE(period, __VA_ARGS__)
#define ROS_FATAL_STREAM_COND(condition, what) ROS_SHIM_IF(condition, ROS_FATAL_STREAM(what))
#define ROS_FATAL_STREAM_ONCE(what) ROS_SHIM_ONCE(ROS_FATAL_STREAM(what))
#define ROS_FATAL_STREAM_THROTTLE(period, what) \
  ROS_SHIM_THROTTLE(period, ROS_SHIM_LONG_AGO, ROS_FATAL_STREAM(what))
#define ROS_FATAL_STREAM_DELAYED_THROTTLE(period, what) \
  ROS_SHIM_THROTTLE(period, ROS_SHIM_NOW, ROS_FATAL_STREAM(what))
#define ROS_FATAL_STREAM_NAMED(name, what) ROS_FATAL_STREAM(what)
#define ROS_FATAL_STREAM_COND_NAMED(condition, name, what) ROS_FATAL_STREAM_COND(condition, what)
#define ROS_FATAL_STREAM_ONCE_NAMED(name, what) ROS_FATAL_STREAM_ONCE(what)
#define ROS_FATAL_STREAM_THROTTLE_NAMED(period, name, what) ROS_FATAL_STREAM_THROTTLE(period, what)

#include "ros/assert.h"

#endif
