#ifndef ROS_DYNAMIC_RECONFIGURE_SERVER_H
#define ROS_DYNAMIC_RECONFIGURE_SERVER_H

#include <cstdint>
#include <exception>
#include <functional>
#include <type_traits>
#include <utility>

#include "ros/console.h"
#include "ros/node_handle.h"
#include "ros_shim/pointer.h"
#ifdef ROS_SHIM_HAS_BOOST
#if __has_include(<boost/thread/recursive_mutex.hpp>)
#include <boost/thread/recursive_mutex.hpp>
#endif
#endif

namespace dynamic_reconfigure {

/// The values of a .cfg file's parameters: defaults, and what the node's private parameters say.
/// Nobody changes them in flight, so the callback is called once; there are no topics or services.
template <class ConfigType>
class Server {
 public:
  using CallbackType = std::function<void(ConfigType&, std::uint32_t)>;

  explicit Server(const ros::NodeHandle& node = ros::NodeHandle("~")) : node_(node) { begin(); }
  /// With the node's mutex: here all is one thread.
  template <class Mutex,
            class = typename std::enable_if<!std::is_base_of<ros::NodeHandle, Mutex>::value>::type>
  explicit Server(Mutex& /*mutex*/, const ros::NodeHandle& node = ros::NodeHandle("~"))
      : node_(node) {
    begin();
  }
  Server(const Server&) = delete;
  Server& operator=(const Server&) = delete;

  /// Calls it with all values and every bit of the level.
  void setCallback(const CallbackType& callback) {
    callback_ = callback;
    if (!callback_) return;
    try {
      callback_(config_, ~std::uint32_t{0});
    } catch (const std::exception& error) {
      ROS_WARN("Reconfigure callback failed with exception %s", error.what());
    }
    config_.__toServer__(node_);
  }
  void clearCallback() { callback_ = CallbackType(); }

  /// Sets the values without a call of the callback.
  void updateConfig(const ConfigType& config) {
    config_ = config;
    config_.__toServer__(node_);
  }
  void getConfigMax(ConfigType& config) const { config = max_; }
  void getConfigMin(ConfigType& config) const { config = min_; }
  void getConfigDefault(ConfigType& config) const { config = default_; }
  void setConfigMax(const ConfigType& config) { max_ = config; }
  void setConfigMin(const ConfigType& config) { min_ = config; }
  void setConfigDefault(const ConfigType& config) { default_ = config; }

 private:
  void begin() {
    config_.__fromServer__(node_);
    config_.__clamp__();
    config_.__toServer__(node_);
  }

  ros::NodeHandle node_;
  ConfigType min_ = ConfigType::__getMin__(), max_ = ConfigType::__getMax__();
  ConfigType default_ = ConfigType::__getDefault__(), config_ = default_;
  CallbackType callback_;
};

}  // namespace dynamic_reconfigure

#endif
