/* Sends back all that it is told: in the points of a trajectory, whose first number is the count of
 * bytes. */
#include <stdlib.h>

#include "avoidbench/process_client.h"
#include "programs/echo_bytes.h"

typedef struct echo {
  const ab_host* host;
  echo_buffer told, answer;
  size_t setup_size;
  int calls;
} echo;

static void* create(const ab_host* host, const ab_setup* setup) {
  echo* self = (echo*)calloc(1, sizeof(echo));
  self->host = host;
  echo_setup(&self->told, setup);
  self->setup_size = self->told.size;
  host->log(host->context, AB_LOG_WARNING, "created");
  return self;
}

static void destroy(void* instance) {
  echo* self = (echo*)instance;
  free(self->told.bytes);
  free(self->answer.bytes);
  free(self);
}

static ab_status reset(void* instance, const ab_mission* mission) {
  echo* self = (echo*)instance;
  self->told.size = self->setup_size;
  self->calls = 0;
  echo_mission(&self->told, mission);
  return AB_OK;
}

static ab_status plan(void* instance, const ab_observation* seen, ab_command* command) {
  echo* self = (echo*)instance;
  echo_buffer* answer = &self->answer;
  double count = 0.0;
  switch (self->calls++) {
    case 1:
      return AB_NO_PLAN;
    case 2:
      self->host->set_error(self->host->context, "no way");
      return AB_GIVE_UP;
    case 3:
      self->host->set_error(self->host->context, "an error of its own");
      return AB_ERROR;
    default:
      break;
  }
  answer->size = self->told.size + sizeof(ab_point);
  if (answer->room < answer->size) {
    answer->bytes = (unsigned char*)realloc(answer->bytes, answer->size);
    answer->room = answer->size;
  }
  memcpy(answer->bytes + sizeof(ab_point), self->told.bytes, self->told.size);
  echo_observation(answer, seen);
  count = (double)(answer->size - sizeof(ab_point));
  memcpy(answer->bytes, &count, sizeof count);
  while (answer->size % sizeof(ab_point) != 0) {
    if (answer->size == answer->room) {
      answer->room += sizeof(ab_point);
      answer->bytes = (unsigned char*)realloc(answer->bytes, answer->room);
    }
    answer->bytes[answer->size++] = 0;
  }
  echo_command(command, seen->state);
  command->points = (const ab_point*)(const void*)answer->bytes;
  command->point_count = (uint32_t)(answer->size / sizeof(ab_point));
  return AB_OK;
}

static const char* const file_names[] = {"echo_weights.txt", "sub/other.txt"};
static const ab_files files = {sizeof(ab_files), 2, file_names};

static const void* get_extension(void* instance, const char* id) {
  (void)instance;
  return strcmp(id, AB_FILES_EXTENSION) == 0 ? &files : NULL;
}

static const ab_parameter number = {
    sizeof(ab_parameter), AB_NUMBER, "gain_hz", "1/s", "A number.", 0.125, 8.5, 1.75, NULL, NULL};
static const ab_parameter choice = {sizeof(ab_parameter), AB_CHOICE, "preset", "",
                                    "A choice.",          0.0,       0.0,      0.0,
                                    "own|published",      "own"};
static const ab_parameter text = {
    sizeof(ab_parameter), AB_TEXT, "note", "", "A text.", 0.0, 0.0, 0.0, NULL, "Grüße"};
static const ab_parameter* const parameters[] = {&number, &choice, &text};
static const ab_named_number published_numbers[] = {{"gain_hz", 3.25}};
static const ab_profile published = {sizeof(ab_profile), 1, "preset", "published",
                                     published_numbers};
static const ab_profile* const profiles[] = {&published};

static const ab_planner planner = {
    sizeof(ab_planner),
    AVOIDBENCH_ABI_VERSION,
    "echo",
    "2.5",
    "Says what it was told.",
    AB_INPUT_STATE | AB_INPUT_DEPTH | AB_INPUT_STEREO | AB_INPUT_COLOR | AB_INPUT_IMU,
    AB_COMMAND_TRAJECTORY,
    3,
    0,
    parameters,
    create,
    destroy,
    reset,
    plan,
    get_extension,
    1,
    0,
    profiles,
    0.0,
    0.0};

int main(void) { return avoidbench_serve(&planner); }
