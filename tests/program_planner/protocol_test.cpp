#include <gtest/gtest.h>

#include <cstddef>

#include "avoidbench/planner.h"
#include "avoidbench/process_protocol.h"

namespace avoidbench {
namespace {

/// docs/process_planners.md has these tables: whoever writes a client goes by them.
struct Field {
  std::size_t found, documented;
};

void expect_offsets(const char* name, std::initializer_list<Field> fields) {
  int index = 0;
  for (const Field& field : fields) {
    EXPECT_EQ(field.found, field.documented) << name << ", field " << index;
    ++index;
  }
}

#define AT(type, field, documented) \
  Field { offsetof(type, field), documented }

TEST(Protocol, StructsOfTheSegmentAreWhereTheyAreDocumented) {
  expect_offsets("ab_process_header",
                 {AT(ab_process_header, magic, 0), AT(ab_process_header, protocol, 8),
                  AT(ab_process_header, abi_version, 12), AT(ab_process_header, segment_bytes, 16),
                  AT(ab_process_header, answer_offset, 24), AT(ab_process_header, answer_bytes, 32),
                  AT(ab_process_header, request_offset, 40), Field{sizeof(ab_process_header), 64}});
  expect_offsets("ab_process_word",
                 {AT(ab_process_word, kind, 4), Field{sizeof(ab_process_word), 8}});
  expect_offsets("ab_process_request",
                 {AT(ab_process_request, kind, 4), AT(ab_process_request, bytes, 8),
                  AT(ab_process_request, body, 16), Field{sizeof(ab_process_request), 32}});
  expect_offsets("ab_process_answer",
                 {AT(ab_process_answer, kind, 4), AT(ab_process_answer, status, 8),
                  AT(ab_process_answer, log_count, 12), AT(ab_process_answer, bytes, 16),
                  AT(ab_process_answer, body, 24), AT(ab_process_answer, error, 32),
                  AT(ab_process_answer, log, 40), Field{sizeof(ab_process_answer), 64}});
  expect_offsets("ab_process_log",
                 {AT(ab_process_log, text, 8), Field{sizeof(ab_process_log), 16}});
  expect_offsets(
      "ab_process_description",
      {AT(ab_process_description, protocol, 4), AT(ab_process_description, planner, 8),
       AT(ab_process_description, files, 16), Field{sizeof(ab_process_description), 24}});
  expect_offsets("ab_files", {AT(ab_files, file_count, 4), AT(ab_files, files, 8),
                              Field{sizeof(ab_files), 16}});
}

TEST(Protocol, StructsOfThePlannerInterfaceAreWhereTheyAreDocumented) {
  expect_offsets("ab_planner",
                 {AT(ab_planner, name, 8), AT(ab_planner, version, 16), AT(ab_planner, summary, 24),
                  AT(ab_planner, needs, 32), AT(ab_planner, commands, 36),
                  AT(ab_planner, parameter_count, 40), AT(ab_planner, parameters, 48),
                  AT(ab_planner, create, 56), AT(ab_planner, profile_count, 96),
                  AT(ab_planner, profiles, 104), AT(ab_planner, least_fov_x_rad, 112),
                  AT(ab_planner, least_fov_y_rad, 120), Field{sizeof(ab_planner), 128}});
  expect_offsets(
      "ab_parameter",
      {AT(ab_parameter, kind, 4), AT(ab_parameter, name, 8), AT(ab_parameter, unit, 16),
       AT(ab_parameter, doc, 24), AT(ab_parameter, lowest, 32), AT(ab_parameter, highest, 40),
       AT(ab_parameter, preset, 48), AT(ab_parameter, choices, 56),
       AT(ab_parameter, preset_text, 64), Field{sizeof(ab_parameter), 72}});
  expect_offsets("ab_profile", {AT(ab_profile, number_count, 4), AT(ab_profile, choice, 8),
                                AT(ab_profile, word, 16), AT(ab_profile, numbers, 24),
                                Field{sizeof(ab_profile), 32}, Field{sizeof(ab_named_number), 16}});
  expect_offsets(
      "ab_setup",
      {AT(ab_setup, value_count, 4), AT(ab_setup, values, 8), AT(ab_setup, max_speed_mps, 16),
       AT(ab_setup, max_acceleration_mps2, 24), AT(ab_setup, max_yaw_rate_radps, 32),
       AT(ab_setup, body_size_m, 40), AT(ab_setup, body_radius_m, 64),
       AT(ab_setup, plan_period_s, 72), AT(ab_setup, gravity_mps2, 80),
       AT(ab_setup, depth_camera, 88), AT(ab_setup, camera_count, 96), AT(ab_setup, cameras, 104),
       AT(ab_setup, lidar_count, 112), AT(ab_setup, lidars, 120), Field{sizeof(ab_setup), 128}});
  expect_offsets("ab_lidar",
                 {AT(ab_lidar, is_deskewed, 4), AT(ab_lidar, position_body_m, 8),
                  AT(ab_lidar, q_body_lidar, 32), AT(ab_lidar, rate_hz, 64),
                  AT(ab_lidar, min_range_m, 72), AT(ab_lidar, max_range_m, 80),
                  AT(ab_lidar, lowest_elevation_rad, 88), AT(ab_lidar, highest_elevation_rad, 96),
                  AT(ab_lidar, shots, 104), Field{sizeof(ab_lidar), 112}});
  expect_offsets("ab_value",
                 {AT(ab_value, number, 8), AT(ab_value, text, 16), Field{sizeof(ab_value), 24}});
  expect_offsets("ab_camera", {AT(ab_camera, width_px, 4), AT(ab_camera, height_px, 8),
                               AT(ab_camera, fx_px, 16), AT(ab_camera, position_body_m, 48),
                               AT(ab_camera, q_body_camera, 72), AT(ab_camera, rate_hz, 104),
                               AT(ab_camera, min_range_m, 112), AT(ab_camera, max_range_m, 120),
                               AT(ab_camera, baseline_m, 128), Field{sizeof(ab_camera), 136}});
  expect_offsets("ab_mission",
                 {AT(ab_mission, seed, 8), AT(ab_mission, start_world_m, 16),
                  AT(ab_mission, start_yaw_rad, 40), AT(ab_mission, goal_world_m, 48),
                  AT(ab_mission, goal_radius_m, 72), AT(ab_mission, time_limit_s, 80),
                  AT(ab_mission, lowest_world_m, 88), AT(ab_mission, highest_world_m, 112),
                  AT(ab_mission, command_latency_s, 136), AT(ab_mission, goal_count, 144),
                  AT(ab_mission, goals_world_m, 152), Field{sizeof(ab_mission), 160}});
}

TEST(Protocol, StructsOfOneCallAreWhereTheyAreDocumented) {
  expect_offsets("ab_state", {AT(ab_state, time_s, 8), AT(ab_state, position_world_m, 16),
                              AT(ab_state, velocity_world_mps, 40), AT(ab_state, q_world_body, 64),
                              AT(ab_state, rates_body_radps, 96), Field{sizeof(ab_state), 120}});
  expect_offsets("ab_observation",
                 {AT(ab_observation, depth_count, 4),    AT(ab_observation, state, 8),
                  AT(ab_observation, depth, 16),         AT(ab_observation, stereo_count, 24),
                  AT(ab_observation, color_count, 28),   AT(ab_observation, stereo, 32),
                  AT(ab_observation, color, 40),         AT(ab_observation, imu_count, 48),
                  AT(ab_observation, imu, 56),           AT(ab_observation, time_s, 64),
                  AT(ab_observation, state_count, 72),   AT(ab_observation, states, 80),
                  AT(ab_observation, reference, 88),     AT(ab_observation, cloud_count, 96),
                  AT(ab_observation, clouds, 104),       AT(ab_observation, goal_index, 112),
                  AT(ab_observation, goal_world_m, 120), AT(ab_observation, track_count, 144),
                  AT(ab_observation, tracks, 152),       AT(ab_observation, wanted, 160),
                  Field{sizeof(ab_observation), 168}});
  expect_offsets("ab_cloud", {AT(ab_cloud, lidar, 4), AT(ab_cloud, time_s, 8),
                              AT(ab_cloud, position_world_m, 16), AT(ab_cloud, q_world_lidar, 40),
                              AT(ab_cloud, point_count, 72), AT(ab_cloud, miss_count, 76),
                              AT(ab_cloud, points, 80), AT(ab_cloud, misses_lidar, 88),
                              Field{sizeof(ab_cloud), 96}, Field{sizeof(ab_lidar_point), 20}});
  expect_offsets("ab_depth_image",
                 {AT(ab_depth_image, width_px, 4), AT(ab_depth_image, height_px, 8),
                  AT(ab_depth_image, time_s, 16), AT(ab_depth_image, fx_px, 24),
                  AT(ab_depth_image, position_world_m, 56), AT(ab_depth_image, q_world_camera, 80),
                  AT(ab_depth_image, depth_m, 112), AT(ab_depth_image, camera, 120),
                  Field{sizeof(ab_depth_image), 128}});
  expect_offsets(
      "ab_picture",
      {AT(ab_picture, width_px, 4), AT(ab_picture, height_px, 8), AT(ab_picture, channels, 12),
       AT(ab_picture, camera, 16), AT(ab_picture, time_s, 24), AT(ab_picture, fx_px, 32),
       AT(ab_picture, position_world_m, 64), AT(ab_picture, q_world_camera, 88),
       AT(ab_picture, pixels, 120), Field{sizeof(ab_picture), 128}});
  expect_offsets("ab_stereo_pair",
                 {AT(ab_stereo_pair, baseline_m, 8), AT(ab_stereo_pair, left, 16),
                  AT(ab_stereo_pair, right, 24), Field{sizeof(ab_stereo_pair), 32},
                  Field{sizeof(ab_imu_sample), 56}});
  expect_offsets(
      "ab_command",
      {AT(ab_command, kind, 4), AT(ab_command, flags, 8), AT(ab_command, point_count, 12),
       AT(ab_command, position_world_m, 16), AT(ab_command, velocity_world_mps, 40),
       AT(ab_command, acceleration_world_mps2, 64), AT(ab_command, yaw_rad, 88),
       AT(ab_command, yaw_rate_radps, 96), AT(ab_command, rates_body_radps, 104),
       AT(ab_command, thrust_mps2, 128), AT(ab_command, points, 136),
       AT(ab_command, horizon_s, 144), Field{sizeof(ab_command), 152},
       Field{sizeof(ab_point), 120}});
}

#undef AT

}  // namespace
}  // namespace avoidbench
