#include "programs/echo_bytes.h"

#include <stdlib.h>
#include <string.h>

static void add(echo_buffer* to, const void* bytes, size_t count) {
  if (to->size + count > to->room) {
    to->room = 2 * (to->size + count);
    to->bytes = (unsigned char*)realloc(to->bytes, to->room);
  }
  if (count > 0) memcpy(to->bytes + to->size, bytes, count);
  to->size += count;
}

void echo_setup(echo_buffer* to, const ab_setup* setup) {
  ab_setup copy = *setup;
  uint32_t i;
  copy.values = NULL;
  copy.cameras = NULL;
  copy.depth_camera = NULL;
  copy.lidars = NULL;
  add(to, &copy, sizeof copy);
  for (i = 0; i < setup->value_count; ++i) {
    ab_value value = *setup->values[i];
    add(to, setup->values[i]->text, strlen(setup->values[i]->text) + 1);
    value.text = NULL;
    add(to, &value, sizeof value);
  }
  for (i = 0; i < setup->camera_count; ++i) add(to, setup->cameras[i], sizeof(ab_camera));
  if (setup->camera_count > 0) add(to, setup->depth_camera, sizeof(ab_camera));
  for (i = 0; i < setup->lidar_count; ++i) add(to, setup->lidars[i], sizeof(ab_lidar));
}

void echo_mission(echo_buffer* to, const ab_mission* mission) {
  ab_mission copy = *mission;
  copy.goals_world_m = NULL;
  add(to, &copy, sizeof copy);
  add(to, mission->goals_world_m, 3 * mission->goal_count * sizeof(double));
}

static void add_picture(echo_buffer* to, const ab_picture* picture) {
  ab_picture copy = *picture;
  copy.pixels = NULL;
  add(to, &copy, sizeof copy);
  add(to, picture->pixels,
      (size_t)picture->width_px * (size_t)picture->height_px * picture->channels);
}

void echo_observation(echo_buffer* to, const ab_observation* seen) {
  uint32_t i;
  add(to, seen->state, sizeof(ab_state));
  for (i = 0; i < seen->depth_count; ++i) {
    ab_depth_image copy = *seen->depth[i];
    copy.depth_m = NULL;
    add(to, &copy, sizeof copy);
    add(to, seen->depth[i]->depth_m,
        sizeof(float) * (size_t)copy.width_px * (size_t)copy.height_px);
  }
  for (i = 0; i < seen->stereo_count; ++i) {
    add(to, &seen->stereo[i]->baseline_m, sizeof(double));
    add_picture(to, seen->stereo[i]->left);
    add_picture(to, seen->stereo[i]->right);
  }
  for (i = 0; i < seen->color_count; ++i) add_picture(to, seen->color[i]);
  add(to, seen->imu, seen->imu_count * sizeof(ab_imu_sample));
  add(to, &seen->time_s, sizeof seen->time_s);
  for (i = 0; i < seen->state_count; ++i) add(to, seen->states[i], sizeof(ab_state));
  if (seen->reference != NULL) add(to, seen->reference, sizeof(ab_point));
  for (i = 0; i < seen->cloud_count; ++i) {
    ab_cloud copy = *seen->clouds[i];
    copy.points = NULL;
    copy.misses_lidar = NULL;
    add(to, &copy, sizeof copy);
    add(to, seen->clouds[i]->points, copy.point_count * sizeof(ab_lidar_point));
    add(to, seen->clouds[i]->misses_lidar, 3u * copy.miss_count * sizeof(float));
  }
  add(to, &seen->goal_index, sizeof seen->goal_index);
  add(to, seen->goal_world_m, sizeof seen->goal_world_m);
  add(to, seen->tracks, seen->track_count * sizeof(ab_track));
  if (seen->wanted != NULL) {
    ab_command copy = *seen->wanted;
    copy.points = NULL;
    add(to, &copy, sizeof copy);
    add(to, seen->wanted->points, copy.point_count * sizeof(ab_point));
  }
}

void echo_command(ab_command* command, const ab_state* state) {
  command->kind = AB_COMMAND_TRAJECTORY;
  command->flags = 0x5a5a5a5au;
  memcpy(command->position_world_m, state->position_world_m, sizeof state->position_world_m);
  memcpy(command->velocity_world_mps, state->velocity_world_mps, sizeof state->velocity_world_mps);
  memcpy(command->acceleration_world_mps2, &state->q_world_body[1], 3 * sizeof(double));
  memcpy(command->rates_body_radps, state->rates_body_radps, sizeof state->rates_body_radps);
  memcpy(&command->yaw_rad, &state->time_s, sizeof(double));
  memcpy(&command->yaw_rate_radps, &state->q_world_body[0], sizeof(double));
  memcpy(&command->thrust_mps2, &state->position_world_m[2], sizeof(double));
  memcpy(&command->horizon_s, &state->velocity_world_mps[1], sizeof(double));
}
