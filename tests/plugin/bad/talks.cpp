#include <cstdio>
#include <cstdlib>
#include <iostream>
#include <stdexcept>
#include <string>
#include <thread>

#include "avoidbench/planner.hpp"

/// Flies to the goal, prints as it goes, sleeps in each call, and ends as it is told to.
class Talks {
 public:
  static constexpr const char* name = "talks";
  static constexpr const char* version = "1.5";
  static constexpr const char* summary = "Prints, sleeps and ends as it is told to.";
  static constexpr std::uint32_t needs = AB_INPUT_DEPTH;
  static constexpr std::uint32_t commands = AB_COMMAND_POSITION;
  static constexpr std::array parameters{
      avoidbench::parameter("sleep_ms", "ms", 0.0, 0.0, 1000.0, "Sleep in each call."),
      avoidbench::parameter("end_s", "s", 1.0, 0.0, 100.0, "When it ends."),
      avoidbench::integer_parameter("print_lines", "", 1, 0, 100000, "Lines printed in each call."),
      avoidbench::choice_parameter("end", "never", "never|crash|hang|terminate", "How it ends.")};

  Talks(const ab_setup& setup, const ab_host& host) : host_(host) {
    const avoidbench::Parameters<Talks> values(setup);
    sleep_ms_ = values.number("sleep_ms");
    end_s_ = values.number("end_s");
    lines_ = static_cast<int>(values.number("print_lines"));
    end_ = values.text("end");
  }

  void reset(const ab_mission& mission) {
    mission_ = mission;
    std::puts("reset");
  }

  std::optional<ab_command> plan(const ab_observation& seen) {
    for (int i = 0; i < lines_; ++i) std::printf("line %d at %.3f s\n", i, seen.state->time_s);
    std::cerr << "to stderr\n";
    host_.log(host_.context, AB_LOG_INFO, "logged");
    if (sleep_ms_ > 0.0) {
      std::this_thread::sleep_for(std::chrono::duration<double, std::milli>(sleep_ms_));
    }
    if (seen.state->time_s >= end_s_) end_here();
    ab_command command = avoidbench::make_command(AB_COMMAND_POSITION);
    for (int i = 0; i < 3; ++i) command.position_world_m[i] = mission_.goal_world_m[i];
    return command;
  }

 private:
  void end_here() const {
    if (end_ == "crash") crash_deep_inside();
    if (end_ == "terminate") std::thread([] { throw std::runtime_error("lost the map"); }).join();
    volatile bool forever = end_ == "hang";
    while (forever) {
    }
  }

  // Not exported: its name is in the library's own symbol table only.
  [[gnu::noinline]] static void crash_deep_inside() {
    volatile int* volatile nowhere = nullptr;
    *nowhere = 1;
  }

  ab_host host_;
  ab_mission mission_{};
  double sleep_ms_ = 0.0, end_s_ = 0.0;
  int lines_ = 0;
  std::string end_;
};

AVOIDBENCH_PLANNER(Talks)
