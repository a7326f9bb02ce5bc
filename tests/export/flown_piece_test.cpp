#include "export/flown_piece.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <sstream>

#include "base/digest.hpp"
#include "base/input_error.hpp"
#include "export/export_mcap.hpp"
#include "maps/map_spec.hpp"
#include "trial/planner_view.hpp"

namespace avoidbench {
namespace {

/// A short flight whose pieces a worker sent.
struct FlownPieces : testing::Test {
  FlownPieces() {
    job.token = make_token();
    job.spec.map = HallSpec{.area_m = {12.0, 12.0}, .poisson_radius_m = 4.0};
    job.spec.map_seed = 2;
    job.spec.planner.file = TELLING;
    job.spec.planner.file_digest = file_digest(TELLING);
    job.spec.sensor.width_px = 40;
    job.spec.sensor.height_px = 30;
    job.spec.mission.time_limit_s = 1.0;
    job.mission_count = 1;
    Worker worker({{kPiecesLookout, pieces_lookout}});
    worker.send_pieces([this](const Message& piece) { messages.push_back(piece); });
    job.mission = worker.work(job).map->missions.front();
    job.lookout = pieces_job(job.spec);
    result = worker.work(job);
    stored.spec = job.spec;
    stored.mission = job.mission->mission;
    if (result.trial) stored.row.record = *result.trial;
    setup = planner_setup(job.spec);
  }
  FlownPiece piece(std::size_t i) const { return flown_piece_from(messages[i], job.spec, setup); }

  Job job;
  PlannerSetup setup;
  std::vector<Message> messages;
  JobResult result;
  StoredTrial stored;
};

TEST_F(FlownPieces, AreAViewAndAnAnswerOfEachCall) {
  ASSERT_TRUE(result.trial) << result.error;
  const std::vector<PlanCall>& calls = result.trial->plan_calls;
  ASSERT_EQ(messages.size(), 2 * calls.size());
  for (std::size_t i = 0; i < messages.size(); ++i) {
    ASSERT_TRUE(is_piece_of(messages[i], job));
    const FlownPiece it = piece(i);
    EXPECT_EQ(it.number, i);
    EXPECT_EQ(it.kind, i % 2 == 0 ? PieceKind::view : PieceKind::answer);
    EXPECT_EQ(it.time_s, calls[i / 2].time_s);
  }
  // Depth, a stereo pair and a colour image, each of the camera's size.
  ASSERT_EQ(piece(0).pictures.size(), 4U);
  EXPECT_FALSE(piece(2).imu.empty());
  EXPECT_EQ(piece(1).status, PlanStatus::command);
  EXPECT_EQ(piece(1).command.velocity_world_mps[0], 0.5);
  EXPECT_EQ(piece(1).log.size(), 5U);  // what reset() logged, and of each image
}

TEST_F(FlownPieces, AreBelievedOnlyWhereTheyMakeSense) {
  // Half of it, another sensor's image, a camera that is not there, a time that is none.
  Message half = messages[0];
  half.bytes.resize(half.bytes.size() / 2);
  EXPECT_THROW(flown_piece_from(half, job.spec, setup), InputError);
  PlannerSetup other = setup;
  other.cameras[0].width_px = 41;
  EXPECT_THROW(flown_piece_from(messages[0], job.spec, other), InputError);
  other.cameras.clear();
  EXPECT_THROW(flown_piece_from(messages[0], job.spec, other), InputError);
  TrialSpec shorter = job.spec;
  shorter.mission.time_limit_s = -2.0;
  EXPECT_THROW(flown_piece_from(messages[0], shorter, setup), InputError);
}

TEST_F(FlownPieces, ComeInTheirOrder) {
  std::ostringstream stream;
  McapExport exported({.stored = stored, .world = nullptr, .program = "test"}, stream);
  EXPECT_THROW(exported.add(piece(1)), InputError);  // not the first
  exported.add(piece(0));
  EXPECT_THROW(exported.add(piece(0)), InputError);
  EXPECT_THROW(exported.add(piece(2)), InputError);
  FlownPiece of_the_past = piece(1);
  exported.add(of_the_past);
  of_the_past = piece(2);
  of_the_past.time_s = 0.0;  // as the call before
  EXPECT_THROW(exported.add(of_the_past), InputError);
  // A view where an answer is due.
  exported.add(piece(2));
  FlownPiece view = piece(4);
  view.number = 3;
  EXPECT_THROW(exported.add(view), InputError);
}

TEST_F(FlownPieces, GiveTheSameBytesAgain) {
  const auto written = [&] {
    std::ostringstream stream;
    McapExport exported({.stored = stored, .world = nullptr, .program = "test"}, stream);
    for (std::size_t i = 0; i < messages.size(); ++i) exported.add(piece(i));
    exported.finish();
    return stream.str();
  };
  const std::string once = written();
  EXPECT_GT(once.size(), 1000U);
  EXPECT_EQ(once, written());
}

/// A worker may die in its first call; what is stored may be an end alone.
TEST_F(FlownPieces, AreNotNeeded) {
  stored.row.record = {};
  stored.row.record.outcome = Outcome::planner_crashed;
  stored.row.record.end_time_s = std::nan("");
  std::ostringstream stream;
  McapExport exported({.stored = stored, .world = nullptr, .program = "test"}, stream);
  exported.finish();
  EXPECT_EQ(exported.message_count(), 5U);  // mountings, vehicle, an empty path, the goal, the end
}

}  // namespace
}  // namespace avoidbench
