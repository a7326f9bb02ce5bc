#include "store/merge.hpp"

#include <gtest/gtest.h>
#include <sqlite3.h>

#include "base/input_error.hpp"
#include "store/record_format.hpp"
#include "store/run_sql.hpp"
#include "support/canonical_rows.hpp"
#include "support/redigest.hpp"
#include "support/sample_rows.hpp"

namespace avoidbench {
namespace {

using namespace sample_rows;  // NOLINT(google-build-using-namespace): a test's own rows
using test::canonical_rows;

constexpr const char* kSweepJson =
    R"({"trials":2,"planners":[{},{}],"axes":[{"path":"map_seed","values":[1,2]}]})";

/// A file with a sweep of two maps, two planners and two missions a map, and these trials of it.
void write_part(const std::filesystem::path& file, const std::string& shard,
                const std::vector<TrialRow>& trials) {
  Database db = Database::open_for_run(file, kMetrics);
  RunRow run = run_row();
  run.shard = shard;
  db.add_run(run);
  db.add_sweep(sweep_row(kSweepJson));
  for (const char* label : {"a", "b"}) db.add_planner(planner_row(label));
  for (int map = 0; map < 2; ++map) db.add_map(map_row(map, 2), "forest");
  for (const TrialRow& trial : trials) db.add_trial(trial);
}

std::vector<TrialRow> trials_of(const std::string& label) {
  std::vector<TrialRow> trials;
  for (int map = 0; map < 2; ++map) {
    for (int mission = 0; mission < 2; ++mission) {
      trials.push_back(trial_row(label, map, mission, Outcome::reached_goal));
    }
  }
  return trials;
}

std::string merged(const TemporaryFolder& folder, const std::string& into,
                   const std::vector<std::string>& parts) {
  Database db = Database::open_for_run(folder / into, kMetrics);
  for (const std::string& part : parts) merge_database(db, folder / part);
  return canonical_rows(db);
}

TEST(Merge, PartsMakeTheWholeInAnyOrderAndTwice) {
  const TemporaryFolder folder;
  std::vector<TrialRow> all = trials_of("a");
  for (const TrialRow& trial : trials_of("b")) all.push_back(trial);
  write_part(folder / "whole.db", "", all);
  write_part(folder / "1.db", "1/2", trials_of("a"));
  write_part(folder / "2.db", "2/2", trials_of("b"));
  const std::string whole = canonical_rows(Database::open_for_reading(folder / "whole.db"));
  EXPECT_EQ(merged(folder, "12.db", {"1.db", "2.db"}), whole);
  EXPECT_EQ(merged(folder, "21.db", {"2.db", "1.db"}), whole);
  EXPECT_EQ(merged(folder, "12.db", {"1.db", "2.db", "1.db"}), whole);
  Database db = Database::open_for_run(folder / "12.db", kMetrics);
  EXPECT_EQ(merge_database(db, folder / "1.db").new_trials, 0);
  const TrialRow row = trials_of("b")[1];
  EXPECT_EQ(db.read_trial(row.key)->record.samples.size(), row.record.samples.size());
  const auto complete = sweep_completeness(db);
  ASSERT_EQ(complete.size(), 1U);
  EXPECT_EQ(complete[0].wanted, 8);
  EXPECT_EQ(complete[0].flown, 8);
  EXPECT_TRUE(complete[0].lost_shards.empty());
}

TEST(Merge, SaysWhatIsMissing) {
  const TemporaryFolder folder;
  write_part(folder / "1.db", "1/3", trials_of("a"));
  Database db = Database::open_for_run(folder / "all.db", kMetrics);
  merge_database(db, folder / "1.db");
  const auto complete = sweep_completeness(db);
  EXPECT_EQ(complete[0].flown, 4);
  EXPECT_EQ(complete[0].wanted, 8);
  EXPECT_EQ(complete[0].lost_shards, (std::vector<std::string>{"2/3", "3/3"}));
}

/// An axis that shares its maps flies each of their invalid missions in none of its settings.
TEST(Merge, InvalidMissionsAreNotMissing) {
  const TemporaryFolder folder;
  const std::pair<const char*, std::int64_t> cases[] = {{"vehicle.mass_kg", 12},
                                                        {"mission.time_limit_s", 14},
                                                        {"vehicle.body_size_m", 14},
                                                        {"seed", 14}};
  for (const auto& [path, wanted] : cases) {
    Database db = Database::open_for_run(folder / (std::string(path) + ".db"), kMetrics);
    db.add_run(run_row());
    db.add_sweep(sweep_row(R"({"trials":4,"planners":[{},{}],"axes":[{"path":")" +
                           std::string(path) + R"(","values":[1,2]}]})"));
    db.add_map(map_row(0, 4, true), "forest");
    EXPECT_EQ(sweep_completeness(db)[0].wanted, wanted) << path;
  }
}

TEST(Merge, RefusesOtherResultsOfOneTrialAndChangesNothing) {
  const TemporaryFolder folder;
  write_part(folder / "1.db", "", trials_of("a"));
  std::vector<TrialRow> other = trials_of("a");
  other[2].record.end_time_s += 1e-9;
  std::vector<TrialRow> more = trials_of("b");
  other.insert(other.begin(), more.begin(), more.end());
  write_part(folder / "2.db", "", other);
  const std::string before = merged(folder, "all.db", {"1.db"});
  Database db = Database::open_for_run(folder / "all.db", kMetrics);
  try {
    merge_database(db, folder / "2.db");
    FAIL() << "merged";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("holds trial " + other[6].key.substr(0, 12)),
              std::string::npos)
        << error.what();
  }
  EXPECT_EQ(canonical_rows(db), before);
  EXPECT_EQ(merge_database(db, folder / "1.db").new_trials, 0);  // and it still works
}

TEST(Merge, RefusesAnotherTrajectoryAndItself) {
  const TemporaryFolder folder;
  write_part(folder / "1.db", "", trials_of("a"));
  std::vector<TrialRow> other = trials_of("a");
  other[0].record.samples[1].position_world.x() += 0.5;
  write_part(folder / "2.db", "", other);
  Database db = Database::open_for_run(folder / "1.db", kMetrics);
  EXPECT_THROW(merge_database(db, folder / "2.db"), InputError);
  EXPECT_THROW(merge_database(db, folder / "1.db"), InputError);
  EXPECT_THROW(merge_database(db, folder / "none.db"), InputError);
}

TEST(Merge, RefusesAPlannerWhoseKeyIsNotItsOwn) {
  const TemporaryFolder folder;
  write_part(folder / "1.db", "", trials_of("a"));
  test::run_sql(folder / "1.db", "UPDATE planners SET label = 'zzz'");
  Database db = Database::open_for_run(folder / "all.db", kMetrics);
  EXPECT_THROW(merge_database(db, folder / "1.db"), InputError);
  EXPECT_TRUE(db.list_trials().empty());
}

/// What merging says where `change` was done to the second of two equal files, by a program that
/// wrote the digests of what it stored.
std::string refusal_after(const std::string& change) {
  static const TemporaryFolder samples;
  if (!std::filesystem::exists(samples / "s.db")) {
    std::vector<TrialRow> trials = trials_of("a");
    trials.push_back(trial_row("b", 0, 0, Outcome::collided));
    write_part(samples / "s.db", "", trials);
  }
  const TemporaryFolder folder;
  for (const char* file : {"1.db", "2.db"}) copy_file(samples / "s.db", folder / file);
  sqlite3* handle = nullptr;
  EXPECT_EQ(sqlite3_open((folder / "2.db").c_str(), &handle), SQLITE_OK);
  EXPECT_EQ(sqlite3_exec(handle, change.c_str(), nullptr, nullptr, nullptr), SQLITE_OK)
      << sqlite3_errmsg(handle);
  test::redigest(handle);
  sqlite3_close(handle);
  Database db = Database::open_for_run(folder / "1.db", kMetrics);
  const std::string before = canonical_rows(db);
  std::string message;
  try {
    merge_database(db, folder / "2.db");
  } catch (const InputError& error) {
    message = error.what();
  }
  EXPECT_EQ(canonical_rows(db), before);
  return message;
}

TEST(Merge, RefusesAnyColumnThatDiffers) {
  for (const std::string change : {"planners SET name = 'x'",
                                   "planners SET is_privileged = 1",
                                   "maps SET generator = 'hall'",
                                   "maps SET map_seed = 3",
                                   "maps SET spec_json = '{\"a\":1}'",
                                   "maps SET obstacle_count = 1",
                                   "missions SET traversability_obstruction = 9.0",
                                   "missions SET view_occlusion = 9.0",
                                   "missions SET angle_over_length_1pm = NULL",
                                   "missions SET reference_length_m = 1.0",
                                   "trials SET outcome = 'timed_out'",
                                   "trials SET spec_json = '{\"seed\":2}'",
                                   "trials SET mission_progress_pct = 1.0",
                                   "trials SET reason = 'x'",
                                   "trajectories SET samples_digest = 'x'",
                                   "trajectories SET sample_count = 3",
                                   "plan_calls SET calls_digest = 'x'",
                                   "plan_calls SET call_count = 3",
                                   "events SET speed_mps = 1.0",
                                   "events SET obstacle_kind = 'rock'"}) {
    EXPECT_NE(refusal_after("UPDATE " + change), "") << change;
  }
  for (const std::string table : {"events", "trajectories", "plan_calls"}) {
    EXPECT_NE(refusal_after("DELETE FROM " + table), "") << table;
  }
}

TEST(Merge, TakesWhatAClockMeasuredAsItIs) {
  EXPECT_EQ(refusal_after("UPDATE trials SET wall_time_s = 99.0, processing_time_ms = 99.0, "
                          "attempt = 3; UPDATE runs SET host = 'other'"),
            "");
}

TEST(Merge, AFileWithFewerMetricsIsMerged) {
  const TemporaryFolder folder;
  {
    Database db = Database::open_for_run(folder / "fewer.db", std::span(kMetrics).first(2));
    db.add_run(run_row());
    db.add_sweep(sweep_row(kSweepJson));
    for (const char* label : {"a", "b"}) db.add_planner(planner_row(label));
    for (int map = 0; map < 2; ++map) db.add_map(map_row(map, 2), "forest");
    for (TrialRow trial : trials_of("a")) {
      trial.metrics.resize(2);
      db.add_trial(trial);
    }
  }
  write_part(folder / "1.db", "", trials_of("b"));
  Database db = Database::open_for_run(folder / "1.db", kMetrics);
  EXPECT_EQ(merge_database(db, folder / "fewer.db").new_trials, 4);
  EXPECT_EQ(merge_database(db, folder / "fewer.db").new_trials, 0);
}

TEST(Merge, RowsThatContradictEachOtherAreRefused) {
  const TemporaryFolder folder;
  write_part(folder / "part.db", "", trials_of("a"));
  Database db = Database::open_for_run(folder / "1.db", kMetrics);
  const std::string before = canonical_rows(db);
  for (const std::string change :
       {"DELETE FROM planners", "DELETE FROM maps", "DELETE FROM missions", "DELETE FROM runs",
        "UPDATE trials SET run_id = 77", "UPDATE sweep_trials SET trial_key = 'x' || trial_key"}) {
    copy_file(folder / "part.db", folder / "2.db",
              std::filesystem::copy_options::overwrite_existing);
    sqlite3* handle = nullptr;
    ASSERT_EQ(sqlite3_open((folder / "2.db").c_str(), &handle), SQLITE_OK);
    ASSERT_EQ(sqlite3_exec(handle, change.c_str(), nullptr, nullptr, nullptr), SQLITE_OK);
    sqlite3_close(handle);
    EXPECT_THROW(merge_database(db, folder / "2.db"), InputError) << change;
    EXPECT_EQ(canonical_rows(db), before) << change;
  }
}

TEST(Merge, ASweepOfAnotherContentIsARevision) {
  const TemporaryFolder folder;
  write_part(folder / "1.db", "", trials_of("a"));
  {
    Database db = Database::open_for_run(folder / "2.db", kMetrics);
    db.add_run(run_row());
    db.add_sweep(sweep_row(R"({"trials":9,"planners":[{}],"axes":[]})"));
  }
  Database db = Database::open_for_run(folder / "1.db", kMetrics);
  merge_database(db, folder / "2.db");
  merge_database(db, folder / "2.db");
  const auto sweeps = db.read_sweeps();
  ASSERT_EQ(sweeps.size(), 2U);
  EXPECT_EQ(sweeps[1].revision, 2);
  EXPECT_EQ(sweeps[1].trial_count, 0);
}

TEST(PackedSamples, ComeBackAndDamageIsSeen) {
  const TrialRow row = trials_of("a")[0];
  const std::vector<std::byte> bytes = sample_bytes(row.record.samples);
  std::vector<std::byte> packed = packed_samples(bytes);
  EXPECT_LT(packed.size(), bytes.size());
  EXPECT_EQ(unpacked_samples(packed, row.record.samples.size()), bytes);
  EXPECT_TRUE(unpacked_samples(packed, row.record.samples.size() + 1).empty());
  EXPECT_TRUE(unpacked_samples(packed, std::size_t{1} << 60U).empty());
  packed.resize(packed.size() / 2);
  EXPECT_TRUE(unpacked_samples(packed, row.record.samples.size()).empty());
  EXPECT_TRUE(unpacked_samples(packed_samples({}), 0).empty());
}

}  // namespace
}  // namespace avoidbench
