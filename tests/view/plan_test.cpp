// Plans: cut at flight height, as large as the map, with what a flight struck.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "base/math.hpp"
#include "support/flight_worlds.hpp"
#include "view/map_plan.hpp"
#include "view/replay_panel.hpp"
#include "view/replay_sheet.hpp"
#include "view/struck_obstacle.hpp"

namespace avoidbench {
namespace {

int difference(const Color& a, const Color& b) {
  int sum = 0;
  for (std::size_t i = 0; i < 3; ++i) sum += std::abs(int{a[i]} - int{b[i]});
  return sum;
}

Color pixel(const Picture& picture, const Eigen::Vector2d& at) {
  const auto index =
      3 * (static_cast<std::size_t>(at.y()) * static_cast<std::size_t>(picture.width_px) +
           static_cast<std::size_t>(at.x()));
  return {picture.rgb[index], picture.rgb[index + 1], picture.rgb[index + 2]};
}

bool is_reddish(const Color& color) { return color[0] > color[1] + 40 && color[0] > color[2] + 40; }

/// A trunk below a crown that is as wide as a tree's.
World tree_world() {
  World world = test::flight_world();
  test::add_obstacle(world, test::cylinder_mesh(0.5, 4.0, 16), {0, 0, 0}, "tree");
  test::add_obstacle(world, test::cylinder_mesh(3.0, 2.0, 16), {0, 0, 4}, "crown");
  return world;
}

TEST(Plan, CrownsDoNotHideWhatStandsAtFlightHeight) {
  const World world = tree_world();
  const Scene scene(world);
  const double highest_m = world.flight_bounds.sizes().z();
  const Color ground = plan_color(scene, 10.0, 0.0, 2.0), veiled = plan_color(scene, 2.0, 0.0, 2.0);
  const Color crown = color_below(scene, 2.0, 0.0, 20.0, highest_m);
  EXPECT_LT(difference(veiled, ground), difference(veiled, crown));
  EXPECT_GT(difference(veiled, ground), 10);           // it is seen that something is above
  EXPECT_EQ(plan_color(scene, 0.1, 0.0, 2.0), crown);  // the trunk stands there
  EXPECT_EQ(plan_color(scene, 2.0, 0.0, 5.0), crown);  // at that height the crown does
  EXPECT_EQ(plan_color(scene, 10.0, 0.0, 5.0), ground);
}

/// 90 × 90 pixels on 10 m × 10 m around (0, `center_y`, 2), seen from above.
Panel panel_at(double center_y = 0.0) {
  return make_panel(90, 90, {0, center_y, 2}, Eigen::Vector3d::UnitX(), Eigen::Vector3d::UnitY(),
                    10.0);
}

TEST(Plan, IsAQuarterPalerUnderDrawings) {
  const World world = tree_world();
  const Scene scene(world);
  Panel panel = panel_at();
  paint_plan(scene, 2.0, panel);
  for (const auto& [column, row] : {std::pair{45, 45}, {60, 45}, {3, 80}}) {
    const Eigen::Vector3d at = panel.world_at(column + 0.5, row + 0.5);
    const Color plan = plan_color(scene, at.x(), at.y(), 2.0);
    const Color seen = pixel(panel.picture, Eigen::Vector2d(column, row));
    for (std::size_t i = 0; i < 3; ++i) {
      EXPECT_NEAR(seen[i], 0.75 * plan[i] + 0.25 * 255, 0.51) << column << ", " << row;
    }
  }
}

TEST(Plan, FitsTheMap) {
  World world = test::flight_world();
  MapView view;
  world.flight_bounds = Aabb(Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(60, 20, 5));
  fit_plan(world, 960, view);
  EXPECT_EQ(view.width_px, 916);
  EXPECT_NEAR(view.height_px, 916 * 21.0 / 61.0 + 44, 1.0);
  world.flight_bounds = Aabb(Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(20, 60, 5));
  fit_plan(world, 960, view);
  EXPECT_EQ(view.height_px, 960);
  EXPECT_EQ(view.width_px, 480);  // captions need that
}

TEST(Plan, IsPaperBeyondTheMap) {
  World world = test::flight_world();  // its floor goes on for 10 m
  std::string note;
  for (const bool is_tall : {true, false}) {
    MapView view;
    view.width_px = is_tall ? 300 : 700;
    view.height_px = is_tall ? 700 : 300;
    view.samples = 1;
    const Picture picture = plan_view(world, TrialSpec{}, view, note);
    const Color paper{236, 236, 234};
    for (const double at : {0.2, 0.8}) {  // on both sides of the map
      const Eigen::Vector2d beyond =
          is_tall ? Eigen::Vector2d(150, 700 * at) : Eigen::Vector2d(700 * at, 150);
      EXPECT_EQ(pixel(picture, beyond), paper) << beyond.transpose();
    }
    EXPECT_NE(pixel(picture, {0.5 * view.width_px, 0.5 * view.height_px}), paper);
  }
}

TrialRecord crash_into(std::int64_t obstacle, const std::string& kind) {
  TrialRecord record;
  record.outcome = Outcome::collided;
  for (int i = 0; i <= 10; ++i) {
    Sample sample;
    sample.time_s = 0.1 * i;
    sample.position_world = {-2.0 + 0.13 * i, 0.0, 2.0};
    sample.velocity_world = {1.3, 0.0, 0.0};
    record.samples.push_back(sample);
  }
  record.collisions.push_back(
      {.time_s = 1.0, .speed_mps = 1.3, .obstacle = obstacle, .kind = kind});
  return record;
}

TEST(Struck, TheContactIsOnTheObstacleAndMarkedThere) {
  const World world = tree_world();
  const auto struck = struck_obstacle(world, crash_into(1, "tree"));
  ASSERT_NE(struck, nullptr);
  EXPECT_EQ(struck->label, "touched tree 1 at 1.00 s, 1.3 m/s");
  EXPECT_NEAR(struck->contact_world.x(), -0.5, 0.02);
  EXPECT_NEAR(struck->contact_world.z(), 2.0, 0.02);
  Panel panel =
      make_panel(900, 900, {0, 0, 2}, Eigen::Vector3d::UnitX(), Eigen::Vector3d::UnitY(), 10.0);
  panel.picture.rgb.assign(panel.picture.rgb.size(), 255);
  draw_struck(*struck, panel);
  EXPECT_TRUE(is_reddish(pixel(panel.picture, panel.to_pixels(struck->contact_world))));
  EXPECT_TRUE(is_reddish(pixel(panel.picture, panel.to_pixels({0.3, -0.3, 2}))));  // the trunk
  // Neither what stands beside it nor the crown above, which is another obstacle.
  EXPECT_EQ(pixel(panel.picture, panel.to_pixels({0.0, 1.5, 2})), (Color{255, 255, 255}));
}

/// Its arms go along both diagonals, 7 px from the middle.
TEST(Struck, IsMarkedByACross) {
  StruckObstacle struck(tree_world());
  struck.contact_world = {1.0, -1.0, 0.0};
  struck.is_shown = false;
  Panel panel = panel_at();
  panel.picture.rgb.assign(panel.picture.rgb.size(), 0);
  draw_struck(struck, panel);
  const Eigen::Vector2d middle = panel.to_pixels(struck.contact_world);
  EXPECT_TRUE(middle.isApprox(Eigen::Vector2d(54, 54)));
  for (const int x : {-5, 5}) {
    EXPECT_TRUE(is_reddish(pixel(panel.picture, middle + Eigen::Vector2d(x, 5))));
    EXPECT_TRUE(is_reddish(pixel(panel.picture, middle + Eigen::Vector2d(x, -5))));
    EXPECT_FALSE(is_reddish(pixel(panel.picture, middle + Eigen::Vector2d(x, 0))));
    EXPECT_FALSE(is_reddish(pixel(panel.picture, middle + Eigen::Vector2d(0, x))));
  }
}

/// By the middles of its pixels: on one side of the box, the last one's is 5 mm within it.
TEST(Silhouette, IsTintedPixelByPixel) {
  World world = test::flight_world();
  world.prototypes.clear();
  world.instances.clear();
  world.obstacles.clear();
  test::add_obstacle(world, test::box_mesh({4, 4, 4}), {0, 0, 0}, "box");
  const Scene scene(world);
  Panel panel =
      make_panel(100, 100, {0, 0.055, 2}, Eigen::Vector3d::UnitX(), Eigen::Vector3d::UnitY(), 10.0);
  panel.picture.rgb.assign(panel.picture.rgb.size(), 0);
  paint_silhouette(scene, {0, 0, 2}, 20.0, kWhite, panel);
  for (int row = 0; row < 100; ++row) {
    // The middle of the picture is y = 0.055 m, and a pixel 0.1 m.
    const double y = 0.055 + 0.1 * (50 - row - 0.5);
    const bool is_tinted = pixel(panel.picture, Eigen::Vector2d(50, row)) != Color{0, 0, 0};
    EXPECT_EQ(is_tinted, std::abs(y) < 2.0) << row;
  }
}

TEST(Legend, HasEachLineOnceAndTwelveAtMost) {
  const auto color_of_line = [](std::size_t i) { return color_of(std::uint32_t(0x400000 + i)); };
  std::vector<LegendLine> lines{{color_of_line(99), ""}};  // says nothing
  for (std::size_t i = 0; i < 20; ++i) {
    lines.push_back({color_of_line(i), "line " + std::to_string(i)});
    lines.push_back(lines.back());
  }
  Picture picture = make_picture(200, 500);
  add_legend(lines, picture);
  // The first line's middle is at 33 px, the others follow each 18 px.
  for (std::size_t i = 0; i < 20; ++i) {
    const Color swatch = pixel(picture, Eigen::Vector2d(13.0, 33.0 + 18.0 * double(i)));
    EXPECT_EQ(swatch == color_of_line(i), i < 12) << i;
  }
}

TEST(Struck, IsNothingWhereNothingWasTouched) {
  const World world = tree_world();
  TrialRecord record = crash_into(1, "tree");
  record.collisions.clear();
  EXPECT_EQ(struck_obstacle(world, record), nullptr);
  EXPECT_EQ(struck_obstacle(world, crash_into(99, "tree")), nullptr);  // of another world
  record = crash_into(1, "tree");
  record.samples.clear();
  EXPECT_EQ(struck_obstacle(world, record), nullptr);
}

TEST(Struck, TheGroundIsNotPaintedRed) {
  const World world = tree_world();
  const auto struck = struck_obstacle(world, crash_into(0, "ground"));
  ASSERT_NE(struck, nullptr);
  Panel panel =
      make_panel(900, 900, {0, 0, 2}, Eigen::Vector3d::UnitX(), Eigen::Vector3d::UnitY(), 10.0);
  panel.picture.rgb.assign(panel.picture.rgb.size(), 255);
  draw_struck(*struck, panel);
  EXPECT_EQ(pixel(panel.picture, panel.to_pixels({2.0, 2.0, 2})), (Color{255, 255, 255}));
}

/// What the camera has as depth, and what people would see.
TEST(MapViews, OfDepthIsBlackWhereNothingIsInRangeAndThatOfAPersonIsNot) {
  const World world = test::flight_world();
  MapView view;
  view.width_px = 160;
  view.height_px = 120;
  view.samples = 1;
  view.listed_missions = {test::straight_mission()};
  std::string note;
  const auto above_the_horizon = [&](const std::string& name) {
    view.name = name;
    return pixel(render_map(world, TrialSpec{}, view, note), {80.0, 20.0});
  };
  EXPECT_EQ(above_the_horizon("depth"), (Color{0, 0, 0}));
  EXPECT_GT(above_the_horizon("first_person")[2], 100);  // the sky
}

/// The trunk's face is at x = −0.5: what a body of 0.5 m has left before it is told for where it
/// was told to be, not for where it is.
TEST(Reference, SaysHowFarTheVehicleIsOffAndWhetherItWouldBeClear) {
  const World world = tree_world();
  const Scene scene(world);
  Sample now;
  now.q_world_body.setIdentity();
  now.position_world = {-0.7, 0.0, 2.0};
  now.reference_world = {-1.0, 0.0, 2.0};
  const std::array<double, 3> body_m{0.5, 0.5, 0.12};
  EXPECT_EQ(reference_text(scene, body_m, now), "reference: 0.30 m off, clear by 0.25 m");
  now.reference_world = {-0.6, 0.0, 2.0};
  EXPECT_EQ(reference_text(scene, body_m, now), "reference: 0.10 m off, clear by 0.00 m");
  now.reference_world.x() = std::numeric_limits<double>::quiet_NaN();  // of body rates
  EXPECT_EQ(reference_text(scene, body_m, now), "reference");
}

TEST(Labels, StandOnAGroundOfTheirOwnWithinThePicture) {
  Picture picture = make_picture(200, 60);  // black
  draw_label(picture, "touched tree 1", 190, 30, {220, 20, 30});
  int pale = 0;
  for (std::size_t i = 0; i < picture.rgb.size(); i += 3) pale += picture.rgb[i + 1] > 180 ? 1 : 0;
  EXPECT_GT(pale, text_width_px("touched tree 1") * 8);
  EXPECT_GT(pixel(picture, {195.0, 32.0})[1], 180);
  EXPECT_EQ(pixel(picture, {5.0, 30.0}), (Color{0, 0, 0}));
}

/// A patch of 0.25 m, 2.5 m ahead of a camera whose z is the body's x.
TEST(Struck, IsRingedWhereTheImageShowsIt) {
  StruckObstacle struck(tree_world());
  struck.contact_world = {2.5, 0.5, 0.0};
  CameraSetup camera{.width_px = 200, .height_px = 100, .fx_px = 100.0, .fy_px = 100.0};
  camera.cx_px = 99.5;
  camera.cy_px = 49.5;
  camera.T_body_camera.linear() << 0, 0, 1, -1, 0, 0, 0, -1, 0;
  const auto black = [] {
    Picture picture = make_picture(400, 200);
    std::fill(picture.rgb.begin(), picture.rgb.end(), std::uint8_t{0});
    return picture;
  };
  Picture image = black();
  // At column 80 of 200, twice as large here; the radius is 10 pixels, twice as large.
  ASSERT_TRUE(ring_struck(struck, camera, Pose::Identity(), 2.0, image));
  EXPECT_TRUE(is_reddish(pixel(image, {160.0 - 20.0, 100.0})));
  EXPECT_TRUE(is_reddish(pixel(image, {160.0, 100.0 + 20.0})));
  EXPECT_EQ(pixel(image, {160.0, 100.0}), (Color{0, 0, 0}));
  Picture behind = black();
  Pose turned = Pose::Identity();
  turned.linear() = Eigen::AngleAxisd(math::kPi, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  EXPECT_FALSE(ring_struck(struck, camera, turned, 2.0, behind));
  EXPECT_EQ(behind.rgb, black().rgb);
  // Ahead, but beside what the image shows.
  for (const double aside_m : {-3.0, 3.0}) {
    struck.contact_world = {2.5, aside_m, 0.0};
    EXPECT_FALSE(ring_struck(struck, camera, Pose::Identity(), 2.0, behind));
  }
  EXPECT_EQ(behind.rgb, black().rgb);
}

}  // namespace
}  // namespace avoidbench
