#include <gtest/gtest.h>

#include <cmath>
#include <limits>

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
