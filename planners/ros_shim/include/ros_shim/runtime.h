#ifndef ROS_SHIM_RUNTIME_H
#define ROS_SHIM_RUNTIME_H

#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "ros_shim/pointer.h"

// What the stand-in headers ask of the simulated ROS behind them: names, parameters, topics,
// timers, time and the log. Every function means the node that runs now, where a node matters.
// C++14, as the sources that include it.
namespace ros_shim {

/// A message is going from its publisher to one subscriber.
struct Delivery {
  AnyMessage message;
  std::string publisher;  ///< the node's name
  std::int64_t received_ns;
};

using Deliver = std::function<void(const Delivery&)>;

// time: of the simulation, in nanoseconds
std::int64_t now_ns();
/// The same on a clock that nodes look at: each look finds it a step later.
std::int64_t clock_ns();
/// The node that runs waits until then; others go on. Returns at once where the simulation ends.
void sleep_until_ns(std::int64_t time_ns);

// life
/// Whether the simulation goes on: false once the flight has ended.
bool is_running();
/// As ros::shutdown(): is_running() is false for this node from now on.
void stop_node();
void init_node(const std::string& name);
bool is_node_initialized();
/// Callbacks until the flight ends.
void spin();
/// The callbacks that wait now. A node that asks again while time stands still and nothing has
/// come, waits for the next message, a millisecond at most.
void spin_once();
/// At most so many of the callbacks that wait now; where none does, it waits for the first, at most
/// for `wait_ns`. Returns how many there were.
constexpr int kAllCallbacks = -1;
int call_callbacks(int most, std::int64_t wait_ns);
std::size_t waiting_callbacks();
/// Callbacks run while the node sleeps too (ros::AsyncSpinner).
void spin_in_background(bool on);
/// Callbacks until `condition` holds or that time has come; whether it holds.
bool spin_until(const std::function<bool()>& condition, std::int64_t time_ns);

// names
const std::string& node_name();
/// As roscpp resolves names: "/a" as it is, "~a" below the node's name, "a" below `space`; then
/// the node's remappings. Throws std::invalid_argument for what is no name.
std::string resolved(const std::string& space, const std::string& name);

// topics
/// The number of the topic, which is made where there is none; throws std::logic_error where it
/// carries another type.
int topic_of(const std::string& resolved_name, const char* type);
/// A publisher of the topic comes (+1) or goes (-1).
void count_publishers(int topic, int change);
/// `latched`: subscribers that come later get the topic's last message. Messages never wait
/// at the publisher.
void publish(int topic, AnyMessage message, bool latched);
/// The number of the subscription. Of its messages at most `limit` wait (0: any number); then the
/// oldest is dropped.
int subscribe(int topic, std::uint32_t limit, Deliver deliver);
/// Its callback runs within publish(), whether the node spins or not.
int subscribe_at_once(int topic, Deliver deliver);
void unsubscribe(int subscription);
std::size_t subscriber_count(int topic);
std::size_t publisher_count(int topic);

// services
/// Reads the request, writes the response; false: the call failed.
using Answer = std::function<bool(void* request, void* response)>;
/// The number of the service, which the node that runs offers; throws std::logic_error where there
/// is one of this name.
int offer_service(const std::string& resolved_name, const char* request_type, Answer answer);
void withdraw_service(int service);
bool has_service(const std::string& resolved_name);
/// Until somebody offers it, for `wait_ns` at most (negative: for ever); whether somebody does.
bool wait_for_service(const std::string& resolved_name, std::int64_t wait_ns);
/// Waits until the service has answered; throws std::logic_error where it takes another type. False
/// where nobody offers it, its answer is false, or the flight ends.
bool call_service(const std::string& resolved_name, const char* request_type, void* request,
                  void* response);

// timers
struct TimerTick {
  std::int64_t last_expected_ns, last_real_ns, expected_ns, real_ns;
};
/// The number of a timer that is not running yet.
int make_timer(std::int64_t period_ns, bool once, std::function<void(const TimerTick&)> tick);
void remove_timer(int timer);
void start_timer(int timer);
void stop_timer(int timer);
/// `reset`: the next tick is a period from now; else from the last one.
void set_timer_period(int timer, std::int64_t period_ns, bool reset);
bool has_pending_tick(int timer);

// log
enum class Level { debug, info, warning, error, fatal };
void log(Level level, const std::string& text);
std::string formatted(const char* format, ...) __attribute__((format(printf, 1, 2)));
/// Whether a period of `seconds` has passed since `last_s`, which is then set to now.
bool is_due(double& last_s, double seconds);

/// The folder of a ROS package, as the topics file names it; "" where it does not.
std::string package_folder(const std::string& package);

}  // namespace ros_shim

#endif
