#include <gtest/gtest.h>
#include <signal.h>
#include <sqlite3.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <fstream>

#include "base/digest.hpp"
#include "base/input_error.hpp"
#include "store/database.hpp"
#include "store/merge.hpp"
#include "store/row_digest.hpp"
#include "store/run_sql.hpp"
#include "store/statement.hpp"
#include "support/input_error_message.hpp"
#include "support/sample_rows.hpp"

/// What may be wrong with a file or its disk, and what survives.
namespace avoidbench {
namespace {

using namespace sample_rows;
using test::has;
using test::message_of;
using test::run_sql;

std::string message_of_opening(const std::filesystem::path& path) {
  const std::string for_run = message_of([&] { Database::open_for_run(path, kMetrics); });
  const std::string for_reading = message_of([&] { Database::open_for_reading(path); });
  EXPECT_EQ(for_run.find(path.string()), 0U) << for_run;
  EXPECT_EQ(for_reading.find(path.string()), 0U) << for_reading;
  return for_run;
}

TEST(Damage, AForeignDatabaseIsRefusedAndLeftAsItIs) {
  const TemporaryFolder folder;
  run_sql(
      folder / "f.db",
      "PRAGMA journal_mode = WAL; CREATE TABLE photos (name); INSERT INTO photos VALUES ('x');");
  const std::string before = file_digest(folder / "f.db");
  EXPECT_TRUE(has(message_of_opening(folder / "f.db"), "not a database of avoidbench"));
  EXPECT_EQ(file_digest(folder / "f.db"), before);
}

TEST(Damage, ATextFileIsRefusedAndLeftAsItIs) {
  const TemporaryFolder folder;
  for (const std::string& content : {std::string("short"), std::string(5000, 'x')}) {
    std::ofstream(folder / "t.db") << content;
    EXPECT_TRUE(has(message_of_opening(folder / "t.db"), "not an SQLite file"));
    EXPECT_EQ(std::filesystem::file_size(folder / "t.db"), content.size());
  }
}

TEST(Damage, ANewerSchemaIsRefusedWithTheVersionNeeded) {
  const TemporaryFolder folder;
  { begun(folder / "n.db"); }
  run_sql(folder / "n.db", "PRAGMA user_version = 7");
  const std::string message = message_of_opening(folder / "n.db");
  EXPECT_TRUE(has(message, "newer avoidbench")) << message;
  EXPECT_TRUE(has(message, " is 7; ")) << message;
}

TEST(Damage, AnotherSchemaVersionIsRefusedAndTheFileLeftAlone) {
  const TemporaryFolder folder;
  { begun(folder / "o.db").add_trial(trial_row("a", 0, 0, Outcome::reached_goal)); }
  for (const int version : {-1, 0}) {
    run_sql(folder / "o.db", "PRAGMA user_version = " + std::to_string(version));
    const std::string before = file_digest(folder / "o.db");
    const std::string expected = "o.db: its schema version (PRAGMA user_version) is " +
                                 std::to_string(version) + "; this avoidbench reads version 1: ";
    EXPECT_TRUE(has(message_of_opening(folder / "o.db"), expected));
    EXPECT_TRUE(
        has(message_of([&] { Database::open_for_run(folder / "o.db", kMetrics); }), expected));
    Database other = begun(folder / "other.db");
    EXPECT_TRUE(has(message_of([&] { merge_database(other, folder / "o.db"); }), expected));
    EXPECT_EQ(file_digest(folder / "o.db"), before);
  }
}

TEST(Damage, AnotherVersionOfAMetricIsRefused) {
  const TemporaryFolder folder;
  { begun(folder / "m.db"); }
  std::vector<MetricDef> metrics(std::begin(kMetrics), std::end(kMetrics));
  metrics[0].version = 2;
  const std::string changed = message_of([&] { Database::open_for_run(folder / "m.db", metrics); });
  EXPECT_TRUE(has(changed, "path_optimality_pct in version 1")) << changed;
  EXPECT_TRUE(has(changed, "version 2")) << changed;
  metrics.erase(metrics.begin());
  const std::string gone = message_of([&] { Database::open_for_run(folder / "m.db", metrics); });
  EXPECT_TRUE(has(gone, "does not compute")) << gone;
}

TEST(Damage, PlacesThatCanHoldNoFile) {
  const TemporaryFolder folder;
  EXPECT_TRUE(has(message_of_opening(folder.path()), "a folder"));
  EXPECT_TRUE(has(message_of_opening("/dev/full"), "not a regular file"));
  const std::filesystem::path nowhere = folder / "no/such/folder.db";
  EXPECT_TRUE(has(message_of([&] { Database::open_for_run(nowhere, kMetrics); }), "folder exists"));
  EXPECT_TRUE(has(message_of([&] { Database::open_for_reading(nowhere); }), "no such file"));
  const std::string proc = message_of([] { Database::open_for_run("/proc/results.db", kMetrics); });
  EXPECT_TRUE(has(proc, "/proc/results.db: ")) << proc;
}

/// What `action` says where this process may write nowhere in the folder; "skipped" where it may
/// whatever it does.
template <class Action>
std::string message_without_rights(const TemporaryFolder& folder, Action action) {
  using std::filesystem::perms;
  std::filesystem::permissions(folder.path(), perms::owner_read | perms::owner_exec |
                                                  perms::others_read | perms::others_exec);
  int ends[2];
  EXPECT_EQ(pipe(ends), 0);
  const pid_t child = fork();
  if (child == 0) {
    constexpr uid_t kNobody = 65534;
    const bool is_root = geteuid() == 0;
    const bool may_not = !is_root || (setgid(kNobody) == 0 && setuid(kNobody) == 0);
    const std::string message = may_not ? message_of(action) : "skipped";
    _exit(write(ends[1], message.data(), message.size()) < 0 ? 1 : 0);
  }
  close(ends[1]);
  std::string message(4096, '\0');
  const ssize_t count = read(ends[0], message.data(), message.size());
  message.resize(count > 0 ? static_cast<std::size_t>(count) : 0);
  close(ends[0]);
  waitpid(child, nullptr, 0);
  std::filesystem::permissions(folder.path(), perms::owner_all);
  return message;
}

TEST(Damage, AFolderThatCannotBeWrittenIsReadFromAndNotWrittenTo) {
  const TemporaryFolder folder;
  { begun(folder / "closed.db").add_trial(trial_row("a", 0, 0, Outcome::reached_goal)); }
  {
    Database db = begun(folder / "running.db");
    db.checkpoint();
    copy_file(folder / "running.db", folder / "wal_mode.db");
    db.add_trial(trial_row("a", 0, 0, Outcome::reached_goal));
    copy_file(folder / "running.db", folder / "killed.db");
    copy_file(folder / "running.db-wal", folder / "killed.db-wal");
  }
  for (const auto& [name, trials] :
       {std::pair("closed.db", 1U), {"wal_mode.db", 0U}, {"killed.db", 1U}}) {
    const std::filesystem::path file = folder / name;
    const std::size_t expected = trials;  // clang 14 captures no structured binding
    const std::string read = message_without_rights(folder, [&] {
      const Database db = Database::open_for_reading(file);
      check_digests(db, true);
      if (db.finished_keys().size() != expected) throw InputError("other trials");
    });
    if (read == "skipped") GTEST_SKIP() << "may write everywhere";
    EXPECT_EQ(read, "") << name;
    const std::string run =
        message_without_rights(folder, [&] { Database::open_for_run(file, kMetrics); });
    EXPECT_TRUE(has(run, file.string() + ": can't be ")) << run;
  }
  const std::filesystem::path fresh = folder / "new.db";
  const std::string message =
      message_without_rights(folder, [&] { Database::open_for_run(fresh, kMetrics); });
  EXPECT_TRUE(has(message, "check that its folder exists and may be written")) << message;
}

TEST(Damage, AnEmptyFileIsANewDatabaseForARunOnly) {
  const TemporaryFolder folder;
  std::ofstream(folder / "e.db").flush();
  EXPECT_TRUE(has(message_of([&] { Database::open_for_reading(folder / "e.db"); }), "empty file"));
  EXPECT_EQ(begun(folder / "e.db").finished_keys().size(), 0U);
}

TEST(Damage, OverwrittenPagesAreFound) {
  const TemporaryFolder folder;
  {
    Database db = begun(folder / "c.db");
    for (int mission = 0; mission < 2; ++mission) {
      db.add_trial(trial_row("a", 0, mission, Outcome::reached_goal));
    }
  }
  const auto size = static_cast<std::streamoff>(std::filesystem::file_size(folder / "c.db"));
  {
    std::fstream file(folder / "c.db", std::ios::in | std::ios::out | std::ios::binary);
    for (std::streamoff at = 4096; at + 4096 <= size; at += 4096) {
      file.seekp(at);
      file << std::string(64, '\xee');
    }
  }
  EXPECT_TRUE(has(message_of_opening(folder / "c.db"), "damaged"));
}

TEST(Damage, ALockedFileIsSaidToBeLocked) {
  const TemporaryFolder folder;
  Database db = begun(folder / "l.db");
  sqlite3* other = nullptr;
  ASSERT_EQ(sqlite3_open((folder / "l.db").c_str(), &other), SQLITE_OK);
  ASSERT_EQ(sqlite3_exec(other, "BEGIN IMMEDIATE", nullptr, nullptr, nullptr), SQLITE_OK);
  sqlite3_busy_timeout(db.handle(), 20);
  const std::string message =
      message_of([&] { db.add_trial(trial_row("a", 0, 0, Outcome::reached_goal)); });
  EXPECT_TRUE(has(message, "locked by another program")) << message;
  sqlite3_exec(other, "ROLLBACK", nullptr, nullptr, nullptr);
  sqlite3_close(other);
  db.add_trial(trial_row("a", 0, 0, Outcome::reached_goal));
  EXPECT_EQ(db.finished_keys().size(), 1U);
}

TEST(Damage, ReadersAreNotDisturbedByAWriter) {
  const TemporaryFolder folder;
  Database writer = begun(folder / "w.db");
  writer.add_trial(trial_row("a", 0, 0, Outcome::reached_goal));
  const Database reader = Database::open_for_reading(folder / "w.db");
  EXPECT_EQ(reader.finished_keys().size(), 1U);
  writer.add_trial(trial_row("a", 0, 1, Outcome::reached_goal));
  EXPECT_EQ(reader.finished_keys().size(), 2U);
  EXPECT_THROW(execute(reader.handle(), reader.path(), "DELETE FROM events"), InputError);
}

/// Runs `work` in a child process; its exit status as waitpid() gives it.
template <class Work>
int status_of_child(Work work) {
  const pid_t child = fork();
  if (child == 0) {
    work();
    _exit(0);
  }
  int status = 0;
  waitpid(child, &status, 0);
  return status;
}

TEST(Damage, CommittedTrialsSurviveAKill) {
  const TemporaryFolder folder;
  const int status = status_of_child([&] {
    Database db = begun(folder / "k.db");
    db.add_trial(trial_row("a", 0, 0, Outcome::reached_goal));
    db.add_trial(trial_row("a", 0, 1, Outcome::collided));
    // Killed in the middle of the third.
    execute(db.handle(), db.path(),
            "BEGIN IMMEDIATE; UPDATE trials SET outcome = 'timed_out'; DELETE FROM events;");
    kill(getpid(), SIGKILL);
  });
  ASSERT_TRUE(WIFSIGNALED(status));
  Database db = begun(folder / "k.db");
  EXPECT_EQ(db.finished_keys().size(), 2U);
  const auto trial = db.read_trial(trial_row("a", 0, 1, Outcome::collided).key);
  ASSERT_TRUE(trial.has_value());
  EXPECT_EQ(trial->record.outcome, Outcome::collided);
  EXPECT_EQ(trial->record.collisions.size(), 1U);
  db.add_trial(trial_row("a", 1, 0, Outcome::reached_goal));
  EXPECT_EQ(db.finished_keys().size(), 3U);
}

TEST(Damage, AFullDiskIsAClearErrorAndLosesNothing) {
  const TemporaryFolder folder;
  // Trials until no byte more fits; exit status 10 + the number that were committed.
  const int status = status_of_child([&] {
    signal(SIGXFSZ, SIG_IGN);
    Database db = begun(folder / "d.db");
    const rlimit limit{.rlim_cur = 400000, .rlim_max = 400000};
    setrlimit(RLIMIT_FSIZE, &limit);
    int count = 0;
    const std::string message = message_of([&] {
      for (; count < 100; ++count) {
        TrialRow trial = trial_row("a", 0, 0, Outcome::reached_goal);
        trial.key = key_of(std::to_string(count));
        trial.record.samples.resize(200, sample(1));
        db.add_trial(trial);
      }
    });
    const bool is_clear = has(message, "committed before is kept") && has(message, "d.db: ");
    _exit(is_clear ? 10 + count : 1);
  });
  ASSERT_TRUE(WIFEXITED(status));
  ASSERT_GT(WEXITSTATUS(status), 10);
  ASSERT_LT(WEXITSTATUS(status), 110);
  const auto count = static_cast<std::size_t>(WEXITSTATUS(status) - 10);
  Database db = begun(folder / "d.db");
  EXPECT_EQ(db.finished_keys().size(), count);
  db.add_trial(trial_row("a", 0, 1, Outcome::reached_goal));
  EXPECT_EQ(db.finished_keys().size(), count + 1);
}

TEST(Damage, AFileWithOddCharactersInItsNameIsAFile) {
  const TemporaryFolder folder;
  const std::filesystem::path path = folder / "100% a?b#c é.db";
  { begun(path); }
  EXPECT_TRUE(std::filesystem::exists(path));
  EXPECT_EQ(Database::open_for_reading(path).finished_keys().size(), 0U);
}

}  // namespace
}  // namespace avoidbench
