#ifndef ROS_NODE_HANDLE_H
#define ROS_NODE_HANDLE_H

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "ros/callback_queue.h"
#include "ros/publisher.h"
#include "ros/service_client.h"
#include "ros/service_server.h"
#include "ros/subscriber.h"
#include "ros/timer.h"
#include "ros/transport_hints.h"
#include "ros_shim/callback.h"
#include "ros_shim/value.h"

namespace ros {

using M_string = std::map<std::string, std::string>;
using VoidPtr = ros_shim::shared_ptr<void>;
using VoidConstPtr = ros_shim::shared_ptr<const void>;

class NodeHandle {
 public:
  NodeHandle(const std::string& space = "", const M_string& remappings = M_string())
      : space_(ros_shim::resolved("", space)), remappings_(remappings) {}
  NodeHandle(const NodeHandle& parent, const std::string& space)
      : space_(parent.resolveName(space)), remappings_(parent.remappings_) {}
  NodeHandle(const NodeHandle& parent, const std::string& space, const M_string& remappings)
      : space_(parent.resolveName(space)), remappings_(remappings) {}

  const std::string& getNamespace() const { return space_; }
  const std::string& getUnresolvedNamespace() const { return space_; }
  std::string resolveName(const std::string& name, bool remap = true) const {
    const auto found = remappings_.find(name);
    return ros_shim::resolved(space_, remap && found != remappings_.end() ? found->second : name);
  }
  bool ok() const { return ros_shim::is_running(); }
  void shutdown() {}

  // publishers
  template <class M>
  Publisher advertise(const std::string& topic, std::uint32_t /*queue_size*/, bool latch = false) {
    const std::string name = topic_name(topic);
    const char* type = message_traits::DataType<M>::value();
    return Publisher(ros_shim::topic_of(name, type), name, type, latch);
  }

  // subscribers: the forms that roscpp has, of members, functions and function objects
  template <class P, class T>
  Subscriber subscribe(const std::string& topic, std::uint32_t limit, void (T::*callback)(P),
                       T* object, const TransportHints& = TransportHints()) {
    return subscribed<P>(topic, limit, [object, callback](P p) { (object->*callback)(p); });
  }
  template <class P, class T>
  Subscriber subscribe(const std::string& topic, std::uint32_t limit, void (T::*callback)(P) const,
                       T* object, const TransportHints& = TransportHints()) {
    return subscribed<P>(topic, limit, [object, callback](P p) { (object->*callback)(p); });
  }
  template <class M, class T>
  Subscriber subscribe(const std::string& topic, std::uint32_t limit,
                       void (T::*callback)(const ros_shim::shared_ptr<const M>&), T* object,
                       const TransportHints& = TransportHints()) {
    using P = const ros_shim::shared_ptr<const M>&;
    return subscribed<P>(topic, limit, [object, callback](P p) { (object->*callback)(p); });
  }
  template <class M, class T>
  Subscriber subscribe(const std::string& topic, std::uint32_t limit,
                       void (T::*callback)(const ros_shim::shared_ptr<const M>&) const, T* object,
                       const TransportHints& = TransportHints()) {
    using P = const ros_shim::shared_ptr<const M>&;
    return subscribed<P>(topic, limit, [object, callback](P p) { (object->*callback)(p); });
  }
  template <class P, class T>
  Subscriber subscribe(const std::string& topic, std::uint32_t limit, void (T::*callback)(P),
                       const ros_shim::shared_ptr<T>& object,
                       const TransportHints& = TransportHints()) {
    return subscribed<P>(topic, limit, [object, callback](P p) { (object.get()->*callback)(p); });
  }
  template <class P>
  Subscriber subscribe(const std::string& topic, std::uint32_t limit, void (*callback)(P),
                       const TransportHints& = TransportHints()) {
    return subscribed<P>(topic, limit, callback);
  }
  template <class M>
  Subscriber subscribe(const std::string& topic, std::uint32_t limit,
                       void (*callback)(const ros_shim::shared_ptr<const M>&),
                       const TransportHints& = TransportHints()) {
    return subscribed<const ros_shim::shared_ptr<const M>&>(topic, limit, callback);
  }
  /// A function object, a lambda or what boost::bind gives: subscribe<M>(…).
  template <class M, class Callback>
  Subscriber subscribe(const std::string& topic, std::uint32_t limit, Callback callback,
                       const VoidConstPtr& = VoidConstPtr(),
                       const TransportHints& = TransportHints()) {
    using P = const ros_shim::shared_ptr<const M>&;
    return subscribed<P>(topic, limit, std::function<void(P)>(callback));
  }
#ifdef ROS_SHIM_HAS_BOOST
  /// A boost::function says itself what it takes.
  template <class P>
  Subscriber subscribe(const std::string& topic, std::uint32_t limit,
                       const boost::function<void(P)>& callback,
                       const VoidConstPtr& = VoidConstPtr(),
                       const TransportHints& = TransportHints()) {
    return subscribed<P>(topic, limit, callback);
  }
  /// subscribe<M, const M&>(…, boost::bind(…))
  template <class M, class P>
  Subscriber subscribe(const std::string& topic, std::uint32_t limit,
                       const boost::function<void(P)>& callback,
                       const VoidConstPtr& = VoidConstPtr(),
                       const TransportHints& = TransportHints()) {
    return subscribed<P>(topic, limit, callback);
  }
#endif

  // services
  template <class T, class Request, class Response>
  ServiceServer advertiseService(const std::string& service,
                                 bool (T::*callback)(Request&, Response&), T* object) {
    return offered<Request, Response>(
        service, [object, callback](Request& q, Response& a) { return (object->*callback)(q, a); });
  }
  template <class T, class Request, class Response>
  ServiceServer advertiseService(const std::string& service,
                                 bool (T::*callback)(Request&, Response&),
                                 const ros_shim::shared_ptr<T>& object) {
    return offered<Request, Response>(service, [object, callback](Request& q, Response& a) {
      return (object.get()->*callback)(q, a);
    });
  }
  template <class Request, class Response>
  ServiceServer advertiseService(const std::string& service,
                                 bool (*callback)(Request&, Response&)) {
    return offered<Request, Response>(service, callback);
  }
  template <class Request, class Response>
  ServiceServer advertiseService(const std::string& service,
                                 const std::function<bool(Request&, Response&)>& callback) {
    return offered<Request, Response>(service, callback);
  }
#ifdef ROS_SHIM_HAS_BOOST
  template <class Request, class Response>
  ServiceServer advertiseService(const std::string& service,
                                 const boost::function<bool(Request&, Response&)>& callback) {
    return offered<Request, Response>(service, callback);
  }
#endif
  template <class Service>
  ServiceClient serviceClient(const std::string& service, bool /*persistent*/ = false,
                              const M_string& = M_string()) {
    return ServiceClient(topic_name(service));
  }
  template <class Request, class Response>
  ServiceClient serviceClient(const std::string& service, bool /*persistent*/ = false,
                              const M_string& = M_string()) {
    return ServiceClient(topic_name(service));
  }

  /// There is one queue a node.
  void setCallbackQueue(CallbackQueueInterface*) {}
  CallbackQueueInterface* getCallbackQueue() const { return getGlobalCallbackQueue(); }

  // timers
  template <class T>
  Timer createTimer(Duration period, void (T::*callback)(const TimerEvent&), T* object,
                    bool oneshot = false, bool autostart = true) const {
    return Timer(
        period, [object, callback](const TimerEvent& event) { (object->*callback)(event); },
        oneshot, autostart);
  }
  template <class T>
  Timer createTimer(Duration period, void (T::*callback)(const TimerEvent&) const, T* object,
                    bool oneshot = false, bool autostart = true) const {
    return Timer(
        period, [object, callback](const TimerEvent& event) { (object->*callback)(event); },
        oneshot, autostart);
  }
  template <class T>
  Timer createTimer(Duration period, void (T::*callback)(const TimerEvent&),
                    const ros_shim::shared_ptr<T>& object, bool oneshot = false,
                    bool autostart = true) const {
    return Timer(
        period, [object, callback](const TimerEvent& event) { (object.get()->*callback)(event); },
        oneshot, autostart);
  }
  template <class T>
  Timer createTimer(Rate rate, void (T::*callback)(const TimerEvent&), T* object,
                    bool oneshot = false, bool autostart = true) const {
    return createTimer(rate.expectedCycleTime(), callback, object, oneshot, autostart);
  }
  Timer createTimer(Duration period, const TimerCallback& callback, bool oneshot = false,
                    bool autostart = true) const {
    return Timer(period, callback, oneshot, autostart);
  }
  Timer createTimer(const TimerOptions& options) const {
    return Timer(options.period, options.callback, options.oneshot, options.autostart);
  }
  template <class T>
  WallTimer createWallTimer(WallDuration period, void (T::*callback)(const WallTimerEvent&),
                            T* object, bool oneshot = false, bool autostart = true) const {
    return WallTimer(
        period, [object, callback](const WallTimerEvent& event) { (object->*callback)(event); },
        oneshot, autostart);
  }
  WallTimer createWallTimer(WallDuration period, const WallTimerCallback& callback,
                            bool oneshot = false, bool autostart = true) const {
    return WallTimer(period, callback, oneshot, autostart);
  }
  template <class T>
  SteadyTimer createSteadyTimer(WallDuration period, void (T::*callback)(const SteadyTimerEvent&),
                                T* object, bool oneshot = false, bool autostart = true) const {
    return SteadyTimer(
        period, [object, callback](const SteadyTimerEvent& event) { (object->*callback)(event); },
        oneshot, autostart);
  }
  SteadyTimer createSteadyTimer(WallDuration period, const SteadyTimerCallback& callback,
                                bool oneshot = false, bool autostart = true) const {
    return SteadyTimer(period, callback, oneshot, autostart);
  }

  // parameters
  template <class T>
  bool getParam(const std::string& name, T& out) const {
    const std::string full = resolveName(name);
    ros_shim::Value value;
    if (!ros_shim::find_parameter(full, value)) return false;
    if (ros_shim::read(value, out)) return true;
    ros_shim::note_wrong_kind(full);
    return false;
  }
  template <class T>
  bool getParamCached(const std::string& name, T& out) const {
    return getParam(name, out);
  }
  template <class T>
  bool param(const std::string& name, T& out, const T& preset) const {
    if (getParam(name, out)) return true;
    out = preset;
    return false;
  }
  template <class T>
  T param(const std::string& name, const T& preset) const {
    T value{};
    return getParam(name, value) ? value : preset;
  }
  template <class T>
  void setParam(const std::string& name, const T& value) const {
    ros_shim::set_parameter(resolveName(name), ros_shim::value_of(value));
  }
  bool hasParam(const std::string& name) const {
    ros_shim::Value value;
    return ros_shim::find_parameter(resolveName(name), value);
  }
  bool deleteParam(const std::string& name) const {
    return ros_shim::delete_parameter(resolveName(name));
  }
  bool getParamNames(std::vector<std::string>& names) const {
    names = ros_shim::parameter_names();
    return true;
  }
  /// From this namespace outward.
  bool searchParam(const std::string& name, std::string& found) const;

 private:
  std::string topic_name(const std::string& topic) const {
    if (!topic.empty() && topic[0] == '~') {
      throw std::invalid_argument(
          "Using ~ names with NodeHandle methods is not allowed: use "
          "NodeHandle(\"~\") for " +
          topic);
    }
    return resolveName(topic);
  }
  template <class P, class Callback>
  Subscriber subscribed(const std::string& topic, std::uint32_t limit, Callback callback) {
    const std::string name = topic_name(topic);
    using M = ros_shim::MessageOf<P>;
    const int number = ros_shim::topic_of(name, message_traits::DataType<M>::value());
    return Subscriber(
        ros_shim::subscribe(number, limit, ros_shim::deliver_to<P>(std::move(callback))), number,
        name);
  }

  template <class Request, class Response, class Callback>
  ServiceServer offered(const std::string& service, Callback callback) {
    const std::string name = topic_name(service);
    const ros_shim::Answer answer = [callback](void* request, void* response) {
      return callback(*static_cast<Request*>(request), *static_cast<Response*>(response));
    };
    const int number =
        ros_shim::offer_service(name, message_traits::DataType<Request>::value(), answer);
    return ServiceServer(number, name);
  }

  std::string space_;
  M_string remappings_;
};

}  // namespace ros

#endif
