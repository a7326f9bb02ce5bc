/* A planner that flies straight to the goal and attacks the program under which it flies, in one of
 * the ways of the tables below. */
#ifndef AVOIDBENCH_TESTS_HOSTILE_H
#define AVOIDBENCH_TESTS_HOSTILE_H

#include <stddef.h>
#include <sys/types.h>

#include "avoidbench/planner.h"

/* When a way acts. */
enum Stage {
  AT_CREATE,
  AT_RESET,
  AT_CALL,   /* once a trial, half a second into it */
  EACH_CALL, /* from then on, with the command that would be honest in `command` */
  AT_DESTROY
};

/* What a way can see and change. */
struct Attack {
  const ab_host* host;
  const char* way;
  const char* folder;    /* of the run: results.db, sweep.yaml and planners/ are in it */
  uint32_t metric_count; /* that a result has */
  const ab_observation* observation; /* null but in calls */
  ab_command* command;               /* null but in calls */
  ab_status status;                  /* what the call returns */
};

struct Way {
  const char* name; /* null ends a table */
  enum Stage stage;
  void (*act)(struct Attack*);
};

extern const struct Way kMemoryWays[], kSignalWays[], kProcessWays[], kParentWays[],
    kDescriptorWays[], kFileWays[], kResultWays[], kTimeWays[], kEnvironmentWays[], kCommandWays[],
    kTerminalWays[];

/* What the planner says that it uses, so that the sandbox leaves it that. */
extern const uint32_t kHostileUses;

/* Path of `name` in the run's folder; valid until the next call. */
const char* in_folder(const struct Attack* attack, const char* name);

/* Fails the trial, which so is none that honest planners fly: it could do what it must not. */
void tell_success(struct Attack* attack, const char* what);

/* Sleeps for that long whatever signals come. */
void sleep_s(double seconds);

/* Sleeps until it is killed. */
void sleep_for_ever(void);

/* A child process that does this and then sleeps until it is killed. */
pid_t leave_child(void (*act)(struct Attack*), struct Attack* attack);

/* A detached thread. */
void start_thread(void* (*act)(void*), void* argument);

/* Processes that have this one's parent; returns how many it put into `pids`. */
int siblings(pid_t* pids, int most);

#endif
