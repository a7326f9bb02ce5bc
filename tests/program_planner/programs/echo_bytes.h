/* All that a planner was told, as one row of bytes: for comparing what went in with what came out.
 */
#ifndef ECHO_BYTES_H
#define ECHO_BYTES_H

#include <stddef.h>

#include "avoidbench/planner.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct echo_buffer {
  unsigned char* bytes;
  size_t size, room;
} echo_buffer;

void echo_setup(echo_buffer* to, const ab_setup* setup);
void echo_mission(echo_buffer* to, const ab_mission* mission);
void echo_observation(echo_buffer* to, const ab_observation* seen);
/* A command whose numbers are those of the state, each bit of them. */
void echo_command(ab_command* command, const ab_state* state);

#ifdef __cplusplus
}
#endif

#endif
