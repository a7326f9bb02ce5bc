/* The pipes to the parent and every other descriptor. What goes over them in good order: results.c.
 */
#include <errno.h>
#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "hostile.h"

/* Closes all but the first three. */
static void close_pipes(struct Attack* attack) {
  (void)attack;
  for (int fd = 3; fd < 1024; ++fd) close(fd);
}

/* Closes all. */
static void close_all(struct Attack* attack) {
  (void)attack;
  for (int fd = 0; fd < 1024; ++fd) close(fd);
}

/* Closes all and opens others, which take their numbers. */
static void close_and_open(struct Attack* attack) {
  close_pipes(attack);
  for (int i = 0; i < 8; ++i) (void)!open("/dev/null", O_RDWR);
}

/* Puts /dev/null in the pipes' places. */
static void cover_pipes(struct Attack* attack) {
  (void)attack;
  const int nothing = open("/dev/null", O_RDWR);
  for (int fd = 3; fd < 32; ++fd) {
    if (fd != nothing) dup2(nothing, fd);
  }
}

/* Puts a pipe that nobody reads in the pipes' places, and fills it. */
static void cover_with_full_pipe(struct Attack* attack) {
  (void)attack;
  int ends[2];
  if (pipe2(ends, O_NONBLOCK) != 0) return;
  while (write(ends[1], attack->folder, 1) == 1) {
  }
  fcntl(ends[1], F_SETFL, 0);
  for (int fd = 3; fd < 10; ++fd) dup2(ends[1], fd);
}

/* Exchanges the pipes for one another. */
static void exchange_pipes(struct Attack* attack) {
  (void)attack;
  const int jobs = dup(3), results = dup(4), notes = dup(5);
  dup2(notes, 4);
  dup2(results, 5);
  dup2(results, 3);
  close(jobs);
}

/* Garbage to every descriptor. */
static void write_everywhere(struct Attack* attack) {
  (void)attack;
  for (int fd = 3; fd < 64; ++fd) (void)!write(fd, "not a message at all, not even nearly", 37);
}

/* One byte to every descriptor. */
static void write_a_byte(struct Attack* attack) {
  (void)attack;
  for (int fd = 3; fd < 64; ++fd) (void)!write(fd, "x", 1);
}

/* More than a pipe holds, to every descriptor, as long as it is let. */
static void flood_pipes(struct Attack* attack) {
  (void)attack;
  static char block[1 << 16];
  memset(block, 0x2e, sizeof block);
  for (int fd = 3; fd < 64; ++fd) fcntl(fd, F_SETFL, O_NONBLOCK);
  while (1) {
    for (int fd = 3; fd < 64; ++fd) (void)!write(fd, block, sizeof block);
  }
}

/* A gigabyte of notes. */
static void flood_notes(struct Attack* attack) {
  (void)attack;
  static char block[1 << 16];
  memset(block, 0x2e, sizeof block);
  for (long sent = 0; sent < 1L << 30;) {
    const ssize_t now = write(5, block, sizeof block);
    if (now < 0 && errno != EAGAIN) return;
    if (now > 0) sent += now;
  }
}

static void* read_all(void* nothing) {
  (void)nothing;
  char byte;
  while (read(3, &byte, 1) >= 0) {
  }
  return NULL;
}

/* A thread that takes the jobs away. */
static void read_jobs(struct Attack* attack) {
  (void)attack;
  start_thread(read_all, NULL);
}

/* No descriptor is free any more. */
static void use_up(struct Attack* attack) {
  (void)attack;
  while (open("/dev/null", O_RDONLY) >= 0) {
  }
}

/* Nothing waits any more: reads and writes of the host come back at once. */
static void do_not_wait(struct Attack* attack) {
  (void)attack;
  for (int fd = 0; fd < 64; ++fd) fcntl(fd, F_SETFL, fcntl(fd, F_GETFL) | O_NONBLOCK);
}

/* The smallest pipes. */
static void shrink_pipes(struct Attack* attack) {
  (void)attack;
  for (int fd = 3; fd < 10; ++fd) fcntl(fd, F_SETPIPE_SZ, 4096);
}

/* What looks like results, on the standard output. */
static void print_results(struct Attack* attack) {
  (void)attack;
  for (int i = 0; i < 100; ++i) printf("{\"outcome\": \"reached_goal\", \"reason\": \"forged\"}\n");
  fflush(stdout);
  (void)!write(STDOUT_FILENO, "forged\n", 7);
}

/* Two hundred megabytes to the standard error. */
static void flood_errors(struct Attack* attack) {
  (void)attack;
  static char line[1 << 20];
  memset(line, 0x23, sizeof line);
  for (int i = 0; i < 200; ++i) (void)!write(STDERR_FILENO, line, sizeof line);
}

/* A hundred thousand lines to the host's log, with what would move a terminal's cursor. */
static void flood_log(struct Attack* attack) {
  for (int i = 0; i < 100000; ++i) {
    attack->host->log(attack->host->context, AB_LOG_WARNING,
                      "\033[2J\033]0;title\007 again and again");
  }
}

/* Nothing is left of a file that the shell had open when it started the run. */
static void write_inherited(struct Attack* attack) {
  (void)attack;
  const int numbers[] = {77, 200};
  for (size_t i = 0; i < sizeof numbers / sizeof numbers[0]; ++i) {
    (void)!ftruncate(numbers[i], 0);
    (void)!write(numbers[i], "garbage", 7);
  }
}

const struct Way kDescriptorWays[] = {{"close_pipes", AT_CALL, close_pipes},
                                      {"close_all", AT_CALL, close_all},
                                      {"close_all_at_create", AT_CREATE, close_all},
                                      {"close_and_open", AT_CALL, close_and_open},
                                      {"cover_pipes", AT_CALL, cover_pipes},
                                      {"cover_with_full_pipe", AT_CALL, cover_with_full_pipe},
                                      {"exchange_pipes", AT_CALL, exchange_pipes},
                                      {"write_everywhere", AT_CALL, write_everywhere},
                                      {"write_a_byte", AT_CALL, write_a_byte},
                                      {"flood_pipes", AT_CALL, flood_pipes},
                                      {"flood_notes", AT_CALL, flood_notes},
                                      {"read_jobs", AT_CALL, read_jobs},
                                      {"use_up_descriptors", AT_CALL, use_up},
                                      {"do_not_wait", AT_CALL, do_not_wait},
                                      {"shrink_pipes", AT_CALL, shrink_pipes},
                                      {"print_results", AT_CALL, print_results},
                                      {"flood_errors", AT_CALL, flood_errors},
                                      {"flood_log", AT_CALL, flood_log},
                                      {"write_inherited", AT_CALL, write_inherited},
                                      {NULL, AT_CALL, NULL}};
