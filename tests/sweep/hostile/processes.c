/* Children, grandchildren, threads, and this process turned into something else. */
#include <pthread.h>
#include <sched.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <sys/prctl.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include "hostile.h"

/* Parent and child both come back from the call: two answers to one job. */
static void fork_and_return(struct Attack* attack) {
  (void)attack;
  (void)!fork();
}

/* The mistake by which that happens: a program that is not there, and no _exit. */
static void fork_and_fail_to_exec(struct Attack* attack) {
  (void)attack;
  if (fork() == 0) execlp("no_such_helper", "no_such_helper", (char*)NULL);
}

/* The child answers, the parent waits for it. */
static void let_the_child_answer(struct Attack* attack) {
  (void)attack;
  const pid_t child = fork();
  if (child > 0) waitpid(child, NULL, 0);
}

/* Two hundred children that stay. */
static void fork_two_hundred(struct Attack* attack) {
  for (int i = 0; i < 200; ++i) leave_child(NULL, attack);
}

/* Two hundred processes, each the child of the one before, which is gone. */
static void fork_chain(struct Attack* attack) {
  (void)attack;
  if (fork() != 0) return;
  for (int i = 0; i < 200; ++i) {
    if (fork() != 0) _exit(0);
    sleep_s(0.005);
  }
  sleep_for_ever();
}

/* A daemon: of another session, of another parent. */
static void leave_daemon(struct Attack* attack) {
  (void)attack;
  if (fork() != 0) return;
  setsid();
  if (fork() != 0) _exit(0);
  for (int fd = 0; fd < 64; ++fd) close(fd);
  sleep_for_ever();
}

/* A child keeps the pipes open, and the planner crashes. */
static void leave_child_with_pipes(struct Attack* attack) {
  leave_child(NULL, attack);
  abort();
}

/* A daemon that keeps the pipes open, and the planner leaves. */
static void leave_daemon_with_pipes(struct Attack* attack) {
  (void)attack;
  if (fork() == 0) {
    setsid();
    if (fork() != 0) _exit(0);
    sleep_for_ever();
  }
  _exit(0);
}

static void write_later(struct Attack* attack) {
  (void)attack;
  for (int i = 0; i < 20; ++i) {
    sleep_s(0.05);
    for (int fd = 3; fd < 32; ++fd) (void)!write(fd, "from the child", 14);
  }
}

/* A child that writes into the pipes while the next trial flies. */
static void leave_child_that_writes(struct Attack* attack) { leave_child(write_later, attack); }

/* A child that uses a processor for ever. */
static void spin(struct Attack* attack) {
  (void)attack;
  for (volatile int i = 0;; ++i) {
  }
}
static void leave_child_that_spins(struct Attack* attack) { leave_child(spin, attack); }

/* A child that no signal but SIGKILL ends and that follows no parent. */
static void ignore_all(struct Attack* attack) {
  (void)attack;
  for (int number = 1; number < 65; ++number) signal(number, SIG_IGN);
  prctl(PR_SET_PDEATHSIG, 0);
  setsid();
}
static void leave_child_that_ignores(struct Attack* attack) { leave_child(ignore_all, attack); }

/* A child that stands still. */
static void stop_itself(struct Attack* attack) {
  (void)attack;
  raise(SIGSTOP);
}
static void leave_child_stopped(struct Attack* attack) { leave_child(stop_itself, attack); }

/* A child whose parent is the run itself. */
static void leave_sibling(struct Attack* attack) {
  (void)attack;
  if (syscall(SYS_clone, CLONE_PARENT | SIGCHLD, NULL, NULL, NULL, 0) == 0) sleep_for_ever();
}

/* A child of the run itself that leaves at once with an exit code that means something. */
static void leave_sibling_that_exits(struct Attack* attack) {
  (void)attack;
  if (syscall(SYS_clone, CLONE_PARENT | SIGCHLD, NULL, NULL, NULL, 0) == 0) _exit(86);
}

static int sleep_in_shared_memory(void* nothing) {
  (void)nothing;
  sleep_for_ever();
  return 0;
}

/* A process with this one's memory and descriptors, and a name of its own. */
static void leave_process_in_same_memory(struct Attack* attack) {
  (void)attack;
  const size_t size = 65536;
  char* stack = malloc(size);
  if (stack != NULL)
    clone(sleep_in_shared_memory, stack + size, CLONE_VM | CLONE_FILES | SIGCHLD, NULL);
}

/* What orphans there will be, it gathers itself. */
static void become_reaper(struct Attack* attack) {
  prctl(PR_SET_CHILD_SUBREAPER, 1);
  leave_daemon(attack);
}

/* A session and a group of its own; no signal when the run is gone. */
static void leave_session(struct Attack* attack) {
  (void)attack;
  prctl(PR_SET_PDEATHSIG, 0);
  setsid();
}

/* A group of its own. */
static void leave_group(struct Attack* attack) {
  (void)attack;
  setpgid(0, 0);
}

/* Namespaces of its own, where it can. */
static void unshare_all(struct Attack* attack) {
  (void)attack;
  unshare(CLONE_NEWUSER | CLONE_NEWNS | CLONE_NEWPID | CLONE_NEWNET);
  leave_child(NULL, attack);
}

/* Another name, not to be looked at. */
static void hide(struct Attack* attack) {
  (void)attack;
  prctl(PR_SET_NAME, "init");
  prctl(PR_SET_DUMPABLE, 0);
}

/* Another program in this process, with its pipes. */
static void become_sleep(struct Attack* attack) {
  (void)attack;
  execlp("sleep", "sleep", "1000", (char*)NULL);
}

/* Another program that ends well at once. */
static void become_true(struct Attack* attack) {
  (void)attack;
  execlp("true", "true", (char*)NULL);
}

/* The same run once more, into the same database, and waits for it. */
static void run_again(struct Attack* attack) {
  char sweep[4096], database[4096], program[64];
  snprintf(sweep, sizeof sweep, "%s/sweep.yaml", attack->folder);
  snprintf(database, sizeof database, "%s/results.db", attack->folder);
  snprintf(program, sizeof program, "/proc/%d/exe", (int)getppid());
  const pid_t child = fork();
  if (child == 0) {
    execl(program, "avoidbench", "run", sweep, "--db", database, "--jobs", "1", "--quiet",
          (char*)NULL);
    _exit(1);
  }
  waitpid(child, NULL, 0);
}

static void* crash_later(void* nothing) {
  (void)nothing;
  sleep_s(0.02);
  raise(SIGSEGV);
  return NULL;
}

/* A thread that crashes when the call is over. */
static void start_thread_that_crashes(struct Attack* attack) {
  (void)attack;
  start_thread(crash_later, NULL);
}

static void* spin_for_ever(void* nothing) {
  (void)nothing;
  for (volatile int i = 0;; ++i) {
  }
  return NULL;
}

/* Four threads that use the processors from then on. */
static void start_threads_that_spin(struct Attack* attack) {
  (void)attack;
  for (int i = 0; i < 4; ++i) start_thread(spin_for_ever, NULL);
}

static void* sleep_on(void* nothing) {
  (void)nothing;
  sleep_for_ever();
  return NULL;
}

/* Five hundred threads. */
static void start_five_hundred_threads(struct Attack* attack) {
  (void)attack;
  for (int i = 0; i < 500; ++i) start_thread(sleep_on, NULL);
}

/* Ends the thread in which the host called it. */
static void exit_thread(struct Attack* attack) {
  (void)attack;
  pthread_exit(NULL);
}

/* A new child as soon as the last one is killed. */
static void leave_child_that_returns(struct Attack* attack) {
  (void)attack;
  if (fork() != 0) return;
  prctl(PR_SET_PDEATHSIG, 0);
  for (int i = 0; i < 1000; ++i) {
    const pid_t child = fork();
    if (child != 0) {
      waitpid(child, NULL, 0);
    } else {
      sleep_for_ever();
    }
  }
  _exit(0);
}

const struct Way kProcessWays[] = {
    {"fork_and_return", AT_CALL, fork_and_return},
    {"fork_and_fail_to_exec", AT_CALL, fork_and_fail_to_exec},
    {"fork_at_create", AT_CREATE, fork_and_return},
    {"fork_at_reset", AT_RESET, fork_and_return},
    {"let_the_child_answer", AT_CALL, let_the_child_answer},
    {"fork_two_hundred", AT_CALL, fork_two_hundred},
    {"fork_chain", AT_CALL, fork_chain},
    {"leave_daemon", AT_CALL, leave_daemon},
    {"leave_child_with_pipes", AT_CALL, leave_child_with_pipes},
    {"leave_daemon_with_pipes", AT_CALL, leave_daemon_with_pipes},
    {"leave_child_that_writes", AT_CALL, leave_child_that_writes},
    {"leave_child_that_spins", AT_CALL, leave_child_that_spins},
    {"leave_child_that_ignores", AT_CALL, leave_child_that_ignores},
    {"leave_child_stopped", AT_CALL, leave_child_stopped},
    {"leave_child_that_returns", AT_CALL, leave_child_that_returns},
    {"leave_sibling", AT_CALL, leave_sibling},
    {"leave_sibling_that_exits", AT_CALL, leave_sibling_that_exits},
    {"leave_process_in_same_memory", AT_CALL, leave_process_in_same_memory},
    {"become_reaper", AT_CALL, become_reaper},
    {"leave_session", AT_CALL, leave_session},
    {"leave_group", AT_CALL, leave_group},
    {"unshare_all", AT_CALL, unshare_all},
    {"hide", AT_CALL, hide},
    {"become_sleep", AT_CALL, become_sleep},
    {"become_true", AT_CALL, become_true},
    {"run_again", AT_CALL, run_again},
    {"start_thread_that_crashes", AT_CALL, start_thread_that_crashes},
    {"start_threads_that_spin", AT_CALL, start_threads_that_spin},
    {"start_five_hundred_threads", AT_CALL, start_five_hundred_threads},
    {"exit_thread", AT_CALL, exit_thread},
    {NULL, AT_CALL, NULL}};
