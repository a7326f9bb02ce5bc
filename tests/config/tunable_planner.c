/* Hovers where it is; has one parameter of each kind. */
#include <stddef.h>

#include "avoidbench/planner.h"

static int the_instance;

static void* create(const ab_host* host, const ab_setup* setup) {
  (void)host;
  (void)setup;
  return &the_instance;
}
static void destroy(void* instance) { (void)instance; }
static ab_status reset(void* instance, const ab_mission* mission) {
  (void)instance;
  (void)mission;
  return AB_OK;
}
static ab_status plan(void* instance, const ab_observation* observation, ab_command* command) {
  (void)instance;
  command->kind = AB_COMMAND_POSITION;
  for (int i = 0; i < 3; ++i)
    command->position_world_m[i] = observation->state->position_world_m[i];
  return AB_OK;
}

static const ab_parameter kHorizon = {sizeof(ab_parameter),
                                      AB_NUMBER,
                                      "horizon_m",
                                      "m",
                                      "How far it looks.",
                                      1.0,
                                      20.0,
                                      5.0,
                                      NULL,
                                      NULL};
static const ab_parameter kSteps = {sizeof(ab_parameter),
                                    AB_INTEGER,
                                    "steps_count",
                                    "",
                                    "How many steps.",
                                    1.0,
                                    100.0,
                                    10.0,
                                    NULL,
                                    NULL};
static const ab_parameter kMode = {
    sizeof(ab_parameter), AB_CHOICE, "mode", "", "How bold.", 0.0, 0.0, 0.0, "safe|fast", "safe"};
static const ab_parameter kMap = {
    sizeof(ab_parameter), AB_TEXT, "note", "", "Any text.", 0.0, 0.0, 0.0, NULL, ""};
static const ab_parameter kSpeed = {sizeof(ab_parameter),
                                    AB_NUMBER,
                                    "max_speed_mps",
                                    "m/s",
                                    "Greatest speed.",
                                    0.5,
                                    10.0,
                                    3.0,
                                    NULL,
                                    NULL};
static const ab_parameter* const kParameters[] = {&kHorizon, &kSteps, &kMode, &kMap, &kSpeed};

/* What it has in mode fast where nothing else is given. */
static const ab_named_number kFastNumbers[] = {{"horizon_m", 9.0}, {"max_speed_mps", 6.0}};
static const ab_profile kFast = {sizeof(ab_profile), 2, "mode", "fast", kFastNumbers};
static const ab_profile* const kProfiles[] = {&kFast};

static const ab_planner kTable = {sizeof(ab_planner),
                                  AVOIDBENCH_ABI_VERSION,
                                  "tunable",
                                  "1.0",
                                  "Hovers; has parameters.",
                                  AB_INPUT_STATE | AB_INPUT_GOALS,
                                  AB_COMMAND_POSITION,
                                  5,
                                  0,
                                  kParameters,
                                  create,
                                  destroy,
                                  reset,
                                  plan,
                                  NULL,
                                  1,
                                  0,
                                  kProfiles,
                                  0.0,
                                  0.0};

AB_EXPORT const ab_planner* avoidbench_planner_v1(uint32_t host_api) {
  return host_api == AVOIDBENCH_ABI_VERSION ? &kTable : NULL;
}
