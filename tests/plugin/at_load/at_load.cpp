// A planner like honest.cpp that does something else first: what kAtLoadWay names, in a constructor
// that runs when the library is loaded.
#include <fcntl.h>
#include <locale.h>
#include <pthread.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdio>
#include <stdexcept>
#include <string>
#include <string_view>

#include "plugin/bad/honest.hpp"

/// In a file of its own for each library.
extern "C" const char kAtLoadWay[];

namespace {

std::string_view way() { return kAtLoadWay; }
constexpr int kMostFd = 1024;

[[noreturn]] void spin() {
  for (volatile bool on = true; on;) {
  }
  ::abort();
}

void sleep_for_ever() {
  while (true) ::pause();
}

[[noreturn]] void stay_for_long() {
  ::sleep(1000);
  ::_exit(0);
}

/// A process that is nobody's child, in a session of its own.
void start_daemon(bool hops) {
  if (::fork() != 0) return;
  ::setsid();
  if (::fork() != 0) ::_exit(0);
  while (hops) {
    ::usleep(1000);
    if (::fork() != 0) ::_exit(0);
  }
  stay_for_long();
}

void write_everywhere() {
  const std::string garbage(4096, '{');
  for (int fd = 0; fd < kMostFd; ++fd) {
    ::fcntl(fd, F_SETFL, ::fcntl(fd, F_GETFL) | O_NONBLOCK);
    for (int i = 0; i < 100 && ::write(fd, garbage.data(), garbage.size()) > 0; ++i) {
    }
  }
}

void* wait_in_thread(void*) {
  sleep_for_ever();
  return nullptr;
}

void ignore_signals_and_sleep() {
  for (int number = 1; number < NSIG; ++number) ::signal(number, SIG_IGN);
  sleep_for_ever();
}

void swarm() {
  for (int i = 0; i < 6; ++i) {
    if (::fork() == 0) ::setpgid(0, 0);
  }
  if (::getpgrp() == ::getpid() && ::getsid(0) != ::getpid()) stay_for_long();
}

void in_processes() {
  if (way() == "fork") {
    if (::fork() == 0) stay_for_long();
  } else if (way() == "fork_and_return") {
    if (::fork() == 0) ::execlp("no_such_helper", "no_such_helper", nullptr);
  } else if (way() == "daemon") {
    start_daemon(false);
  } else if (way() == "hopping") {
    start_daemon(true);
  } else if (way() == "swarm") {
    swarm();
  } else if (way() == "kill_parent") {
    ::kill(::getppid(), SIGKILL);
    ::sleep(5);  // longer than the tests' limit, where nothing was killed
  } else if (way() == "stop_parent") {
    ::kill(::getppid(), SIGSTOP);
    sleep_for_ever();
  } else if (way() == "stop") {
    ::raise(SIGSTOP);
  }
}

void in_files() {
  if (way() == "chdir") {
    if (::chdir("/") != 0) ::abort();
  } else if (way() == "close_all") {
    for (int fd = 0; fd < kMostFd; ++fd) ::close(fd);
  } else if (way() == "scribble") {
    write_everywhere();
  } else if (way() == "print") {
    for (int i = 0; i < 100'000; ++i) std::puts("\x1b[31mloud\x1b[0m");
  }
}

__attribute__((constructor)) void at_load() {
  if (way() == "exit") ::exit(0);
  if (way() == "exit_at_once") ::_exit(0);
  if (way() == "sleep") sleep_for_ever();
  if (way() == "spin") spin();
  if (way() == "slow") ::usleep(300'000);
  if (way() == "abort") {
    std::fputs("no model\x1b[31m.onnx\n", stderr);
    ::abort();
  }
  if (way() == "segfault") ::raise(SIGSEGV);
  if (way() == "ignore") ignore_signals_and_sleep();
  if (way() == "throw") throw std::runtime_error("thrown at load");
  if (way() == "end_of_thread") ::pthread_exit(nullptr);
  if (way() == "thread") {
    pthread_t thread{};
    ::pthread_create(&thread, nullptr, wait_in_thread, nullptr);
  }
  if (way() == "locale") ::setlocale(LC_ALL, "de_DE.UTF-8");
  in_processes();
  in_files();
}

__attribute__((destructor)) void at_end() {
  if (way() == "destructor_sleep") sleep_for_ever();
  if (way() == "destructor_abort") ::abort();
}

ab_planner changed(ab_planner table) {
  if (way() == "table_spin") spin();
  return table;
}

}  // namespace

BAD_PLANNER(table = changed(table))
