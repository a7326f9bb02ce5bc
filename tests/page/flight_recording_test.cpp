#include "page/flight_recording.hpp"

#include <gtest/gtest.h>

#include "base/digest.hpp"
#include "base/input_error.hpp"
#include "maps/map_spec.hpp"
#include "page/flight_page.hpp"
#include "support/sample_rows.hpp"

namespace avoidbench {
namespace {

struct Recorded : testing::Test {
  Recorded() {
    job.token = make_token();
    job.spec.map = HallSpec{.area_m = {12.0, 12.0}, .poisson_radius_m = 4.0};
    job.spec.map_seed = 2;
    job.spec.planner.file = TALKING;
    job.spec.planner.file_digest = file_digest(TALKING);
    job.spec.sensor.width_px = 40;
    job.spec.sensor.height_px = 30;
    job.spec.mission.time_limit_s = 1.0;
    job.mission_count = 1;
    job.mission = Worker().work(job).map->missions.front();
  }
  JobResult flown(const RecordingWanted& wanted) {
    job.lookout = recording_job(wanted, job.spec);
    return Worker({{kRecordingLookout, recording_lookout}}).work(job);
  }

  test::TemporaryFolder folder;
  Job job;
};

TEST_F(Recorded, ComesBackFromTheWorkerAsItWasSeen) {
  const JobResult result =
      flown({.has_calls = true, .has_moments = true, .has_page = true, .at_s = {0.2, 0.6}});
  ASSERT_TRUE(result.trial && result.reported) << result.error;
  const FlightRecording recording = recording_from(*result.reported);
  EXPECT_EQ(recording.calls.size(), result.trial->plan_calls.size());
  ASSERT_EQ(recording.moments.size(), 2U);
  EXPECT_NEAR(recording.moments[0].time_s, 0.2, 0.05);
  EXPECT_NEAR(recording.moments[1].time_s, 0.6, 0.05);
  ASSERT_EQ(recording.log.size(), 1U);
  EXPECT_NE(recording.log[0].text.find("I stand"), std::string::npos);
  EXPECT_FALSE(recording.seen.at("images").empty());
  // Another process has it in its hands: half of it is no recording.
  Message half = *result.reported;
  half.bytes.resize(half.bytes.size() / 2);
  EXPECT_THROW(recording_from(half), InputError);
}

TEST_F(Recorded, EndsWithAsManyCallsAsAreAskedFor) {
  const JobResult result = flown({.has_calls = true, .most_calls = 3});
  ASSERT_TRUE(result.reported) << result.error;
  EXPECT_EQ(recording_from(*result.reported).calls.size(), 3U);
}

TEST_F(Recorded, ThePageTellsHowItEndedNow) {
  const JobResult result = flown({.has_page = true});
  ASSERT_TRUE(result.trial && result.reported) << result.error;
  const Database database = sample_rows::begun(folder / "p.db");
  StoredTrial stored{.row = sample_rows::finished(),
                     .spec = job.spec,
                     .mission = job.mission->mission,
                     .world_digest = result.world_digest};
  const TrialListing listing{};
  const nlohmann::ordered_json page =
      flight_page(database, stored, make_world(job.spec.map, job.spec.map_seed), *result.trial,
                  recording_from(*result.reported).seen, listing, "title", PageOrigin{});
  ASSERT_EQ(page.at("flights").size(), 1U);
  EXPECT_EQ(page.at("flights")[0].at("head").at("outcome"), "timed_out");
  EXPECT_EQ(page.at("flights")[0].at("head").at("reason"), result.trial->reason);
}

}  // namespace
}  // namespace avoidbench
