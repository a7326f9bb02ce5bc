/* Results that no flight had, written to the parent as if the worker had sent them
 * (lib/bench/worker/message.cpp). */
#include <fcntl.h>
#include <signal.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "hostile.h"

enum { kMagicParts = 3 };
static const uint64_t kMagic = 0x6176426e4d736731;

static void write_all_pipes(const void* bytes, size_t size) {
  for (int fd = 3; fd < 16; ++fd) {
    const int flags = fcntl(fd, F_GETFL);
    if (flags < 0 || (flags & O_ACCMODE) == O_RDONLY) continue;
    (void)!write(fd, bytes, size);
  }
}

/* Header, text and bytes in one write, so that nothing comes between them. */
static void send_as_result(const char* text, size_t bytes) {
  const uint64_t sizes[kMagicParts] = {kMagic, strlen(text), bytes};
  const size_t size = sizeof sizes + strlen(text) + bytes;
  char* message = calloc(size, 1);
  if (message == NULL) return;
  memcpy(message, sizes, sizeof sizes);
  memcpy(message + sizeof sizes, text, strlen(text));
  write_all_pipes(message, size);
  free(message);
}

/* "[1,1,…]", as many as a result has metrics. */
static const char* metrics_of(const struct Attack* attack, const char* value) {
  static char list[16384];
  size_t length = (size_t)snprintf(list, sizeof list, "[");
  for (uint32_t i = 0; i < attack->metric_count; ++i) {
    length +=
        (size_t)snprintf(list + length, sizeof list - length, "%s%s", i == 0 ? "" : ",", value);
  }
  snprintf(list + length, sizeof list - length, "]");
  return list;
}

static const char* forged_trial(const struct Attack* attack, const char* end_time,
                                const char* metric) {
  static char text[20000];
  snprintf(text, sizeof text,
           "{\"token\":\"00000000000000000000000000000000\",\"error\":\"\",\"is_out_of_memory\":"
           "false,\"wall_time_s\":0.5,\"metrics\":%s,\"trial\":{"
           "\"collisions\":[],\"end_time_s\":%s,\"outcome\":\"reached_goal\",\"plan_calls\":\"[]\","
           "\"reason\":\"forged\"}}",
           metrics_of(attack, metric), end_time);
  return text;
}

/* A whole result: it reached the goal. */
static void forge_result(struct Attack* attack) {
  send_as_result(forged_trial(attack, "0.125", "1.0"), (size_t)22 * 8 * 3);
}

/* The same and off, before the true one comes. */
static void forge_result_and_exit(struct Attack* attack) {
  forge_result(attack);
  _exit(0);
}

/* The same and no more. */
static void forge_result_and_hang(struct Attack* attack) {
  forge_result(attack);
  sleep_for_ever();
}

/* Three of them: for this trial and those that come. */
static void forge_three_results(struct Attack* attack) {
  for (int i = 0; i < 3; ++i) forge_result(attack);
}

/* Its numbers are none. */
static void forge_nan(struct Attack* attack) {
  send_as_result(forged_trial(attack, "0.125", "\"nan\""), 0);
}
static void forge_null(struct Attack* attack) {
  send_as_result(forged_trial(attack, "null", "null"), 0);
}

#define SENDS(name, text, bytes)            \
  static void name(struct Attack* attack) { \
    (void)attack;                           \
    send_as_result(text, bytes);            \
  }
/* An object with nothing in it; no object; fields that are missing or of another kind. */
SENDS(forge_empty, "{}", 0)
SENDS(forge_list, "[1,2,3]", 0)
SENDS(forge_text, "this is not JSON", 0)
SENDS(forge_half,
      "{\"token\":\"00000000000000000000000000000000\",\"error\":\"\",\"is_out_of_memory\":false,"
      "\"wall_time_s\":0.5,\"trial\":{}}",
      0)
SENDS(forge_kinds,
      "{\"token\":\"00000000000000000000000000000000\",\"error\":7,\"is_out_of_memory\":\"no\","
      "\"wall_time_s\":[],\"trial\":7,\"metrics\":{}}",
      0)
SENDS(
    forge_outcome,
    "{\"token\":\"00000000000000000000000000000000\",\"error\":\"\",\"is_out_of_memory\":false,"
    "\"wall_time_s\":0.5,\"metrics\":[],\"trial\":{"
    "\"collisions\":[],"
    "\"end_time_s\":0.125,\"outcome\":\"won\",\"plan_calls\":\"not JSON\",\"reason\":\"forged\"}}",
    0)
/* The map, in place of a trial. */
SENDS(
    forge_map,
    "{\"token\":\"00000000000000000000000000000000\",\"error\":\"\",\"is_out_of_memory\":false,"
    "\"wall_time_s\":0.5,\"map\":{\"world_digest\":"
    "\"forged\","
    "\"obstacle_count\":0,\"triangle_count\":0,\"traversability\":1,\"traversability_normalized_"
    "ratio\":1,"
    "\"relative_gap_size\":1,\"obstacle_density_1pm2\":0,\"free_volume_ratio\":1,\"missions\":[]}}",
    0)
/* What would end the whole run. */
SENDS(forge_error,
      "{\"token\":\"00000000000000000000000000000000\",\"error\":\"forged\",\"is_out_of_memory\":"
      "false,\"wall_time_s\":0.5}",
      0)
SENDS(forge_out_of_memory,
      "{\"token\":\"00000000000000000000000000000000\",\"error\":\"\",\"is_out_of_memory\":true,"
      "\"wall_time_s\":0.5}",
      0)
SENDS(forge_nothing,
      "{\"token\":\"00000000000000000000000000000000\",\"error\":\"\",\"is_out_of_memory\":false,"
      "\"wall_time_s\":0.5}",
      0)

/* Brackets, thirty thousand deep. */
static void forge_depth(struct Attack* attack) {
  (void)attack;
  const size_t depth = 30000;
  char* text = calloc(2 * depth + 64, 1);
  if (text == NULL) return;
  size_t length =
      (size_t)sprintf(text, "{\"token\":\"00000000000000000000000000000000\",\"error\":");
  memset(text + length, '[', depth);
  memset(text + length + depth, ']', depth);
  text[length + 2 * depth] = '}';
  send_as_result(text, 0);
  free(text);
}

static void send_header(uint64_t text, uint64_t bytes, size_t how_much) {
  const uint64_t sizes[kMagicParts] = {kMagic, text, bytes};
  write_all_pipes(sizes, how_much);
}

/* Half a header, then nothing. */
static void send_half_a_header(struct Attack* attack) {
  (void)attack;
  send_header(100, 100, 12);
  sleep_for_ever();
}

/* Half a header, then it flies on. */
static void send_half_a_header_and_go_on(struct Attack* attack) {
  (void)attack;
  send_header(100, 100, 12);
}

/* A whole header of a message that never comes. */
static void send_header_only(struct Attack* attack) {
  (void)attack;
  send_header(1000000, 1000000, 24);
  sleep_for_ever();
}

/* A header of twice 4 GiB. */
static void send_huge_header(struct Attack* attack) {
  (void)attack;
  send_header(1ULL << 32U, 1ULL << 32U, 24);
  sleep_for_ever();
}

/* A header of all that 64 bits can say. */
static void send_endless_header(struct Attack* attack) {
  (void)attack;
  send_header(UINT64_MAX, UINT64_MAX, 24);
}

/* A message that is stopped in the middle of. */
static void stop_in_a_message(struct Attack* attack) {
  (void)attack;
  send_header(100, 100, 24);
  raise(SIGSTOP);
}

static void* send_slowly(void* nothing) {
  (void)nothing;
  const uint64_t sizes[kMagicParts] = {kMagic, 1000, 1000};
  write_all_pipes(sizes, sizeof sizes);
  while (1) {
    write_all_pipes(" ", 1);
    sleep_s(0.1);
  }
  return NULL;
}

/* A byte each tenth of a second. */
static void send_for_ever(struct Attack* attack) {
  (void)attack;
  start_thread(send_slowly, NULL);
  sleep_for_ever();
}

/* A true message's bytes: 512 MiB of them. */
static void send_much(struct Attack* attack) {
  (void)attack;
  send_header(2, 512ULL << 20U, 24);
  static char block[1 << 20];
  for (int i = 0; i < 512; ++i) write_all_pipes(block, sizeof block);
}

const struct Way kResultWays[] = {
    {"forge_result", AT_CALL, forge_result},
    {"forge_result_and_exit", AT_CALL, forge_result_and_exit},
    {"forge_result_and_hang", AT_CALL, forge_result_and_hang},
    {"forge_three_results", AT_CALL, forge_three_results},
    {"forge_result_at_create", AT_CREATE, forge_result},
    {"forge_nan", AT_CALL, forge_nan},
    {"forge_null", AT_CALL, forge_null},
    {"forge_empty", AT_CALL, forge_empty},
    {"forge_list", AT_CALL, forge_list},
    {"forge_text", AT_CALL, forge_text},
    {"forge_half", AT_CALL, forge_half},
    {"forge_kinds", AT_CALL, forge_kinds},
    {"forge_outcome", AT_CALL, forge_outcome},
    {"forge_map", AT_CALL, forge_map},
    {"forge_error", AT_CALL, forge_error},
    {"forge_out_of_memory", AT_CALL, forge_out_of_memory},
    {"forge_nothing", AT_CALL, forge_nothing},
    {"forge_depth", AT_CALL, forge_depth},
    {"send_half_a_header", AT_CALL, send_half_a_header},
    {"send_half_a_header_and_go_on", AT_CALL, send_half_a_header_and_go_on},
    {"send_header_only", AT_CALL, send_header_only},
    {"send_huge_header", AT_CALL, send_huge_header},
    {"send_endless_header", AT_CALL, send_endless_header},
    {"stop_in_a_message", AT_CALL, stop_in_a_message},
    {"send_for_ever", AT_CALL, send_for_ever},
    {"send_much", AT_CALL, send_much},
    {NULL, AT_CALL, NULL}};
