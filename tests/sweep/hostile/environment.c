/* What all of a process shares: locale, floating point, folders, variables, libraries, ports. */
#include <arpa/inet.h>
#include <dlfcn.h>
#include <fenv.h>
#include <immintrin.h>
#include <locale.h>
#include <math.h>
#include <sched.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/inotify.h>
#include <sys/personality.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <unistd.h>

#include "hostile.h"

extern char** environ;

/* Numbers with a comma, from now on; and a trial whose reason has a number in it. */
static void write_commas(struct Attack* attack) {
  (void)attack;
  setlocale(LC_ALL, "de_DE.UTF-8");
}
static void write_commas_and_fail(struct Attack* attack) {
  setlocale(LC_ALL, "de_DE.UTF-8");
  attack->command->velocity_world_mps[0] = INFINITY;
}

/* Rounds up; takes the smallest numbers for zero; computes x87 numbers in single precision. */
static void round_up(struct Attack* attack) {
  (void)attack;
  fesetround(FE_UPWARD);
}
static void flush_to_zero(struct Attack* attack) {
  (void)attack;
  _mm_setcsr(_mm_getcsr() | 0x8040U);
}
static void round_x87(struct Attack* attack) {
  (void)attack;
  const uint16_t single = 0x007f;
  __asm__ volatile("fldcw %0" : : "m"(single));
}

/* Leaves the vector registers in a state in which x87 computes nothing right. */
static void leave_mmx(struct Attack* attack) {
  (void)attack;
  __asm__ volatile("pxor %%mm0, %%mm0" : : : "mm0");
}

/* Leaves the direction flag set: copies run backward. */
static void run_backward(struct Attack* attack) {
  (void)attack;
  __asm__ volatile("std" : : : "cc");
}

/* Checks the alignment of every access from now on. */
static void check_alignment(struct Attack* attack) {
  (void)attack;
  __asm__ volatile("pushf\n\torl $0x40000, (%%rsp)\n\tpopf" : : : "cc", "memory");
}

/* Elsewhere; without a root; every file open to everybody. */
static void change_folder(struct Attack* attack) {
  (void)attack;
  (void)!chdir("/");
}
static void change_root(struct Attack* attack) { (void)!chroot(attack->folder); }
static void open_mask(struct Attack* attack) {
  (void)attack;
  umask(0);
}
static void close_mask(struct Attack* attack) {
  (void)attack;
  umask(0777);
}

/* Other variables; none at all. */
static void set_variables(struct Attack* attack) {
  setenv("LD_PRELOAD", in_folder(attack, "planners/hostile.so"), 1);
  setenv("GLIBC_TUNABLES", "glibc.malloc.perturb=85", 1);
  setenv("AVOIDBENCH_PLANNER_PATH", "/nonexistent", 1);
  setenv("LD_LIBRARY_PATH", "/nonexistent", 1);
}
static void clear_variables(struct Attack* attack) {
  (void)attack;
  environ = NULL;
}

/* Another state of what the C library draws. */
static void seed_draws(struct Attack* attack) {
  (void)attack;
  srand(1);
  srand48(1);
}

/* Another personality, another share of the processors, another policy. */
static void change_personality(struct Attack* attack) {
  (void)attack;
  personality(ADDR_NO_RANDOMIZE | READ_IMPLIES_EXEC | ADDR_LIMIT_32BIT);
}
static void hurry(struct Attack* attack) {
  (void)attack;
  const struct sched_param first = {.sched_priority = 1};
  sched_setscheduler(0, SCHED_FIFO, &first);
  setpriority(PRIO_PROCESS, 0, -20);
}
static void dawdle(struct Attack* attack) {
  (void)attack;
  const struct sched_param none = {0};
  cpu_set_t first;
  CPU_ZERO(&first);
  CPU_SET(0, &first);
  sched_setaffinity(0, sizeof first, &first);
  setpriority(PRIO_PROCESS, 0, 19);
  sched_setscheduler(0, SCHED_IDLE, &none);
}

/* Takes its own library out, or loads another copy, or one of the host's. */
static void unload_itself(struct Attack* attack) {
  void* library = dlopen(in_folder(attack, "planners/hostile.so"), RTLD_NOW | RTLD_NOLOAD);
  for (int i = 0; i < 10 && library != NULL; ++i) {
    if (dlclose(library) != 0) break;
  }
}
static void load_good_planner(struct Attack* attack) {
  dlopen(in_folder(attack, "planners/reactive.so"), RTLD_NOW | RTLD_GLOBAL);
}

static int bound_socket(uint16_t port) {
  const int fd = socket(AF_INET, SOCK_STREAM, 0);
  struct sockaddr_in here = {
      .sin_family = AF_INET, .sin_port = htons(port), .sin_addr = {htonl(INADDR_LOOPBACK)}};
  struct sockaddr any;
  memcpy(&any, &here, sizeof any);
  if (bind(fd, &any, sizeof here) != 0) return -1;
  listen(fd, 8);
  return fd;
}

/* Listens on a port. */
static void listen_on_port(struct Attack* attack) {
  (void)attack;
  bound_socket(0);
}

/* Waits for a call that nobody makes, in a child that stays. */
static void accept_for_ever(struct Attack* attack) {
  (void)attack;
  accept(bound_socket(0), NULL, NULL);
}
static void leave_server(struct Attack* attack) { leave_child(accept_for_ever, attack); }

/* A socket in the run's folder. */
static void leave_socket(struct Attack* attack) {
  struct sockaddr_un here = {.sun_family = AF_UNIX};
  snprintf(here.sun_path, sizeof here.sun_path, "%.90s/hostile", attack->folder);
  struct sockaddr_storage any;
  memset(&any, 0, sizeof any);
  memcpy(&any, &here, sizeof here);
  const int fd = socket(AF_UNIX, SOCK_STREAM, 0);
  if (bind(fd, (const struct sockaddr*)(const void*)&any, sizeof here) == 0) listen(fd, 8);
}

/* Sockets whose sender chooses who receives, as of the system's log: for none there is a need. */
static void send_datagram(struct Attack* attack) {
  int ends[2];
  const int kinds[] = {SOCK_DGRAM, SOCK_RAW, SOCK_DGRAM | SOCK_CLOEXEC | SOCK_NONBLOCK};
  for (size_t i = 0; i < sizeof kinds / sizeof kinds[0]; ++i) {
    if (socketpair(AF_UNIX, kinds[i], 0, ends) == 0) tell_success(attack, "a datagram socket");
  }
}

/* Calls a machine that does not answer. */
static void call_nobody(struct Attack* attack) {
  (void)attack;
  const int fd = socket(AF_INET, SOCK_STREAM, 0);
  struct sockaddr_in there = {
      .sin_family = AF_INET, .sin_port = htons(9), .sin_addr = {htonl(0xc0000201U)}};
  struct sockaddr any;
  memcpy(&any, &there, sizeof any);
  (void)!connect(fd, &any, sizeof there);
}

/* Watches what the run does with its files. */
static void watch_folder(struct Attack* attack) {
  inotify_add_watch(inotify_init1(IN_NONBLOCK), attack->folder, IN_ALL_EVENTS);
}

const struct Way kEnvironmentWays[] = {{"write_commas", AT_CALL, write_commas},
                                       {"write_commas_and_fail", EACH_CALL, write_commas_and_fail},
                                       {"round_up", AT_CALL, round_up},
                                       {"round_up_at_create", AT_CREATE, round_up},
                                       {"flush_to_zero", AT_CALL, flush_to_zero},
                                       {"flush_to_zero_at_reset", AT_RESET, flush_to_zero},
                                       {"round_x87", AT_CALL, round_x87},
                                       {"leave_mmx", AT_CALL, leave_mmx},
                                       {"run_backward", AT_CALL, run_backward},
                                       {"check_alignment", AT_CALL, check_alignment},
                                       {"change_folder", AT_CALL, change_folder},
                                       {"change_root", AT_CALL, change_root},
                                       {"open_mask", AT_CALL, open_mask},
                                       {"close_mask", AT_CALL, close_mask},
                                       {"set_variables", AT_CALL, set_variables},
                                       {"clear_variables", AT_CALL, clear_variables},
                                       {"seed_draws", AT_CALL, seed_draws},
                                       {"change_personality", AT_CALL, change_personality},
                                       {"hurry", AT_CALL, hurry},
                                       {"dawdle", AT_CALL, dawdle},
                                       {"unload_itself", AT_CALL, unload_itself},
                                       {"load_good_planner", AT_CALL, load_good_planner},
                                       {"listen_on_port", AT_CALL, listen_on_port},
                                       {"leave_server", AT_CALL, leave_server},
                                       {"leave_socket", AT_CALL, leave_socket},
                                       {"send_datagram", AT_CALL, send_datagram},
                                       {"call_nobody", AT_CALL, call_nobody},
                                       {"watch_folder", AT_CALL, watch_folder},
                                       {NULL, AT_CALL, NULL}};
