/* older_kernel [--no-landlock] [--no-namespaces] [--no-seccomp] PROGRAM ARGUMENT…
 *
 * Starts a program on a kernel that seems not to have these: a filter of system calls answers them
 * as such a kernel, or a container that forbids them, does. Without rights of its own: it gives up
 * those of set-user-id programs first. */
#include <errno.h>
#include <fcntl.h>
#include <linux/audit.h>
#include <linux/filter.h>
#include <linux/landlock.h>
#include <linux/seccomp.h>
#include <poll.h>
#include <sched.h>
#include <signal.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/ioctl.h>
#include <sys/prctl.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

enum { kLandlockFirst = 444, kLandlockLast = 446, kClone3 = 435, kMostRules = 64 };

struct Filter {
  struct sock_filter rules[kMostRules];
  unsigned short count;
  int landlock_version; /* 0: the kernel's own */
};

static void add(struct Filter* filter, struct sock_filter rule) {
  filter->rules[filter->count++] = rule;
}

static void load(struct Filter* filter, size_t offset) {
  add(filter, (struct sock_filter)BPF_STMT(BPF_LD | BPF_W | BPF_ABS, (uint32_t)offset));
}

static void answer(struct Filter* filter, int error) {
  add(filter, (struct sock_filter)BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_ERRNO | (uint32_t)error));
}

/* This call fails with that error. */
static void refuse(struct Filter* filter, uint32_t call, int error) {
  add(filter, (struct sock_filter)BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, call, 0, 1));
  answer(filter, error);
}

/* It does so where its first argument has one of these bits, or, of `exactly`, is that number. */
static void refuse_with(struct Filter* filter, uint32_t call, uint32_t bits, int exactly,
                        int error) {
  const uint16_t test = exactly ? BPF_JEQ : BPF_JSET;
  add(filter, (struct sock_filter)BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, call, 0, 4));
  load(filter, offsetof(struct seccomp_data, args[0]));
  add(filter, (struct sock_filter)BPF_JUMP((uint16_t)(BPF_JMP | test | BPF_K), bits, 0, 1));
  answer(filter, error);
  load(filter, offsetof(struct seccomp_data, nr));
}

/* Whoever asks which version of Landlock there is, is answered by `answer_for`. */
static void ask_about_landlock(struct Filter* filter) {
  add(filter, (struct sock_filter)BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, kLandlockFirst, 0, 4));
  load(filter, offsetof(struct seccomp_data, args[2]));
  add(filter, (struct sock_filter)BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K,
                                           LANDLOCK_CREATE_RULESET_VERSION, 0, 1));
  add(filter, (struct sock_filter)BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_USER_NOTIF));
  load(filter, offsetof(struct seccomp_data, nr));
}

static int build(struct Filter* filter, const char* word) {
  if (strncmp(word, "--landlock-version=", 19) == 0) {
    filter->landlock_version = atoi(word + 19);
    ask_about_landlock(filter);
    return 1;
  }
  if (strcmp(word, "--no-landlock") == 0) {
    for (uint32_t call = kLandlockFirst; call <= kLandlockLast; ++call)
      refuse(filter, call, ENOSYS);
    return 1;
  }
  if (strcmp(word, "--no-namespaces") == 0) {
    const uint32_t kNew =
        CLONE_NEWUSER | CLONE_NEWNS | CLONE_NEWPID | CLONE_NEWNET | CLONE_NEWIPC | CLONE_NEWUTS;
    refuse(filter, SYS_unshare, EPERM);
    refuse(filter, SYS_setns, EPERM);
    refuse(filter, SYS_mount, EPERM);
    refuse(filter, kClone3, ENOSYS); /* its flags lie in memory; the C library then takes clone */
    refuse_with(filter, SYS_clone, kNew, 0, EPERM);
    return 1;
  }
  if (strcmp(word, "--no-seccomp") == 0) {
    refuse(filter, SYS_seccomp, ENOSYS);
    refuse_with(filter, SYS_prctl, PR_SET_SECCOMP, 1, EINVAL);
    return 1;
  }
  return 0;
}

static _Noreturn void fail(void) {
  perror("older_kernel");
  exit(1);
}

/* Installs it for this process and all that come from it; the descriptor of what it asks. */
static int install(const struct Filter* filter) {
  const struct sock_fprog program = {.len = filter->count,
                                     .filter = (struct sock_filter*)(uintptr_t)filter->rules};
  const unsigned flags = filter->landlock_version > 0 ? SECCOMP_FILTER_FLAG_NEW_LISTENER : 0;
  if (prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) != 0) fail();
  const int questions = (int)syscall(SYS_seccomp, SECCOMP_SET_MODE_FILTER, flags, &program);
  if (questions < 0) fail();
  return questions;
}

/* Answers questions until the child has ended; its exit code. */
static int answer_for(pid_t child, int questions, int version) {
  int status = 0;
  while (waitpid(child, &status, WNOHANG) == 0) {
    struct pollfd waiting = {.fd = questions, .events = POLLIN};
    if (poll(&waiting, 1, 20) <= 0 || (waiting.revents & POLLIN) == 0) continue;
    struct seccomp_notif question;
    memset(&question, 0, sizeof question);
    if (ioctl(questions, SECCOMP_IOCTL_NOTIF_RECV, &question) != 0) continue;
    struct seccomp_notif_resp response = {.id = question.id, .val = version};
    ioctl(questions, SECCOMP_IOCTL_NOTIF_SEND, &response);
  }
  return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

int main(int count, char** words) {
  struct Filter filter = {.count = 0};
  load(&filter, offsetof(struct seccomp_data, nr));
  int first = 1;
  while (first < count && build(&filter, words[first])) ++first;
  add(&filter, (struct sock_filter)BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_ALLOW));
  if (first >= count) fail();
  int number[2];
  if (pipe2(number, O_CLOEXEC) != 0) fail();
  /* With its parent's descriptors, so that the one of the questions is there, too; until it starts
   * the program. */
  const pid_t child = filter.landlock_version > 0
                          ? (pid_t)syscall(SYS_clone, CLONE_FILES | SIGCHLD, NULL, NULL, NULL, 0)
                          : 0;
  if (child < 0) fail();
  if (child == 0) {
    const int questions = install(&filter);
    (void)!write(number[1], &questions, sizeof questions);
    execvp(words[first], words + first);
    fail();
  }
  int questions = -1;
  if (read(number[0], &questions, sizeof questions) != sizeof questions) fail();
  return answer_for(child, questions, filter.landlock_version);
}
