/* The process that runs the sweep, and the other workers: signals, their memory, their descriptors,
 * their limits. */
#include <dirent.h>
#include <fcntl.h>
#include <sched.h>
#include <signal.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/ptrace.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <sys/uio.h>
#include <unistd.h>

#include "hostile.h"

#define TO_PARENT(name, number)             \
  static void name(struct Attack* attack) { \
    (void)attack;                           \
    kill(getppid(), number);                \
  }
TO_PARENT(interrupt_parent, SIGINT)
TO_PARENT(terminate_parent, SIGTERM)
TO_PARENT(warn_parent, SIGUSR1)
TO_PARENT(kill_parent, SIGKILL)
TO_PARENT(stop_parent, SIGSTOP)

/* Its group: the run, the other workers. */
static void interrupt_group(struct Attack* attack) {
  (void)attack;
  kill(0, SIGINT);
}
static void kill_group(struct Attack* attack) {
  (void)attack;
  kill(0, SIGKILL);
}

/* Every process that it may signal. */
static void kill_everyone(struct Attack* attack) {
  (void)attack;
  kill(-1, SIGKILL);
}

static void signal_siblings(int number) {
  pid_t pids[64];
  const int count = siblings(pids, 64);
  for (int i = 0; i < count; ++i) kill(pids[i], number);
}

/* The other workers, while they fly other planners. */
static void kill_siblings(struct Attack* attack) {
  (void)attack;
  signal_siblings(SIGKILL);
}
static void stop_siblings(struct Attack* attack) {
  (void)attack;
  signal_siblings(SIGSTOP);
}
static void crash_siblings(struct Attack* attack) {
  (void)attack;
  signal_siblings(SIGSEGV);
}

/* By a descriptor of the process. */
static void kill_parent_by_descriptor(struct Attack* attack) {
  (void)attack;
  const int fd = (int)syscall(SYS_pidfd_open, getppid(), 0);
  syscall(SYS_pidfd_send_signal, fd, SIGKILL, NULL, 0);
}

/* By tgkill, tkill and rt_sigqueueinfo. */
static void kill_parent_otherwise(struct Attack* attack) {
  (void)attack;
  siginfo_t info;
  memset(&info, 0, sizeof info);
  info.si_code = SI_QUEUE;
  syscall(SYS_rt_sigqueueinfo, getppid(), SIGTERM, &info);
  syscall(SYS_tkill, getppid(), SIGKILL);
  syscall(SYS_tgkill, getppid(), getppid(), SIGKILL);
}

/* By a pipe that signals its owner, which is said to be the parent. */
static void kill_parent_by_pipe(struct Attack* attack) {
  (void)attack;
  int ends[2];
  if (pipe(ends) != 0) return;
  fcntl(ends[0], F_SETOWN, getppid());
  fcntl(ends[0], F_SETSIG, SIGKILL);
  fcntl(ends[0], F_SETFL, O_ASYNC | O_NONBLOCK);
  (void)!write(ends[1], "x", 1);
}

/* Traces the parent, which stops it. */
static void trace_parent(struct Attack* attack) {
  (void)attack;
  if (ptrace(PTRACE_ATTACH, getppid(), NULL, NULL) == 0) sleep_for_ever();
}

/* First address and size of the parent's heap. */
static int find_heap(uintptr_t* from, size_t* size) {
  char path[64], line[512];
  snprintf(path, sizeof path, "/proc/%d/maps", (int)getppid());
  FILE* file = fopen(path, "r");
  if (file == NULL) return 0;
  int found = 0;
  while (found == 0 && fgets(line, sizeof line, file) != NULL) {
    unsigned long first = 0, end = 0;
    if (strstr(line, "[heap]") == NULL || sscanf(line, "%lx-%lx", &first, &end) != 2) continue;
    *from = first;
    *size = end - first;
    found = 1;
  }
  fclose(file);
  return found;
}

/* Writes over the parent's heap by its file in /proc. */
static void write_parent_memory(struct Attack* attack) {
  (void)attack;
  uintptr_t from = 0;
  size_t size = 0;
  char path[64];
  static char block[1 << 16];
  memset(block, 0x41, sizeof block);
  snprintf(path, sizeof path, "/proc/%d/mem", (int)getppid());
  const int fd = open(path, O_RDWR);
  if (fd < 0 || !find_heap(&from, &size)) return;
  for (size_t at = 0; at + sizeof block <= size; at += sizeof block) {
    (void)!pwrite(fd, block, sizeof block, (off_t)(from + at));
  }
}

/* The same by a call of its own. */
static void write_parent_memory_by_call(struct Attack* attack) {
  (void)attack;
  uintptr_t from = 0;
  size_t size = 0;
  static char block[1 << 16];
  memset(block, 0x41, sizeof block);
  if (!find_heap(&from, &size)) return;
  for (size_t at = 0; at + sizeof block <= size; at += sizeof block) {
    const struct iovec here = {block, sizeof block};
    struct iovec there = {NULL, sizeof block};
    memcpy(&there.iov_base, &(uintptr_t){from + at}, sizeof there.iov_base);
    (void)!process_vm_writev(getppid(), &here, 1, &there, 1, 0);
  }
}

static void limit_parent(int resource, rlim_t limit) {
  const struct rlimit64 to = {limit, limit};
  syscall(SYS_prlimit64, getppid(), resource, &to, NULL);
}

/* The parent may write no file any more. */
static void limit_parents_files(struct Attack* attack) {
  (void)attack;
  limit_parent(RLIMIT_FSIZE, 0);
}

/* The parent may open nothing any more. */
static void limit_parents_descriptors(struct Attack* attack) {
  (void)attack;
  limit_parent(RLIMIT_NOFILE, 0);
}

/* The parent has had its time. */
static void limit_parents_time(struct Attack* attack) {
  (void)attack;
  limit_parent(RLIMIT_CPU, 0);
}

/* The parent last of all, on one processor, only when nobody else wants it. */
static void slow_parent(struct Attack* attack) {
  (void)attack;
  const struct sched_param none = {0};
  cpu_set_t first;
  CPU_ZERO(&first);
  CPU_SET(0, &first);
  setpriority(PRIO_PROCESS, (id_t)getppid(), 19);
  sched_setaffinity(getppid(), sizeof first, &first);
  sched_setscheduler(getppid(), SCHED_IDLE, &none);
}

/* The kernel is to kill the parent first. */
static void offer_parent_to_the_kernel(struct Attack* attack) {
  (void)attack;
  char path[64];
  snprintf(path, sizeof path, "/proc/%d/oom_score_adj", (int)getppid());
  const int fd = open(path, O_WRONLY);
  if (fd < 0) return;
  (void)!write(fd, "1000", 4);
  close(fd);
}

/* Garbage, by the parent's descriptors in /proc, into whatever they lead to; and nothing is left of
 * files. */
static void write_parents_files(struct Attack* attack) {
  (void)attack;
  char path[64];
  for (int number = 3; number < 64; ++number) {
    snprintf(path, sizeof path, "/proc/%d/fd/%d", (int)getppid(), number);
    const int fd = open(path, O_RDWR | O_NONBLOCK);
    if (fd < 0) continue;
    (void)!write(fd, "garbage, garbage, garbage", 25);
    (void)!ftruncate(fd, 0);
    close(fd);
  }
}

/* The same by descriptors taken out of the parent. */
static void steal_parents_files(struct Attack* attack) {
  (void)attack;
  const int parent = (int)syscall(SYS_pidfd_open, getppid(), 0);
  for (int number = 3; number < 64; ++number) {
    const int fd = (int)syscall(SYS_pidfd_getfd, parent, number, 0);
    if (fd < 0) continue;
    (void)!pwrite(fd, "garbage, garbage, garbage", 25, 0);
    (void)!ftruncate(fd, 0);
    close(fd);
  }
}

/* Writes into the other workers' pipes by their descriptors in /proc. */
static void write_siblings_pipes(struct Attack* attack) {
  (void)attack;
  pid_t pids[64];
  char path[64];
  const int count = siblings(pids, 64);
  for (int i = 0; i < count; ++i) {
    for (int number = 3; number < 10; ++number) {
      snprintf(path, sizeof path, "/proc/%d/fd/%d", (int)pids[i], number);
      const int fd = open(path, O_WRONLY | O_NONBLOCK);
      if (fd < 0) continue;
      (void)!write(fd, "garbage, garbage, garbage", 25);
      close(fd);
    }
  }
}

/* Reads it by that file, as a program would its worker's. */
static void read_parent_memory(struct Attack* attack) {
  char path[64];
  snprintf(path, sizeof path, "/proc/%d/mem", (int)getppid());
  if (open(path, O_RDONLY) >= 0) tell_success(attack, "the parent's memory");
}

const struct Way kParentWays[] = {
    {"interrupt_parent", AT_CALL, interrupt_parent},
    {"terminate_parent", AT_CALL, terminate_parent},
    {"warn_parent", AT_CALL, warn_parent},
    {"kill_parent", AT_CALL, kill_parent},
    {"stop_parent", AT_CALL, stop_parent},
    {"interrupt_group", AT_CALL, interrupt_group},
    {"kill_group", AT_CALL, kill_group},
    {"kill_everyone", AT_CALL, kill_everyone},
    {"kill_siblings", AT_CALL, kill_siblings},
    {"stop_siblings", AT_CALL, stop_siblings},
    {"crash_siblings", AT_CALL, crash_siblings},
    {"kill_parent_by_descriptor", AT_CALL, kill_parent_by_descriptor},
    {"kill_parent_otherwise", AT_CALL, kill_parent_otherwise},
    {"kill_parent_by_pipe", AT_CALL, kill_parent_by_pipe},
    {"trace_parent", AT_CALL, trace_parent},
    {"read_parent_memory", AT_CALL, read_parent_memory},
    {"write_parent_memory", AT_CALL, write_parent_memory},
    {"write_parent_memory_by_call", AT_CALL, write_parent_memory_by_call},
    {"limit_parents_files", AT_CALL, limit_parents_files},
    {"limit_parents_descriptors", AT_CALL, limit_parents_descriptors},
    {"limit_parents_time", AT_CALL, limit_parents_time},
    {"slow_parent", AT_CALL, slow_parent},
    {"offer_parent_to_the_kernel", AT_CALL, offer_parent_to_the_kernel},
    {"write_parents_files", AT_CALL, write_parents_files},
    {"steal_parents_files", AT_CALL, steal_parents_files},
    {"write_siblings_pipes", AT_CALL, write_siblings_pipes},
    {NULL, AT_CALL, NULL}};
