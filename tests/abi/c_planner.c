/* A planner in plain C: the interface must stay usable without C++. */
#include <stdlib.h>
#include <string.h>

#include "avoidbench/planner.h"

typedef struct {
  double speed_mps;
  double climb_mps;
  double goal_world_m[3];
  const ab_debug* debug; /* null with hosts that show no drawings */
} c_planner;

static void* create(const ab_host* host, const ab_setup* setup) {
  c_planner* self;
  if (setup->value_count != 2) {
    host->set_error(host->context, "two values expected");
    return NULL;
  }
  self = calloc(1, sizeof *self);
  if (self == NULL) {
    host->set_error(host->context, "no memory");
    return NULL;
  }
  self->debug = host->get_extension(host->context, AB_DEBUG_EXTENSION);
  self->speed_mps = setup->values[0]->number;
  self->climb_mps = strcmp(setup->values[1]->text, "climb") == 0 ? 0.5 : 0.0;
  return self;
}

static void destroy(void* instance) { free(instance); }

static ab_status reset(void* instance, const ab_mission* mission) {
  c_planner* self = instance;
  memcpy(self->goal_world_m, mission->goal_world_m, sizeof self->goal_world_m);
  return AB_OK;
}

static void draw_goal(const c_planner* self) {
  ab_drawing goal = {sizeof(ab_drawing), AB_DRAW_POINTS, 0xff0000, 1, NULL, 8.0, "goal"};
  goal.points_world_m = self->goal_world_m;
  if (self->debug->is_wanted(self->debug->context)) self->debug->draw(self->debug->context, &goal);
}

static ab_status plan(void* instance, const ab_observation* seen, ab_command* command) {
  const c_planner* self = instance;
  const double ahead_m = self->goal_world_m[0] - seen->state->position_world_m[0];
  command->kind = AB_COMMAND_VELOCITY;
  if (ahead_m > 0.5) command->velocity_world_mps[0] = self->speed_mps;
  if (ahead_m < -0.5) command->velocity_world_mps[0] = -self->speed_mps;
  command->velocity_world_mps[2] = self->climb_mps;
  if (self->debug != NULL) draw_goal(self);
  return AB_OK;
}

static const ab_parameter speed = {sizeof(ab_parameter),
                                   AB_NUMBER,
                                   "speed_mps",
                                   "m/s",
                                   "Speed along x.",
                                   0.1,
                                   10.0,
                                   2.0,
                                   NULL,
                                   NULL};
static const ab_parameter mode = {sizeof(ab_parameter), AB_CHOICE, "mode", "",
                                  "Whether it climbs.", 0.0,       0.0,    0.0,
                                  "level|climb",        "level"};
static const ab_parameter* const parameters[] = {&speed, &mode};

static const ab_planner table = {sizeof(ab_planner),
                                 AVOIDBENCH_ABI_VERSION,
                                 "c_planner",
                                 "1.0",
                                 "Flies along x to the goal's x.",
                                 AB_INPUT_STATE,
                                 AB_COMMAND_VELOCITY,
                                 2,
                                 0,
                                 parameters,
                                 create,
                                 destroy,
                                 reset,
                                 plan,
                                 NULL,
                                 0,
                                 0,
                                 NULL,
                                 0.0,
                                 0.0};

const ab_planner* avoidbench_planner_v1(uint32_t host_api) {
  return host_api == AVOIDBENCH_ABI_VERSION ? &table : NULL;
}
