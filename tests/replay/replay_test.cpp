#include "replay/replay.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include "base/input_error.hpp"
#include "base/option_error.hpp"
#include "metrics/metric_table.hpp"
#include "support/planner_files.hpp"
#include "sweep/run_sweep.hpp"

namespace avoidbench {
namespace {

/// A database of one small hall's trials.
class ReplayTest : public testing::Test {
 protected:
  ReplayTest()
      : file_(std::filesystem::temp_directory_path() /
              ("replay_" + std::to_string(::getpid()) + ".db")) {
    SweepSpec sweep;
    sweep.name = "small";
    sweep.base.map = HallSpec{.area_m = {10, 14}, .poisson_radius_m = 2.5};
    sweep.base.mission.time_limit_s = 20.0;
    sweep.base.sensor.width_px = 80;
    sweep.base.sensor.height_px = 60;
    sweep.base.odometry.position_drift_ratio = 0.01;
    sweep.trials = 2;
    sweep.planners = {test::preset_choice("straight_line"), test::preset_choice("reactive")};
    sweep.planners[1].parameters[0].number = 1.9;
    sweep.planners[0].plugin = sweep.planners[0].file;  // by a path
    sweep.planners[1].plugin = sweep.planners[1].file;
    Database database = Database::open_for_run(file_, metric_table());
    RunOptions options;
    options.in_process = true;
    run_sweep(sweep, {}, database, options);
  }
  ~ReplayTest() override {
    for (const char* suffix : {"", "-wal", "-shm"}) {
      std::filesystem::remove(file_.string() + suffix);
    }
  }

  std::filesystem::path file_;
};

TEST_F(ReplayTest, FliesTheStoredTrialsBitForBit) {
  const Database database = Database::open_for_reading(file_);
  const std::vector<TrialListing> trials = database.list_trials();
  ASSERT_EQ(trials.size(), 4U);
  for (const TrialListing& listing : trials) {
    EXPECT_EQ(listing.generator, "hall");
    EXPECT_EQ(listing.poisson_radius_m, 2.5);
    const Replay replay(read_stored_trial(database, listing.key));
    EXPECT_TRUE(replay.warnings().empty()) << replay.warnings().front();
    std::size_t calls = 0, drawings = 0;
    TrialObserver observer;
    observer.planned = [&](const PlanStep& step) {
      ++calls;
      drawings += step.drawings.size();
    };
    std::vector<std::string> log;
    const TrialRecord record = replay.fly(observer, log);
    const TrialRecord& stored = replay.stored().row.record;
    const std::vector<std::string> found = differences(stored, record);
    EXPECT_TRUE(found.empty()) << listing.planner_label << ": " << found.front();
    EXPECT_EQ(record.outcome, listing.outcome);
    EXPECT_GT(record.samples.size(), 100U);
    EXPECT_EQ(calls, record.plan_calls.size());
    EXPECT_EQ(drawings > 0, listing.planner_label == "reactive");
  }
}

TEST_F(ReplayTest, TellsWhatDiffers) {
  const Database database = Database::open_for_reading(file_);
  StoredTrial stored = read_stored_trial(database, database.list_trials().front().key);
  stored.spec.planner.file_digest = "of another day";
  stored.spec.planner.parameters.push_back({.name = "no_more", .number = 1.0, .text = {}});
  const Replay replay(stored,
                      {.planner = test::built_planner("straight_line"), .map = {}, .wind = {}});
  EXPECT_EQ(replay.warnings().size(), 3U);  // key, file, parameter
  const TrialRecord& same = stored.row.record;
  EXPECT_TRUE(differences(same, same).empty());
  TrialRecord other = same;
  other.outcome = Outcome::timed_out;
  other.end_time_s += 1.0;
  other.samples[10].clearance_m += 1e-15;
  other.plan_calls.pop_back();
  other.plan_calls[0].cpu_time_s += 1.0;  // measured: no matter
  const std::vector<std::string> found = differences(same, other);
  ASSERT_EQ(found.size(), 4U);
  EXPECT_NE(found[2].find("differ from t = 0.1000 s on"), std::string::npos) << found[2];
}

/// A library that says so in a file when it is loaded: dlopen alone runs its code.
TEST_F(ReplayTest, LoadsNoLibraryOnADatabasesWord) {
  const Database database = Database::open_for_reading(file_);
  StoredTrial stored = read_stored_trial(database, database.list_trials().front().key);
  const std::filesystem::path mark = file_.string() + ".loaded";
  ::setenv("AVOIDBENCH_TEST_MARK", mark.c_str(), 1);
  for (const std::string& plugin :
       {std::string(AVOIDBENCH_MARKING_PLANNER),
        "./" + std::filesystem::relative(AVOIDBENCH_MARKING_PLANNER).string()}) {
    stored.spec.planner.plugin = plugin;
    try {
      const Replay replay(stored);
      FAIL() << "another library than the stored one";
    } catch (const OptionError& error) {
      const std::string message = error.what();
      EXPECT_NE(message.find("is not the library that the trial was flown with"), std::string::npos)
          << message;
      EXPECT_TRUE(error.hint().starts_with("library ")) << error.hint();
    }
    EXPECT_FALSE(std::filesystem::exists(mark)) << "its code has run";
  }
  // Named by the user it is loaded; only then does it turn out to be no planner.
  EXPECT_THROW(Replay(stored, {.planner = AVOIDBENCH_MARKING_PLANNER, .map = {}, .wind = {}}),
               InputError);
  EXPECT_TRUE(std::filesystem::exists(mark));
  std::filesystem::remove(mark);
}

TEST_F(ReplayTest, SaysWhatIsMissing) {
  const Database database = Database::open_for_reading(file_);
  EXPECT_THROW(read_stored_trial(database, "no such key"), InputError);
  StoredTrial stored = read_stored_trial(database, database.list_trials().front().key);
  stored.spec.planner.plugin = "./moved/away_planner.so";
  try {
    const Replay replay(stored);
    FAIL() << "a planner that is not there";
  } catch (const OptionError& error) {
    EXPECT_EQ(error.hint(), "library") << error.what();
  }
  const Replay elsewhere(stored,
                         {.planner = test::built_planner("straight_line"), .map = {}, .wind = {}});
  EXPECT_TRUE(elsewhere.warnings().empty());
}

TEST(LibraryFor, NoFolderToLookInIsAnError) {
  PlannerChoice choice;
  choice.plugin = "mine";
  ReplayFiles files;
  files.folders.clear();
  try {
    library_for(choice, files);
    FAIL() << "a planner out of no folder";
  } catch (const OptionError& error) {
    EXPECT_EQ(std::string(error.what()).find("no planner 'mine'"), 0U) << error.what();
    EXPECT_EQ(error.hint(), "library");
  }
}

}  // namespace
}  // namespace avoidbench
