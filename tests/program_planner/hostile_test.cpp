// Programs that break the protocol, die or misbehave: each is an error with a reason, nothing is
// left behind, and the next one is served as ever.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <set>
#include <thread>

#include "base/input_error.hpp"
#include "noisy_inputs.hpp"
#include "plugin/planner_library.hpp"
#include "process/process_tree.hpp"
#include "program_host.hpp"
#include "support/input_error_message.hpp"

namespace avoidbench {
namespace {

using testing::HasSubstr;

constexpr const char* kFine = "";

/// What plan() gives in the first call of a hostile program.
struct Case {
  const char* way;
  const char* error;  ///< a part of it; kFine: none, a command
  bool has_ended = false;
};

void PrintTo(const Case& hostile, std::ostream* out) { *out << hostile.way; }

constexpr Case kInPlan[] = {
    {"none", kFine},
    {"exit", "the program hostile ended with exit code 3", true},
    {"exit_well", "ended with exit code 0", true},
    {"segfault", "ended by signal 11 (Segmentation fault)", true},
    {"abort", "ended by signal 6 (Aborted)", true},
    {"kill", "ended by signal 9 (Killed)", true},
    {"says_and_exits",
     "ended with exit code 4; it printed: first words / the \\x1b[31mlast\\x1b[0m words", true},
    {"close_socket", "has closed its socket"},
    {"close_all", "has closed its socket"},
    {"flood", kFine},
    {"fork_and_exit", "ended with exit code 5", true},
    {"grow", kFine},
    {"shrink", kFine},
    {"scribble", kFine},
    {"scribble_requests", kFine},
    {"command_short", "the command has struct_size 8"},
    {"command_outside", "the command lies outside of the answer"},
    {"body_null", "the command lies outside of the answer"},
    {"points_many", "the trajectory's points, 4294967295 of them, lie outside"},
    {"points_outside", "lie outside of the answer"},
    {"points_wrap", "lie outside of the answer"},
    {"points_are_the_tracks", "the trajectory's points, 2 of them, lie outside of the answer"},
    {"error_in_the_sweeps", "the error lies outside of the answer"},
    {"scribble_sweeps", kFine},
    {"error_outside", "the error lies outside of the answer"},
    {"error_without_end", "the error has no end"},
    {"log_many", "too many lines of log"},
    {"log_outside", "lie outside of the answer"},
    {"log_of_one_text", "a line of the log: its texts together are longer than 4194304 bytes"},
    {"old_answer", "the answer to another request"},
    {"other_kind", "the answer to another request"},
    {"size_huge", "an impossible size"},
    {"size_small", "an impossible size"},
    {"size_zero", "an impossible size"},
    {"word_sequence", "a word that answers another request"},
    {"word_kind", "a word that answers another request"},
    {"half_word", "4 bytes through its socket"},
    {"two_words", "16 bytes through its socket"},
    {"many_words", "16 bytes through its socket"},
    {"garbage", "a word that answers another request"},
};

class HostileProgram : public testing::TestWithParam<Case> {};

std::set<pid_t> children_within(const std::set<pid_t>& before, double seconds) {
  std::set<pid_t> more;
  for (int look = 0; look < static_cast<int>(100.0 * seconds); ++look) {
    more.clear();
    for (const pid_t child : own_children()) {
      if (!before.contains(child)) more.insert(child);
    }
    if (more.empty()) break;
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  return more;
}

TEST_P(HostileProgram, IsAnErrorOfItsCallAndNothingIsLeft) {
  const Case& hostile = GetParam();
  adopt_orphans();  // so that what it leaves is seen
  const std::set<pid_t> before = own_children();
  const ab_planner& table = *program_table(hostile_source(hostile.way));
  KeepingHost host;
  const ab_setup setup{};
  double goals_world_m[] = {1.0, 2.0, 3.0, 4.0, 5.0, 6.0};
  ab_mission mission{};
  mission.struct_size = sizeof mission;
  mission.goal_count = 2;
  mission.goals_world_m = goals_world_m;
  const Seen all(7, 1, 13, 7), unspoilt(7, 1, 13, 7);
  const ab_observation& seen = all.all;
  void* instance = table.create(&host.table, &setup);
  ASSERT_NE(instance, nullptr) << host.error;
  const std::set<pid_t> with_program = own_children();
  for (const bool is_first : {true, false}) {
    ASSERT_EQ(table.reset(instance, &mission), AB_OK) << host.error;
    ab_command command{};
    command.struct_size = sizeof command;
    const ab_status status = table.plan(instance, &seen, &command);
    EXPECT_TRUE(all.is_as(unspoilt)) << "it reached the host's own";
    if (std::string(hostile.error) == kFine) {
      EXPECT_EQ(status, AB_OK) << host.error;
      EXPECT_EQ(command.velocity_world_mps[0], 1.0);
      continue;
    }
    // A fresh program does the same in its first call.
    EXPECT_EQ(status, AB_ERROR);
    EXPECT_THAT(host.error, HasSubstr(hostile.error)) << (is_first ? "first" : "second");
    EXPECT_EQ(program_has_ended(instance), hostile.has_ended);
    EXPECT_EQ(table.plan(instance, &seen, &command), AB_ERROR);
    EXPECT_THAT(host.error, HasSubstr("has ended before"));
  }
  table.destroy(instance);
  if (std::string(hostile.error) != kFine) {
    EXPECT_THAT(children_within(before, 2.0), testing::IsEmpty()) << "something is left behind";
  } else {
    EXPECT_THAT(children_within(with_program, 0.0), testing::IsEmpty());
  }
}

INSTANTIATE_TEST_SUITE_P(Ways, HostileProgram, testing::ValuesIn(kInPlan),
                         [](const auto& way) { return std::string(way.param.way); });

/// Programs that do not become planners.
struct AtStart {
  const char* way;
  const char* error;
};
constexpr AtStart kAtStart[] = {
    {"exit_at_once", "ended with exit code 2"},
    {"words_at_once", "16 bytes through its socket"},
    {"exit_in_hello", "ended with exit code 9"},
    {"no_description", "the description lies outside of the answer"},
    {"refuses", "does not describe itself: not today"},
    {"other_protocol", "it speaks protocol 2, this avoidbench needs protocol 1"},
    {"planner_outside", "the planner's table lies outside"},
    {"planner_before", "the planner's table lies outside"},
    {"planner_at_end", "the planner's table has struct_size 0"},
    {"table_short", "the planner's table has struct_size 88, less than"},
    {"name_outside", "the planner's name lies outside"},
    {"parameters_many", "the parameters, 999 of them, lie outside"},
    {"parameters_too_many", "too many parameters"},
    {"parameters_of_one_text", "a parameter: its texts together are longer than 4194304 bytes"},
};

TEST(HostilePrograms, ThatAreNoPlannersAreRefusedWithAReason) {
  for (const AtStart& hostile : kAtStart) {
    try {
      program_table(hostile_source(hostile.way));
      ADD_FAILURE() << hostile.way << " is taken for a planner";
    } catch (const InputError& error) {
      EXPECT_THAT(error.what(), HasSubstr(hostile.error)) << hostile.way;
    }
  }
  // What a table lacks is found where those of libraries are checked.
  EXPECT_THROW(PlannerLibrary::load(hostile_source("name_null")), InputError);
  try {
    PlannerLibrary::load(hostile_source("name_long"));
    ADD_FAILURE() << "a name of 4 MB is taken";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("1 to 100 characters"));
    EXPECT_LT(std::string(error.what()).size(), 1000U);
  }
}

TEST(HostilePrograms, MayFailInAnyCall) {
  const ab_setup setup{};
  const ab_mission mission{};
  for (const auto& [way, error] : {std::pair{"create_fails", "no memory for it"},
                                   std::pair{"exit_in_create", "ended with exit code 7"}}) {
    KeepingHost host;
    const ab_planner& table = *program_table(hostile_source(way));
    EXPECT_EQ(table.create(&host.table, &setup), nullptr);
    EXPECT_THAT(host.error, HasSubstr(error));
  }
  KeepingHost host;
  const ab_planner& in_reset = *program_table(hostile_source("exit_in_reset"));
  void* instance = in_reset.create(&host.table, &setup);
  ASSERT_NE(instance, nullptr);
  EXPECT_EQ(in_reset.reset(instance, &mission), AB_ERROR);
  EXPECT_TRUE(program_has_ended(instance));
  in_reset.destroy(instance);
  const ab_planner& in_destroy = *program_table(hostile_source("exit_in_destroy"));
  instance = in_destroy.create(&host.table, &setup);
  ASSERT_NE(instance, nullptr);
  in_destroy.destroy(instance);
  instance = in_destroy.create(&host.table, &setup);
  ASSERT_NE(instance, nullptr) << "another one takes over";
  in_destroy.destroy(instance);
}

TEST(HostilePrograms, ThatWriteWhileTheyAreReadHarmNobody) {
  const ab_planner& table = *program_table(hostile_source("race"));
  KeepingHost host;
  const ab_setup setup{};
  const ab_mission mission{};
  ab_state state{};
  state.struct_size = sizeof state;
  ab_observation seen{};
  seen.struct_size = sizeof seen;
  seen.state = &state;
  void* instance = table.create(&host.table, &setup);
  ASSERT_NE(instance, nullptr);
  EXPECT_GE(program_cpu_time_s(instance), 0.0);
  EXPECT_LT(program_cpu_time_s(instance), 0.9);  // from its own beginning
  for (int i = 0; i < 50; ++i) {
    table.reset(instance, &mission);
    ab_command command{};
    command.struct_size = sizeof command;
    const ab_status status = table.plan(instance, &seen, &command);
    EXPECT_TRUE(status == AB_OK || status == AB_ERROR);
  }
  table.destroy(instance);
}

TEST(HostilePrograms, ThatAreNotThereOrMayNotBeStartedAreNamed) {
  const auto error_of = [](const PlannerSource& source) -> std::string {
    return test::message_of([&] { program_table(source); });
  };
  EXPECT_THAT(error_of({program_file_of("nothing"), {}}), HasSubstr("No such file"));
  EXPECT_THAT(error_of({program_file_of("echo"), {"no-such-interpreter", kFileWord}}),
              HasSubstr("there is no program 'no-such-interpreter' on the PATH"));
}

}  // namespace
}  // namespace avoidbench
