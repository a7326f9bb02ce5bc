#include "store/log_check.hpp"

#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <fstream>
#include <set>

#include "base/random.hpp"
#include "store/database.hpp"
#include "store/run_sql.hpp"
#include "support/input_error_message.hpp"
#include "support/sample_rows.hpp"

/// Logs that killed runs leave beside their files, and files that then get the names of others.
namespace avoidbench {
namespace {

using namespace sample_rows;
using test::has;
using test::message_of;
using test::run_sql;

/// A trial whose flight takes some thirty pages, none of which equals another one's.
TrialRow long_trial(int number) {
  TrialRow row = trial_row("a", 0, 0, Outcome::reached_goal);
  row.key = key_of("long " + std::to_string(number));
  row.record.samples.clear();
  for (int i = 0; i < 600; ++i) {
    row.record.samples.push_back(sample(i));
    row.record.samples.back().rotor_power_w = 1.0 / (1.0 + number + i);
    row.record.samples.back().position_world *= 1.0 / (7.0 + number * 600 + i);
  }
  return row;
}

/// What a run that was killed now would leave: file and log, under this name.
void leave_as_killed(const std::filesystem::path& running, const std::filesystem::path& copy) {
  for (const char* part : {"", "-wal"}) {
    std::filesystem::copy_file(running.string() + part, copy.string() + part,
                               std::filesystem::copy_options::overwrite_existing);
  }
}

/// Refused for reading and writing, with nothing changed.
void expect_refused(const std::filesystem::path& file) {
  const std::string before = file_digest(file), log = file_digest(file.string() + "-wal");
  const std::string expected = ": next to it is " + file.filename().string() + "-wal, the log of ";
  EXPECT_TRUE(has(message_of([&] { Database::open_for_reading(file); }), expected));
  EXPECT_TRUE(has(message_of([&] { Database::open_for_run(file, kMetrics); }), expected));
  EXPECT_EQ(file_digest(file), before);
  EXPECT_EQ(file_digest(file.string() + "-wal"), log);
}

/// A run of twenty trials, killed, and a file that takes the name of its own.
class Replaced : public testing::Test {
 protected:
  void SetUp() override {
    Database db = begun(folder / "r.db");
    for (int i = 0; i < 20; ++i) db.add_trial(long_trial(i));
    leave_as_killed(folder / "r.db", folder / "k.db");
    leave_as_killed(folder / "r.db", folder / "saved.db");
  }
  void replace_by(const std::filesystem::path& other) {
    std::filesystem::copy_file(other, folder / "k.db",
                               std::filesystem::copy_options::overwrite_existing);
  }
  const TemporaryFolder folder;
};

TEST_F(Replaced, ByNothingTheRunIsWhole) {
  EXPECT_EQ(Database::open_for_reading(folder / "k.db").finished_keys().size(), 20U);
  Database db = begun(folder / "k.db");
  db.add_trial(long_trial(20));
  EXPECT_EQ(db.finished_keys().size(), 21U);
}

TEST_F(Replaced, ByAFinishedDatabase) {
  { begun(folder / "other.db").add_trial(finished()); }
  replace_by(folder / "other.db");
  expect_refused(folder / "k.db");
}

TEST_F(Replaced, ByTheFileOfAnotherKilledRun) {
  for (const int checkpoints : {1, 2}) {
    Database other = begun(folder / "other.db");
    for (int i = 0; i < 30 * checkpoints; ++i) {
      other.add_trial(long_trial(100 + i));
      if (i % 30 == 29) other.checkpoint();
    }
    replace_by(folder / "other.db");
    // The log has pages of a database of twenty trials from its beginning: they would be all.
    Database resumed = begun(folder / "r.db");
    resumed.checkpoint();
    resumed.add_trial(long_trial(50));
    leave_as_killed(folder / "r.db", folder / "k.db");
    replace_by(folder / "other.db");
    expect_refused(folder / "k.db");
  }
}

TEST_F(Replaced, ByAnEarlierStateOfItself) {
  { Database::open_for_run(folder / "r.db", kMetrics); }
  std::filesystem::copy_file(folder / "r.db", folder / "backup.db");
  Database db = begun(folder / "r.db");
  // The backup and what was committed since are the whole.
  leave_as_killed(folder / "r.db", folder / "k.db");
  replace_by(folder / "backup.db");
  expect_refused(folder / "k.db");
  db.add_trial(long_trial(60));
  db.checkpoint();
  std::filesystem::copy_file(folder / "r.db", folder / "while_running.db");
  for (int i = 0; i < 30; ++i) db.add_trial(long_trial(70 + i));
  db.checkpoint();
  db.add_trial(long_trial(61));
  leave_as_killed(folder / "r.db", folder / "k.db");
  EXPECT_EQ(Database::open_for_reading(folder / "k.db").finished_keys().size(), 52U);
  leave_as_killed(folder / "r.db", folder / "k.db");
  replace_by(folder / "while_running.db");
  expect_refused(folder / "k.db");
  leave_as_killed(folder / "r.db", folder / "k.db");
  replace_by(folder / "backup.db");
  expect_refused(folder / "k.db");
}

TEST_F(Replaced, BySomethingElse) {
  std::ofstream(folder / "k.db") << std::string(8000, 'x');
  expect_refused(folder / "k.db");
  run_sql(folder / "foreign.db", "CREATE TABLE t (x); PRAGMA journal_mode = WAL");
  replace_by(folder / "foreign.db");
  expect_refused(folder / "k.db");
}

TEST_F(Replaced, WhereTheFileIsGoneItsLogIsKept) {
  const std::string log = file_digest(folder / "k.db-wal");
  std::filesystem::remove(folder / "k.db");
  EXPECT_TRUE(has(message_of([&] { Database::open_for_run(folder / "k.db", kMetrics); }),
                  "k.db: is not there, but its log k.db-wal is"));
  EXPECT_FALSE(std::filesystem::exists(folder / "k.db"));
  std::ofstream(folder / "k.db").flush();
  EXPECT_TRUE(has(message_of([&] { Database::open_for_run(folder / "k.db", kMetrics); }),
                  "k.db: is empty, but its log k.db-wal is, with rows "));
  EXPECT_EQ(file_digest(folder / "k.db-wal"), log);
}

TEST_F(Replaced, ALogInWhichNothingIsCommittedIsNoHindrance) {
  { begun(folder / "other.db").add_trial(finished()); }
  for (const std::uintmax_t bytes : {0U, 10U, 32U, 4000U, 4152U}) {
    leave_as_killed(folder / "saved.db", folder / "k.db");
    std::filesystem::resize_file(folder / "k.db-wal", bytes);
    replace_by(folder / "other.db");
    EXPECT_EQ(Database::open_for_reading(folder / "k.db").finished_keys().size(), 1U) << bytes;
    Database::open_for_run(folder / "k.db", kMetrics);
  }
}

/// Adds trials until it is killed, with a checkpoint now and then.
[[noreturn]] void fly_until_killed(const std::filesystem::path& file, int first) {
  try {
    Database db = begun(file);
    for (int i = first;; ++i) {
      db.add_trial(long_trial(i));
      if (i % 7 == 0) db.checkpoint();
    }
  } catch (const InputError& error) {
    std::fprintf(stderr, "%s\n", error.what());
  }
  _exit(1);
}

TEST(LogCheck, ARunThatIsKilledAtAnyMomentIsResumed) {
  const TemporaryFolder folder;
  const std::filesystem::path file = folder / "r.db";
  RandomStream random = stream(1, "kills");
  std::size_t count = 0;
  constexpr int kKills = 40;
  for (int kill_index = 0; kill_index < kKills; ++kill_index) {
    const pid_t child = fork();
    if (child == 0) fly_until_killed(file, 1000 * kill_index);
    usleep(static_cast<useconds_t>(random.uniform(5e3, 3e5)));
    kill(child, SIGKILL);
    int status = 0;
    waitpid(child, &status, 0);
    ASSERT_TRUE(WIFSIGNALED(status)) << "it ended by itself: see above";
    // By a reader while the log is there, and at times by a run that takes it in.
    if (kill_index % 3 == 0) {
      Database::open_for_run(file, kMetrics);
    }
    std::error_code error;
    if (!std::filesystem::exists(file, error) || std::filesystem::file_size(file, error) == 0)
      continue;
    const std::string message = message_of([&] {
      const std::size_t now = Database::open_for_reading(file).finished_keys().size();
      EXPECT_GE(now, count);
      count = now;
    });
    const bool is_whole = message == "" || (count == 0 && has(message, "an empty file"));
    ASSERT_TRUE(is_whole) << message;
  }
  EXPECT_GT(count, static_cast<std::size_t>(kKills));
}

}  // namespace
}  // namespace avoidbench
