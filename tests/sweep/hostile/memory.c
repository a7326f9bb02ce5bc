/* Memory: more of it than is allowed, memory that is not this process's own to count, and writing
 * where nothing of its own lies. */
#include <fcntl.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <unistd.h>

#include "hostile.h"

enum { kMib = 1 << 20 };

static void touch(char* bytes, size_t size) {
  for (size_t i = 0; i < size; i += 4096) ((volatile char*)bytes)[i] = 1;
}

/* Allocates until there is no more. */
static void fill_heap(struct Attack* attack) {
  (void)attack;
  while (1) {
    char* block = malloc(64 * kMib);
    if (block == NULL) abort();
    touch(block, 64 * kMib);
  }
}

/* Maps a terabyte and uses it from its start on. */
static void map_terabyte(struct Attack* attack) {
  (void)attack;
  const size_t size = (size_t)1 << 40U;
  char* bytes =
      mmap(NULL, size, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
  if (bytes == MAP_FAILED) abort();
  touch(bytes, size);
}

static int dive(volatile int* from) {
  volatile int here[4096] = {0};
  here[0] = from != NULL ? from[0] + 1 : 0;
  return here[0] < 0 ? 0 : dive(here) + here[0];
}

/* Recursion without an end. */
static void overflow_stack(struct Attack* attack) {
  (void)attack;
  dive(NULL);
}

static void hold_150_mib(struct Attack* attack) {
  (void)attack;
  char* bytes = malloc(150 * kMib);
  if (bytes != NULL) touch(bytes, 150 * kMib);
}

/* Four children with 150 MiB each, all together more than the limit; waits until they are there. */
static void fill_children(struct Attack* attack) {
  for (int i = 0; i < 4; ++i) leave_child(hold_150_mib, attack);
  sleep_for_ever();
}

static void fill_file(int fd) {
  static char block[kMib];
  memset(block, 1, sizeof block);
  for (int i = 0; i < 600; ++i) {
    if (write(fd, block, sizeof block) <= 0) break;
  }
}

/* 600 MiB in a file that is in memory and has no name. */
static void fill_memfd(struct Attack* attack) {
  (void)attack;
  fill_file(memfd_create("hostile", 0));
}

/* 600 MiB in a file of /dev/shm, which stays. */
static void fill_shared_memory(struct Attack* attack) {
  char path[128];
  snprintf(path, sizeof path, "/dev/shm/avoidbench_hostile_%s", attack->way);
  fill_file(open(path, O_CREAT | O_WRONLY, 0600));
}

/* Nothing of it may be paged out, whatever is mapped later. */
static void lock_memory(struct Attack* attack) {
  (void)attack;
  mlockall(MCL_CURRENT | MCL_FUTURE);
}

static void* null_pointer(void) {
  void* volatile pointer = NULL;
  return pointer;
}

/* Writes through a null pointer. */
static void write_null(struct Attack* attack) {
  (void)attack;
  *(volatile int*)null_pointer() = 1;
}

/* Jumps to address 0. */
static void call_null(struct Attack* attack) {
  (void)attack;
  void (*function)(void) = NULL;
  void* nothing = null_pointer();
  memcpy(&function, &nothing, sizeof function);
  function();
}

/* Overwrites what the allocator keeps before a block, then frees it. */
static void break_heap(struct Attack* attack) {
  (void)attack;
  char* block = malloc(2000);
  volatile char* before = block - 16;
  for (int i = 0; i < 32; ++i) before[i] = 0x5a;
  free(block);
}

/* Frees a block twice. */
static void free_twice(struct Attack* attack) {
  (void)attack;
  void* volatile block = malloc(2000);
  void* volatile same = block;
  free(block);
  free(same);
}

/* Writes into what it is only shown. */
static void write_observation(struct Attack* attack) {
  ab_state* state = (ab_state*)(uintptr_t)attack->observation->state;
  for (int i = 0; i < 3; ++i) state->position_world_m[i] = attack->command->velocity_world_mps[i];
}

static void* write_later(void* state) {
  sleep_s(0.05);
  memset(state, 0x7f, 65536);
  return NULL;
}

/* A thread that writes 64 KiB over what the last call was shown, when that call is long over. */
static void write_later_over_observation(struct Attack* attack) {
  start_thread(write_later, (void*)(uintptr_t)attack->observation->state);
}

/* Makes the program's own code writable and breaks the function that it is about to call. */
static void write_code(struct Attack* attack) {
  uintptr_t address = 0;
  memcpy(&address, &attack->host->log, sizeof address);
  char* page = (char*)(address & ~(uintptr_t)4095);
  if (mprotect(page, 8192, PROT_READ | PROT_WRITE | PROT_EXEC) == 0)
    memset((char*)address, 0xcc, 16);
  attack->host->log(attack->host->context, AB_LOG_INFO, "still here");
}

/* Unmaps the stack that it runs on. */
static void unmap_stack(struct Attack* attack) {
  char* here = (char*)((uintptr_t)&attack & ~(uintptr_t)4095);
  munmap(here - 65536, 131072);
}

/* Unmaps its own code while it runs. */
static void unmap_itself(struct Attack* attack) {
  uintptr_t address = 0;
  void (*self)(struct Attack*) = unmap_itself;
  (void)attack;
  memcpy(&address, &self, sizeof address);
  munmap((char*)(address & ~(uintptr_t)4095), 4096);
}

const struct Way kMemoryWays[] = {{"fill_heap", AT_CALL, fill_heap},
                                  {"map_terabyte", AT_CALL, map_terabyte},
                                  {"overflow_stack", AT_CALL, overflow_stack},
                                  {"fill_children", AT_CALL, fill_children},
                                  {"fill_memfd", AT_CALL, fill_memfd},
                                  {"fill_shared_memory", AT_CALL, fill_shared_memory},
                                  {"lock_memory", AT_CALL, lock_memory},
                                  {"write_null", AT_CALL, write_null},
                                  {"call_null", AT_CALL, call_null},
                                  {"break_heap", AT_CALL, break_heap},
                                  {"free_twice", AT_CALL, free_twice},
                                  {"write_observation", AT_CALL, write_observation},
                                  {"write_later", AT_CALL, write_later_over_observation},
                                  {"write_code", AT_CALL, write_code},
                                  {"unmap_stack", AT_CALL, unmap_stack},
                                  {"unmap_itself", AT_CALL, unmap_itself},
                                  {NULL, AT_CALL, NULL}};
