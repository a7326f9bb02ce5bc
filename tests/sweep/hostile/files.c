/* The run's files: the database, the sweep file, the planners' libraries; and files that nobody
 * asked for. */
#include <dlfcn.h>
#include <errno.h>
#include <fcntl.h>
#include <linux/fs.h>
#include <linux/io_uring.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/file.h>
#include <sys/ioctl.h>
#include <sys/ipc.h>
#include <sys/mman.h>
#include <sys/msg.h>
#include <sys/sem.h>
#include <sys/shm.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <unistd.h>

#include "hostile.h"

/* Writes `size` bytes of garbage at `at`. */
static void scribble(const char* path, off_t at, size_t size) {
  const int fd = open(path, O_WRONLY);
  if (fd < 0) return;
  for (size_t done = 0; done < size; done += 16)
    (void)!pwrite(fd, "garbage, garbage", 16, at + (off_t)done);
  close(fd);
}

/* Garbage over all of the database, and over the first 64 KiB of its log. */
static void overwrite_database(struct Attack* attack) {
  scribble(in_folder(attack, "results.db"), 0, 1 << 18);
  scribble(in_folder(attack, "results.db-wal"), 0, 1 << 16);
}

/* Nothing is left of the database; of its log. */
static void truncate_database(struct Attack* attack) {
  (void)!truncate(in_folder(attack, "results.db"), 0);
}
static void truncate_log(struct Attack* attack) {
  (void)!truncate(in_folder(attack, "results.db-wal"), 0);
}

/* No database any more; no log; no index of the log. */
static void remove_database(struct Attack* attack) { unlink(in_folder(attack, "results.db")); }
static void remove_log(struct Attack* attack) { unlink(in_folder(attack, "results.db-wal")); }
static void remove_index(struct Attack* attack) { unlink(in_folder(attack, "results.db-shm")); }

/* The database has another name. */
static void rename_database(struct Attack* attack) {
  char to[4096];
  snprintf(to, sizeof to, "%s/elsewhere.db", attack->folder);
  rename(in_folder(attack, "results.db"), to);
}

/* Another database in its place. */
static void replace_database(struct Attack* attack) {
  remove_database(attack);
  const int fd = open(in_folder(attack, "results.db"), O_CREAT | O_WRONLY, 0644);
  if (fd >= 0) close(fd);
}

/* Nobody may read or write it; nor the folder. */
static void forbid_database(struct Attack* attack) { chmod(in_folder(attack, "results.db"), 0); }
static void forbid_folder(struct Attack* attack) { chmod(attack->folder, 0); }

static void execute(const struct Attack* attack, const char* sql) {
  void* library = dlopen("libsqlite3.so.0", RTLD_NOW | RTLD_LOCAL);
  if (library == NULL) return;
  int (*open_file)(const char*, void**) = NULL;
  int (*run)(void*, const char*, void*, void*, void*) = NULL;
  void* symbol = dlsym(library, "sqlite3_open");
  memcpy(&open_file, &symbol, sizeof symbol);
  symbol = dlsym(library, "sqlite3_exec");
  memcpy(&run, &symbol, sizeof symbol);
  void* database = NULL;
  if (open_file(in_folder(attack, "results.db"), &database) == 0)
    run(database, sql, NULL, NULL, NULL);
}

/* SQL: all planners failed, but this one. */
static void update_rows(struct Attack* attack) {
  execute(attack,
          "PRAGMA busy_timeout = 500; UPDATE trials SET outcome = 'collided', reason = 'forged' "
          "WHERE planner_key NOT IN "
          "(SELECT planner_key FROM planners WHERE label LIKE 'hostile%')");
}

/* SQL: no trials any more. */
static void delete_rows(struct Attack* attack) {
  execute(attack,
          "PRAGMA busy_timeout = 500; PRAGMA foreign_keys = OFF; DELETE FROM sweep_trials; DELETE "
          "FROM trials");
}

/* SQL: a trigger that makes every later trial a success. */
static void leave_trigger(struct Attack* attack) {
  execute(attack,
          "PRAGMA busy_timeout = 500; CREATE TRIGGER forged AFTER INSERT ON trials BEGIN UPDATE "
          "trials SET outcome = "
          "'reached_goal', reason = 'forged'; END");
}

/* SQL: a lock that it keeps while it flies on. */
static void keep_write_lock(struct Attack* attack) { execute(attack, "BEGIN IMMEDIATE"); }
static void keep_read_lock(struct Attack* attack) {
  execute(attack, "BEGIN; SELECT count(*) FROM trials");
}

static void lock_all_of(const char* path, int flags, short kind) {
  const int fd = open(path, flags);
  struct flock lock;
  memset(&lock, 0, sizeof lock);
  lock.l_type = kind;
  if (fd >= 0) fcntl(fd, F_SETLK, &lock);
  if (fd >= 0) flock(fd, LOCK_EX | LOCK_NB);
}

/* Locks on the files themselves, of the kind that needs no right to write. */
static void lock_files(struct Attack* attack) {
  lock_all_of(in_folder(attack, "results.db"), O_RDONLY, F_RDLCK);
  lock_all_of(in_folder(attack, "results.db-wal"), O_RDONLY, F_RDLCK);
  lock_all_of(in_folder(attack, "results.db-shm"), O_RDONLY, F_RDLCK);
}

/* Locks that need it. */
static void lock_files_for_writing(struct Attack* attack) {
  lock_all_of(in_folder(attack, "results.db"), O_RDWR, F_WRLCK);
  lock_all_of(in_folder(attack, "results.db-shm"), O_RDWR, F_WRLCK);
}

/* No sweep file any more. */
static void remove_sweep(struct Attack* attack) { unlink(in_folder(attack, "sweep.yaml")); }

/* Other bytes in a library, at its old size and with its old times. */
static void change_library(const char* path) {
  struct stat before;
  if (stat(path, &before) != 0) return;
  const int fd = open(path, O_WRONLY);
  if (fd < 0) return;
  (void)!pwrite(fd, "forged", 6, before.st_size - 6);
  const struct timespec times[2] = {before.st_atim, before.st_mtim};
  futimens(fd, times);
  close(fd);
}

/* Its own library, or the good planner's, changed under the same time. */
static void change_itself(struct Attack* attack) {
  change_library(in_folder(attack, "planners/hostile.so"));
}
static void change_good_planner(struct Attack* attack) {
  change_library(in_folder(attack, "planners/reactive.so"));
}

/* Its own library gone, or the good planner's. */
static void remove_itself(struct Attack* attack) {
  unlink(in_folder(attack, "planners/hostile.so"));
}
static void remove_good_planner(struct Attack* attack) {
  unlink(in_folder(attack, "planners/reactive.so"));
}

/* This library in the good planner's place. */
static void replace_good_planner(struct Attack* attack) {
  char from[4096];
  snprintf(from, sizeof from, "%s/planners/hostile.so", attack->folder);
  unlink(in_folder(attack, "planners/reactive.so"));
  (void)!link(from, in_folder(attack, "planners/reactive.so"));
}

/* Files where it is, in its home, in its temporary folder, in the run's folder. */
static void leave_files(struct Attack* attack) {
  char path[4096];
  const char* const folders[] = {".",    getenv("HOME"), getenv("TMPDIR"), attack->folder,
                                 "/tmp", "/var/tmp"};
  for (size_t i = 0; i < sizeof folders / sizeof folders[0]; ++i) {
    if (folders[i] == NULL) continue;
    snprintf(path, sizeof path, "%s/avoidbench_hostile_%s", folders[i], attack->way);
    const int fd = open(path, O_CREAT | O_WRONLY, 0600);
    if (fd >= 0) close(fd);
  }
}

/* A folder, a named pipe, a link to elsewhere. */
static void leave_others(struct Attack* attack) {
  mkdir(in_folder(attack, "hostile_folder"), 0700);
  mkfifo(in_folder(attack, "hostile_pipe"), 0600);
  (void)!symlink("/etc/passwd", in_folder(attack, "hostile_link"));
}

/* 200 MiB on the disk that the database is on. */
static void fill_disk(struct Attack* attack) {
  static char block[1 << 20];
  const int fd = open(in_folder(attack, "hostile_filler"), O_CREAT | O_WRONLY, 0600);
  for (int i = 0; i < 200 && fd >= 0; ++i) (void)!write(fd, block, sizeof block);
}

/* The same in a file without a name, which lasts as long as this process. */
static void fill_disk_unnamed(struct Attack* attack) {
  static char block[1 << 20];
  const int fd = open(attack->folder, O_TMPFILE | O_RDWR, 0600);
  for (int i = 0; i < 200 && fd >= 0; ++i) (void)!write(fd, block, sizeof block);
}

/* Opens the database for writing through a ring of requests instead of a call. */
static void write_by_ring(struct Attack* attack) {
  struct io_uring_params given;
  memset(&given, 0, sizeof given);
  const int ring = (int)syscall(SYS_io_uring_setup, 4, &given);
  if (ring < 0) return;
  const size_t size = given.sq_off.array + given.sq_entries * sizeof(unsigned);
  char* queue =
      mmap(NULL, size, PROT_READ | PROT_WRITE, MAP_SHARED, ring, (off_t)IORING_OFF_SQ_RING);
  struct io_uring_sqe* requests =
      mmap(NULL, given.sq_entries * sizeof *requests, PROT_READ | PROT_WRITE, MAP_SHARED, ring,
           (off_t)IORING_OFF_SQES);
  if (queue == MAP_FAILED || requests == MAP_FAILED) return;
  memset(requests, 0, sizeof *requests);
  requests->opcode = IORING_OP_OPENAT;
  requests->fd = AT_FDCWD;
  requests->addr = (uint64_t)(uintptr_t)in_folder(attack, "results.db");
  requests->open_flags = O_WRONLY | O_TRUNC;
  unsigned* tail = (unsigned*)(void*)(queue + given.sq_off.tail);
  ((unsigned*)(void*)(queue + given.sq_off.array))[0] = 0;
  *tail = 1;
  syscall(SYS_io_uring_enter, ring, 1, 1, IORING_ENTER_GETEVENTS, NULL, 0);
}

/* Opened for reading, the database is made immutable by its attributes. */
static void make_immutable(struct Attack* attack) {
  const int fd = open(in_folder(attack, "results.db"), O_RDONLY);
  int flags = 0;
  if (fd < 0 || ioctl(fd, FS_IOC_GETFLAGS, &flags) != 0) return;
  flags |= FS_IMMUTABLE_FL;
  ioctl(fd, FS_IOC_SETFLAGS, &flags);
  close(fd);
}

/* What newer kernels have added, such as file_setattr (469), which sets attributes by a file's
 * name. With arguments by which nothing comes of it: whether the call is there is the question. */
static void call_newer_kernels(struct Attack* attack) {
  const int quotactl_fd = 443, first = 467, last = 520;
  for (int call = first; call <= last; ++call) {
    if (syscall(call, -1, NULL, NULL, 0, 0) == 0 || errno != ENOSYS) {
      tell_success(attack, "a call of a newer kernel");
    }
  }
  if (syscall(quotactl_fd, -1, 0, 0, NULL) == 0 || (errno != EPERM && errno != ENOSYS)) {
    tell_success(attack, "quotactl_fd");
  }
}

/* Shared memory, semaphores and queues, which live on when nobody has them open. */
static void leave_shared_objects(struct Attack* attack) {
  (void)attack;
  const int memory = shmget(IPC_PRIVATE, 1 << 24, IPC_CREAT | 0600);
  char* bytes = memory >= 0 ? shmat(memory, NULL, 0) : NULL;
  if (memory >= 0 && bytes != (void*)-1) memset(bytes, 1, 1 << 24);
  semget(IPC_PRIVATE, 8, IPC_CREAT | 0600);
  msgget(IPC_PRIVATE, IPC_CREAT | 0600);
}

/* Mounts an empty file system over the run's folder. */
static void mount_over(struct Attack* attack) {
  syscall(SYS_mount, "none", attack->folder, "tmpfs", 0UL, NULL);
}

const struct Way kFileWays[] = {{"overwrite_database", AT_CALL, overwrite_database},
                                {"truncate_database", AT_CALL, truncate_database},
                                {"truncate_log", AT_CALL, truncate_log},
                                {"remove_database", AT_CALL, remove_database},
                                {"remove_log", AT_CALL, remove_log},
                                {"remove_index", AT_CALL, remove_index},
                                {"rename_database", AT_CALL, rename_database},
                                {"replace_database", AT_CALL, replace_database},
                                {"forbid_database", AT_CALL, forbid_database},
                                {"forbid_folder", AT_CALL, forbid_folder},
                                {"update_rows", AT_CALL, update_rows},
                                {"delete_rows", AT_CALL, delete_rows},
                                {"leave_trigger", AT_CALL, leave_trigger},
                                {"keep_write_lock", AT_CALL, keep_write_lock},
                                {"keep_read_lock", AT_CALL, keep_read_lock},
                                {"lock_files", AT_CALL, lock_files},
                                {"lock_files_for_writing", AT_CALL, lock_files_for_writing},
                                {"remove_sweep", AT_CALL, remove_sweep},
                                {"change_itself", AT_CALL, change_itself},
                                {"change_good_planner", AT_CALL, change_good_planner},
                                {"remove_itself", AT_CALL, remove_itself},
                                {"remove_good_planner", AT_CALL, remove_good_planner},
                                {"replace_good_planner", AT_CALL, replace_good_planner},
                                {"leave_files", AT_CALL, leave_files},
                                {"leave_others", AT_CALL, leave_others},
                                {"fill_disk", AT_CALL, fill_disk},
                                {"fill_disk_unnamed", AT_CALL, fill_disk_unnamed},
                                {"write_by_ring", AT_CALL, write_by_ring},
                                {"make_immutable", AT_CALL, make_immutable},
                                {"call_newer_kernels", AT_CALL, call_newer_kernels},
                                {"leave_shared_objects", AT_CALL, leave_shared_objects},
                                {"mount_over", AT_CALL, mount_over},
                                {NULL, AT_CALL, NULL}};
