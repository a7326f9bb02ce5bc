#include "core.hpp"

#include <algorithm>

#include "avoidbench/repeatable.hpp"

namespace ros_shim {
namespace {

// A pair of nodes that answer each other without end would never let time go on.
constexpr int kMostTurnsAtOnce = 2000000;
// Of the end: a main whose loops do not ask ros::ok() is thrown out of them.
constexpr int kMostFarewells = 200;

std::unique_ptr<Core> the_core;

void set_now(Core& core, std::int64_t to_ns) {
  core.now_ns = std::max(core.now_ns, to_ns);
  avoidbench::set_clocks_ns(core.now_ns);
}

bool is_ready(const Core& core, const Node& node) {
  if (!node.fibre || node.fibre->is_done()) return false;
  return !core.is_running || node.wake_ns <= core.now_ns ||
         (node.takes_callbacks && !node.queue.empty());
}

/// Nodes that wake first, in the order of their creation; then the oldest callback.
Node* next_ready(Core& core) {
  Node* best = nullptr;
  for (const std::unique_ptr<Node>& node : core.nodes) {
    if (!is_ready(core, *node)) continue;
    if (node->wake_ns <= core.now_ns || !core.is_running) return node.get();
    if (best == nullptr || node->queue.front().order < best->queue.front().order) best = node.get();
  }
  return best;
}

void resume(Core& core, Node& node) {
  Node* before = core.current;
  core.current = &node;
  node.fibre->resume();
  core.current = before;
  if (node.failure) {
    const std::exception_ptr failure = node.failure;
    node.failure = nullptr;
    try {
      std::rethrow_exception(failure);
    } catch (const std::exception& error) {
      throw std::runtime_error("node " + node.full_name + ": " + error.what());
    } catch (...) {
      throw std::runtime_error("node " + node.full_name +
                               ": an exception that is no std::exception");
    }
  }
}

bool may_tick(const Timer& timer) {
  return timer.is_running && !timer.is_waiting && !timer.is_removed;
}

std::int64_t next_event_ns(const Core& core) {
  std::int64_t next = kNever;
  for (const Timer& timer : core.timers) {
    if (may_tick(timer)) next = std::min(next, timer.next_ns);
  }
  for (const std::unique_ptr<Node>& node : core.nodes) {
    if (node->fibre && !node->fibre->is_done()) next = std::min(next, node->wake_ns);
  }
  return next;
}

void run_tick(Core& core, int index) {
  const auto timer_at = [&]() -> Timer& { return core.timers[static_cast<std::size_t>(index)]; };
  Timer& timer = timer_at();
  if (timer.is_removed) return;
  const std::int64_t expected_ns = timer.next_ns;
  const TimerTick tick{timer.last_expected_ns, timer.last_real_ns, expected_ns, core.now_ns};
  const std::shared_ptr<std::function<void(const TimerTick&)>> function = timer.tick;
  timer.last_expected_ns = expected_ns;
  timer.last_real_ns = core.now_ns;
  if (timer.once) timer.is_running = false;
  timer.next_ns = expected_ns + timer.period_ns;  // before the tick, which may change it
  (*function)(tick);
  // No two ticks of a timer wait. One that was kept for more than a period begins anew, as roscpp
  // does. Looked up again: the tick may have made timers.
  Timer& after = timer_at();
  after.is_waiting = false;
  if (after.next_ns + after.period_ns < core.now_ns) after.next_ns = core.now_ns;
}

/// The timers that are due now enter their nodes' queues, the earliest first, then as they were
/// made.
void queue_ticks(Core& core) {
  std::vector<int> due;
  for (std::size_t i = 0; i < core.timers.size(); ++i) {
    if (may_tick(core.timers[i]) && core.timers[i].next_ns <= core.now_ns) {
      due.push_back(static_cast<int>(i));
    }
  }
  std::stable_sort(due.begin(), due.end(), [&](int a, int b) {
    return core.timers[static_cast<std::size_t>(a)].next_ns <
           core.timers[static_cast<std::size_t>(b)].next_ns;
  });
  for (const int index : due) {
    Timer& timer = core.timers[static_cast<std::size_t>(index)];
    if (!timer.node->fibre) {  // the host's side: now, whatever nodes do
      run_tick(core, index);
      continue;
    }
    timer.is_waiting = true;
    Waiting waiting;
    waiting.order = core.next_order++;
    waiting.timer = index;
    timer.node->queue.push_back(waiting);
  }
}

void run_scheduler(Core& core, std::int64_t to_ns) {
  int turns = 0;
  while (true) {
    if (Node* node = next_ready(core)) {
      resume(core, *node);
      if (++turns > kMostTurnsAtOnce) {
        throw std::runtime_error("node " + node->full_name +
                                 " never lets time go on: callbacks at " +
                                 std::to_string(core.now_ns) + " ns follow each other without end");
      }
      continue;
    }
    const std::int64_t next_ns = next_event_ns(core);
    if (next_ns > to_ns) break;
    if (next_ns > core.now_ns) {
      set_now(core, next_ns);
      turns = 0;
    }
    queue_ticks(core);
  }
  set_now(core, to_ns);
}

/// The body of a node's fibre.
void run_main(Node& node) {
  std::vector<std::string> words = node.spec.arguments;
  words.insert(words.begin(), node.spec.name);
  std::vector<char*> arguments;
  arguments.reserve(words.size() + 1);
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  try {
    node.spec.main(static_cast<int>(words.size()), arguments.data());
  } catch (const Unwind&) {
  } catch (...) {
    node.failure = std::current_exception();
  }
}

}  // namespace

Core& core_of_any_thread() {
  if (!the_core) throw std::logic_error("ROS is used before a trial has begun or after its end");
  return *the_core;
}

Core& core() {
  Core& core = core_of_any_thread();
  if (::pthread_equal(core.thread, ::pthread_self()) != 0) return core;
  throw std::logic_error(
      "a thread that a node has started uses ROS: flights would differ from run to run (it may log "
      "and read clocks)");
}

Core& enter_nodes() {
  Core& core = core_of_any_thread();
  core.thread = ::pthread_self();
  return core;
}

bool is_over() { return the_core == nullptr; }

void set_core(std::unique_ptr<Core> fresh, std::int64_t look_ns, std::uint64_t seed) {
  the_core = std::move(fresh);
  if (!the_core) return;
  enter_nodes();
  avoidbench::begin_repeatable_ns(the_core->now_ns, look_ns, seed);
  avoidbench::set_sleep(&sleep_of_thread_ns);
  the_core->nodes.push_back(std::make_unique<Node>());
  Node& host = *the_core->nodes.front();
  host.full_name = "/avoidbench";
  host.is_initialized = true;
  the_core->current = &host;
}

void add_node(const NodeSpec& spec) {
  Core& core = ros_shim::core();
  auto node = std::make_unique<Node>();
  node->spec = spec;
  const std::string space = spec.space.empty() ? "/" : spec.space;
  node->full_name = space == "/" ? "/" + spec.name : space + "/" + spec.name;
  Node* const raw = node.get();
  core.nodes.push_back(std::move(node));
  // Remappings are resolved as the node's own names are.
  Node* before = core.current;
  core.current = raw;
  std::map<std::string, std::string> remappings;
  for (const auto& [from, to] : spec.remappings) remappings[resolved("", from)] = resolved("", to);
  raw->remappings = std::move(remappings);
  core.current = before;
  raw->wake_ns = core.now_ns;
  raw->fibre = std::make_unique<Fibre>([raw] { run_main(*raw); });
}

void advance(std::int64_t to_ns) { run_scheduler(enter_nodes(), to_ns); }

void set_now(std::int64_t to_ns) { set_now(core(), to_ns); }

void end_nodes() {
  Core& core = enter_nodes();
  core.is_running = false;
  for (std::size_t i = core.nodes.size(); i-- > 0;) {
    Node& node = *core.nodes[i];
    while (node.fibre && !node.fibre->is_done() && node.farewells < 2 * kMostFarewells) {
      ++node.farewells;
      try {
        resume(core, node);
      } catch (const std::exception&) {
        // The trial has ended: nobody asks any more.
      }
    }
  }
}

void wait(std::int64_t wake_ns, bool takes_callbacks) {
  Core& core = ros_shim::core();
  Node& node = *core.current;
  if (!node.fibre) return;  // the host's side never waits
  node.wake_ns = wake_ns;
  node.takes_callbacks = takes_callbacks;
  node.fibre->yield();
  node.wake_ns = kNever;
  node.takes_callbacks = false;
  // Not while another exception is on its way: that would end the process.
  if (!core.is_running && node.farewells > kMostFarewells && std::uncaught_exceptions() == 0) {
    throw Unwind{};
  }
}

void run_one_callback(Node& node) {
  Core& core = ros_shim::core();
  const Waiting waiting = std::move(node.queue.front());
  node.queue.pop_front();
  if (waiting.timer >= 0) {
    run_tick(core, waiting.timer);
    return;
  }
  if (waiting.call) {
    answer_call(core, *waiting.call);
    return;
  }
  // Held: the callback may unsubscribe itself.
  const std::shared_ptr<Deliver> deliver =
      core.subscriptions[static_cast<std::size_t>(waiting.subscription)]->deliver;
  if (deliver) (*deliver)(waiting.delivery);
}

}  // namespace ros_shim
