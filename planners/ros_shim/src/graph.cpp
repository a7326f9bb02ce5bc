#include <sys/syscall.h>
#include <unistd.h>

#include <algorithm>
#include <ctime>
#include <stdexcept>

#include "avoidbench/repeatable.hpp"
#include "core.hpp"

// What ros_shim/runtime.h declares: topics, timers, life of a node.
namespace ros_shim {
namespace {

Topic& topic_at(int topic) { return *core().topics[static_cast<std::size_t>(topic)]; }
Timer& timer_at(int timer) { return core().timers[static_cast<std::size_t>(timer)]; }

void enqueue(Core& core, int index, const Delivery& delivery) {
  Subscription& subscription = *core.subscriptions[static_cast<std::size_t>(index)];
  if (!subscription.deliver) return;
  Node& node = *subscription.node;
  if (!node.fibre) {  // the host's side
    const std::shared_ptr<Deliver> deliver = subscription.deliver;
    (*deliver)(delivery);
    return;
  }
  if (subscription.limit > 0) {
    const auto of_it = [&](const Waiting& waiting) { return waiting.subscription == index; };
    const auto count = std::count_if(node.queue.begin(), node.queue.end(), of_it);
    if (count >= static_cast<std::ptrdiff_t>(subscription.limit)) {
      node.queue.erase(std::find_if(node.queue.begin(), node.queue.end(), of_it));
    }
  }
  Waiting waiting;
  waiting.order = core.next_order++;
  waiting.subscription = index;
  waiting.delivery = delivery;
  node.queue.push_back(std::move(waiting));
}

}  // namespace

// time

std::int64_t now_ns() { return core_of_any_thread().now_ns; }

std::int64_t clock_ns() {
  core_of_any_thread();  // throws where there is no trial
  return avoidbench::look_at_clock_ns();
}

void wait_a_turn(Core& core, std::int64_t wake_ns) {
  Node& node = *core.current;
  const bool in_background = node.background_spinners > 0;
  if (in_background && !node.queue.empty()) {
    run_one_callback(node);
  } else {
    wait(wake_ns, in_background);
  }
}

void sleep_until_ns(std::int64_t time_ns) {
  Core& core = ros_shim::core();
  const auto is_past = [&] { return core.now_ns >= time_ns; };
  while (is_running() && !is_past()) {
    if (!core.current->fibre) return;
    wait_a_turn(core, time_ns);
  }
  // A loop that does not ask ros::ok() is still seen by the scheduler.
  if (!is_running()) wait(time_ns, false);
}

void sleep_for_ns(std::int64_t nanoseconds) {
  if (nanoseconds > 0) sleep_until_ns(now_ns() + nanoseconds);
}

void sleep_of_thread_ns(std::int64_t duration_ns) {
  if (is_over()) return;
  if (::pthread_equal(core_of_any_thread().thread, ::pthread_self()) != 0) {
    return sleep_for_ns(duration_ns);
  }
  std::timespec duration{};
  duration.tv_sec = static_cast<std::time_t>(duration_ns / 1000000000);
  duration.tv_nsec = static_cast<long>(duration_ns % 1000000000);
  ::syscall(SYS_nanosleep, &duration, nullptr);
}

// life

bool is_running() {
  if (is_over()) return false;
  const Core& core = core_of_any_thread();
  return core.is_running && !core.current->is_stopped;
}

void stop_node() { core().current->is_stopped = true; }

void init_node(const std::string&) { core().current->is_initialized = true; }

bool is_node_initialized() { return !is_over() && core().current->is_initialized; }

void spin() {
  spin_until([] { return false; }, kNever);
}

bool spin_until(const std::function<bool()>& condition, std::int64_t time_ns) {
  Core& core = ros_shim::core();
  Node& node = *core.current;
  while (is_running()) {
    if (condition()) return true;
    if (core.now_ns >= time_ns) return false;
    if (!node.queue.empty()) run_one_callback(node);
    // Between any two callbacks, so that nodes take turns in the order in which messages came.
    if (is_running() && !condition()) wait(time_ns, true);
  }
  if (!core.is_running) wait(kNever, false);
  return condition();
}

void spin_once() {
  Core& core = ros_shim::core();
  Node& node = *core.current;
  std::size_t count = node.queue.size();
  if (count > 0) node.polls = 0;
  for (; count > 0 && !node.queue.empty() && is_running(); --count) run_one_callback(node);
  if (node.polled_ns != core.now_ns) {
    node.polled_ns = core.now_ns;
    node.polls = 0;
  }
  // Time stands still until this node waits: one that polls again at the same moment has nothing
  // else to do. A message ends its wait.
  constexpr int kPolls = 2;
  constexpr std::int64_t kPause_ns = 1000000;
  if (++node.polls < kPolls && core.is_running) return;
  node.polls = 0;
  wait(core.now_ns + kPause_ns, true);
}

int call_callbacks(int most, std::int64_t wait_ns) {
  Core& core = ros_shim::core();
  Node& node = *core.current;
  const std::int64_t end_ns = core.now_ns + wait_ns;
  while (is_running() && node.queue.empty() && core.now_ns < end_ns) wait(end_ns, true);
  if (node.queue.empty()) {
    // As of spin_once(): a loop that polls lets time go on.
    spin_once();
    return 0;
  }
  node.polls = 0;
  int called = 0;
  for (auto count = node.queue.size(); count > 0 && !node.queue.empty() && is_running(); --count) {
    if (called == most) break;
    run_one_callback(node);
    ++called;
  }
  return called;
}

std::size_t waiting_callbacks() { return core().current->queue.size(); }

void spin_in_background(bool on) { core().current->background_spinners += on ? 1 : -1; }

// topics

int topic_of(const std::string& name, const char* type) {
  Core& core = ros_shim::core();
  for (std::size_t i = 0; i < core.topics.size(); ++i) {
    if (core.topics[i]->name != name) continue;
    if (core.topics[i]->type != type) {
      throw std::logic_error("topic " + name + " carries " + core.topics[i]->type + ", and " +
                             core.current->full_name + " takes it for " + type);
    }
    return static_cast<int>(i);
  }
  core.topics.push_back(std::make_unique<Topic>());
  core.topics.back()->name = name;
  core.topics.back()->type = type;
  return static_cast<int>(core.topics.size()) - 1;
}

void count_publishers(int topic, int change) {
  // Publishers and timers of static storage outlive the simulation.
  if (!is_over()) topic_at(topic).publishers += change;
}

void publish(int topic, AnyMessage message, bool latched) {
  Core& core = ros_shim::core();
  Topic& to = topic_at(topic);
  const Delivery delivery{std::move(message), core.current->full_name, core.now_ns};
  if (latched) {
    to.latched = delivery.message;
    to.latched_by = delivery.publisher;
  }
  // By index: a callback of the host's side may subscribe.
  for (std::size_t i = 0; i < to.subscriptions.size(); ++i) {
    enqueue(core, to.subscriptions[i], delivery);
  }
}

namespace {

int subscribe_by(Node* node, int topic, std::uint32_t limit, Deliver deliver) {
  Core& core = ros_shim::core();
  auto subscription = std::make_unique<Subscription>();
  subscription->topic = topic;
  subscription->node = node;
  subscription->limit = limit;
  subscription->deliver = std::make_shared<Deliver>(std::move(deliver));
  const int index = static_cast<int>(core.subscriptions.size());
  core.subscriptions.push_back(std::move(subscription));
  Topic& to = topic_at(topic);
  to.subscriptions.push_back(index);
  if (to.latched) enqueue(core, index, {to.latched, to.latched_by, core.now_ns});
  return index;
}

}  // namespace

int subscribe(int topic, std::uint32_t limit, Deliver deliver) {
  return subscribe_by(core().current, topic, limit, std::move(deliver));
}

int subscribe_at_once(int topic, Deliver deliver) {
  return subscribe_by(core().nodes.front().get(), topic, 0, std::move(deliver));
}

void unsubscribe(int subscription) {
  if (is_over()) return;
  Core& core = ros_shim::core();
  Subscription& gone = *core.subscriptions[static_cast<std::size_t>(subscription)];
  gone.deliver.reset();
  std::vector<int>& all = topic_at(gone.topic).subscriptions;
  all.erase(std::remove(all.begin(), all.end(), subscription), all.end());
}

std::size_t subscriber_count(int topic) {
  return is_over() ? 0 : topic_at(topic).subscriptions.size();
}

std::size_t publisher_count(int topic) {
  return is_over() ? 0 : static_cast<std::size_t>(std::max(0, topic_at(topic).publishers));
}

// timers

int make_timer(std::int64_t period_ns, bool once, std::function<void(const TimerTick&)> tick) {
  if (period_ns < 0 || (period_ns == 0 && !once)) {
    throw std::invalid_argument("a timer's period must be positive");
  }
  Core& core = ros_shim::core();
  Timer timer;
  timer.node = core.current;
  timer.period_ns = period_ns;
  timer.once = once;
  timer.tick = std::make_shared<std::function<void(const TimerTick&)>>(std::move(tick));
  core.timers.push_back(std::move(timer));
  return static_cast<int>(core.timers.size()) - 1;
}

void remove_timer(int timer) {
  if (is_over()) return;
  timer_at(timer).is_removed = true;
  timer_at(timer).tick.reset();
}

void start_timer(int timer) {
  Timer& started = timer_at(timer);
  if (started.is_running) return;
  started.is_running = true;
  started.next_ns = core().now_ns + started.period_ns;
}

void stop_timer(int timer) { timer_at(timer).is_running = false; }

void set_timer_period(int timer, std::int64_t period_ns, bool reset) {
  if (period_ns <= 0) throw std::invalid_argument("a timer's period must be positive");
  Timer& changed = timer_at(timer);
  const std::int64_t begun_ns = reset ? core().now_ns : changed.next_ns - changed.period_ns;
  changed.period_ns = period_ns;
  changed.next_ns = std::max(core().now_ns, begun_ns + period_ns);
}

bool has_pending_tick(int timer) {
  return timer_at(timer).is_waiting || timer_at(timer).next_ns <= core().now_ns;
}

}  // namespace ros_shim
