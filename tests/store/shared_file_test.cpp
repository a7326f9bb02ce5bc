#include <fcntl.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sqlite3.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <fstream>
#include <set>

#include "store/database.hpp"
#include "store/merge.hpp"
#include "support/input_error_message.hpp"
#include "support/sample_rows.hpp"

/// What other programs do to a file while a run writes to it.
namespace avoidbench {
namespace {

using namespace sample_rows;
using test::has;
using test::message_of;

TrialRow first() { return trial_row("a", 0, 0, Outcome::reached_goal); }
TrialRow second() { return trial_row("a", 0, 1, Outcome::collided); }

std::set<std::string> keys_in(const std::filesystem::path& file) {
  return Database::open_for_reading(file).finished_keys();
}

/// A process that has the file open for a run, as long as it isn't killed; it has started a program
/// that outlives it.
class OtherRun {
 public:
  explicit OtherRun(const std::filesystem::path& file) {
    int ready[2];
    EXPECT_EQ(pipe2(ready, O_CLOEXEC), 0);
    pid_ = fork();
    if (pid_ == 0) {
      Database db = begun(file);
      db.add_trial(first());
      const pid_t started = fork();
      if (started == 0) execl("/bin/sleep", "sleep", "30", nullptr);
      usleep(200000);  // until it is another program
      if (write(ready[1], &started, sizeof started) != sizeof started) _exit(1);
      pause();
      _exit(0);
    }
    EXPECT_EQ(read(ready[0], &started_, sizeof started_), static_cast<ssize_t>(sizeof started_));
    close(ready[0]);
    close(ready[1]);
  }
  ~OtherRun() {
    end();
    kill(started_, SIGKILL);
  }
  OtherRun(const OtherRun&) = delete;
  OtherRun& operator=(const OtherRun&) = delete;

  void end() {
    if (pid_ == 0) return;
    kill(pid_, SIGKILL);
    waitpid(pid_, nullptr, 0);
    pid_ = 0;
  }
  pid_t pid() const { return pid_; }

 private:
  pid_t pid_ = 0, started_ = 0;
};

TEST(SharedFile, ASecondRunSaysWhoWritesToIt) {
  const TemporaryFolder folder;
  OtherRun other(folder / "r.db");
  const std::string message =
      message_of([&] { Database::open_for_run(folder / "r.db", kMetrics); });
  EXPECT_TRUE(has(message, "another avoidbench run or merge (pid " + std::to_string(other.pid())))
      << message;
  EXPECT_TRUE(has(message, ", since 20")) << message;
  EXPECT_TRUE(has(message, "Z, host ")) << message;
  // Under another name it is the same file, and readers are free.
  std::filesystem::create_symlink(folder / "r.db", folder / "link.db");
  EXPECT_TRUE(has(message_of([&] { Database::open_for_run(folder / "link.db", kMetrics); }),
                  "is writing to it"));
  EXPECT_EQ(keys_in(folder / "r.db").size(), 1U);
  // A killed run leaves no lock, also where a program that it started goes on.
  other.end();
  Database db = begun(folder / "r.db");
  db.add_trial(second());
  EXPECT_EQ(db.finished_keys().size(), 2U);
}

TEST(SharedFile, AMovedFileEndsTheRunAndHoldsAllTrials) {
  const TemporaryFolder folder;
  {
    Database db = begun(folder / "r.db");
    db.add_trial(first());
    std::filesystem::rename(folder / "r.db", folder / "moved.db");
    const std::string message = message_of([&] { db.add_trial(second()); });
    EXPECT_EQ(message.find((folder / "r.db").string() + ": was deleted or moved"), 0U) << message;
    EXPECT_TRUE(has(message, "is in " + (folder / "moved.db").string())) << message;
  }
  EXPECT_EQ(files_in(folder), std::set<std::string>{"moved.db"});
  EXPECT_EQ(keys_in(folder / "moved.db"), (std::set<std::string>{first().key, second().key}));
}

TEST(SharedFile, AFileMovedWithItsFolderHoldsAllTrials) {
  const TemporaryFolder folder;
  std::filesystem::create_directory(folder / "old");
  {
    Database db = begun(folder / "old/r.db");
    db.add_trial(first());
    std::filesystem::rename(folder / "old", folder / "new");
    EXPECT_TRUE(
        has(message_of([&] { db.checkpoint(); }), "is in " + (folder / "new/r.db").string()));
  }
  EXPECT_EQ(keys_in(folder / "new/r.db"), std::set<std::string>{first().key});
}

TEST(SharedFile, ADeletedFileIsRescued) {
  const TemporaryFolder folder;
  std::ofstream(folder / "r.rescued.db") << "somebody's";
  {
    Database db = begun(folder / "r.db");
    db.add_trial(first());
    for (const char* name : {"r.db", "r.db-wal", "r.db-shm"}) {
      std::filesystem::remove(folder / name);
    }
    const std::string message = message_of([&] { db.add_trial(second()); });
    EXPECT_TRUE(has(message, "saved in " + (folder / "r.rescued2.db").string())) << message;
  }
  EXPECT_EQ(files_in(folder), (std::set<std::string>{"r.rescued.db", "r.rescued2.db"}));
  EXPECT_EQ(keys_in(folder / "r.rescued2.db"), (std::set<std::string>{first().key, second().key}));
  Database again = begun(folder / "r.rescued2.db");
  again.add_trial(trial_row("b", 0, 0, Outcome::reached_goal));
  EXPECT_EQ(again.finished_keys().size(), 3U);
}

TEST(SharedFile, AReplacedFileIsRescuedAndTheOtherLeftAlone) {
  const TemporaryFolder folder;
  std::ofstream(folder / "other") << "another file";
  {
    Database db = begun(folder / "r.db");
    db.add_trial(first());
    std::filesystem::rename(folder / "other", folder / "r.db");
    EXPECT_TRUE(has(message_of([&] { db.add_trial(second()); }), "replaced by another file"));
  }
  EXPECT_EQ(std::filesystem::file_size(folder / "r.db"), 12U);
  EXPECT_EQ(keys_in(folder / "r.rescued.db").size(), 2U);
}

TEST(SharedFile, AFileIsRescuedWhereTheWorkingFolderIsGone) {
  const TemporaryFolder folder;
  std::filesystem::create_directory(folder / "gone");
  Database db = begun(folder / "r.db");
  db.add_trial(first());
  std::filesystem::remove(folder / "r.db");
  const auto current = std::filesystem::current_path();
  std::filesystem::current_path(folder / "gone");
  std::filesystem::remove(folder / "gone");
  const std::string message = message_of([&] { db.checkpoint(); });
  std::filesystem::current_path(current);
  EXPECT_TRUE(has(message, "saved in " + (folder / "r.rescued.db").string())) << message;
}

TEST(SharedFile, AFileDeletedWithItsFolderIsRescuedElsewhere) {
  const TemporaryFolder folder;
  std::filesystem::create_directory(folder / "gone");
  Database db = begun(folder / "gone/r.db");
  db.add_trial(first());
  std::filesystem::remove_all(folder / "gone");
  const auto current = std::filesystem::current_path();
  std::filesystem::current_path(folder.path());
  const std::string message = message_of([&] { db.checkpoint(); });
  std::filesystem::current_path(current);
  EXPECT_TRUE(has(message, "saved in " + (folder / "r.rescued.db").string())) << message;
  EXPECT_EQ(keys_in(folder / "r.rescued.db").size(), 1U);
}

/// Another program's lock of the whole file.
class OtherLock {
 public:
  explicit OtherLock(const std::filesystem::path& file, const char* kind) {
    EXPECT_EQ(sqlite3_open(file.c_str(), &handle_), SQLITE_OK);
    EXPECT_EQ(sqlite3_exec(handle_, kind, nullptr, nullptr, nullptr), SQLITE_OK);
  }
  ~OtherLock() {
    release();
    sqlite3_close(handle_);
  }
  OtherLock(const OtherLock&) = delete;
  OtherLock& operator=(const OtherLock&) = delete;
  void release() { sqlite3_exec(handle_, "ROLLBACK", nullptr, nullptr, nullptr); }

 private:
  sqlite3* handle_ = nullptr;
};

TEST(SharedFile, LocksOfOthersAreWaitedForAsLongAsItTakes) {
  const TemporaryFolder folder;
  { begun(folder / "r.db"); }
  OtherLock* lock = nullptr;
  double waited_s = 0.0;
  int calls = 0;
  const OnWait release_at_last = [&](double s) {
    waited_s = s;
    if (++calls == 12) lock->release();
    return true;
  };
  OtherLock opening(folder / "r.db", "BEGIN EXCLUSIVE");
  lock = &opening;
  Database db = Database::open_for_run(folder / "r.db", kMetrics, release_at_last);
  EXPECT_GE(calls, 12);
  EXPECT_GT(waited_s, 0.3);
  db.add_run(run_row());
  db.add_sweep(sweep_row());
  db.add_planner(planner_row("a"));
  db.add_map(map_row(0, 2), "forest");
  OtherLock writing(folder / "r.db", "BEGIN IMMEDIATE");
  lock = &writing;
  calls = 0;
  db.add_trial(first());
  EXPECT_GE(calls, 12);
  EXPECT_FALSE(db.has_given_up());
  EXPECT_EQ(db.finished_keys().size(), 1U);
}

TEST(SharedFile, AReaderInTheOldModeIsWaitedFor) {
  const TemporaryFolder folder;
  { begun(folder / "r.db"); }
  OtherLock reader(folder / "r.db", "BEGIN; SELECT count(*) FROM trials");
  int calls = 0;
  Database db = Database::open_for_run(folder / "r.db", kMetrics, [&](double) {
    if (++calls == 8) reader.release();
    return true;
  });
  EXPECT_GE(calls, 8);
}

TEST(SharedFile, WaitingEndsWhenItIsToldTo) {
  const TemporaryFolder folder;
  bool is_stopped = false;
  { begun(folder / "r.db"); }
  Database db =
      Database::open_for_run(folder / "r.db", kMetrics, [&](double) { return !is_stopped; });
  db.add_run(run_row());
  is_stopped = true;
  OtherLock writing(folder / "r.db", "BEGIN IMMEDIATE");
  EXPECT_TRUE(has(message_of([&] { db.add_sweep(sweep_row()); }), "locked by another program"));
  EXPECT_TRUE(db.has_given_up());
  writing.release();
  EXPECT_EQ(db.add_sweep(sweep_row()), 1);
}

/// The trials of a copy of the file alone, without the log beside it.
std::size_t count_in_file_alone(const TemporaryFolder& folder) {
  std::filesystem::copy_file(folder / "r.db", folder / "copy.db",
                             std::filesystem::copy_options::overwrite_existing);
  return keys_in(folder / "copy.db").size();
}

TEST(SharedFile, ACheckpointBringsAllIntoTheFile) {
  const TemporaryFolder folder;
  Database db = begun(folder / "r.db");
  db.checkpoint();
  db.add_trial(first());
  EXPECT_EQ(count_in_file_alone(folder), 0U);
  db.checkpoint();
  EXPECT_EQ(count_in_file_alone(folder), 1U);
}

TEST(SharedFile, AnEndWithoutAWrittenFileIsAnError) {
  const TemporaryFolder folder;
  Database db = begun(folder / "r.db");
  db.checkpoint();
  db.add_trial(first());
  // As with a file that became immutable: no write beyond a limit on the size of files.
  ::signal(SIGXFSZ, SIG_IGN);
  rlimit before{};
  ::getrlimit(RLIMIT_FSIZE, &before);
  rlimit small = before;
  small.rlim_cur = 4096;
  ::setrlimit(RLIMIT_FSIZE, &small);
  std::string problem;
  try {
    db.checkpoint();
  } catch (const InputError& error) {
    problem = error.what();
  }
  ::setrlimit(RLIMIT_FSIZE, &before);
  EXPECT_NE(problem.find("r.db-wal, which belongs to it"), std::string::npos) << problem;
  EXPECT_EQ(count_in_file_alone(folder), 0U);
  db.checkpoint();
  EXPECT_EQ(count_in_file_alone(folder), 1U);
}

TEST(SharedFile, AfterClosingAllIsInOneFile) {
  const TemporaryFolder folder;
  Database db = begun(folder / "r.db");
  db.add_trial(first());
  db.close();
  EXPECT_EQ(files_in(folder), std::set<std::string>{"r.db"});
  EXPECT_EQ(count_in_file_alone(folder), 1U);
  Database again = begun(folder / "r.db");
  const Database reader = Database::open_for_reading(folder / "r.db");
  EXPECT_EQ(reader.finished_keys().size(), 1U);
  again.add_trial(second());
  again.close();
  EXPECT_EQ(count_in_file_alone(folder), 2U);
}

}  // namespace
}  // namespace avoidbench
