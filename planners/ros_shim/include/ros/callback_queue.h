#ifndef ROS_CALLBACK_QUEUE_H
#define ROS_CALLBACK_QUEUE_H

#include "ros/time.h"
#include "ros_shim/runtime.h"

namespace ros {

class CallbackQueueInterface {
 public:
  virtual ~CallbackQueueInterface() = default;
};

/// There is one queue a node: each of its queues is that one.
class CallbackQueue : public CallbackQueueInterface {
 public:
  enum CallOneResult { Called, TryAgain, Disabled, Empty };
  explicit CallbackQueue(bool /*enabled*/ = true) {}
  /// The callbacks that wait now; without any those that come within the time.
  void callAvailable(WallDuration timeout = WallDuration()) {
    if (is_enabled_) ros_shim::call_callbacks(ros_shim::kAllCallbacks, timeout.toNSec());
  }
  CallOneResult callOne(WallDuration timeout = WallDuration()) {
    if (!is_enabled_) return Disabled;
    return ros_shim::call_callbacks(1, timeout.toNSec()) > 0 ? Called : Empty;
  }
  bool empty() { return isEmpty(); }
  bool isEmpty() { return ros_shim::waiting_callbacks() == 0; }
  bool isEnabled() const { return is_enabled_; }
  void enable() { is_enabled_ = true; }
  void disable() { is_enabled_ = false; }

 private:
  bool is_enabled_ = true;
};

inline CallbackQueue* getGlobalCallbackQueue() {
  static CallbackQueue queue;
  return &queue;
}

}  // namespace ros

#endif
