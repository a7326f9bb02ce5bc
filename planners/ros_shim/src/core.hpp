#pragma once

#include <pthread.h>

#include <cstdint>
#include <deque>
#include <exception>
#include <functional>
#include <limits>
#include <map>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "fibre.hpp"
#include "ros_shim/runtime.h"
#include "ros_shim/value.h"

/// The simulated ROS: nodes, topics, timers, parameters and one clock. There is one a copy of the
/// library (see loader.cpp), so one a trial.
namespace ros_shim {

constexpr std::int64_t kNever = std::numeric_limits<std::int64_t>::max();

struct NodeSpec {
  std::string name, space;  ///< "planner", "/" or "/group"
  int (*main)(int, char**) = nullptr;
  std::vector<std::pair<std::string, std::string>> remappings;
  std::vector<std::string> arguments;
};

struct Node;

/// A call of a service on its way.
struct ServiceCall {
  std::shared_ptr<Answer> answer;
  void *request = nullptr, *response = nullptr;
  Node* caller = nullptr;  ///< null: gone
  bool is_answered = false, is_good = false;
};

/// A callback that waits in a node's queue: of a subscription, a timer or a service.
struct Waiting {
  std::uint64_t order = 0;
  int subscription = -1, timer = -1;
  Delivery delivery;
  std::shared_ptr<ServiceCall> call;
};

struct Node {
  NodeSpec spec;
  std::string full_name;  ///< "/planner"
  std::map<std::string, std::string> remappings;
  std::deque<Waiting> queue;
  std::unique_ptr<Fibre> fibre;  ///< null: the host's side, whose callbacks are called at once
  bool is_initialized = false, is_stopped = false, takes_callbacks = false;
  int background_spinners = 0;
  std::int64_t wake_ns = 0;
  std::int64_t polled_ns = -1;
  int polls = 0;      ///< of an empty queue, at polled_ns
  int farewells = 0;  ///< times it was resumed since the end
  std::exception_ptr failure;
};

struct Subscription {
  int topic = -1;
  Node* node = nullptr;
  std::uint32_t limit = 0;
  std::shared_ptr<Deliver> deliver;  ///< null once unsubscribed
};

struct Topic {
  std::string name, type;
  int publishers = 0;
  std::vector<int> subscriptions;
  AnyMessage latched;
  std::string latched_by;
};

struct Service {
  std::string name, request_type;
  Node* node = nullptr;
  std::shared_ptr<Answer> answer;  ///< null once withdrawn
};

struct Timer {
  Node* node = nullptr;
  std::int64_t period_ns = 0, next_ns = 0, last_expected_ns = 0, last_real_ns = 0;
  bool once = false, is_running = false, is_waiting = false, is_removed = false;
  std::shared_ptr<std::function<void(const TimerTick&)>> tick;
};

struct Core {
  std::int64_t now_ns = 0;
  pthread_t thread{};  ///< that nodes run on
  bool is_running = true;
  std::uint64_t next_order = 0;
  std::vector<std::unique_ptr<Node>> nodes;  ///< the first is the host's side
  Node* current = nullptr;
  std::vector<std::unique_ptr<Topic>> topics;
  std::vector<std::unique_ptr<Subscription>> subscriptions;
  std::vector<std::unique_ptr<Service>> services;
  std::vector<Timer> timers;
  std::map<std::string, Value> parameters;  ///< leaves by full name
  std::map<std::string, std::string> packages;
  std::function<void(Level, const std::string&)> write_log;
};

/// This copy's core. Throws std::logic_error if there is none, and on a thread that a node has
/// started: what such a thread does would come at another time in each run.
Core& core();
/// The same for what such threads may do: log and read clocks.
Core& core_of_any_thread();
/// Nodes run on this thread from now on.
Core& enter_nodes();
/// Whether there is no core: before a trial and after it.
bool is_over();
/// Sets the core of a new trial; null ends it. Clocks stand at its time, and each look at them
/// takes `look_ns`.
void set_core(std::unique_ptr<Core> fresh, std::int64_t look_ns = 1000, std::uint64_t seed = 0);

/// Adds a node whose main begins when the clock next advances.
void add_node(const NodeSpec& spec);
/// Runs everything that is due up to and at `to_ns`, in the order of time, then of creation. Throws
/// what a node threw, with its name.
void advance(std::int64_t to_ns);
/// What C's and C++'s sleeps do: a node lets the others go on, as by ros::Duration::sleep(). Of
/// threads that a node has started the scheduler knows nothing: they sleep by the wall's clock.
void sleep_of_thread_ns(std::int64_t duration_ns);
/// Time alone: what is due waits for the next advance().
void set_now(std::int64_t to_ns);
/// Ends all nodes: ros::ok() is false and every wait ends, so that their mains return. Those that
/// do not are unwound.
void end_nodes();

/// Of the node that runs: back to the scheduler until that time, or the first callback where it
/// takes them.
void wait(std::int64_t wake_ns, bool takes_callbacks);
/// As wait(), for one turn: where the node spins in the background its callbacks run meanwhile.
void wait_a_turn(Core& core, std::int64_t wake_ns);
/// The first callback in the node's queue.
void run_one_callback(Node& node);
void answer_call(Core& core, ServiceCall& call);

/// Thrown through a node that does not end by itself.
struct Unwind {};

}  // namespace ros_shim
