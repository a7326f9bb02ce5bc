// Every bit that the host gives reaches a program, and every bit of its command the host.
#include <gtest/gtest.h>

#include <cstdlib>
#include <cstring>
#include <limits>
#include <random>

#include "base/input_error.hpp"
#include "plugin/planner_library.hpp"
#include "program_host.hpp"
#include "programs/echo_bytes.h"

namespace avoidbench {
namespace {

/// Bytes of all kinds, among them those of NaN and subnormal numbers.
class Noise {
 public:
  explicit Noise(unsigned seed) : draws_(seed) {}
  void fill(void* at, std::size_t count) {
    auto* bytes = static_cast<unsigned char*>(at);
    for (std::size_t i = 0; i < count; ++i) bytes[i] = static_cast<unsigned char>(draws_());
  }
  template <class Struct>
  Struct made() {
    Struct value{};
    fill(&value, sizeof value);
    value.struct_size = sizeof value;
    return value;
  }

 private:
  std::mt19937 draws_;
};

/// An observation with everything, of random bits.
struct Seen {
  Seen(unsigned seed, int depth_count, int width_px, int height_px) {
    Noise noise(seed);
    state = noise.made<ab_state>();
    const auto pixels = static_cast<std::size_t>(width_px * height_px);
    for (int i = 0; i < depth_count; ++i) {
      depths.push_back(noise.made<ab_depth_image>());
      depth_pixels.emplace_back(pixels);
      noise.fill(depth_pixels.back().data(), pixels * sizeof(float));
    }
    for (int i = 0; i < 5; ++i) {
      pictures.push_back(noise.made<ab_picture>());
      pictures.back().channels = i == 4 ? 3 : 1;
      picture_pixels.emplace_back(pixels * pictures.back().channels);
      noise.fill(picture_pixels.back().data(), picture_pixels.back().size());
    }
    for (std::size_t i = 0; i < depths.size(); ++i) {
      depths[i].width_px = width_px;
      depths[i].height_px = height_px;
      depths[i].depth_m = depth_pixels[i].data();
      depth_pointers.push_back(&depths[i]);
    }
    for (std::size_t i = 0; i < pictures.size(); ++i) {
      pictures[i].width_px = width_px;
      pictures[i].height_px = height_px;
      pictures[i].pixels = picture_pixels[i].data();
    }
    for (std::size_t i = 0; i < 2; ++i) {
      pairs.push_back(noise.made<ab_stereo_pair>());
      pairs.back().left = &pictures[2 * i];
      pairs.back().right = &pictures[2 * i + 1];
    }
    for (const ab_stereo_pair& pair : pairs) pair_pointers.push_back(&pair);
    color_pointers.push_back(&pictures[4]);
    imu.resize(7);
    noise.fill(imu.data(), imu.size() * sizeof(ab_imu_sample));
    all.struct_size = sizeof all;
    all.state = &state;
    all.depth_count = static_cast<std::uint32_t>(depth_pointers.size());
    all.depth = depth_pointers.data();
    all.stereo_count = 2;
    all.stereo = pair_pointers.data();
    all.color_count = 1;
    all.color = color_pointers.data();
    all.imu_count = static_cast<std::uint32_t>(imu.size());
    all.imu = imu.data();
    noise.fill(&all.time_s, sizeof all.time_s);
    for (int i = 0; i < 4; ++i) past.push_back(noise.made<ab_state>());
    for (const ab_state& one : past) past_pointers.push_back(&one);
    all.state_count = static_cast<std::uint32_t>(past.size());
    all.states = past_pointers.data();
    tracks.resize(3);
    noise.fill(tracks.data(), tracks.size() * sizeof(ab_track));
    all.track_count = static_cast<std::uint32_t>(tracks.size());
    all.tracks = tracks.data();
    noise.fill(&reference, sizeof reference);
    // Of other seeds there is none.
    all.reference = seed % 2 == 1 ? &reference : nullptr;
    // One sweep, one that met nothing, one that met all.
    for (const auto& [point_count, miss_count] : {std::pair(5U, 3U), {0U, 7U}, {4U, 0U}}) {
      clouds.push_back(noise.made<ab_cloud>());
      clouds.back().point_count = point_count;
      clouds.back().miss_count = miss_count;
      points.emplace_back(point_count);
      noise.fill(points.back().data(), point_count * sizeof(ab_lidar_point));
      misses.emplace_back(3 * miss_count);
      noise.fill(misses.back().data(), misses.back().size() * sizeof(float));
    }
    for (std::size_t i = 0; i < clouds.size(); ++i) {
      clouds[i].points = points[i].data();
      clouds[i].misses_lidar = misses[i].data();
      cloud_pointers.push_back(&clouds[i]);
    }
    all.cloud_count = static_cast<std::uint32_t>(cloud_pointers.size());
    all.clouds = cloud_pointers.data();
    noise.fill(&all.goal_index, sizeof all.goal_index);
    noise.fill(all.goal_world_m, sizeof all.goal_world_m);
  }
  Seen(const Seen&) = delete;
  Seen& operator=(const Seen&) = delete;

  ab_state state{};
  std::vector<ab_depth_image> depths;
  std::vector<std::vector<float>> depth_pixels;
  std::vector<ab_picture> pictures;
  std::vector<std::vector<std::uint8_t>> picture_pixels;
  std::vector<const ab_depth_image*> depth_pointers;
  std::vector<ab_stereo_pair> pairs;
  std::vector<const ab_stereo_pair*> pair_pointers;
  std::vector<const ab_picture*> color_pointers;
  std::vector<ab_imu_sample> imu;
  std::vector<ab_state> past;
  ab_point reference{};
  std::vector<ab_track> tracks;
  std::vector<const ab_state*> past_pointers;
  std::vector<ab_cloud> clouds;
  std::vector<std::vector<ab_lidar_point>> points;
  std::vector<std::vector<float>> misses;
  std::vector<const ab_cloud*> cloud_pointers;
  ab_observation all{};
};

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
