// Planners that are programs behind what flies libraries.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <cstring>
#include <fstream>
#include <thread>

#include "base/digest.hpp"
#include "base/input_error.hpp"
#include "conformance/conformance.hpp"
#include "conformance/conformance_flight.hpp"
#include "plugin/planner_instance.hpp"
#include "process/process_tree.hpp"
#include "program_host.hpp"
#include "support/input_error_message.hpp"

namespace avoidbench {
namespace {

namespace fs = std::filesystem;

fs::path own_folder() {
  const std::string test = testing::UnitTest::GetInstance()->current_test_info()->name();
  const fs::path folder = fs::path(testing::TempDir()) / ("program_planner_" + test);
  fs::remove_all(folder);
  fs::create_directories(folder / "sub");
  return folder;
}

std::string problem_of(const PlannerSource& source) {
  return test::message_of([&] { describe_planner(source, 10.0); });
}

TEST(Programs, PassTheConformanceSuite) {
  for (const char* name : {"straight_line", "reactive"}) {
    for (const ConformanceResult& rule : check_conformance_isolated(program_file_of(name))) {
      EXPECT_TRUE(rule.passed) << name << ": " << rule.name << ": " << rule.finding;
    }
  }
}

TEST(Programs, AreDescribedAsTheLibraryOfTheSameSource) {
  const PlannerDescription library =
      describe_planner(fs::path(AVOIDBENCH_BINARY_DIR) / "planners" / "reactive.so", 10.0);
  const fs::path file = program_file_of("reactive");
  const PlannerDescription program = describe_planner(file, 10.0);
  EXPECT_EQ(program.name, library.name);
  EXPECT_EQ(program.needs, library.needs | AB_USES_PROCESSES);
  ASSERT_EQ(program.parameters.size(), library.parameters.size());
  for (std::size_t i = 0; i < program.parameters.size(); ++i) {
    EXPECT_EQ(program.parameters[i].name, library.parameters[i].name);
    EXPECT_EQ(program.parameters[i].doc, library.parameters[i].doc);
    EXPECT_EQ(program.parameters[i].preset, library.parameters[i].preset);
    EXPECT_EQ(program.parameters[i].choices, library.parameters[i].choices);
  }
  EXPECT_TRUE(program.is_program);
  EXPECT_FALSE(library.is_program);
  EXPECT_EQ(program.file_digest, file_digest(file)) << "one file alone is known as before";
}

TEST(Programs, OneServesTrialsAndInstancesAfterEachOther) {
  const ab_planner& table = *program_table(program_file_of("straight_line"));
  KeepingHost host;
  ab_setup setup{};
  setup.struct_size = sizeof setup;
  ab_value value{};
  value.struct_size = sizeof value;
  value.number = 1.0;
  const ab_value* values[] = {&value, &value};
  setup.value_count = 2;
  setup.values = values;
  setup.max_speed_mps = 1.0;
  void* first = table.create(&host.table, &setup);
  ASSERT_NE(first, nullptr) << host.error;
  const std::set<pid_t> one = own_children();
  table.destroy(first);
  first = table.create(&host.table, &setup);
  EXPECT_EQ(own_children(), one) << "the same program serves the next one";
  void* second = table.create(&host.table, &setup);
  ASSERT_NE(second, nullptr);
  EXPECT_EQ(own_children().size(), one.size() + 1) << "beside it another one is needed";
  // Made by a thread that has ended: the program lives on.
  void* third = nullptr;
  std::thread([&] { third = table.create(&host.table, &setup); }).join();
  ASSERT_NE(third, nullptr);
  std::this_thread::sleep_for(std::chrono::milliseconds(50));
  const ab_mission mission{};
  EXPECT_EQ(table.reset(third, &mission), AB_OK) << host.error;
  for (void* instance : {first, second, third}) table.destroy(instance);
}

/// Computing time of the first call of a program.
double first_call_cpu_s(const std::string& way) {
  const PlannerLibrary library = PlannerLibrary::load(hostile_source(way));
  PlannerInstance planner(library, conformance_setup(),
                          resolve_parameters(library.description(), {}));
  EXPECT_EQ(planner.reset({}), "");
  PlannerView view;
  view.q_world_body.setIdentity();
  const PlanResult result = planner.plan(view);
  EXPECT_EQ(result.status, PlanStatus::command) << result.reason;
  EXPECT_GT(result.wall_time_s, 0.045);
  return result.cpu_time_s;
}

TEST(Programs, ComputingTimeOfTheProgramIsTheCalls) {
  EXPECT_GT(first_call_cpu_s("busy"), 0.045);
  EXPECT_LT(first_call_cpu_s("sleepy"), 0.02) << "waiting costs nothing";
}

TEST(Programs, WhatIsNeitherLibraryNorProgramIsRefusedClearly) {
  const fs::path folder = own_folder();
  std::ofstream(folder / "text.txt") << "words\n";
  EXPECT_THAT(problem_of(folder / "text.txt"),
              testing::HasSubstr("is not a shared library (no ELF header); nor a program: those "
                                 "end in .py or are executable (chmod +x)"));
  std::ofstream(folder / "script.sh") << "#!/bin/sh\necho words >&2\nexit 3\n";
  ::chmod((folder / "script.sh").c_str(), 0755);
  EXPECT_THAT(problem_of(folder / "script.sh"),
              testing::HasSubstr("the program script.sh ended with exit code 3; it printed: words "
                                 "before it described itself as a planner"));
  std::ofstream(folder / "sleeps.sh") << "#!/bin/sh\nsleep 1000\n";
  ::chmod((folder / "sleeps.sh").c_str(), 0755);
  try {
    describe_planner(folder / "sleeps.sh", 0.5);
    ADD_FAILURE() << "nothing was thrown";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("did not return within 0.5 s"));
  }
}

/// The echo names two files; of a copy of it in another folder they are there.
TEST(Programs, FilesThatItNamesAreInItsDigest) {
  const fs::path folder = own_folder();
  fs::copy_file(program_file_of("echo"), folder / "echo");
  EXPECT_THAT(problem_of(folder / "echo"), testing::HasSubstr("echo_weights.txt"))
      << "they must be there";
  std::ofstream(folder / "echo_weights.txt") << "1";
  std::ofstream(folder / "sub/other.txt") << "2";
  const PlannerDescription before = describe_planner(folder / "echo");
  ASSERT_EQ(before.files.size(), 3U);
  EXPECT_EQ(before.files[0].digest, file_digest(folder / "echo"));
  EXPECT_EQ(before.files[2].name, "sub/other.txt");
  EXPECT_EQ(before.files[2].digest, file_digest(folder / "sub/other.txt"));
  EXPECT_NE(before.file_digest, before.files[0].digest);
  EXPECT_EQ(digest_now(folder / "echo", before.files), before.file_digest);
  EXPECT_EQ(PlannerLibrary::load(folder / "echo").description().file_digest, before.file_digest);
  std::ofstream(folder / "sub/other.txt") << "3";
  const PlannerDescription after = describe_planner(folder / "echo");
  EXPECT_NE(after.file_digest, before.file_digest);
  EXPECT_EQ(after.file_digest, digest_now(folder / "echo", after.files));
}

TEST(Programs, ACommandNamesTheFileAmongItsWords) {
  const fs::path folder = own_folder();
  std::ofstream(folder / "mine.jl") << "words\n";
  const PlannerSource in_julia = source_of_command({"sh", "-e", "mine.jl", "--fast"}, folder);
  EXPECT_EQ(in_julia.file, folder / "mine.jl");
  EXPECT_EQ(in_julia.command, (std::vector<std::string>{"sh", "-e", kFileWord, "--fast"}));
  const std::vector<std::string> words = words_to_start(in_julia);
  EXPECT_TRUE(words[0].ends_with("/sh")) << words[0];
  EXPECT_EQ(words[2], (folder / "mine.jl").string());
  fs::create_symlink("/bin/sh", folder / "sub/own_sh");
  const PlannerSource relative = source_of_command({"sub/own_sh", "./mine.jl"}, folder);
  EXPECT_EQ(relative.command, (std::vector<std::string>{"./sub/own_sh", kFileWord}));
  EXPECT_EQ(words_to_start(relative)[0], (folder / "sub/own_sh").string());
  const PlannerSource alone = source_of_command({"sh", "-c"}, folder);
  EXPECT_EQ(alone.command, (std::vector<std::string>{kFileWord, "-c"}));
  EXPECT_EQ(alone.file.filename(), "sh");
  EXPECT_THROW(source_of_command({"no-such-program"}, folder), InputError);
}

}  // namespace
}  // namespace avoidbench
