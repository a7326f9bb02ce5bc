/* What a call gives back: commands that are none, texts without an end, drawings, other answers
 * each time. */
#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "hostile.h"

/* Numbers that are none, or too large for anything. */
static void give_nan(struct Attack* attack) { attack->command->velocity_world_mps[1] = NAN; }
static void give_infinity(struct Attack* attack) { attack->command->yaw_rad = INFINITY; }
static void give_huge(struct Attack* attack) { attack->command->velocity_world_mps[0] = 1e308; }
static void give_denormal(struct Attack* attack) {
  attack->command->velocity_world_mps[2] = 5e-324;
}
static void give_nan_horizon(struct Attack* attack) { attack->command->horizon_s = NAN; }

/* Kinds that there are not, that it did not declare, several at once; flags that there are not. */
static void give_no_kind(struct Attack* attack) { attack->command->kind = 0; }
static void give_undeclared_kind(struct Attack* attack) {
  attack->command->kind = AB_COMMAND_RATES;
}
static void give_all_kinds(struct Attack* attack) { attack->command->kind = UINT32_MAX; }
static void give_flags(struct Attack* attack) { attack->command->flags = UINT32_MAX; }

/* Another size than the host's. */
static void give_size_zero(struct Attack* attack) { attack->command->struct_size = 0; }
static void give_size_huge(struct Attack* attack) { attack->command->struct_size = UINT32_MAX; }

static void give_points(struct Attack* attack, const ab_point* points, uint32_t count) {
  attack->command->kind = AB_COMMAND_TRAJECTORY;
  attack->command->points = points;
  attack->command->point_count = count;
}

/* Points that are nowhere, one, too many, not aligned, in memory that is not its own any more, not
 * in order. */
static void give_points_nowhere(struct Attack* attack) { give_points(attack, NULL, 1000); }
static void give_one_point(struct Attack* attack) {
  static const ab_point kPoint;
  give_points(attack, &kPoint, 1);
}
static void give_endless_points(struct Attack* attack) {
  static const ab_point kPoints[2];
  give_points(attack, kPoints, UINT32_MAX);
}
static void give_points_not_aligned(struct Attack* attack) {
  static char bytes[3 * sizeof(ab_point)];
  give_points(attack, (const ab_point*)(const void*)(bytes + 1), 2);
}
static void give_points_freed(struct Attack* attack) {
  ab_point* volatile points = calloc(2, sizeof(ab_point));
  ab_point* volatile same = points;
  free(points);
  give_points(attack, same, 2);
}
static void give_points_backward(struct Attack* attack) {
  static ab_point points[3];
  for (int i = 0; i < 3; ++i) points[i].time_s = -i;
  give_points(attack, points, 3);
}
static void give_points_at_code(struct Attack* attack) {
  const ab_point* points = NULL;
  memcpy(&points, &attack->host->log, sizeof points);
  give_points(attack, points, 2);
}

/* An answer that there is not. */
static void answer_77(struct Attack* attack) { attack->status = 77; }

/* An error without a text; with 100 MB of it; with what moves a terminal's cursor; that is no
 * UTF-8. */
static void fail_without_text(struct Attack* attack) { attack->status = AB_ERROR; }
static void fail_with(struct Attack* attack, const char* text) {
  attack->host->set_error(attack->host->context, text);
  attack->status = AB_ERROR;
}
static void fail_at_length(struct Attack* attack) {
  const size_t length = 100000000;
  char* text = malloc(length + 1);
  if (text == NULL) return;
  memset(text, 'a', length);
  text[length] = '\0';
  fail_with(attack, text);
  free(text);
}
static void fail_with_controls(struct Attack* attack) {
  fail_with(attack, "\033[2J\033]0;owned\007\r\n\x01\x7f\u202eturned\u202c reason");
}
static void fail_with_broken_text(struct Attack* attack) {
  fail_with(attack, "\xff\xfe\xc0\xaf\xed\xa0\x80 text \xf0\x9f");
}
static void fail_with_null(struct Attack* attack) { fail_with(attack, NULL); }
static void fail_with_formats(struct Attack* attack) {
  fail_with(attack, "%n%s%s%s%n {} '; DROP TABLE trials; --");
}

/* The host's functions with what is not theirs. */
static void log_null(struct Attack* attack) { attack->host->log(attack->host->context, 77, NULL); }
static void log_without_context(struct Attack* attack) { attack->host->set_error(NULL, "text"); }
static void ask_for_extension(struct Attack* attack) {
  attack->host->get_extension(attack->host->context, NULL);
}

static void* set_errors(void* given) {
  const ab_host* host = given;
  while (1)
    host->set_error(host->context,
                    "from another thread, while the host reads it, long enough to be on the heap");
  return NULL;
}

/* A thread that sets the error's text for ever. */
static void set_error_in_thread(struct Attack* attack) {
  start_thread(set_errors, (void*)(uintptr_t)attack->host);
}

/* A drawing of four thousand million points. */
static void draw_endlessly(struct Attack* attack) {
  const ab_debug* debug = attack->host->get_extension(attack->host->context, AB_DEBUG_EXTENSION);
  const double point[3] = {0.0, 0.0, 0.0};
  const ab_drawing drawing = {.struct_size = sizeof drawing,
                              .kind = AB_DRAW_POINTS,
                              .point_count = UINT32_MAX,
                              .points_world_m = point};
  if (debug != NULL) debug->draw(debug->context, &drawing);
}

/* Another flight each time. */
static void fly_by_the_clock(struct Attack* attack) {
  struct timespec now;
  clock_gettime(CLOCK_MONOTONIC, &now);
  attack->command->velocity_world_mps[2] += 1e-10 * (double)now.tv_nsec;
}

/* Back to where it came from, so that the flight lasts as long as it may. */
static void never_arrive(struct Attack* attack) {
  for (int i = 0; i < 3; ++i) attack->command->velocity_world_mps[i] = 0.0;
}

const struct Way kCommandWays[] = {{"give_nan", EACH_CALL, give_nan},
                                   {"give_infinity", EACH_CALL, give_infinity},
                                   {"give_huge", EACH_CALL, give_huge},
                                   {"give_denormal", EACH_CALL, give_denormal},
                                   {"give_nan_horizon", EACH_CALL, give_nan_horizon},
                                   {"give_no_kind", EACH_CALL, give_no_kind},
                                   {"give_undeclared_kind", EACH_CALL, give_undeclared_kind},
                                   {"give_all_kinds", EACH_CALL, give_all_kinds},
                                   {"give_flags", EACH_CALL, give_flags},
                                   {"give_size_zero", EACH_CALL, give_size_zero},
                                   {"give_size_huge", EACH_CALL, give_size_huge},
                                   {"give_points_nowhere", EACH_CALL, give_points_nowhere},
                                   {"give_one_point", EACH_CALL, give_one_point},
                                   {"give_endless_points", EACH_CALL, give_endless_points},
                                   {"give_points_not_aligned", EACH_CALL, give_points_not_aligned},
                                   {"give_points_freed", EACH_CALL, give_points_freed},
                                   {"give_points_backward", EACH_CALL, give_points_backward},
                                   {"give_points_at_code", EACH_CALL, give_points_at_code},
                                   {"answer_77", EACH_CALL, answer_77},
                                   {"fail_without_text", AT_CALL, fail_without_text},
                                   {"fail_at_length", AT_CALL, fail_at_length},
                                   {"fail_with_controls", AT_CALL, fail_with_controls},
                                   {"fail_with_broken_text", AT_CALL, fail_with_broken_text},
                                   {"fail_with_null", AT_CALL, fail_with_null},
                                   {"fail_with_formats", AT_CALL, fail_with_formats},
                                   {"fail_at_reset", AT_RESET, fail_with_controls},
                                   {"log_null", AT_CALL, log_null},
                                   {"log_without_context", AT_CALL, log_without_context},
                                   {"ask_for_extension", AT_CALL, ask_for_extension},
                                   {"set_error_in_thread", AT_CALL, set_error_in_thread},
                                   {"draw_endlessly", AT_CALL, draw_endlessly},
                                   {"fly_by_the_clock", EACH_CALL, fly_by_the_clock},
                                   {"never_arrive", EACH_CALL, never_arrive},
                                   {NULL, AT_CALL, NULL}};
