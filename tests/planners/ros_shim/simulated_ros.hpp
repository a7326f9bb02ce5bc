#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "core.hpp"
#include "ros/ros.h"

namespace ros_shim::test {

/// What the node of a test does; its main() calls it.
inline std::vector<std::function<void()>>& bodies() {
  static std::vector<std::function<void()>> all;
  return all;
}

template <std::size_t index>
int main_of(int, char**) {
  bodies().at(index)();
  return 0;
}

/// A simulated ROS with nodes "a", "b" and "c" whose mains are these functions, from time 10 s.
class SimulatedRos {
 public:
  explicit SimulatedRos(std::vector<std::function<void()>> mains,
                        std::vector<std::pair<std::string, std::string>> remappings = {}) {
    bodies() = std::move(mains);
    auto fresh = std::make_unique<Core>();
    fresh->now_ns = kBegin_ns;
    set_core(std::move(fresh));
    core().write_log = [this](Level, const std::string& text) { lines.push_back(text); };
    int (*const functions[])(int, char**) = {&main_of<0>, &main_of<1>, &main_of<2>};
    const char* const names[] = {"a", "b", "c"};
    for (std::size_t i = 0; i < bodies().size(); ++i) {
      NodeSpec spec;
      spec.name = names[i];
      spec.main = functions[i];
      spec.remappings = remappings;
      add_node(spec);
    }
  }
  ~SimulatedRos() {
    end_nodes();
    set_core(nullptr);
  }
  SimulatedRos(const SimulatedRos&) = delete;
  SimulatedRos& operator=(const SimulatedRos&) = delete;

  /// Until this long after the begin.
  void run_to(double after_s) { advance(kBegin_ns + nanoseconds_of(after_s)); }

  static constexpr std::int64_t kBegin_ns = 10000000000;
  std::vector<std::string> lines;  ///< of the log
};

/// Seconds since the begin.
inline double now_s() {
  return static_cast<double>(ros_shim::now_ns() - SimulatedRos::kBegin_ns) / 1e9;
}

}  // namespace ros_shim::test
