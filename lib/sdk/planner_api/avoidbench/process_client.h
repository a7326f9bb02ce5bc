/* Makes a program of a planner's table, in C99 or C++, for Linux:
 *
 *   #include <avoidbench/process_client.h>
 *   int main(void) { return avoidbench_serve(avoidbench_planner_v1(AVOIDBENCH_ABI_VERSION)); }
 *
 * linked with the planner's source, be it in C, C++ or what else can export the symbol. The program
 * is then named in a sweep in place of a library: `plugin: ./my_planner`. What it and avoidbench
 * say to each other is in process_protocol.h.
 *
 * SPDX-License-Identifier: MIT
 * This header may be used in and linked with planners under any licence, closed ones too.
 */
#ifndef AVOIDBENCH_PROCESS_CLIENT_H
#define AVOIDBENCH_PROCESS_CLIENT_H

#include <errno.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <unistd.h>

#include "avoidbench/planner.h"
#include "avoidbench/process_protocol.h"

#ifdef __cplusplus
extern "C" {
#endif

#define AB_CLIENT_MOST_LOG 64u
#define AB_CLIENT_TEXT_BYTES 1024u

typedef struct ab_client {
  const ab_planner* planner;
  void* instance;
  ab_host host;
  int socket_fd, segment_fd;
  unsigned char* segment;
  uint64_t segment_bytes;
  uint64_t answer_offset, answer_bytes, request_offset;
  uint64_t used; /* of the answer */
  int is_full;   /* the answer does not fit */
  char error[AB_CLIENT_TEXT_BYTES];
  int has_error;
  char log[AB_CLIENT_MOST_LOG][AB_CLIENT_TEXT_BYTES];
  int32_t log_levels[AB_CLIENT_MOST_LOG];
  uint32_t log_count;
  void* scratch; /* the structs of the request as C has them: pointers instead of offsets */
  size_t scratch_bytes, scratch_used;
} ab_client;

static void ab_client_copy_text(char* to, const char* from) {
  strncpy(to, from != NULL ? from : "", AB_CLIENT_TEXT_BYTES - 1);
  to[AB_CLIENT_TEXT_BYTES - 1] = '\0';
}

static void ab_client_set_error(void* context, const char* text) {
  ab_client* self = (ab_client*)context;
  ab_client_copy_text(self->error, text);
  self->has_error = 1;
}

static void ab_client_log(void* context, int32_t level, const char* text) {
  ab_client* self = (ab_client*)context;
  if (self->log_count == AB_CLIENT_MOST_LOG) return;
  self->log_levels[self->log_count] = level;
  ab_client_copy_text(self->log[self->log_count++], text);
}

static const void* ab_client_extension(void* context, const char* id) {
  (void)context;
  (void)id;
  return NULL;
}

/* Appends to the answer; the offset in the segment, 0 if it does not fit. */
static uint64_t ab_client_add(ab_client* self, const void* bytes, uint64_t count) {
  const uint64_t at = (self->used + 7u) & ~(uint64_t)7u;
  if (at > self->answer_bytes || count > self->answer_bytes - at) {
    self->is_full = 1;
    return 0;
  }
  if (count > 0) memcpy(self->segment + self->answer_offset + at, bytes, (size_t)count);
  self->used = at + count;
  return self->answer_offset + at;
}

static uint64_t ab_client_add_text(ab_client* self, const char* text) {
  return text == NULL ? 0 : ab_client_add(self, text, (uint64_t)strlen(text) + 1u);
}

/* A pointer's place in a struct takes an offset. */
static void ab_client_set_offset(void* pointer, uint64_t offset) {
  memcpy(pointer, &offset, sizeof offset);
}
static uint64_t ab_client_offset(const void* pointer) {
  uint64_t offset = 0;
  memcpy(&offset, pointer, sizeof offset);
  return offset;
}

static uint64_t ab_client_add_parameters(ab_client* self, const ab_planner* planner) {
  const uint32_t count = planner->parameter_count;
  uint64_t* offsets = (uint64_t*)calloc((size_t)count + 1u, sizeof(uint64_t));
  uint64_t array = 0;
  uint32_t i;
  for (i = 0; i < count && offsets != NULL; ++i) {
    const ab_parameter* from = planner->parameters[i];
    ab_parameter copy;
    memset(&copy, 0, sizeof copy);
    memcpy(&copy, from, from->struct_size < sizeof copy ? from->struct_size : sizeof copy);
    copy.struct_size = (uint32_t)sizeof copy;
    ab_client_set_offset(&copy.name, ab_client_add_text(self, from->name));
    ab_client_set_offset(&copy.unit, ab_client_add_text(self, from->unit));
    ab_client_set_offset(&copy.doc, ab_client_add_text(self, from->doc));
    ab_client_set_offset(&copy.choices, ab_client_add_text(self, from->choices));
    ab_client_set_offset(&copy.preset_text, ab_client_add_text(self, from->preset_text));
    offsets[i] = ab_client_add(self, &copy, sizeof copy);
  }
  if (offsets != NULL) array = ab_client_add(self, offsets, (uint64_t)count * sizeof(uint64_t));
  free(offsets);
  return array;
}

static uint64_t ab_client_add_profiles(ab_client* self, const ab_planner* planner) {
  const uint32_t count = planner->profile_count;
  uint64_t* offsets = (uint64_t*)calloc((size_t)count + 1u, sizeof(uint64_t));
  uint64_t array = 0;
  uint32_t i, k;
  for (i = 0; i < count && offsets != NULL; ++i) {
    const ab_profile* from = planner->profiles[i];
    ab_profile copy = *from;
    ab_named_number* numbers =
        (ab_named_number*)calloc((size_t)from->number_count + 1u, sizeof(ab_named_number));
    if (numbers == NULL) break;
    for (k = 0; k < from->number_count; ++k) {
      ab_client_set_offset(&numbers[k].name, ab_client_add_text(self, from->numbers[k].name));
      numbers[k].number = from->numbers[k].number;
    }
    copy.struct_size = (uint32_t)sizeof copy;
    ab_client_set_offset(&copy.choice, ab_client_add_text(self, from->choice));
    ab_client_set_offset(&copy.word, ab_client_add_text(self, from->word));
    ab_client_set_offset(&copy.numbers,
                         ab_client_add(self, numbers, from->number_count * sizeof *numbers));
    free(numbers);
    offsets[i] = ab_client_add(self, &copy, sizeof copy);
  }
  if (offsets != NULL) array = ab_client_add(self, offsets, (uint64_t)count * sizeof(uint64_t));
  free(offsets);
  return array;
}

/* The ab_files of the planner; 0 where it has none. */
static uint64_t ab_client_add_files(ab_client* self, const ab_planner* planner) {
  const ab_files* files = planner->get_extension == NULL
                              ? NULL
                              : (const ab_files*)planner->get_extension(NULL, AB_FILES_EXTENSION);
  ab_files copy;
  uint64_t* offsets;
  uint32_t i;
  if (files == NULL) return 0;
  offsets = (uint64_t*)calloc((size_t)files->file_count + 1u, sizeof(uint64_t));
  if (offsets == NULL) return 0;
  for (i = 0; i < files->file_count; ++i) {
    offsets[i] = ab_client_add_text(self, files->files[i]);
  }
  memset(&copy, 0, sizeof copy);
  copy.struct_size = (uint32_t)sizeof copy;
  copy.file_count = files->file_count;
  ab_client_set_offset(&copy.files,
                       ab_client_add(self, offsets, files->file_count * sizeof(uint64_t)));
  free(offsets);
  return ab_client_add(self, &copy, sizeof copy);
}

static uint64_t ab_client_describe(ab_client* self) {
  const ab_planner* from = self->planner;
  ab_planner copy;
  ab_process_description description;
  memset(&copy, 0, sizeof copy);
  memcpy(&copy, from, from->struct_size < sizeof copy ? from->struct_size : sizeof copy);
  copy.struct_size = (uint32_t)sizeof copy;
  memset(&description, 0, sizeof description);
  description.struct_size = (uint32_t)sizeof description;
  description.protocol = AB_PROCESS_PROTOCOL;
  ab_client_set_offset(&copy.name, ab_client_add_text(self, from->name));
  ab_client_set_offset(&copy.version, ab_client_add_text(self, from->version));
  ab_client_set_offset(&copy.summary, ab_client_add_text(self, from->summary));
  ab_client_set_offset(&copy.parameters, ab_client_add_parameters(self, from));
  {
    const uint64_t profiles = copy.profile_count > 0 ? ab_client_add_profiles(self, from) : 0;
    ab_client_set_offset(&copy.profiles, profiles);
  }
  memset(&copy.create, 0, sizeof copy.create);
  memset(&copy.destroy, 0, sizeof copy.destroy);
  memset(&copy.reset, 0, sizeof copy.reset);
  memset(&copy.plan, 0, sizeof copy.plan);
  memset(&copy.get_extension, 0, sizeof copy.get_extension);
  description.planner = ab_client_add(self, &copy, sizeof copy);
  description.files = ab_client_add_files(self, from);
  return ab_client_add(self, &description, sizeof description);
}

/* Room for the request's structs with pointers. What it gave before stays where it is: it is made
 * large enough before each request. */
static void* ab_client_take(ab_client* self, size_t bytes) {
  void* taken = (char*)self->scratch + self->scratch_used;
  self->scratch_used += (bytes + 15u) & ~(size_t)15u;
  return taken;
}

/* The struct at an offset of the segment. */
static const void* ab_client_at(const ab_client* self, uint64_t offset) {
  return offset == 0 ? NULL : self->segment + offset;
}

/* A private copy of the struct at an offset, not longer than `bytes`. */
static void* ab_client_copied(ab_client* self, uint64_t offset, size_t bytes) {
  uint32_t size = 0;
  void* copy = ab_client_take(self, bytes);
  memset(copy, 0, bytes);
  memcpy(&size, ab_client_at(self, offset), sizeof size);
  memcpy(copy, ab_client_at(self, offset), size < bytes ? size : bytes);
  return copy;
}

static const ab_setup* ab_client_setup(ab_client* self, uint64_t body) {
  ab_setup* setup = (ab_setup*)ab_client_copied(self, body, sizeof(ab_setup));
  const uint64_t* values = (const uint64_t*)ab_client_at(self, ab_client_offset(&setup->values));
  const uint64_t* cameras = (const uint64_t*)ab_client_at(self, ab_client_offset(&setup->cameras));
  const ab_value** value_pointers =
      (const ab_value**)ab_client_take(self, setup->value_count * sizeof(void*));
  const ab_camera** camera_pointers =
      (const ab_camera**)ab_client_take(self, setup->camera_count * sizeof(void*));
  const uint64_t* lidars = (const uint64_t*)ab_client_at(self, ab_client_offset(&setup->lidars));
  const ab_lidar** lidar_pointers =
      (const ab_lidar**)ab_client_take(self, setup->lidar_count * sizeof(void*));
  uint32_t i;
  for (i = 0; i < setup->value_count; ++i) {
    ab_value* value = (ab_value*)ab_client_copied(self, values[i], sizeof(ab_value));
    value->text = (const char*)ab_client_at(self, ab_client_offset(&value->text));
    value_pointers[i] = value;
  }
  for (i = 0; i < setup->camera_count; ++i) {
    camera_pointers[i] = (const ab_camera*)ab_client_copied(self, cameras[i], sizeof(ab_camera));
  }
  for (i = 0; i < setup->lidar_count; ++i) {
    lidar_pointers[i] = (const ab_lidar*)ab_client_copied(self, lidars[i], sizeof(ab_lidar));
  }
  setup->lidars = setup->lidar_count > 0 ? lidar_pointers : NULL;
  setup->values = value_pointers;
  setup->cameras = setup->camera_count > 0 ? camera_pointers : NULL;
  setup->depth_camera = setup->camera_count > 0 ? camera_pointers[0] : NULL;
  return setup;
}

static const ab_mission* ab_client_mission(ab_client* self, uint64_t body) {
  ab_mission* mission = (ab_mission*)ab_client_copied(self, body, sizeof(ab_mission));
  mission->goals_world_m =
      (const double*)ab_client_at(self, ab_client_offset(&mission->goals_world_m));
  return mission;
}

static const ab_picture* ab_client_picture(ab_client* self, uint64_t offset) {
  ab_picture* picture = (ab_picture*)ab_client_copied(self, offset, sizeof(ab_picture));
  picture->pixels = (const uint8_t*)ab_client_at(self, ab_client_offset(&picture->pixels));
  return picture;
}

static const ab_command* ab_client_wanted(ab_client* self, uint64_t offset) {
  ab_command* wanted;
  if (offset == 0) return NULL;
  wanted = (ab_command*)ab_client_copied(self, offset, sizeof(ab_command));
  wanted->points = (const ab_point*)ab_client_at(self, ab_client_offset(&wanted->points));
  return wanted;
}

static const ab_observation* ab_client_observation(ab_client* self, uint64_t body) {
  ab_observation* seen = (ab_observation*)ab_client_copied(self, body, sizeof(ab_observation));
  const uint64_t* depth = (const uint64_t*)ab_client_at(self, ab_client_offset(&seen->depth));
  const uint64_t* stereo = (const uint64_t*)ab_client_at(self, ab_client_offset(&seen->stereo));
  const uint64_t* color = (const uint64_t*)ab_client_at(self, ab_client_offset(&seen->color));
  const uint64_t* offsets = (const uint64_t*)ab_client_at(self, ab_client_offset(&seen->states));
  const uint64_t* clouds = (const uint64_t*)ab_client_at(self, ab_client_offset(&seen->clouds));
  const ab_cloud** sweeps =
      (const ab_cloud**)ab_client_take(self, seen->cloud_count * sizeof(void*));
  const ab_state** states =
      (const ab_state**)ab_client_take(self, seen->state_count * sizeof(void*));
  const ab_depth_image** images =
      (const ab_depth_image**)ab_client_take(self, seen->depth_count * sizeof(void*));
  const ab_stereo_pair** pairs =
      (const ab_stereo_pair**)ab_client_take(self, seen->stereo_count * sizeof(void*));
  const ab_picture** pictures =
      (const ab_picture**)ab_client_take(self, seen->color_count * sizeof(void*));
  uint32_t i;
  for (i = 0; i < seen->depth_count; ++i) {
    ab_depth_image* image =
        (ab_depth_image*)ab_client_copied(self, depth[i], sizeof(ab_depth_image));
    image->depth_m = (const float*)ab_client_at(self, ab_client_offset(&image->depth_m));
    images[i] = image;
  }
  for (i = 0; i < seen->stereo_count; ++i) {
    ab_stereo_pair* pair =
        (ab_stereo_pair*)ab_client_copied(self, stereo[i], sizeof(ab_stereo_pair));
    pair->left = ab_client_picture(self, ab_client_offset(&pair->left));
    pair->right = ab_client_picture(self, ab_client_offset(&pair->right));
    pairs[i] = pair;
  }
  for (i = 0; i < seen->color_count; ++i) pictures[i] = ab_client_picture(self, color[i]);
  seen->state =
      (const ab_state*)ab_client_copied(self, ab_client_offset(&seen->state), sizeof(ab_state));
  for (i = 0; i < seen->state_count; ++i) {
    states[i] = (const ab_state*)ab_client_copied(self, offsets[i], sizeof(ab_state));
  }
  for (i = 0; i < seen->cloud_count; ++i) {
    ab_cloud* cloud = (ab_cloud*)ab_client_copied(self, clouds[i], sizeof(ab_cloud));
    cloud->points = (const ab_lidar_point*)ab_client_at(self, ab_client_offset(&cloud->points));
    cloud->misses_lidar = (const float*)ab_client_at(self, ab_client_offset(&cloud->misses_lidar));
    sweeps[i] = cloud;
  }
  seen->clouds = sweeps;
  seen->states = states;
  seen->reference = (const ab_point*)ab_client_at(self, ab_client_offset(&seen->reference));
  seen->tracks = (const ab_track*)ab_client_at(self, ab_client_offset(&seen->tracks));
  seen->imu = (const ab_imu_sample*)ab_client_at(self, ab_client_offset(&seen->imu));
  seen->wanted = ab_client_wanted(self, ab_client_offset(&seen->wanted));
  seen->depth = images;
  seen->stereo = pairs;
  seen->color = pictures;
  return seen;
}

static ab_status ab_client_plan(ab_client* self, uint64_t body, uint64_t* answer_body) {
  ab_command command;
  ab_status status;
  memset(&command, 0, sizeof command);
  command.struct_size = (uint32_t)sizeof command;
  status = self->planner->plan(self->instance, ab_client_observation(self, body), &command);
  if (status != AB_OK) return status;
  {
    const uint64_t points =
        command.points == NULL || command.kind != AB_COMMAND_TRAJECTORY
            ? 0
            : ab_client_add(self, command.points, command.point_count * sizeof(ab_point));
    ab_client_set_offset(&command.points, points);
  }
  *answer_body = ab_client_add(self, &command, sizeof command);
  return status;
}

static ab_status ab_client_create(ab_client* self, uint64_t body) {
  if (self->instance != NULL) self->planner->destroy(self->instance);
  self->instance = self->planner->create(&self->host, ab_client_setup(self, body));
  return self->instance != NULL ? AB_OK : AB_ERROR;
}

static ab_status ab_client_do(ab_client* self, uint32_t kind, uint64_t body, uint64_t* answer) {
  switch (kind) {
    case AB_PROCESS_HELLO:
      *answer = ab_client_describe(self);
      return AB_OK;
    case AB_PROCESS_CREATE:
      return ab_client_create(self, body);
    case AB_PROCESS_RESET:
      return self->planner->reset(self->instance, ab_client_mission(self, body));
    case AB_PROCESS_PLAN:
      return ab_client_plan(self, body, answer);
    case AB_PROCESS_DESTROY:
      if (self->instance != NULL) self->planner->destroy(self->instance);
      self->instance = NULL;
      return AB_OK;
    default:
      ab_client_set_error(self, "the program does not know this request");
      return AB_ERROR;
  }
}

/* Writes the answer, what it points to first. */
static void ab_client_answer(ab_client* self, const ab_process_request* request) {
  ab_process_answer answer;
  ab_process_log lines[AB_CLIENT_MOST_LOG];
  uint32_t i;
  memset(&answer, 0, sizeof answer);
  memset(lines, 0, sizeof lines);
  self->used = sizeof answer;
  self->is_full = self->has_error = 0;
  self->log_count = 0;
  answer.sequence = request->sequence;
  answer.kind = request->kind;
  answer.status = ab_client_do(self, request->kind, request->body, &answer.body);
  if (self->is_full) {
    self->used = sizeof answer;
    answer.body = 0;
    answer.status = AB_ERROR;
    ab_client_set_error(self, "the answer is longer than the segment's room for it");
  }
  if (self->has_error) answer.error = ab_client_add_text(self, self->error);
  for (i = 0; i < self->log_count; ++i) {
    lines[i].level = self->log_levels[i];
    lines[i].text = ab_client_add_text(self, self->log[i]);
  }
  if (self->log_count > 0) {
    answer.log = ab_client_add(self, lines, self->log_count * sizeof lines[0]);
  }
  answer.log_count = answer.log != 0 ? self->log_count : 0;
  answer.bytes = self->used;
  memcpy(self->segment + self->answer_offset, &answer, sizeof answer);
}

/* Maps the segment as large as it is now. */
static int ab_client_map(ab_client* self) {
  ab_process_header header;
  if (self->segment != NULL) {
    memcpy(&header, self->segment, sizeof header);
    if (header.segment_bytes == self->segment_bytes) return 0;
    munmap(self->segment, (size_t)self->segment_bytes);
  } else {
    void* first = mmap(NULL, sizeof header, PROT_READ, MAP_SHARED, self->segment_fd, 0);
    if (first == MAP_FAILED) return -1;
    memcpy(&header, first, sizeof header);
    munmap(first, sizeof header);
  }
  if (memcmp(header.magic, AB_PROCESS_MAGIC, sizeof header.magic) != 0 ||
      header.protocol != AB_PROCESS_PROTOCOL || header.abi_version != AVOIDBENCH_ABI_VERSION) {
    fprintf(stderr, "this planner speaks protocol %u, avoidbench %u: build it again\n",
            (unsigned)AB_PROCESS_PROTOCOL, (unsigned)header.protocol);
    return -1;
  }
  self->segment_bytes = header.segment_bytes;
  self->answer_offset = header.answer_offset;
  self->answer_bytes = header.answer_bytes;
  self->request_offset = header.request_offset;
  self->segment = (unsigned char*)mmap(NULL, (size_t)header.segment_bytes, PROT_READ | PROT_WRITE,
                                       MAP_SHARED, self->segment_fd, 0);
  return (void*)self->segment == MAP_FAILED ? -1 : 0;
}

/* Copies are a little larger than what the request has, as they are padded and this header's
 * structs may be longer than the host's: four times its size is always enough, and what no copy
 * touches costs nothing. */
static int ab_client_make_scratch(ab_client* self, uint64_t request_bytes) {
  const size_t wanted = 4096u + 4u * (size_t)request_bytes;
  self->scratch_used = 0;
  if (wanted <= self->scratch_bytes) return 0;
  free(self->scratch);
  self->scratch = malloc(wanted);
  self->scratch_bytes = self->scratch != NULL ? wanted : 0;
  return self->scratch != NULL ? 0 : -1;
}

/* One request and its answer; 0 to go on, 1 at the end, -1 after a failure. */
static int ab_client_step(ab_client* self) {
  ab_process_word word;
  ab_process_request request;
  ssize_t count;
  do {
    count = read(self->socket_fd, &word, sizeof word);
  } while (count < 0 && errno == EINTR);
  if (count == 0 || (count < 0 && errno == ECONNRESET)) return 1;
  if (count != (ssize_t)sizeof word || ab_client_map(self) != 0) return -1;
  memcpy(&request, self->segment + self->request_offset, sizeof request);
  if (ab_client_make_scratch(self, request.bytes) != 0) return -1;
  ab_client_answer(self, &request);
  word.sequence = request.sequence;
  word.kind = request.kind;
  do {
    count = write(self->socket_fd, &word, sizeof word);
  } while (count < 0 && errno == EINTR);
  if (count < 0 && errno == EPIPE) return 1;
  return count == (ssize_t)sizeof word ? 0 : -1;
}

/* Serves the planner until avoidbench lets go of it. Returns the program's exit code. `planner` may
 * be null, as avoidbench_planner_v1() gives it for an ABI that it can't serve. */
static int avoidbench_serve(const ab_planner* planner) {
  ab_client* self = (ab_client*)calloc(1, sizeof(ab_client));
  const char* given = getenv(AB_PROCESS_VARIABLE);
  int state = 0;
  if (self == NULL) return 1;
  if (given == NULL || sscanf(given, "%d,%d", &self->socket_fd, &self->segment_fd) != 2) {
    fprintf(stderr,
            "this program is a planner: name it in a sweep of avoidbench, as plugin: ./FILE\n");
    free(self);
    return 2;
  }
  if (planner == NULL) {
    fprintf(stderr, "the planner refuses ABI %u\n", (unsigned)AVOIDBENCH_ABI_VERSION);
    free(self);
    return 2;
  }
  self->planner = planner;
  self->host.struct_size = (uint32_t)sizeof(ab_host);
  self->host.abi_version = AVOIDBENCH_ABI_VERSION;
  self->host.context = self;
  self->host.set_error = ab_client_set_error;
  self->host.log = ab_client_log;
  self->host.get_extension = ab_client_extension;
  if (ab_client_map(self) != 0) state = -1;
  while (state == 0) state = ab_client_step(self);
  free(self->scratch);
  free(self);
  return state == 1 ? 0 : 1;
}

#ifdef __cplusplus
}
#endif

#endif
