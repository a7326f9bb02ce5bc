#include "avoidbench/tracks.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace {

using avoidbench::distance_to_track_m;
using avoidbench::track_center_at;
using avoidbench::track_radius_m;
using avoidbench::Vec3;

/// At (1, 2, 3) at 10 s, by 1 m/s to the left and 0.5 m/s up.
ab_track moving(std::uint32_t kind, const Vec3& size_m) {
  ab_track track{};
  track.kind = kind;
  track.time_s = 10.0;
  for (std::size_t k = 0; k < 3; ++k) {
    track.center_world_m[k] = 1.0 + static_cast<double>(k);
    track.size_m[k] = size_m[k];
  }
  track.velocity_world_mps[1] = 1.0;
  track.velocity_world_mps[2] = 0.5;
  return track;
}

TEST(Tracks, GoOnWithTheirVelocity) {
  const ab_track track = moving(AB_TRACK_BALL, {1.0, 1.0, 1.0});
  EXPECT_EQ(track_center_at(track, 10.0), (Vec3{1.0, 2.0, 3.0}));
  EXPECT_EQ(track_center_at(track, 12.0), (Vec3{1.0, 4.0, 4.0}));
  EXPECT_EQ(track_center_at(track, 8.0), (Vec3{1.0, 0.0, 2.0}));
}

TEST(Tracks, RadiiHoldTheBoxWhateverItsHeading) {
  const Vec3 person{0.3, 0.5, 1.75}, box{0.6, 0.8, 2.0};
  EXPECT_DOUBLE_EQ(track_radius_m(moving(AB_TRACK_PERSON, person)), 0.25);
  EXPECT_DOUBLE_EQ(track_radius_m(moving(AB_TRACK_POLE, {0.2, 0.2, 4.0})), 0.1);
  EXPECT_DOUBLE_EQ(track_radius_m(moving(AB_TRACK_BALL, {0.8, 0.8, 0.8})), 0.4);
  EXPECT_DOUBLE_EQ(track_radius_m(moving(AB_TRACK_BOX, box)), 0.5);
  EXPECT_DOUBLE_EQ(track_radius_m(moving(AB_TRACK_OTHER, box)), 0.5);
  // Of a kind that is added some day, too.
  EXPECT_DOUBLE_EQ(track_radius_m(moving(99, box)), 0.5);
}

TEST(Tracks, ABallIsAsFarAsItsSurface) {
  const ab_track ball = moving(AB_TRACK_BALL, {1.0, 1.0, 1.0});
  EXPECT_DOUBLE_EQ(distance_to_track_m(ball, {4.0, 2.0, 7.0}, 10.0), 5.0 - 0.5);
  // Two seconds on its middle is at (1, 4, 4).
  EXPECT_DOUBLE_EQ(distance_to_track_m(ball, {3.0, 5.0, 6.0}, 12.0), 3.0 - 0.5);
  EXPECT_DOUBLE_EQ(distance_to_track_m(ball, {1.0, 4.0, 4.0}, 12.0), -0.5);
}

/// The cylinder of radius 0.5 m and height 2 m around the box.
TEST(Tracks, ABoxIsAsFarAsTheCylinderAroundIt) {
  const ab_track box = moving(AB_TRACK_BOX, {0.6, 0.8, 2.0});
  EXPECT_DOUBLE_EQ(distance_to_track_m(box, {4.0, 6.0, 3.5}, 10.0), 5.0 - 0.5);  // beside
  EXPECT_DOUBLE_EQ(distance_to_track_m(box, {1.2, 2.0, 7.0}, 10.0), 3.0);        // above
  EXPECT_DOUBLE_EQ(distance_to_track_m(box, {1.2, 2.0, 0.0}, 10.0), 2.0);        // below
  EXPECT_DOUBLE_EQ(distance_to_track_m(box, {4.5, 2.0, 8.0}, 10.0), 5.0);        // its edge: 3, 4
  EXPECT_DOUBLE_EQ(distance_to_track_m(box, {1.25, 2.0, 3.0}, 10.0), -0.25);     // inside
  EXPECT_DOUBLE_EQ(distance_to_track_m(box, {1.0, 2.0, 3.875}, 10.0), -0.125);   // under its top
  EXPECT_DOUBLE_EQ(distance_to_track_m(box, {4.0, 8.0, 4.5}, 12.0), 5.0 - 0.5);  // moved on
}

/// Nearer than to any corner of the box, whichever way it is turned.
TEST(Tracks, NoBoxIsNearerThanItsDistance) {
  const ab_track box = moving(AB_TRACK_BOX, {0.6, 0.8, 2.0});
  const Vec3 place{2.5, 1.0, 4.2};
  double nearest_m = std::numeric_limits<double>::infinity();
  for (int turn = 0; turn < 360; ++turn) {
    const double angle = 0.017453292519943295 * turn, c = std::cos(angle), s = std::sin(angle);
    const double x = place[0] - 1.0, y = place[1] - 2.0;
    const double along = std::abs(c * x + s * y) - 0.3, across = std::abs(c * y - s * x) - 0.4;
    const double level = std::hypot(std::max(along, 0.0), std::max(across, 0.0));
    nearest_m = std::min(nearest_m, std::hypot(level, std::max(place[2] - 4.0, 0.0)));
  }
  EXPECT_LE(distance_to_track_m(box, place, 10.0), nearest_m);
  // And some heading brings a corner as near.
  EXPECT_NEAR(distance_to_track_m(box, place, 10.0), nearest_m, 1e-3);
}

}  // namespace
