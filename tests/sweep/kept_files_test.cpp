#include "base/kept_files.hpp"

#include <fstream>

#include "base/digest.hpp"
#include "base/option_error.hpp"
#include "support/flown_again.hpp"
#include "support/input_error_message.hpp"
#include "support/small_sweep.hpp"

namespace avoidbench {
namespace {

namespace fs = std::filesystem;

/// A sweep of one trial by a copy of a planner that may be changed, on a map from a file.
class KeptFiles : public test::SweepTest {
 protected:
  void SetUp() override {
    SweepTest::SetUp();
    sweep_ = test::small_sweep();
    sweep_.name = "kept";
    sweep_.axes.clear();
    sweep_.trials = 1;
    sweep_.planners.resize(1);
    PlannerChoice& planner = sweep_.planners[0];
    planner_ = folder_ / "src" / "mine.so";
    fs::create_directories(planner_.parent_path());
    fs::copy_file(planner.file, planner_);
    planner.file = planner.plugin = planner_.string();
    digest_ = planner.file_digest;
    map_ = folder_ / "src" / "wall.obj";
    std::ofstream(map_) << "v 0 0 0\nv 12 0 0\nv 0 16 0\nv 12 16 0\nf 1 2 3\nf 2 4 3\n";
    MeshSpec map;
    map.file = map_.string();
    map.bounds = {.lowest_m = {0, 0, 0}, .highest_m = {12, 16, 4}};
    sweep_.base.map = map;
    options_.keep_planners = options_.keep_maps = true;
  }

  ReplayFiles beside_database() const {
    ReplayFiles files;
    files.database = folder_ / "a.db";
    return files;
  }

  test::FlownAgain replayed() const {
    const Database database = Database::open_for_reading(folder_ / "a.db");
    return test::flown_again(read_stored_trial(database, database.list_trials().at(0).key),
                             beside_database());
  }

  SweepSpec sweep_;
  fs::path planner_, map_;
  std::string digest_;
};

TEST_F(KeptFiles, FlyATrialAgainWhenThePlannerWasRebuiltAndTheMapIsGone) {
  run(sweep_, "a.db", 1, true);
  const fs::path kept = folder_ / "a.planners" / (digest_ + ".so");
  EXPECT_EQ(file_digest(kept), digest_);
  EXPECT_TRUE(fs::exists(folder_ / "a.maps" / (file_digest(map_) + ".obj")));
  EXPECT_FALSE(replayed().flight.is_with_kept_planner);  // the planner is still the one
  std::ofstream(planner_, std::ios::app) << "rebuilt";
  fs::remove(map_);
  const test::FlownAgain flown = replayed();
  EXPECT_EQ(flown.flight.job.job.spec.planner.file, kept);
  EXPECT_TRUE(flown.flight.is_with_kept_planner);
  EXPECT_TRUE(flown.flight.warnings.empty());
  EXPECT_TRUE(flown.differences().empty());
}

TEST_F(KeptFiles, AreRenewedByTheNextRunAndLeftOutIfNotWanted) {
  options_.keep_planners = false;
  run(sweep_, "a.db", 1, true);
  EXPECT_FALSE(fs::exists(folder_ / "a.planners"));
  options_.keep_planners = true;
  options_.keep_maps = false;
  fs::create_directories(folder_ / "a.planners");
  std::ofstream(folder_ / "a.planners" / (digest_ + ".so")) << "something else";
  EXPECT_TRUE(run(sweep_, "a.db", 1, true).unkept.empty());
  EXPECT_TRUE(kept_planner(folder_ / "a.db", digest_));
  EXPECT_FALSE(fs::exists(folder_ / "a.maps"));
  EXPECT_EQ(std::distance(fs::directory_iterator(folder_ / "a.planners"), {}), 1);
}

TEST_F(KeptFiles, ThatCantBeWrittenAreSaidAndNoReasonNotToFly) {
  std::ofstream(folder_ / "a.planners") << "a file where the folder should be";
  const RunSummary summary = run(sweep_, "a.db", 1, true);
  EXPECT_EQ(summary.progress.done, 1);
  ASSERT_EQ(summary.unkept.size(), 1U);
  EXPECT_NE(summary.unkept[0].find("can't write"), std::string::npos) << summary.unkept[0];
}

}  // namespace
}  // namespace avoidbench
