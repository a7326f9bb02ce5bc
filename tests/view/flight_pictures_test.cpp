#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "maps/map_spec.hpp"
#include "view/film.hpp"
#include "view/replay_sheet.hpp"

namespace avoidbench {
namespace {

/// Two seconds ahead through a hall, at 2 m/s.
struct ThroughAHall : testing::Test {
  ThroughAHall() {
    stored.spec.map = HallSpec{.area_m = {12.0, 16.0}, .poisson_radius_m = 4.0};
    stored.spec.map_seed = 2;
    world = make_world(stored.spec.map, stored.spec.map_seed);
    stored.mission = {.start_world = {6.0, 2.0, 2.0}, .goal_world = {6.0, 12.0, 2.0}};
    stored.row.planner_label = "straight";
    record.outcome = Outcome::timed_out;
    record.end_time_s = 2.0;
    for (int i = 0; i <= 100; ++i) {
      Sample sample;
      sample.time_s = 0.02 * i;
      sample.position_world = {6.0, 2.0 + 0.04 * i, 2.0};
      sample.velocity_world = {0.0, 2.0, 0.0};
      sample.q_world_body = Eigen::Quaterniond(std::sqrt(0.5), 0.0, 0.0, std::sqrt(0.5));
      sample.clearance_m = 0.7;
      record.samples.push_back(sample);
    }
  }
  StoredTrial stored;
  World world;
  TrialRecord record;
};

int count_of(const Picture& picture, const Color& color, int from_y, int to_x) {
  int count = 0;
  for (int y = from_y; y < picture.height_px; ++y) {
    for (int x = 0; x < to_x; ++x) {
      const auto i = 3 * static_cast<std::size_t>(y * picture.width_px + x);
      count += picture.rgb[i] == color[0] && picture.rgb[i + 1] == color[1] &&
               picture.rgb[i + 2] == color[2];
    }
  }
  return count;
}

TEST_F(ThroughAHall, TheFilmsLastFramesSayHowItEnded) {
  const std::vector<Moment> moments;
  TrialRecord other = record;
  other.outcome = Outcome::reached_goal;
  Film film(stored, world, record, moments), other_film(stored, world, other, moments);
  ASSERT_GT(film.frame_count(), 50U);
  const Picture picture = film.frame(10);
  EXPECT_EQ(picture.width_px, kFilmWidth_px);
  EXPECT_EQ(picture.height_px, kFilmHeight_px);
  EXPECT_EQ(picture.rgb, other_film.frame(10).rgb);
  const std::size_t last = film.frame_count() - 1;
  EXPECT_NE(film.frame(last).rgb, other_film.frame(last).rgb);
}

TEST_F(ThroughAHall, TheFilmShowsTheImageThatThePlannerSaw) {
  std::vector<Moment> moments(2);
  SeenImage image;
  image.width_px = 40;
  image.height_px = 30;
  image.depth_m.assign(1200, std::numeric_limits<float>::quiet_NaN());  // grey
  moments[1].call_s = 1.0;
  moments[1].images = {SeenImage(), image};  // the first camera had none yet
  Film film(stored, world, record, moments);
  const Color invalid{96, 96, 96};
  const auto count_at = [&](double time_s) {
    const Picture picture =
        film.frame(static_cast<std::size_t>(std::lround(kFilmRate_hz * time_s)));
    return count_of(picture, invalid, 0, picture.width_px);
  };
  EXPECT_LT(count_at(0.4), 1000);
  EXPECT_GT(count_at(1.2), 50'000);  // most of 426 × 320 pixels
}

/// On its plan, which is right of the view from behind.
TEST_F(ThroughAHall, TheFilmShowsTheWayFlownUntilThen) {
  const std::vector<Moment> moments;
  Film film(stored, world, record, moments);
  const Color path{20, 90, 200};
  constexpr int kPlan_px = 2 * (kFilmWidth_px / 3);
  int before = 0;
  for (const std::size_t frame : {10U, 25U, 45U}) {
    const Picture picture = film.frame(frame);
    const int count =
        count_of(picture, path, 0, picture.width_px) - count_of(picture, path, 0, kPlan_px);
    EXPECT_GT(count, before) << frame;
    before = count;
  }
}

TEST(Moments, AreThoseAskedForAndAllMultiples) {
  MomentRecorder recorder({0.75}, 0.5, TrialSpec{});
  const VehicleState believed;
  const PlannerView view;
  const TrialRecord record;
  for (int i = 0; i <= 6; ++i) {
    recorder.planning({.time_s = 0.25 * i, .believed = believed, .view = view, .record = record});
  }
  std::vector<double> times_s, calls_s;
  for (const Moment& moment : recorder.finish(1.625)) {
    times_s.push_back(moment.time_s);
    calls_s.push_back(moment.call_s);
  }
  EXPECT_EQ(times_s, (std::vector<double>{0.0, 0.5, 0.75, 1.0, 1.5, 1.625}));
  EXPECT_EQ(calls_s, (std::vector<double>{0.0, 0.5, 0.75, 1.0, 1.5, 1.5}));
}

TEST_F(ThroughAHall, ASheetShowsWhatEachCameraSaw) {
  ReplaySheets sheets(stored, world, record, "a title");
  Moment moment;
  moment.time_s = moment.call_s = 1.0;
  moment.believed.position_world = record.samples[50].position_world;
  // Three cameras without any valid depth: grey, in two rows.
  for (int camera = 0; camera < 3; ++camera) {
    SeenImage image;
    image.width_px = 40;
    image.height_px = 30;
    image.depth_m.assign(1200, std::numeric_limits<float>::quiet_NaN());
    moment.images.push_back(image);
  }
  const Color invalid{96, 96, 96};
  const Picture three = sheets.sheet(moment);
  const int of_three = count_of(three, invalid, 0, three.width_px);
  moment.images.resize(2);
  const Picture two = sheets.sheet(moment);
  const int of_two = count_of(two, invalid, 0, two.width_px);
  EXPECT_GT(of_two, 10'000);
  EXPECT_NEAR(of_three, 1.5 * of_two, 0.1 * of_two);
}

}  // namespace
}  // namespace avoidbench
