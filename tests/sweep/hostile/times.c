/* Calls that do not come back, ends that do not end, limits and clocks. */
#include <math.h>
#include <pthread.h>
#include <signal.h>
#include <stdlib.h>
#include <sys/resource.h>
#include <sys/time.h>
#include <unistd.h>

#include "hostile.h"

/* Computes for ever. */
static void spin(struct Attack* attack) {
  (void)attack;
  for (volatile int i = 0;; ++i) {
  }
}

/* Sleeps for ever. */
static void sleep_in_call(struct Attack* attack) {
  (void)attack;
  sleep_for_ever();
}

/* Half the time that a call has, in every call. */
static void sleep_in_each_call(struct Attack* attack) {
  (void)attack;
  sleep_s(0.5);
}

/* Waits for a lock that it holds itself. */
static void wait_for_itself(struct Attack* attack) {
  (void)attack;
  pthread_mutex_t mutex = PTHREAD_MUTEX_INITIALIZER;
  pthread_mutex_lock(&mutex);
  pthread_mutex_lock(&mutex);
}

/* Leaves, as if all were well. */
static void exit_well(struct Attack* attack) {
  (void)attack;
  exit(0);
}
static void exit_at_once(struct Attack* attack) {
  (void)attack;
  _exit(0);
}
static void exit_quickly(struct Attack* attack) {
  (void)attack;
  quick_exit(0);
}

/* Leaves with the codes with which workers say why. */
static void exit_as_hung(struct Attack* attack) {
  (void)attack;
  _exit(86);
}
static void exit_as_stopped(struct Attack* attack) {
  (void)attack;
  _exit(75);
}

static void leave_well(void) { _exit(0); }
static void hang(void) { sleep_for_ever(); }

/* What is to be done at the end does not end; ends too well; crashes. */
static void hang_at_exit(struct Attack* attack) {
  (void)attack;
  atexit(hang);
}
static void hang_at_exit_now(struct Attack* attack) {
  (void)attack;
  atexit(hang);
  exit(0);
}
static void leave_at_exit(struct Attack* attack) {
  (void)attack;
  atexit(leave_well);
}
static void abort_at_exit(struct Attack* attack) {
  (void)attack;
  atexit(abort);
}

static void limit(int resource, rlim_t most) {
  const struct rlimit to = {most, most};
  setrlimit(resource, &to);
}

/* A second of processor time is all that it has, and it spends it. */
static void limit_time(struct Attack* attack) {
  limit(RLIMIT_CPU, 1);
  spin(attack);
}

/* No descriptors, no memory, no files, no stack for what comes. */
static void limit_descriptors(struct Attack* attack) {
  (void)attack;
  limit(RLIMIT_NOFILE, 0);
}
static void limit_memory(struct Attack* attack) {
  (void)attack;
  limit(RLIMIT_AS, 1 << 20);
}
static void limit_files(struct Attack* attack) {
  (void)attack;
  limit(RLIMIT_FSIZE, 0);
}
static void limit_stack(struct Attack* attack) {
  (void)attack;
  limit(RLIMIT_STACK, 16384);
}

/* A picture of all its memory as it crashes. */
static void dump_core(struct Attack* attack) {
  (void)attack;
  limit(RLIMIT_CORE, RLIM_INFINITY);
  signal(SIGABRT, SIG_DFL);
  abort();
}

/* Moves the machine's clock by a microsecond. */
static void move_clock(struct Attack* attack) {
  (void)attack;
  const struct timeval by = {0, 1};
  adjtime(&by, NULL);
}

const struct Way kTimeWays[] = {{"spin", AT_CALL, spin},
                                {"spin_at_reset", AT_RESET, spin},
                                {"spin_at_create", AT_CREATE, spin},
                                {"spin_at_destroy", AT_DESTROY, spin},
                                {"sleep_in_call", AT_CALL, sleep_in_call},
                                {"sleep_in_each_call", EACH_CALL, sleep_in_each_call},
                                {"wait_for_itself", AT_CALL, wait_for_itself},
                                {"exit_well", AT_CALL, exit_well},
                                {"exit_at_create", AT_CREATE, exit_well},
                                {"exit_at_reset", AT_RESET, exit_well},
                                {"exit_at_once", AT_CALL, exit_at_once},
                                {"exit_quickly", AT_CALL, exit_quickly},
                                {"exit_as_hung", AT_CALL, exit_as_hung},
                                {"exit_as_stopped", AT_CALL, exit_as_stopped},
                                {"hang_at_exit", AT_CALL, hang_at_exit},
                                {"hang_at_exit_now", AT_CALL, hang_at_exit_now},
                                {"leave_at_exit", AT_CALL, leave_at_exit},
                                {"abort_at_exit", AT_CALL, abort_at_exit},
                                {"limit_time", AT_CALL, limit_time},
                                {"limit_descriptors", AT_CALL, limit_descriptors},
                                {"limit_memory", AT_CALL, limit_memory},
                                {"limit_files", AT_CALL, limit_files},
                                {"limit_stack", AT_CALL, limit_stack},
                                {"dump_core", AT_CALL, dump_core},
                                {"move_clock", AT_CALL, move_clock},
                                {NULL, AT_CALL, NULL}};
