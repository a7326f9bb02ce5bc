#include <fcntl.h>
#include <math.h>
#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

#include "hostile.h"

static const struct Way* const kTables[] = {
    kMemoryWays, kSignalWays, kProcessWays,     kParentWays,  kDescriptorWays, kFileWays,
    kResultWays, kTimeWays,   kEnvironmentWays, kCommandWays, kTerminalWays};
enum { kTableCount = sizeof kTables / sizeof kTables[0], kMostWays = 400 };

static const struct Way kNothing = {"nothing", AT_DESTROY, NULL};

static const struct Way* find_way(const char* name) {
  for (int table = 0; table < kTableCount; ++table) {
    for (const struct Way* way = kTables[table]; way->name != NULL; ++way) {
      if (strcmp(way->name, name) == 0) return way;
    }
  }
  return &kNothing;
}

const char* in_folder(const struct Attack* attack, const char* name) {
  static char path[4096];
  snprintf(path, sizeof path, "%s/%s", attack->folder, name);
  return path;
}

void tell_success(struct Attack* attack, const char* what) {
  attack->host->set_error(attack->host->context, what);
  attack->status = AB_ERROR;
}

void sleep_s(double seconds) {
  struct timespec left = {.tv_sec = (time_t)seconds,
                          .tv_nsec = (long)(1e9 * (seconds - floor(seconds)))};
  while (nanosleep(&left, &left) != 0) {
  }
}

void sleep_for_ever(void) {
  while (1) pause();
}

pid_t leave_child(void (*act)(struct Attack*), struct Attack* attack) {
  const pid_t child = fork();
  if (child == 0) {
    if (act != NULL) act(attack);
    sleep_for_ever();
  }
  return child;
}

void start_thread(void* (*act)(void*), void* argument) {
  pthread_t thread;
  if (pthread_create(&thread, NULL, act, argument) == 0) pthread_detach(thread);
}

int siblings(pid_t* pids, int most) {
  char path[64];
  snprintf(path, sizeof path, "/proc/%d/task/%d/children", (int)getppid(), (int)getppid());
  FILE* file = fopen(path, "r");
  if (file == NULL) return 0;
  int count = 0, pid = 0;
  while (count < most && fscanf(file, "%d", &pid) == 1) {
    if (pid != getpid()) pids[count++] = pid;
  }
  fclose(file);
  return count;
}

struct Instance {
  const struct Way* way;
  struct Attack attack;
  char folder[3072];
  ab_mission mission;
  int calls;
};

static void act_at(struct Instance* self, enum Stage stage) {
  if (self->way->act != NULL && self->way->stage == stage) self->way->act(&self->attack);
}

static void* create(const ab_host* host, const ab_setup* setup) {
  struct Instance* self = calloc(1, sizeof *self);
  if (self == NULL) return NULL;
  self->way = find_way(setup->values[0]->text);
  snprintf(self->folder, sizeof self->folder, "%s", setup->values[1]->text);
  self->attack.host = host;
  self->attack.way = self->way->name;
  self->attack.folder = self->folder;
  self->attack.metric_count = (uint32_t)setup->values[2]->number;
  act_at(self, AT_CREATE);
  return self;
}

static void destroy(void* instance) {
  act_at(instance, AT_DESTROY);
  free(instance);
}

static ab_status reset(void* instance, const ab_mission* mission) {
  struct Instance* self = instance;
  self->mission = *mission;
  self->calls = 0;
  self->attack.status = AB_OK;
  act_at(self, AT_RESET);
  return self->attack.status;
}

static void fly_straight(const struct Instance* self, const ab_state* state, ab_command* command) {
  const double speed_mps = 2.0;
  double away_m[3], distance_m = 0.0;
  for (int i = 0; i < 3; ++i) {
    away_m[i] = self->mission.goal_world_m[i] - state->position_world_m[i];
    distance_m += away_m[i] * away_m[i];
  }
  distance_m = sqrt(distance_m);
  command->kind = AB_COMMAND_VELOCITY;
  for (int i = 0; i < 3; ++i) {
    command->velocity_world_mps[i] = distance_m > 1e-6 ? speed_mps * away_m[i] / distance_m : 0.0;
  }
}

static ab_status plan(void* instance, const ab_observation* observation, ab_command* command) {
  const int good_calls = 15;
  struct Instance* self = instance;
  self->attack.observation = observation;
  self->attack.command = command;
  self->attack.status = AB_OK;
  fly_straight(self, observation->state, command);
  if (++self->calls == good_calls) act_at(self, AT_CALL);
  if (self->calls >= good_calls) act_at(self, EACH_CALL);
  self->attack.observation = NULL;
  self->attack.command = NULL;
  return self->attack.status;
}

/* "nothing|way|way": what the parameter `way` can be. */
static const char* way_names(void) {
  static char names[16384];
  size_t length = (size_t)snprintf(names, sizeof names, "nothing");
  for (int table = 0; table < kTableCount; ++table) {
    for (const struct Way* way = kTables[table]; way->name != NULL && length < sizeof names;
         ++way) {
      length += (size_t)snprintf(names + length, sizeof names - length, "|%s", way->name);
    }
  }
  return names;
}

static ab_parameter way = {.struct_size = sizeof(ab_parameter),
                           .kind = AB_CHOICE,
                           .name = "way",
                           .unit = "",
                           .doc = "How it attacks.",
                           .preset_text = "nothing"};
static const ab_parameter kFolder = {.struct_size = sizeof(ab_parameter),
                                     .kind = AB_TEXT,
                                     .name = "folder",
                                     .unit = "",
                                     .doc = "The run's folder.",
                                     .preset_text = "/nonexistent"};
static const ab_parameter kMetrics = {.struct_size = sizeof(ab_parameter),
                                      .kind = AB_INTEGER,
                                      .name = "metric_count",
                                      .unit = "",
                                      .doc = "How many metrics a result has.",
                                      .highest = 1000.0};
static const ab_parameter* const kParameters[] = {&way, &kFolder, &kMetrics};

static ab_planner table = {.struct_size = sizeof(ab_planner),
                           .abi_version = AVOIDBENCH_ABI_VERSION,
                           .name = "hostile",
                           .version = "1.0",
                           .summary = "Flies straight to the goal and attacks the program.",
                           .needs = AB_INPUT_STATE,
                           .commands = AB_COMMAND_VELOCITY | AB_COMMAND_TRAJECTORY,
                           .parameter_count = 3,
                           .parameters = kParameters,
                           .create = create,
                           .destroy = destroy,
                           .reset = reset,
                           .plan = plan};

AB_EXPORT const ab_planner* avoidbench_planner_v1(uint32_t host_api) {
  way.choices = way_names();
  table.needs = AB_INPUT_STATE | kHostileUses;
  return host_api == AVOIDBENCH_ABI_VERSION ? &table : NULL;
}
