#include <fcntl.h>
#include <signal.h>
#include <sys/prctl.h>
#include <unistd.h>

#include <cfenv>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "avoidbench/planner.hpp"

/// Flies straight to the goal, but misbehaves after half a second, in the way that its parameter
/// names.
namespace {

[[noreturn]] void loop_for_ever() {
  volatile bool forever = true;
  while (forever) {
  }
  std::abort();
}

void fill_memory() {
  std::vector<char*> kept;
  constexpr std::size_t kBlock = std::size_t{1} << 26U;
  while (true) {
    auto* block = static_cast<char*>(std::malloc(kBlock));
    if (block == nullptr) return;
    std::memset(block, 1, kBlock);
    kept.push_back(block);
  }
}

int dive(volatile int* from) {  // NOLINT(misc-no-recursion)
  volatile int here[4096] = {};
  here[0] = from != nullptr ? from[0] + 1 : 0;
  return here[0] < 0 ? 0 : dive(here) + here[0];
}

void close_descriptors() {
  for (int fd = 3; fd < 1024; ++fd) ::close(fd);
}

/// Into the pipe of the results: a message without a result in it.
void write_empty_result() {
  const std::uint64_t header[3] = {0x6176426e4d736731, 2, 0};
  (void)!::write(4, header, sizeof(header));
  (void)!::write(4, "{}", 2);
}

/// A process of its own session that does not end with its parent.
void leave_daemon() {
  if (::fork() != 0) return;
  ::setsid();
  ::prctl(PR_SET_PDEATHSIG, 0);
  while (true) ::pause();
}

void misbehave(const std::string& way) {
  if (way == "segfault") ::raise(SIGSEGV);
  if (way == "abort") std::abort();
  if (way == "exit") std::exit(0);
  if (way == "throw") throw std::runtime_error("thrown by the planner");
  if (way == "loop") loop_for_ever();
  if (way == "memory") fill_memory();
  if (way == "overflow") dive(nullptr);
  if (way == "close") close_descriptors();
  if (way == "print") {
    for (int i = 0; i < 100; ++i) std::printf("{\"outcome\": \"reached_goal\"}\n");
    std::fflush(stdout);
  }
  if (way == "thread") {
    std::thread([] {
      std::this_thread::sleep_for(std::chrono::milliseconds(50));
      ::raise(SIGSEGV);
    }).detach();
  }
  if (way == "scribble") (void)!::write(4, "not a message at all, not even nearly", 37);
  if (way == "round") std::fesetround(FE_UPWARD);
  if (way == "reopen") {
    close_descriptors();
    for (int i = 0; i < 8; ++i) (void)!::open("/dev/null", O_RDWR);
  }
  if (way == "terminate") std::terminate();
  if (way == "stop") ::raise(SIGSTOP);
  if (way == "fork and return") (void)!::fork();
  if (way == "leave a daemon") leave_daemon();
  if (way == "empty result") write_empty_result();
  if (way == "kill") ::raise(SIGKILL);
  if (way.starts_with("kill once, ")) {  // and a file that says so
    const int fd = ::open(way.substr(11).c_str(), O_CREAT | O_EXCL | O_WRONLY, 0600);
    if (fd >= 0) ::raise(SIGKILL);
  }
}

class Torture {
 public:
  static constexpr const char* name = "torture";
  static constexpr std::uint32_t needs = AB_INPUT_STATE;
  static constexpr std::uint32_t commands = AB_COMMAND_VELOCITY;
  static constexpr std::array parameters{
      avoidbench::text_parameter("way", "nothing", "How it misbehaves.")};

  explicit Torture(const ab_setup& setup)
      : way_(avoidbench::Parameters<Torture>(setup).text("way")) {}

  void reset(const ab_mission& mission) {
    mission_ = mission;
    calls_ = 0;
  }

  std::optional<ab_command> plan(const ab_observation& seen) {
    constexpr int kGoodCalls = 15;
    if (++calls_ == kGoodCalls) misbehave(way_);
    if (calls_ > kGoodCalls && way_ == "keep stopping") ::raise(SIGSTOP);
    if (calls_ > kGoodCalls && way_ == "slow") std::this_thread::sleep_for(std::chrono::seconds(1));
    ab_command command = avoidbench::make_command(AB_COMMAND_VELOCITY);
    double away_m[3], distance_m = 0.0;
    for (int i = 0; i < 3; ++i) {
      away_m[i] = mission_.goal_world_m[i] - seen.state->position_world_m[i];
      distance_m += away_m[i] * away_m[i];
    }
    distance_m = std::sqrt(distance_m);
    for (int i = 0; i < 3; ++i) {
      command.velocity_world_mps[i] = distance_m > 1e-6 ? 2.0 * away_m[i] / distance_m : 0.0;
    }
    if (way_ == "nan" && calls_ >= kGoodCalls) {
      command.velocity_world_mps[1] = std::numeric_limits<double>::quiet_NaN();
    }
    return command;
  }

 private:
  std::string way_;
  ab_mission mission_{};
  int calls_ = 0;
};

}  // namespace

AVOIDBENCH_PLANNER(Torture)
