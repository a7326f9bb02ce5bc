/* Signals to itself: each that ends a process, handlers and masks that get in the host's way,
 * timers. */
#include <fcntl.h>
#include <fenv.h>
#include <setjmp.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <sys/syscall.h>
#include <sys/time.h>
#include <time.h>
#include <unistd.h>

#include "hostile.h"

#define RAISES(name, number)                \
  static void name(struct Attack* attack) { \
    (void)attack;                           \
    raise(number);                          \
  }
RAISES(raise_segv, SIGSEGV)
RAISES(raise_bus, SIGBUS)
RAISES(raise_fpe, SIGFPE)
RAISES(raise_ill, SIGILL)
RAISES(raise_trap, SIGTRAP)
RAISES(raise_pipe, SIGPIPE)
RAISES(raise_xcpu, SIGXCPU)
RAISES(raise_sys, SIGSYS)
RAISES(raise_abort, SIGABRT)
RAISES(raise_hangup, SIGHUP)
RAISES(raise_quit, SIGQUIT)
RAISES(raise_alarm, SIGALRM)
RAISES(raise_term, SIGTERM)
RAISES(raise_interrupt, SIGINT)
RAISES(raise_realtime, SIGRTMAX)
RAISES(raise_kill, SIGKILL)
RAISES(raise_stop, SIGSTOP)

static void crash(void) {
  volatile int* volatile nowhere = NULL;
  *nowhere = 1;
}

static void do_nothing(int number) { (void)number; }

/* A crash whose signal is ignored. */
static void crash_ignored(struct Attack* attack) {
  (void)attack;
  signal(SIGSEGV, SIG_IGN);
  crash();
}

/* A crash whose handler comes back, again and again. */
static void crash_handled(struct Attack* attack) {
  (void)attack;
  signal(SIGSEGV, do_nothing);
  crash();
}

static void leave_quietly(int number) {
  (void)number;
  _exit(0);
}

/* A crash that looks like a good end. */
static void crash_as_success(struct Attack* attack) {
  (void)attack;
  signal(SIGSEGV, leave_quietly);
  crash();
}

/* No signal reaches it any more; then it does not come back. */
static void block_signals(struct Attack* attack) {
  (void)attack;
  sigset_t all;
  sigfillset(&all);
  sigprocmask(SIG_BLOCK, &all, NULL);
  sleep_for_ever();
}

/* All signals blocked, and then on as if nothing had been. */
static void leave_signals_blocked(struct Attack* attack) {
  (void)attack;
  sigset_t all;
  sigfillset(&all);
  sigprocmask(SIG_BLOCK, &all, NULL);
}

/* A thousand interruptions a second of whatever the host waits for. */
static void interrupt_often(struct Attack* attack) {
  (void)attack;
  struct sigaction action = {.sa_handler = do_nothing};
  sigaction(SIGALRM, &action, NULL);
  const struct itimerval often = {{0, 1000}, {0, 1000}};
  setitimer(ITIMER_REAL, &often, NULL);
}

/* An alarm that rings when the call is over. */
static void ring_later(struct Attack* attack) {
  (void)attack;
  const struct itimerval once = {{0, 0}, {0, 30000}};
  setitimer(ITIMER_REAL, &once, NULL);
}

/* No stack for handlers, then no stack at all. */
static void overflow_without_stack(struct Attack* attack) {
  (void)attack;
  const stack_t none = {.ss_flags = SS_DISABLE};
  sigaltstack(&none, NULL);
  for (volatile int i = 0;; ++i) {
    volatile char* bytes = __builtin_alloca(65536);
    bytes[0] = (char)i;
  }
}

static jmp_buf before_reset;

__attribute__((noinline)) static void remember_place(void) { (void)setjmp(before_reset); }

/* Goes to a place in a call that is over. */
static void jump_into_past(struct Attack* attack) {
  (void)attack;
  remember_place();
  longjmp(before_reset, 1);
}

/* Every interrupted computation with 0 or infinity raises SIGFPE, the host's too. */
static void trap_floats(struct Attack* attack) {
  (void)attack;
  feenableexcept(FE_DIVBYZERO | FE_INVALID | FE_OVERFLOW);
}

/* Ends itself by a signal that looks as if somebody else had sent it, so that the trial is
 * nobody's: of its default, of a timer, of a pipe. */
static void end_by_term(struct Attack* attack) {
  (void)attack;
  signal(SIGTERM, SIG_DFL);
  raise(SIGTERM);
}
static void end_by_timer(struct Attack* attack) {
  (void)attack;
  struct sigevent event;
  memset(&event, 0, sizeof event);
  event.sigev_notify = SIGEV_SIGNAL;
  event.sigev_signo = SIGKILL;
  timer_t timer;
  const struct itimerspec soon = {{0, 0}, {0, 1000}};
  if (timer_create(CLOCK_MONOTONIC, &event, &timer) == 0) timer_settime(timer, 0, &soon, NULL);
  sleep_s(0.1);
}
static void end_by_pipe(struct Attack* attack) {
  (void)attack;
  int ends[2];
  if (pipe(ends) != 0) return;
  fcntl(ends[0], F_SETOWN, getpid());
  fcntl(ends[0], F_SETSIG, SIGKILL);
  fcntl(ends[0], F_SETFL, O_ASYNC | O_NONBLOCK);
  (void)!write(ends[1], "x", 1);
}

static void hold_thread(int number) {
  (void)number;
  sleep_for_ever();
}

static void hold_threads(void) {
  signal(SIGUSR2, hold_thread);
  for (pid_t thread = getpid() + 1; thread < getpid() + 100; ++thread) {
    syscall(SYS_tgkill, getpid(), thread, SIGUSR2);
  }
}

/* Stops the thread that would end a call that hangs; then hangs. */
static void hold_watchdog(struct Attack* attack) {
  (void)attack;
  hold_threads();
  sleep_for_ever();
}

static void* beat(void* nothing) {
  (void)nothing;
  while (1) {
    for (int fd = 3; fd < 10; ++fd) {
      if (fd != 4 && write(fd, "", 1) < 0) continue;
    }
    sleep_s(0.3);
  }
  return NULL;
}

/* The same, and says in its stead that the worker lives. */
static void hold_watchdog_and_beat(struct Attack* attack) {
  (void)attack;
  hold_threads();
  start_thread(beat, NULL);
  sleep_for_ever();
}

/* Ends the watchdog's thread by the signal with which the C library cancels threads; then hangs. */
static void cancel_watchdog(struct Attack* attack) {
  (void)attack;
  for (pid_t thread = getpid() + 1; thread < getpid() + 100; ++thread) {
    syscall(SYS_tgkill, getpid(), thread, 32);
  }
  sleep_for_ever();
}

const struct Way kSignalWays[] = {{"raise_segv", AT_CALL, raise_segv},
                                  {"raise_bus", AT_CALL, raise_bus},
                                  {"raise_fpe", AT_CALL, raise_fpe},
                                  {"raise_ill", AT_CALL, raise_ill},
                                  {"raise_trap", AT_CALL, raise_trap},
                                  {"raise_pipe", AT_CALL, raise_pipe},
                                  {"raise_xcpu", AT_CALL, raise_xcpu},
                                  {"raise_sys", AT_CALL, raise_sys},
                                  {"raise_abort", AT_CALL, raise_abort},
                                  {"raise_hangup", AT_CALL, raise_hangup},
                                  {"raise_quit", AT_CALL, raise_quit},
                                  {"raise_alarm", AT_CALL, raise_alarm},
                                  {"raise_term", AT_CALL, raise_term},
                                  {"raise_interrupt", AT_CALL, raise_interrupt},
                                  {"raise_realtime", AT_CALL, raise_realtime},
                                  {"raise_kill", AT_CALL, raise_kill},
                                  {"raise_stop", AT_CALL, raise_stop},
                                  {"crash_ignored", AT_CALL, crash_ignored},
                                  {"crash_handled", AT_CALL, crash_handled},
                                  {"crash_as_success", AT_CALL, crash_as_success},
                                  {"block_signals", AT_CALL, block_signals},
                                  {"leave_signals_blocked", AT_CALL, leave_signals_blocked},
                                  {"interrupt_often", AT_CALL, interrupt_often},
                                  {"ring_later", AT_CALL, ring_later},
                                  {"overflow_without_stack", AT_CALL, overflow_without_stack},
                                  {"jump_into_past", AT_CALL, jump_into_past},
                                  {"trap_floats", AT_CALL, trap_floats},
                                  {"end_by_term", AT_CALL, end_by_term},
                                  {"end_by_timer", AT_CALL, end_by_timer},
                                  {"end_by_pipe", AT_CALL, end_by_pipe},
                                  {"hold_watchdog", AT_CALL, hold_watchdog},
                                  {"hold_watchdog_and_beat", AT_CALL, hold_watchdog_and_beat},
                                  {"cancel_watchdog", AT_CALL, cancel_watchdog},
                                  {NULL, AT_CALL, NULL}};
