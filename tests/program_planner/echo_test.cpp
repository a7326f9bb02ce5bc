// Every bit that the host gives reaches a program, and every bit of its command the host.
#include <gtest/gtest.h>

#include <cstdlib>
#include <cstring>
#include <limits>

#include "base/input_error.hpp"
#include "noisy_inputs.hpp"
#include "plugin/planner_library.hpp"
#include "program_host.hpp"
#include "programs/echo_bytes.h"

namespace avoidbench {
namespace {

struct NoisySetup {
  explicit NoisySetup(unsigned seed) {
    Noise noise(seed);
    all = noise.made<ab_setup>();
    for (int i = 0; i < 3; ++i) values.push_back(noise.made<ab_value>());
    for (int i = 0; i < 2; ++i) cameras.push_back(noise.made<ab_camera>());
    const char* texts[] = {"", "published", "Grüße\n"};
    for (std::size_t i = 0; i < 3; ++i) {
      values[i].text = texts[i];
      value_pointers.push_back(&values[i]);
    }
    for (const ab_camera& camera : cameras) camera_pointers.push_back(&camera);
    all.value_count = 3;
    all.values = value_pointers.data();
    all.camera_count = 2;
    all.cameras = camera_pointers.data();
    all.depth_camera = &cameras[0];
    for (int i = 0; i < 2; ++i) lidars.push_back(noise.made<ab_lidar>());
    for (const ab_lidar& lidar : lidars) lidar_pointers.push_back(&lidar);
    all.lidar_count = 2;
    all.lidars = lidar_pointers.data();
  }
  std::vector<ab_value> values;
  std::vector<const ab_value*> value_pointers;
  std::vector<ab_camera> cameras;
  std::vector<const ab_camera*> camera_pointers;
  std::vector<ab_lidar> lidars;
  std::vector<const ab_lidar*> lidar_pointers;
  ab_setup all{};
};

struct NoisyMission {
  explicit NoisyMission(Noise& noise) : all(noise.made<ab_mission>()) {
    noise.fill(goals, sizeof goals);
    all.goal_count = 3;
    all.goals_world_m = goals;
  }
  NoisyMission(const NoisyMission&) = delete;
  NoisyMission& operator=(const NoisyMission&) = delete;
  double goals[9]{};
  ab_mission all{};
};

struct Buffer : echo_buffer {
  Buffer() : echo_buffer{nullptr, 0, 0} {}
  ~Buffer() { std::free(bytes); }
  Buffer(const Buffer&) = delete;
  Buffer& operator=(const Buffer&) = delete;
};

/// Asks until the echo comes: the first call after a reset, so each is begun by one.
void expect_echo(const ab_planner& table, void* instance, const NoisySetup& setup,
                 const ab_mission& mission, const Seen& seen) {
  ASSERT_EQ(table.reset(instance, &mission), AB_OK);
  ab_command command{};
  command.struct_size = sizeof command;
  ASSERT_EQ(table.plan(instance, &seen.all, &command), AB_OK);
  Buffer told;
  echo_setup(&told, &setup.all);
  echo_mission(&told, &mission);
  echo_observation(&told, &seen.all);
  double count = 0.0;
  std::memcpy(&count, command.points, sizeof count);
  ASSERT_EQ(count, static_cast<double>(told.size));
  ASSERT_GE(command.point_count * sizeof(ab_point), told.size + sizeof(ab_point));
  EXPECT_EQ(std::memcmp(command.points + 1, told.bytes, told.size), 0);
  ab_command expected{};
  expected.struct_size = sizeof expected;
  echo_command(&expected, &seen.state);
  expected.points = command.points;
  expected.point_count = command.point_count;
  EXPECT_EQ(std::memcmp(&command, &expected, sizeof command), 0);
}

TEST(Echo, EveryBitGoesBothWays) {
  const ab_planner& table = *program_table(program_file_of("echo"));
  KeepingHost host;
  const NoisySetup setup(1);
  void* instance = table.create(&host.table, &setup.all);
  ASSERT_NE(instance, nullptr) << host.error;
  EXPECT_EQ(host.log, std::vector<std::string>{"1 created"});
  Noise noise(2);
  const NoisyMission noisy(noise);
  const ab_mission& mission = noisy.all;
  for (const unsigned seed : {3U, 4U, 5U}) {
    expect_echo(table, instance, setup, mission, Seen(seed, 1, 13, 7));
  }
  table.destroy(instance);
}

TEST(Echo, TheSegmentGrowsWithWhatIsSeen) {
  const ab_planner& table = *program_table(program_file_of("echo"));
  KeepingHost host;
  const NoisySetup setup(1);
  void* instance = table.create(&host.table, &setup.all);
  ASSERT_NE(instance, nullptr) << host.error;
  Noise noise(2);
  const NoisyMission noisy(noise);
  const ab_mission& mission = noisy.all;
  // The echo's own answer has 4 MiB of room.
  for (const int height_px : {1, 240, 1, 480, 480, 3}) {
    expect_echo(table, instance, setup, mission, Seen(7, 2, 320, height_px));
  }
  // 3 images of 1 Mpx each: more than the first segment has.
  const Seen large(8, 3, 1200, 900);
  ASSERT_EQ(table.reset(instance, &mission), AB_OK);
  ab_command command{};
  command.struct_size = sizeof command;
  EXPECT_EQ(table.plan(instance, &large.all, &command), AB_ERROR);
  EXPECT_EQ(host.error, "the answer is longer than the segment's room for it");
  expect_echo(table, instance, setup, mission, Seen(9, 1, 5, 5));
  table.destroy(instance);
}

TEST(Echo, StatusesAndTheirTextsComeBack) {
  const ab_planner& table = *program_table(program_file_of("echo"));
  KeepingHost host;
  const NoisySetup setup(1);
  void* instance = table.create(&host.table, &setup.all);
  ASSERT_NE(instance, nullptr) << host.error;
  const ab_mission mission{};
  ASSERT_EQ(table.reset(instance, &mission), AB_OK);
  const Seen seen(3, 1, 4, 4);
  const auto planned = [&] {
    ab_command command{};
    command.struct_size = sizeof command;
    host.error.clear();
    return table.plan(instance, &seen.all, &command);
  };
  EXPECT_EQ(planned(), AB_OK);
  EXPECT_EQ(planned(), AB_NO_PLAN);
  EXPECT_EQ(host.error, "");
  EXPECT_EQ(planned(), AB_GIVE_UP);
  EXPECT_EQ(host.error, "no way");
  EXPECT_EQ(planned(), AB_ERROR);
  EXPECT_EQ(host.error, "an error of its own");
  EXPECT_FALSE(program_has_ended(instance));
  table.destroy(instance);
}

TEST(Echo, DescribesItself) {
  const std::filesystem::path file = program_file_of("echo");
  const ab_planner& table = *program_table(file);
  EXPECT_STREQ(table.name, "echo");
  EXPECT_STREQ(table.version, "2.5");
  EXPECT_STREQ(table.summary, "Says what it was told.");
  EXPECT_EQ(table.needs, AB_INPUT_STATE | AB_INPUT_DEPTH | AB_INPUT_STEREO | AB_INPUT_COLOR |
                             AB_INPUT_IMU | AB_USES_PROCESSES);
  ASSERT_EQ(table.parameter_count, 3U);
  EXPECT_EQ(table.parameters[0]->lowest, 0.125);
  EXPECT_EQ(table.parameters[0]->highest, 8.5);
  EXPECT_EQ(table.parameters[0]->preset, 1.75);
  EXPECT_STREQ(table.parameters[0]->unit, "1/s");
  EXPECT_EQ(table.parameters[0]->choices, nullptr);
  EXPECT_STREQ(table.parameters[1]->choices, "own|published");
  EXPECT_STREQ(table.parameters[2]->preset_text, "Grüße");
  ASSERT_EQ(table.profile_count, 1U);
  EXPECT_STREQ(table.profiles[0]->word, "published");
  EXPECT_STREQ(table.profiles[0]->numbers[0].name, "gain_hz");
  EXPECT_EQ(table.profiles[0]->numbers[0].number, 3.25);
  const auto* files =
      static_cast<const ab_files*>(table.get_extension(nullptr, AB_FILES_EXTENSION));
  ASSERT_NE(files, nullptr);
  ASSERT_EQ(files->file_count, 2U);
  EXPECT_STREQ(files->files[1], "sub/other.txt");
  EXPECT_EQ(table.get_extension(nullptr, "another"), nullptr);
  EXPECT_EQ(program_table(file), &table) << "it is asked once";
}

}  // namespace
}  // namespace avoidbench
