#ifndef ROS_ASSERT_H
#define ROS_ASSERT_H

#include <stdexcept>
#include <string>

#include "ros_shim/runtime.h"

// A failed check ends the trial with its text, not the process.
#define ROS_SHIM_TEXT_OF(what) #what
#define ROS_SHIM_TEXT(what) ROS_SHIM_TEXT_OF(what)
#define ROS_BREAK() throw std::runtime_error("ROS_BREAK at " __FILE__ ":" ROS_SHIM_TEXT(__LINE__))
#define ROS_ASSERT(condition)                                                   \
  do {                                                                          \
    if (!(condition)) {                                                         \
      throw std::runtime_error("ROS_ASSERT(" #condition ") failed at " __FILE__ \
                               ":" ROS_SHIM_TEXT(__LINE__));                    \
    }                                                                           \
  } while (false)
#define ROS_ASSERT_MSG(condition, ...)                                              \
  do {                                                                              \
    if (!(condition)) throw std::runtime_error(::ros_shim::formatted(__VA_ARGS__)); \
  } while (false)
#define ROS_ASSERT_CMD(condition, command) \
  do {                                     \
    if (!(condition)) {                    \
      command;                             \
    }                                      \
  } while (false)
#define ROS_ISSUE_BREAK() ROS_BREAK()

#endif
