#ifndef ROS_SPINNER_H
#define ROS_SPINNER_H

#include <cstdint>

#include "ros/callback_queue.h"
#include "ros_shim/runtime.h"

namespace ros {

inline void spin() { ros_shim::spin(); }
inline void spinOnce() { ros_shim::spin_once(); }

class Spinner {
 public:
  virtual ~Spinner() = default;
  virtual void spin(CallbackQueue* = nullptr) { ros_shim::spin(); }
};
class SingleThreadedSpinner : public Spinner {};
/// One thread here too: callbacks never run at once.
class MultiThreadedSpinner : public Spinner {
 public:
  explicit MultiThreadedSpinner(std::uint32_t = 0) {}
};
inline void spin(Spinner& spinner) { spinner.spin(); }

/// Callbacks run while the node's main sleeps or waits: there is one thread.
class AsyncSpinner {
 public:
  explicit AsyncSpinner(std::uint32_t = 0, CallbackQueue* = nullptr) {}
  AsyncSpinner(const AsyncSpinner&) = delete;
  AsyncSpinner& operator=(const AsyncSpinner&) = delete;
  ~AsyncSpinner() { stop(); }
  bool canStart() { return true; }
  void start() {
    if (!is_on_) ros_shim::spin_in_background(true);
    is_on_ = true;
  }
  void stop() {
    if (is_on_) ros_shim::spin_in_background(false);
    is_on_ = false;
  }

 private:
  bool is_on_ = false;
};

}  // namespace ros

#endif
