// A planner like honest.cpp that does something else first: what WAY names, in a constructor that
// runs when the library is loaded.
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

namespace {

constexpr std::string_view kWay = WAY;
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
  if (kWay == "fork") {
    if (::fork() == 0) stay_for_long();
  } else if (kWay == "fork_and_return") {
    if (::fork() == 0) ::execlp("no_such_helper", "no_such_helper", nullptr);
  } else if (kWay == "daemon") {
    start_daemon(false);
  } else if (kWay == "hopping") {
    start_daemon(true);
  } else if (kWay == "swarm") {
    swarm();
  } else if (kWay == "kill_parent") {
    ::kill(::getppid(), SIGKILL);
    ::sleep(1);
  } else if (kWay == "stop_parent") {
    ::kill(::getppid(), SIGSTOP);
    sleep_for_ever();
  } else if (kWay == "stop") {
    ::raise(SIGSTOP);
  }
}

void in_files() {
  if (kWay == "chdir") {
    if (::chdir("/") != 0) ::abort();
  } else if (kWay == "close_all") {
    for (int fd = 0; fd < kMostFd; ++fd) ::close(fd);
  } else if (kWay == "scribble") {
    write_everywhere();
  } else if (kWay == "print") {
    for (int i = 0; i < 100'000; ++i) std::puts("\x1b[31mloud\x1b[0m");
  }
}

__attribute__((constructor)) void at_load() {
  if (kWay == "exit") ::exit(0);
  if (kWay == "exit_at_once") ::_exit(0);
  if (kWay == "sleep") sleep_for_ever();
  if (kWay == "spin") spin();
  if (kWay == "slow") ::usleep(300'000);
  if (kWay == "abort") {
    std::fputs("no model\x1b[31m.onnx\n", stderr);
    ::abort();
  }
  if (kWay == "segfault") ::raise(SIGSEGV);
  if (kWay == "ignore") ignore_signals_and_sleep();
  if (kWay == "throw") throw std::runtime_error("thrown at load");
  if (kWay == "end_of_thread") ::pthread_exit(nullptr);
  if (kWay == "thread") {
    pthread_t thread{};
    ::pthread_create(&thread, nullptr, wait_in_thread, nullptr);
  }
  if (kWay == "locale") ::setlocale(LC_ALL, "de_DE.UTF-8");
  in_processes();
  in_files();
}

__attribute__((destructor)) void at_end() {
  if (kWay == "destructor_sleep") sleep_for_ever();
  if (kWay == "destructor_abort") ::abort();
}

ab_planner changed(ab_planner table) {
  if (kWay == "table_spin") spin();
  return table;
}

}  // namespace

BAD_PLANNER(table = changed(table))
