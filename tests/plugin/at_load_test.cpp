#include <dirent.h>
#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/file.h>
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <thread>

#include "plugin/bad_planners.hpp"
#include "support/input_error_message.hpp"

/// Libraries that do harm as soon as they are loaded: whoever describes them comes to none.
namespace avoidbench {
namespace {

using testing::AllOf;
using testing::HasSubstr;

constexpr double kLimit_s = 1.0;

std::filesystem::path at_load_planner(const std::string& way) {
  return std::filesystem::path(AT_LOAD_PLANNERS) / (way + ".so");
}

/// What describing the planner says; "" if it describes itself as it is.
std::string description_error(const std::string& way, double limit_s = kLimit_s) {
  return test::message_of([&] {
    const PlannerDescription planner = describe_planner(at_load_planner(way), limit_s);
    EXPECT_EQ(planner.name, "honest");
    EXPECT_EQ(planner.summary, "Flies along x.");
    EXPECT_EQ(planner.needs, AB_INPUT_STATE | AB_INPUT_DEPTH);
    EXPECT_EQ(planner.file, at_load_planner(way));
  });
}

/// Processes that have the planner's library mapped.
std::vector<std::string> processes_with(const std::string& way) {
  std::vector<std::string> found;
  for (const auto& entry : std::filesystem::directory_iterator("/proc")) {
    const std::string pid = entry.path().filename().string();
    if (pid.find_first_not_of("0123456789") != std::string::npos) continue;
    std::ifstream maps(entry.path() / "maps");
    for (std::string line; std::getline(maps, line);) {
      if (line.find(at_load_planner(way).string()) == std::string::npos) continue;
      found.push_back(pid);
      break;
    }
  }
  return found;
}

std::size_t open_descriptors() {
  const std::filesystem::directory_iterator entries("/proc/self/fd");
  return static_cast<std::size_t>(std::distance(begin(entries), end(entries)));
}

/// One at a time, though each is a process of its own: they count the processes that have a planner
/// loaded, and share the planners.
class AtLoad : public testing::Test {
 protected:
  void SetUp() override {
    lock_ = ::open(AT_LOAD_PLANNERS "/lock", O_CREAT | O_RDWR | O_CLOEXEC, 0600);
    ASSERT_GE(lock_, 0);
    ASSERT_EQ(::flock(lock_, LOCK_EX), 0);
  }
  void TearDown() override { ::close(lock_); }

 private:
  int lock_ = -1;
};

TEST_F(AtLoad, DescriptionsComeWhole) {
  const PlannerDescription loaded = PlannerLibrary::load(C_PLANNER).description();
  const PlannerDescription told = describe_planner(C_PLANNER, 30.0);
  EXPECT_EQ(told.name, loaded.name);
  EXPECT_EQ(told.version, loaded.version);
  EXPECT_EQ(told.summary, loaded.summary);
  EXPECT_EQ(told.needs, loaded.needs);
  EXPECT_EQ(told.commands, loaded.commands);
  EXPECT_EQ(told.file, loaded.file);
  EXPECT_EQ(told.file_digest, loaded.file_digest);
  ASSERT_EQ(told.parameters.size(), loaded.parameters.size());
  for (std::size_t i = 0; i < told.parameters.size(); ++i) {
    const ParameterDef &a = told.parameters[i], &b = loaded.parameters[i];
    EXPECT_EQ(std::tie(a.name, a.unit, a.doc, a.kind, a.lowest, a.highest, a.preset, a.choices,
                       a.preset_text),
              std::tie(b.name, b.unit, b.doc, b.kind, b.lowest, b.highest, b.preset, b.choices,
                       b.preset_text));
  }
}

TEST_F(AtLoad, EndsAreNamed) {
  EXPECT_THAT(description_error("exit"),
              HasSubstr("at_load/exit.so: ended the process with code 0 while it was loaded"));
  EXPECT_THAT(description_error("exit_at_once"),
              HasSubstr("ended the process with code 0 while it was loaded"));
  EXPECT_THAT(description_error("abort"),
              AllOf(HasSubstr("crashed by signal 6 (Aborted) while it was loaded"),
                    HasSubstr("it printed: no model?[31m.onnx")));
  EXPECT_THAT(description_error("segfault"), HasSubstr("crashed by signal 11"));
  EXPECT_THAT(description_error("throw"), HasSubstr("thrown at load"));
  EXPECT_THAT(description_error("end_of_thread"), HasSubstr("while it was loaded"));
  // In a sandbox it can't, and waits for what it believes to have done.
  EXPECT_THAT(description_error("kill_parent"),
              HasSubstr(sandbox_support().has_seccomp ? "did not return within"
                                                      : "ended the process that watches it"));
}

TEST_F(AtLoad, NoneTakesLongerThanItsLimit) {
  for (const char* way : {"sleep", "spin", "ignore", "stop", "table_spin"}) {
    // Nothing in a sandbox stops itself.
    if (std::string_view(way) == "stop" && sandbox_support().has_seccomp) continue;
    const auto began = std::chrono::steady_clock::now();
    EXPECT_THAT(description_error(way, 0.3),
                HasSubstr("did not return within 0.3 s while it was loaded"))
        << way;
    const std::chrono::duration<double> took = std::chrono::steady_clock::now() - began;
    EXPECT_LT(took.count(), 5.0) << way;
    EXPECT_TRUE(processes_with(way).empty()) << way;
  }
  EXPECT_THAT(description_error("stop_parent", 0.3), HasSubstr("did not return within 0.3 s"));
  EXPECT_TRUE(processes_with("stop_parent").empty());
}

TEST_F(AtLoad, NothingStaysBehind) {
  for (const char* way :
       {"fork", "fork_and_return", "daemon", "hopping", "swarm", "thread", "locale", "print"}) {
    const std::vector<std::string> before = processes_with(way);
    EXPECT_EQ(description_error(way, 30.0), "") << way;
    EXPECT_EQ(processes_with(way), before) << way;
  }
  EXPECT_EQ(::waitpid(-1, nullptr, WNOHANG), -1) << "a child of ours is left";
}

TEST_F(AtLoad, NothingOfOursIsTouched) {
  const std::filesystem::path folder = std::filesystem::current_path();
  int ends[2];
  ASSERT_EQ(::pipe2(ends, O_NONBLOCK), 0);
  const auto file = std::filesystem::path(testing::TempDir()) / "avoidbench_not_scribbled";
  const int written = ::open(file.c_str(), O_CREAT | O_TRUNC | O_RDWR, 0600);
  ASSERT_GE(written, 0);
  for (const char* way :
       {"chdir", "close_all", "scribble", "destructor_sleep", "destructor_abort"}) {
    const std::size_t before = open_descriptors();
    EXPECT_EQ(description_error(way, 30.0), "") << way;
    EXPECT_EQ(open_descriptors(), before) << way;
  }
  EXPECT_EQ(std::filesystem::current_path(), folder);
  char byte = 0;
  EXPECT_EQ(::read(ends[0], &byte, 1), -1) << "a planner wrote to our pipe";
  EXPECT_EQ(std::filesystem::file_size(file), 0U);
  for (const int fd : {ends[0], ends[1], written}) ::close(fd);
}

TEST_F(AtLoad, TheWatcherGoesWithItsParent) {
  const pid_t parent = ::fork();
  if (parent == 0) {
    description_error("sleep", 600.0);
    ::_exit(0);
  }
  const auto wait_for = [](bool loaded) {
    for (int i = 0; i < 1000 && processes_with("sleep").empty() == loaded; ++i) ::usleep(10'000);
    return processes_with("sleep").empty() != loaded;
  };
  EXPECT_TRUE(wait_for(true));
  ::kill(parent, SIGKILL);
  ::waitpid(parent, nullptr, 0);
  EXPECT_TRUE(wait_for(false));
}

TEST_F(AtLoad, IsAskedOnceAProcess) {
  const auto folder = std::filesystem::path(testing::TempDir()) / "avoidbench_asked_once";
  std::filesystem::remove_all(folder);
  std::filesystem::create_directories(folder);
  const auto file = folder / "planner.so";
  std::filesystem::copy_file(at_load_planner("chdir"), file);
  EXPECT_EQ(describe_planner(file).name, "honest");
  const auto began = std::chrono::steady_clock::now();
  for (int i = 0; i < 50; ++i) EXPECT_EQ(describe_planner(file).file, file);
  const std::chrono::duration<double> took = std::chrono::steady_clock::now() - began;
  RecordProperty("fifty_times_s", std::to_string(took.count()));
  std::filesystem::remove(file);
  std::filesystem::copy_file(at_load_planner("exit"), file);  // the same name, other bytes
  EXPECT_THROW(describe_planner(file), InputError);
}

TEST_F(AtLoad, TheLimitIsOfTheEnvironment) {
  setenv("AVOIDBENCH_LOAD_LIMIT_S", "0.2", 1);
  try {
    describe_planner(at_load_planner("sleep"));
    ADD_FAILURE();
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("within 0.2 s while it was loaded (AVOIDBENCH_LOAD_LIMIT_S "
                                        "sets another limit)"));
  }
  for (const char* bad : {"", "ten", "-1", "nan", "1e9", "5s"}) {
    setenv("AVOIDBENCH_LOAD_LIMIT_S", bad, 1);
    EXPECT_THROW(describe_planner(at_load_planner("table_spin")), InputError) << bad;
  }
  unsetenv("AVOIDBENCH_LOAD_LIMIT_S");
}

TEST_F(AtLoad, LoadingIsACallOfTheWatchdogsClock) {
  CallClock clock;
  std::atomic<bool> is_over = false;
  double longest_s = 0.0;
  std::jthread watcher([&] {
    while (!is_over) {
      longest_s = std::max(longest_s, clock.running_s());
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
  });
  const PlannerLibrary library = PlannerLibrary::load(at_load_planner("slow"), &clock);
  EXPECT_EQ(clock.running_s(), 0.0);
  is_over = true;
  watcher.join();
  EXPECT_GT(longest_s, 0.1);
}

}  // namespace
}  // namespace avoidbench
