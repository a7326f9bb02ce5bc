#include "plugin/planner_table.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <thread>

#include "avoidbench/planner.hpp"
#include "base/digest.hpp"
#include "base/input_error.hpp"
#include "conformance/conformance_flight.hpp"
#include "plugin/planner_instance.hpp"

namespace avoidbench {
namespace {

/// Flies up at the speed that it is given.
class Riser {
 public:
  struct Settings {
    double speed_mps = 0.0;
  };
  static constexpr const char* name = "riser";
  static constexpr const char* version = "3";
  static constexpr const char* summary = "Flies up.";
  static constexpr std::uint32_t needs = AB_SEES_STATE;
  static constexpr std::uint32_t commands = AB_COMMAND_VELOCITY;
  static constexpr std::array parameters{
      parameter<&Settings::speed_mps>("speed_mps", "m/s", 1.0, 0.0, 5.0, "Upward.")};

  explicit Riser(const ab_setup& setup) : settings_(settings_from(parameters, setup)) {}
  void reset(const ab_mission&) {}
  std::optional<ab_command> plan(const ab_observation&) const {
    return make_velocity_command({0.0, 0.0, settings_.speed_mps}, 0.0);
  }

 private:
  Settings settings_;
};

/// Processor time of this thread.
double thread_time_s() {
  std::timespec time{};
  ::clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

/// A file of its own for each test, which is no library.
std::filesystem::path source_file() {
  const std::string test = testing::UnitTest::GetInstance()->current_test_info()->name();
  std::filesystem::path file = std::filesystem::path(testing::TempDir()) / (test + ".py");
  std::ofstream(file) << "class Riser: pass\n";
  return file;
}

TEST(OwnPlanners, AreFoundDescribedAndFlownAsLibrariesAre) {
  const std::filesystem::path file = source_file();
  EXPECT_THROW(describe_planner(file), InputError) << "it is no library";
  register_own_planner(file, detail::Table<Riser>::value);
  EXPECT_EQ(find_planner(file.string(), "."), file);
  const PlannerDescription description = describe_planner(file);
  EXPECT_EQ(description.name, "riser");
  EXPECT_EQ(description.version, "3");
  EXPECT_EQ(description.file, file);
  EXPECT_EQ(description.file_digest, file_digest(file));
  const PlannerLibrary library = PlannerLibrary::load(file.parent_path() / "." / file.filename());
  PlannerInstance planner(library, conformance_setup(),
                          resolve_parameters(description, {{"speed_mps", {2.5, ""}}}));
  EXPECT_EQ(planner.reset({}), "");
  PlannerView view;
  view.q_world_body.setIdentity();
  EXPECT_EQ(planner.plan(view).command.velocity_world_mps[2], 2.5);
}

class Named : public Riser {
 public:
  using Riser::Riser;
  static constexpr std::array files{"weights.bin"};
};

TEST(OwnPlanners, FilesThatAClassNamesAreInItsDigest) {
  const std::filesystem::path file = source_file();
  const std::filesystem::path weights = file.parent_path() / "weights.bin";
  std::filesystem::remove(weights);
  register_own_planner(file, detail::Table<Named>::value);
  EXPECT_THROW(describe_planner(file), InputError) << "they must be there";
  std::ofstream(weights) << "1";
  const PlannerDescription before = describe_planner(file);
  ASSERT_EQ(before.files.size(), 2U);
  EXPECT_EQ(before.files[0].digest, file_digest(file));
  EXPECT_EQ(before.files[1].name, "weights.bin");
  EXPECT_NE(before.file_digest, file_digest(file));
  std::ofstream(weights) << "2";
  EXPECT_NE(describe_planner(file).file_digest, before.file_digest);
}

TEST(OwnPlanners, ThreadsOfTheHostAreNotTheirComputingTime) {
  constexpr double kBusy_s = 0.1;
  std::atomic<bool> may_begin = false;
  std::thread host([&may_begin] {
    may_begin.wait(false);
    while (thread_time_s() < kBusy_s) {
    }
  });
  const std::filesystem::path file = source_file();
  register_own_planner(file, detail::Table<Riser>::value);
  const PlannerLibrary library = PlannerLibrary::load(file);
  PlannerInstance planner(library, conformance_setup(),
                          resolve_parameters(library.description(), {}));
  planner.reset({});
  PlannerView view;
  view.q_world_body.setIdentity();
  planner.plan(view);
  may_begin = true;
  may_begin.notify_one();
  std::this_thread::sleep_for(std::chrono::milliseconds(50));  // so that it has computed something
  EXPECT_LT(planner.plan(view).cpu_time_s, 0.01);
  host.join();
}

TEST(OwnPlanners, TablesThatAreNotSoundAreRefusedAndNotKept) {
  const std::filesystem::path file = source_file();
  ab_planner broken = detail::Table<Riser>::value;
  broken.plan = nullptr;
  try {
    register_own_planner(file, broken);
    ADD_FAILURE() << "nothing was thrown";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr(file.string() + ": "));
  }
  EXPECT_EQ(own_planner(file), nullptr);
}

}  // namespace
}  // namespace avoidbench
