#ifndef MESSAGE_FILTERS_SYNCHRONIZER_H
#define MESSAGE_FILTERS_SYNCHRONIZER_H

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "message_filters/simple_filter.h"
#include "ros/message_traits.h"
#include "ros_shim/synchronize.h"

namespace message_filters {

/// Brings messages of some topics together, by a policy of sync_policies.
template <class Policy>
class Synchronizer;

/// The part that knows the messages' types. `Matcher` has add(topic, Stamped).
template <class Matcher, class... M>
class TypedSynchronizer {
 public:
  using Callback = std::function<void(const ros_shim::shared_ptr<const M>&...)>;

  TypedSynchronizer(const TypedSynchronizer&) = delete;
  TypedSynchronizer& operator=(const TypedSynchronizer&) = delete;
  ~TypedSynchronizer() {
    for (Connection& connection : inputs_) connection.disconnect();
  }

  template <class... Filter>
  void connectInput(Filter&... filters) {
    static_assert(sizeof...(Filter) == sizeof...(M), "one filter for each message");
    for (Connection& connection : inputs_) connection.disconnect();
    inputs_.clear();
    connect<0>(filters...);
  }

  template <class C>
  Connection registerCallback(const C& callback) {
    return signal_.add(Callback(callback));
  }
  template <class... P>
  Connection registerCallback(void (*callback)(P...)) {
    return signal_.add(Callback(callback));
  }
  template <class T, class... P>
  Connection registerCallback(void (T::*callback)(P...), T* object) {
    return signal_.add([callback, object](const ros_shim::shared_ptr<const M>&... messages) {
      (object->*callback)(messages...);
    });
  }
  template <class T, class... P>
  Connection registerCallback(void (T::*callback)(P...) const, T* object) {
    return signal_.add([callback, object](const ros_shim::shared_ptr<const M>&... messages) {
      (object->*callback)(messages...);
    });
  }

  /// The message of topic `index`, without a filter.
  template <std::size_t index>
  void add(
      const ros_shim::shared_ptr<const typename std::tuple_element<index, std::tuple<M...>>::type>&
          message) {
    using Message = typename std::tuple_element<index, std::tuple<M...>>::type;
    ros_shim::Stamped stamped;
    stamped.stamp_ns = ros::message_traits::TimeStamp<Message>::value(*message).toNSec();
    stamped.message = message;
    matcher_.add(index, stamped);
  }
  void setName(const std::string& name) { name_ = name; }
  const std::string& getName() { return name_; }

 protected:
  explicit TypedSynchronizer(std::uint32_t queue_size)
      : matcher_(sizeof...(M), queue_size, [this](const std::vector<ros_shim::AnyMessage>& set) {
          give(set, std::index_sequence_for<M...>());
        }) {}

  Matcher matcher_;

 private:
  template <std::size_t index>
  void connect() {}
  template <std::size_t index, class Filter, class... Rest>
  void connect(Filter& filter, Rest&... rest) {
    using Message = typename std::tuple_element<index, std::tuple<M...>>::type;
    inputs_.push_back(
        filter.registerCallback(std::function<void(const ros_shim::shared_ptr<const Message>&)>(
            [this](const ros_shim::shared_ptr<const Message>& message) {
              this->template add<index>(message);
            })));
    connect<index + 1>(rest...);
  }
  template <std::size_t... index>
  void give(const std::vector<ros_shim::AnyMessage>& set, std::index_sequence<index...>) {
    signal_.call(ros_shim::cast_pointer<const M>(set[index])...);
  }

  Signal<const ros_shim::shared_ptr<const M>&...> signal_;
  std::vector<Connection> inputs_;
  std::string name_;
};

}  // namespace message_filters

#endif
