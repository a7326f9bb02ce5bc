#include "replay/replay.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include "base/digest.hpp"
#include "base/input_error.hpp"
#include "base/option_error.hpp"
#include "metrics/metric_table.hpp"
#include "support/flown_again.hpp"
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
    const test::FlownAgain flown = test::flown_again(read_stored_trial(database, listing.key));
    EXPECT_TRUE(flown.flight.warnings.empty()) << flown.flight.warnings.front();
    EXPECT_EQ(other_map_warning(flown.flight.stored, flown.end), "");
    const std::vector<std::string> found = flown.differences();
    EXPECT_TRUE(found.empty()) << listing.planner_label << ": " << found.front();
    EXPECT_EQ(flown.record().outcome, listing.outcome);
    EXPECT_GT(flown.record().samples.size(), 100U);
  }
}

TEST_F(ReplayTest, TellsWhatDiffers) {
  const Database database = Database::open_for_reading(file_);
  StoredTrial stored = read_stored_trial(database, database.list_trials().front().key);
  stored.spec.planner.file_digest = "of another day";
  stored.spec.planner.parameters.push_back({.name = "no_more", .number = 1.0, .text = {}});
  stored.world_digest = "of another map";
  const test::FlownAgain flown =
      test::flown_again(stored, {.planner = test::built_planner("straight_line")});
  EXPECT_EQ(flown.flight.warnings.size(), 3U);  // key, file, parameter
  EXPECT_NE(other_map_warning(flown.flight.stored, flown.end), "");
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

TEST(Differences, CollisionsAreCompared) {
  TrialRecord stored;
  stored.collisions = {{.time_s = 1.5, .speed_mps = 2.0, .obstacle = 3, .kind = "tree"}};
  EXPECT_TRUE(differences(stored, stored).empty());
  const auto found_with = [&](auto&& change) {
    TrialRecord flown = stored;
    change(flown.collisions);
    return differences(stored, flown);
  };
  const std::vector<std::string> otherwise{"collisions differ from t = 1.5000 s on"};
  EXPECT_EQ(found_with([](auto& all) { all[0].time_s = 1.25; }), otherwise);
  EXPECT_EQ(found_with([](auto& all) { all[0].speed_mps += 1e-15; }), otherwise);
  EXPECT_EQ(found_with([](auto& all) { all[0].obstacle = 4; }), otherwise);
  EXPECT_EQ(found_with([](auto& all) { all[0].kind = "wall"; }), otherwise);
  EXPECT_EQ(found_with([](auto& all) { all.clear(); }),
            std::vector<std::string>{"collisions were 1, now 0"});
}

/// What a trial's planner is looked for by, and what is said where it is not taken.
std::string refusal_of(const PlannerChoice& choice, const ReplayFiles& files, std::string& hint) {
  try {
    planner_for(choice, files);
  } catch (const OptionError& error) {
    hint = error.hint();
    return error.what();
  }
  return "";
}

TEST_F(ReplayTest, TakesNoLibraryOnADatabasesWord) {
  const Database database = Database::open_for_reading(file_);
  StoredTrial stored = read_stored_trial(database, database.list_trials().front().key);
  std::string hint;
  for (const std::string& plugin :
       {std::string(AVOIDBENCH_MARKING_PLANNER),
        "./" + std::filesystem::relative(AVOIDBENCH_MARKING_PLANNER).string()}) {
    stored.spec.planner.plugin = plugin;
    const std::string message = refusal_of(stored.spec.planner, {}, hint);
    EXPECT_NE(message.find("is not the library that the trial was flown with"), std::string::npos)
        << message;
    EXPECT_TRUE(hint.starts_with("library ")) << hint;
  }
  // Named by the user it is taken.
  EXPECT_EQ(planner_for(stored.spec.planner, {.planner = AVOIDBENCH_MARKING_PLANNER}).source.file,
            AVOIDBENCH_MARKING_PLANNER);
}

/// Loading it, which is to run its code, writes a file: it can't, in a child in the sandbox.
TEST_F(ReplayTest, RunsNoCodeOfAPlannerInItsOwnProcess) {
  const Database database = Database::open_for_reading(file_);
  StoredTrial stored = read_stored_trial(database, database.list_trials().front().key);
  const std::filesystem::path mark = file_.string() + ".loaded";
  ::setenv("AVOIDBENCH_TEST_MARK", mark.c_str(), 1);
  ReplayPlanners planners({.planner = AVOIDBENCH_MARKING_PLANNER});
  EXPECT_THROW(stored_flight(stored, planners), InputError);  // it is no planner
  EXPECT_FALSE(std::filesystem::exists(mark)) << "its code has run outside of a sandbox";
}

/// The first word's digest is no check: /bin/sh is the same file everywhere, and what it is to do
/// are the words after it.
TEST_F(ReplayTest, StartsNoCommandOnADatabasesWord) {
  const Database database = Database::open_for_reading(file_);
  PlannerChoice choice =
      read_stored_trial(database, database.list_trials().front().key).spec.planner;
  choice.plugin = "/bin/sh";
  choice.file_digest = file_digest("/bin/sh");
  choice.command = {kFileWord, "-c", "touch /tmp/pwned; exec prog"};
  std::string hint;
  const std::string message = refusal_of(choice, {}, hint);
  EXPECT_NE(message.find("/bin/sh -c 'touch /tmp/pwned; exec prog'"), std::string::npos) << message;
  EXPECT_EQ(hint, "command");
  // The user's own planner is started as a file of its kind: by no word of the database's.
  EXPECT_TRUE(planner_for(choice, {.planner = test::built_planner("straight_line")})
                  .source.command.empty());
  // What a sweep of the user's has, word by word and with that file, is the user's own word.
  ReplayFiles files;
  PlannerChoice own = choice;
  own.file = "/bin/sh";
  files.own_planners = {own};
  EXPECT_EQ(planner_for(choice, files).source.command, own.command);
  choice.command.back() += " ";
  EXPECT_NE(refusal_of(choice, files, hint), "");
  choice = own;
  choice.file_digest = "of another file";
  EXPECT_NE(refusal_of(choice, files, hint), "");
}

TEST_F(ReplayTest, SaysWhatIsMissing) {
  const Database database = Database::open_for_reading(file_);
  EXPECT_THROW(read_stored_trial(database, "no such key"), InputError);
  StoredTrial stored = read_stored_trial(database, database.list_trials().front().key);
  stored.spec.planner.plugin = "./moved/away_planner.so";
  try {
    planner_for(stored.spec.planner, {});
    FAIL() << "a planner that is not there";
  } catch (const OptionError& error) {
    EXPECT_EQ(error.hint(), "library") << error.what();
  }
  ReplayPlanners elsewhere({.planner = test::built_planner("straight_line")});
  EXPECT_TRUE(stored_flight(stored, elsewhere).warnings.empty());
}

/// No library flew a real flight, and none that is named flies it again.
TEST(PlannerFor, RealFlightsAreAnError) {
  PlannerChoice choice;
  choice.label = "mine_real";
  ReplayFiles files;
  files.planner = "straight_line";
  EXPECT_THROW(planner_for(choice, files), InputError);
}

TEST(PlannerFor, NoFolderToLookInIsAnError) {
  PlannerChoice choice;
  choice.plugin = "mine";
  choice.file_digest = "0123";
  ReplayFiles files;
  files.folders.clear();
  try {
    planner_for(choice, files);
    FAIL() << "a planner out of no folder";
  } catch (const OptionError& error) {
    EXPECT_EQ(std::string(error.what()).find("no planner 'mine'"), 0U) << error.what();
    EXPECT_EQ(error.hint(), "library");
  }
}

}  // namespace
}  // namespace avoidbench
