/* older_kernel [--no-landlock] [--no-namespaces] [--no-seccomp] PROGRAM ARGUMENT…
 *
 * Starts a program on a kernel that seems not to have these: a filter of system calls answers them
 * as such a kernel, or a container that forbids them, does. Without rights of its own: it gives up
 * those of set-user-id programs first. */
#include <errno.h>
#include <linux/audit.h>
#include <linux/filter.h>
#include <linux/seccomp.h>
#include <sched.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>
#include <sys/prctl.h>
#include <sys/syscall.h>
#include <unistd.h>

enum { kLandlockFirst = 444, kLandlockLast = 446, kClone3 = 435, kMostRules = 64 };

struct Filter {
  struct sock_filter rules[kMostRules];
  unsigned short count;
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

static int build(struct Filter* filter, const char* word) {
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

int main(int count, char** words) {
  struct Filter filter = {.count = 0};
  load(&filter, offsetof(struct seccomp_data, nr));
  int first = 1;
  while (first < count && build(&filter, words[first])) ++first;
  add(&filter, (struct sock_filter)BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_ALLOW));
  const struct sock_fprog program = {.len = filter.count, .filter = filter.rules};
  if (prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) != 0 ||
      prctl(PR_SET_SECCOMP, SECCOMP_MODE_FILTER, &program) != 0) {
    perror("older_kernel");
    return 1;
  }
  if (first < count) execvp(words[first], words + first);
  perror("older_kernel");
  return 1;
}
