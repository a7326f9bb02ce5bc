/* A planner that draws under hostile labels and ends its flight after half a second with a reason
 * that tries to be markup. */
#include <stdlib.h>

#include "avoidbench/planner.h"

#define HOSTILE          \
  "</script><img src=x " \
  "onerror=\"window.hacked=1\"><script>window.hacked=2</script>'\"&amp;\xe2\x80\xa8"

typedef struct {
  const ab_host* host;
  int calls;
} instance;

static void* create(const ab_host* host, const ab_setup* setup) {
  (void)setup;
  instance* self = calloc(1, sizeof *self);
  self->host = host;
  return self;
}

static void destroy(void* self) { free(self); }

static ab_status reset(void* self, const ab_mission* mission) {
  (void)mission;
  ((instance*)self)->calls = 0;
  return AB_OK;
}

static ab_status plan(void* given, const ab_observation* observation, ab_command* command) {
  (void)observation;
  instance* self = given;
  self->host->log(self->host->context, AB_LOG_INFO, HOSTILE);
  if (++self->calls > 15) {
    self->host->set_error(self->host->context, HOSTILE);
    return AB_ERROR;
  }
  command->kind = AB_COMMAND_VELOCITY;
  command->velocity_world_mps[2] = 0.1;
  return AB_OK;
}

static const ab_planner planner = {
    .struct_size = sizeof(ab_planner),
    .abi_version = AVOIDBENCH_ABI_VERSION,
    .name = "hostile",
    .version = "<b>1</b>",
    .summary = HOSTILE,
    .needs = AB_INPUT_STATE | AB_INPUT_DEPTH,
    .commands = AB_COMMAND_VELOCITY,
    .create = create,
    .destroy = destroy,
    .reset = reset,
    .plan = plan,
};

AB_EXPORT const ab_planner* avoidbench_planner_v1(uint32_t host_abi_version) {
  return host_abi_version == AVOIDBENCH_ABI_VERSION ? &planner : NULL;
}
