#ifndef MESSAGE_FILTERS_SIMPLE_FILTER_H
#define MESSAGE_FILTERS_SIMPLE_FILTER_H

#include <functional>
#include <map>
#include <memory>
#include <string>
#include <utility>

#include "message_filters/connection.h"
#include "ros/message_event.h"
#include "ros_shim/pointer.h"

namespace message_filters {

/// Callbacks by the order of their registration.
template <class... Parameters>
class Signal {
 public:
  using Callback = std::function<void(Parameters...)>;

  Connection add(Callback callback) {
    const int key = next_++;
    (*callbacks_)[key] = std::move(callback);
    const std::weak_ptr<std::map<int, Callback>> all = callbacks_;
    return Connection([all, key] {
      if (const auto still = all.lock()) still->erase(key);
    });
  }
  void call(Parameters... parameters) const {
    // A copy: a callback may end itself.
    const std::map<int, Callback> now = *callbacks_;
    for (const auto& callback : now) callback.second(parameters...);
  }

 private:
  int next_ = 0;
  std::shared_ptr<std::map<int, Callback>> callbacks_ = std::make_shared<std::map<int, Callback>>();
};

/// What gives messages of one type to callbacks.
template <class M>
class SimpleFilter {
 public:
  using ConstPtr = ros_shim::shared_ptr<const M>;
  using EventType = ros::MessageEvent<const M>;

  template <class Callback>
  Connection registerCallback(const Callback& callback) {
    return signal_.add(std::function<void(const ConstPtr&)>(callback));
  }
  template <class P>
  Connection registerCallback(void (*callback)(P)) {
    return signal_.add([callback](const ConstPtr& message) { callback(message); });
  }
  template <class T, class P>
  Connection registerCallback(void (T::*callback)(P), T* object) {
    return signal_.add(
        [callback, object](const ConstPtr& message) { (object->*callback)(message); });
  }
  void setName(const std::string& name) { name_ = name; }
  const std::string& getName() { return name_; }

 protected:
  void signalMessage(const ConstPtr& message) { signal_.call(message); }
  void signalMessage(const EventType& event) { signal_.call(event.getConstMessage()); }

 private:
  Signal<const ConstPtr&> signal_;
  std::string name_;
};

}  // namespace message_filters

#endif
