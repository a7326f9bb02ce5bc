#ifndef ROS_SHIM_CALLBACK_H
#define ROS_SHIM_CALLBACK_H

#include <functional>
#include <type_traits>
#include <utility>

#include "ros/message_event.h"
#include "ros/message_traits.h"
#include "ros_shim/pointer.h"
#include "ros_shim/runtime.h"

namespace ros_shim {

/// What a callback takes, by its parameter's type: the message and how it is handed over.
template <class Parameter>
struct Adapter {  // const M&, M
  using Message = typename std::decay<Parameter>::type;
  static const Message& given(const Delivery& delivery) {
    return *static_cast<const Message*>(delivery.message.get());
  }
};

template <class M>
struct PointerAdapter {
  using Message = typename std::remove_const<M>::type;
  static shared_ptr<const Message> shared(const Delivery& delivery) {
    return ros_shim::cast_pointer<const Message>(delivery.message);
  }
  static shared_ptr<const Message> pointer(const Delivery& delivery, std::true_type) {
    return shared(delivery);
  }
  /// Who may change the message gets a copy: other subscribers have the same one.
  static shared_ptr<Message> pointer(const Delivery& delivery, std::false_type) {
    return ros_shim::make_shared<Message>(*shared(delivery));
  }
  static shared_ptr<M> given(const Delivery& delivery) {
    return pointer(delivery, std::is_const<M>());
  }
};
template <class M>
struct Adapter<shared_ptr<M>> : PointerAdapter<M> {};
template <class M>
struct Adapter<const shared_ptr<M>&> : PointerAdapter<M> {};

template <class M>
struct EventAdapter {
  using Message = typename std::remove_const<M>::type;
  static ros::MessageEvent<M> given(const Delivery& delivery) {
    return ros::MessageEvent<M>(ros_shim::cast_pointer<const Message>(delivery.message),
                                delivery.publisher, ros::Time().fromNSec(delivery.received_ns));
  }
};
template <class M>
struct Adapter<const ros::MessageEvent<M>&> : EventAdapter<M> {};
template <class M>
struct Adapter<ros::MessageEvent<M>> : EventAdapter<M> {};

template <class Parameter>
using MessageOf = typename Adapter<Parameter>::Message;

/// `callback(Parameter)` as the runtime calls it.
template <class Parameter, class Callback>
Deliver deliver_to(Callback callback) {
  return [callback](const Delivery& delivery) mutable {
    callback(Adapter<Parameter>::given(delivery));
  };
}

}  // namespace ros_shim

#endif
