/* Speaks the protocol by itself, and breaks it in one way: that of its first argument. Until then,
 * and in all other calls, it is a good planner that gives a velocity. */
#define _GNU_SOURCE
#include <fcntl.h>
#include <pthread.h>
#include <signal.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

#include "avoidbench/planner.h"
#include "avoidbench/process_protocol.h"

enum { SOCKET = 3, SEGMENT = 4 };

static const char* way = "";
static unsigned char* memory;
static ab_process_header header;
static uint64_t used;
static int calls;

static int is(const char* name) { return strcmp(way, name) == 0; }
static int in_plan(uint32_t kind) { return kind == AB_PROCESS_PLAN && calls == 1; }

static uint64_t add(const void* bytes, uint64_t count) {
  const uint64_t at = (used + 7) & ~(uint64_t)7;
  memcpy(memory + header.answer_offset + at, bytes, (size_t)count);
  used = at + count;
  return header.answer_offset + at;
}

static void put_offset(void* pointer, uint64_t offset) { memcpy(pointer, &offset, 8); }

/* A text of that many bytes. */
static uint64_t add_long_text(uint64_t bytes) {
  char* text = malloc((size_t)bytes);
  uint64_t offset;
  memset(text, 'x', (size_t)bytes);
  text[bytes - 1] = 0;
  offset = add(text, bytes);
  free(text);
  return offset;
}

/* A thousand, all of whose texts are one of 200 kB. */
static void add_parameters(ab_planner* planner) {
  const uint64_t text = add_long_text(200000);
  ab_parameter parameter;
  uint64_t offsets[1000];
  int i;
  memset(&parameter, 0, sizeof parameter);
  parameter.struct_size = sizeof parameter;
  put_offset(&parameter.name, text);
  put_offset(&parameter.unit, text);
  put_offset(&parameter.doc, text);
  put_offset(&parameter.choices, text);
  put_offset(&parameter.preset_text, text);
  offsets[0] = add(&parameter, sizeof parameter);
  for (i = 1; i < 1000; ++i) offsets[i] = offsets[0];
  planner->parameter_count = 1000;
  put_offset(&planner->parameters, add(offsets, sizeof offsets));
}

static uint64_t describe(void) {
  ab_planner planner;
  ab_process_description description;
  memset(&planner, 0, sizeof planner);
  memset(&description, 0, sizeof description);
  planner.struct_size = is("table_short") ? offsetof(ab_planner, get_extension) : sizeof planner;
  planner.abi_version = AVOIDBENCH_ABI_VERSION;
  put_offset(&planner.name, add("hostile", 8));
  put_offset(&planner.version, add("1", 2));
  put_offset(&planner.summary, add("Breaks the protocol.", 21));
  if (is("name_null")) put_offset(&planner.name, 0);
  if (is("name_outside")) put_offset(&planner.name, 16);
  if (is("name_long")) put_offset(&planner.name, add_long_text(4000000));
  planner.needs = AB_INPUT_STATE | AB_INPUT_POINTS | AB_INPUT_TRACKS | AB_INPUT_GOALS;
  planner.commands = AB_COMMAND_VELOCITY | AB_COMMAND_TRAJECTORY;
  if (is("parameters_many")) {
    planner.parameter_count = 999;
    put_offset(&planner.parameters, header.answer_offset + 64);
  }
  if (is("parameters_too_many")) planner.parameter_count = 0xffffffffu;
  if (is("parameters_of_one_text")) add_parameters(&planner);
  description.struct_size = sizeof description;
  description.protocol = is("other_protocol") ? 2 : AB_PROCESS_PROTOCOL;
  description.planner = add(&planner, sizeof planner);
  if (is("planner_outside")) description.planner = UINT64_MAX - 8;
  if (is("planner_before")) description.planner = 0;
  if (is("planner_at_end")) description.planner = header.answer_offset + used - 4;
  return add(&description, sizeof description);
}

/* What the request shows, offsets in the pointers' places. */
static ab_observation shown(const ab_process_request* request) {
  ab_observation observation;
  memcpy(&observation, memory + request->body, sizeof observation);
  return observation;
}

static uint64_t offset_in(const void* pointer) {
  uint64_t offset;
  memcpy(&offset, &pointer, sizeof offset);
  return offset;
}

static uint64_t command(const ab_process_request* request) {
  ab_command given;
  ab_point points[2];
  memset(&given, 0, sizeof given);
  memset(points, 0, sizeof points);
  points[1].time_s = 1.0;
  given.struct_size = is("command_short") ? 8 : sizeof given;
  given.kind = AB_COMMAND_VELOCITY;
  given.velocity_world_mps[0] = 1.0;
  if (strncmp(way, "points_", 7) == 0) {
    given.kind = AB_COMMAND_TRAJECTORY;
    given.point_count = is("points_many") ? 0xffffffffu : 2;
    put_offset(&given.points, is("points_outside") ? header.answer_offset + header.answer_bytes
                                                   : add(points, sizeof points));
    if (is("points_wrap")) put_offset(&given.points, UINT64_MAX - 100);
    if (is("points_are_the_tracks")) {
      put_offset(&given.points, offset_in(shown(request).tracks));
    }
  }
  return is("command_outside") ? header.request_offset : add(&given, sizeof given);
}

static void stay(void) {
  for (;;) pause();
}

static void* flip(void* unused) {
  volatile uint64_t* size = (volatile uint64_t*)(void*)(memory + header.answer_offset + 16 + 0);
  (void)unused;
  for (;;) {
    *size = UINT64_MAX;
    *size = 64;
  }
  return NULL;
}

/* What is done in the middle of the first plan(). */
static void misbehave(void) {
  if (is("exit")) exit(3);
  if (is("exit_well")) exit(0);
  if (is("segfault")) {
    signal(SIGSEGV, SIG_DFL);  // a sanitizer's handler would exit instead
    raise(SIGSEGV);
  }
  if (is("abort")) abort();
  if (is("kill")) kill(getpid(), SIGKILL);
  if (is("close_socket")) {
    close(SOCKET);
    stay();
  }
  if (is("close_all")) {
    int fd;
    for (fd = 0; fd < 64; ++fd) close(fd);
    stay();
  }
  if (is("says_and_exits")) {
    fprintf(stderr, "first words\nthe \033[31mlast\033[0m words\n\n");
    exit(4);
  }
  if (is("flood")) {
    char line[65536];
    int i;
    memset(line, 'x', sizeof line);
    line[sizeof line - 1] = '\n';
    for (i = 0; i < 4096; ++i) {
      if (write(i % 2 == 0 ? 1 : 2, line, sizeof line) < 0) break;
    }
  }
  if (is("fork_and_exit")) {
    if (fork() == 0) stay();
    exit(5);
  }
  if (is("fork_of_its_own_and_exit")) {
    if (fork() == 0) {
      setsid();
      stay();
    }
    usleep(20000);
    exit(5);
  }
  if (is("fork_comes_back") && fork() == 0) usleep(50000);
  if (is("grow")) {
    if (ftruncate(SEGMENT, (off_t)1 << 40) != 0) exit(6);
  }
  if (is("shrink") && ftruncate(SEGMENT, 0) == 0) exit(6);
  if (is("scribble")) memset(memory, 0xff, (size_t)header.answer_offset);
  if (is("scribble_requests")) memset(memory + header.request_offset, 0xff, 65536);
  if (is("race")) {
    pthread_t thread;
    pthread_create(&thread, NULL, flip, NULL);
  }
  if (is("no_death_signal")) prctl(PR_SET_PDEATHSIG, 0);
  if (is("stop")) raise(SIGSTOP);
  if (is("busy")) {
    const clock_t end = clock() + CLOCKS_PER_SEC / 20;
    while (clock() < end) {
    }
  }
  if (is("sleepy")) usleep(50000);
  if (is("spin")) {
    for (;;) calls = 1;
  }
}

static void answer(const ab_process_request* request) {
  ab_process_answer given;
  memset(&given, 0, sizeof given);
  used = sizeof given;
  given.sequence = request->sequence;
  given.kind = request->kind;
  if (request->kind == AB_PROCESS_HELLO) {
    if (is("exit_in_hello")) exit(9);
    given.body = describe();
    if (is("no_description")) given.body = 0;
    if (is("refuses")) {
      given.status = AB_ERROR;
      given.error = add("not today", 10);
    }
  }
  if (request->kind == AB_PROCESS_CREATE && is("create_fails")) {
    given.status = AB_ERROR;
    given.error = add("no memory for it", 17);
  }
  if (request->kind == AB_PROCESS_CREATE && is("exit_in_create")) exit(7);
  if (request->kind == AB_PROCESS_RESET && is("exit_in_reset")) exit(8);
  if (request->kind == AB_PROCESS_DESTROY && is("exit_in_destroy")) exit(8);
  if (request->kind == AB_PROCESS_PLAN) {
    ++calls;
    if (calls == 1) misbehave();
    given.body = command(request);
    if (calls == 1 && is("status")) given.status = 99;
    if (calls == 1 && is("silent_error")) given.status = AB_ERROR;
    if (calls == 1 && is("body_null")) given.body = 0;
    if (calls == 1 && is("error_outside")) given.error = 1;
    if (calls == 1 && is("error_in_the_sweeps")) given.error = offset_in(shown(request).clouds);
    if (calls == 1 && is("scribble_sweeps")) {
      /* All that the request shows: counts, points, misses, tracks and the goal. */
      memset(memory + header.request_offset + sizeof *request, 0xff,
             (size_t)request->bytes - sizeof *request);
    }
    if (calls == 1 && is("error_without_end")) {
      given.error = add("xxxxxxxx", 8);
    }
    if (calls == 1 && is("log_many")) given.log_count = 0xffffffffu;
    if (calls == 1 && is("log_of_one_text")) {
      ab_process_log lines[1000];
      int i;
      memset(lines, 0, sizeof lines);
      lines[0].text = add_long_text(4000000);
      for (i = 1; i < 1000; ++i) lines[i] = lines[0];
      given.log = add(lines, sizeof lines);
      given.log_count = 1000;
    }
    if (calls == 1 && is("log_outside")) {
      given.log_count = 3;
      given.log = header.answer_offset + used - 8;
    }
    if (calls == 1 && is("old_answer")) given.sequence -= 1;
    if (calls == 1 && is("other_kind")) given.kind = AB_PROCESS_RESET;
  }
  given.bytes = used;
  if (in_plan(request->kind) && is("size_huge")) given.bytes = UINT64_MAX;
  if (in_plan(request->kind) && is("size_small")) given.bytes = 63;
  if (in_plan(request->kind) && is("size_zero")) given.bytes = 0;
  memcpy(memory + header.answer_offset, &given, sizeof given);
}

static void send_word(const ab_process_request* request) {
  ab_process_word words[3];
  size_t size = sizeof words[0];
  memset(words, 0, sizeof words);
  words[0].sequence = request->sequence;
  words[0].kind = request->kind;
  words[1] = words[0];
  if (in_plan(request->kind)) {
    if (is("word_sequence")) words[0].sequence += 1;
    if (is("word_kind")) words[0].kind = 77;
    if (is("half_word")) size = 4;
    if (is("two_words")) size = 2 * sizeof words[0];
    if (is("many_words")) size = sizeof words;
    if (is("garbage")) memset(words, 0xee, sizeof words);
  }
  if (write(SOCKET, words, size) < 0) exit(1);
}

int main(int argc, char** argv) {
  ab_process_word word;
  if (argc > 1) way = argv[1];
  if (is("exit_at_once")) return 2;
  if (is("words_at_once") && write(SOCKET, "rubbish!rubbish!", 16) < 0) return 1;
  memory = (unsigned char*)mmap(NULL, 4096, PROT_READ | PROT_WRITE, MAP_SHARED, SEGMENT, 0);
  while (read(SOCKET, &word, sizeof word) == (ssize_t)sizeof word) {
    ab_process_request request;
    if (header.segment_bytes == 0) {
      memcpy(&header, memory, sizeof header);
      memory = (unsigned char*)mmap(NULL, (size_t)header.segment_bytes, PROT_READ | PROT_WRITE,
                                    MAP_SHARED, SEGMENT, 0);
    }
    memcpy(&request, memory + header.request_offset, sizeof request);
    if (request.kind == AB_PROCESS_RESET) calls = 0;
    answer(&request);
    send_word(&request);
  }
  return 0;
}
