#include "plugin/drawings.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

#include "avoidbench/planner_eigen.hpp"
#include "conformance/conformance_flight.hpp"
#include "plugin/bad_planners.hpp"
#include "plugin/host_buffers.hpp"

namespace avoidbench {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

class Drawings : public testing::Test {
 protected:
  Drawings() { host.want_drawings(true); }

  /// What the planner's helper draws arrives here.
  HostSide host;
  Canvas canvas{host.table()};
};

TEST_F(Drawings, ArriveAsTheyWereDrawn) {
  std::vector<Eigen::Vector3d> way{{1.0, 2.0, 3.0}, {4.0, 5.0, 6.0}};
  canvas.points("obstacles", 0x123456, std::vector<Vec3>{{1.0, 0.0, 0.0}}, 5.0);
  canvas.line("way", 0xff0000, way);
  canvas.segments("edges", 0xff, way);
  canvas.text("here", 0xff00, {7.0, 8.0, 9.0});
  way.assign(2, Eigen::Vector3d::Zero());  // the host has its copy
  const std::vector<Drawing> drawn = host.take_drawings();
  ASSERT_EQ(drawn.size(), 4U);
  EXPECT_EQ(drawn[0].kind, DrawingKind::points);
  EXPECT_EQ(drawn[0].color_rgb, 0x123456U);
  EXPECT_EQ(drawn[0].label, "obstacles");
  EXPECT_EQ(drawn[0].size_px, 5.0);
  EXPECT_EQ(drawn[1].kind, DrawingKind::line);
  EXPECT_THAT(drawn[1].points_world,
              testing::ElementsAre(Eigen::Vector3d(1, 2, 3), Eigen::Vector3d(4, 5, 6)));
  EXPECT_EQ(drawn[2].kind, DrawingKind::segments);
  EXPECT_EQ(drawn[3].kind, DrawingKind::text);
  EXPECT_EQ(drawn[3].label, "here");
  EXPECT_TRUE(host.take_drawings().empty());
  EXPECT_TRUE(host.take_log().empty());
}

/// Which 0 stands for, in what planners draw and in what others make.
TEST_F(Drawings, AreOfTheUsualSizeWhereNoneIsSaid) {
  EXPECT_EQ(Drawing{}.size_px, 0.0);
  canvas.points("p", 0, std::vector<Vec3>{{1.0, 0.0, 0.0}});
  canvas.line("l", 0, std::vector<Vec3>{{1.0, 0.0, 0.0}, {2.0, 0.0, 0.0}});
  for (const Drawing& drawn : host.take_drawings()) EXPECT_EQ(drawn.size_px, 0.0) << drawn.label;
}

TEST_F(Drawings, AreNotKeptWhereNobodyLooks) {
  host.want_drawings(false);
  EXPECT_FALSE(canvas.is_wanted());
  canvas.points("p", 0, std::vector<Vec3>{{1.0, 0.0, 0.0}});
  const Vec3 point{};
  const ab_drawing bare{sizeof(ab_drawing), AB_DRAW_POINTS, 0, 1, point.data(), 0.0, nullptr};
  const auto* debug = static_cast<const ab_debug*>(
      host.table().get_extension(host.table().context, AB_DEBUG_EXTENSION));
  ASSERT_NE(debug, nullptr);  // the table is always there
  EXPECT_EQ(debug->is_wanted(debug->context), 0);
  debug->draw(debug->context, &bare);
  EXPECT_TRUE(host.take_drawings().empty());
}

TEST_F(Drawings, NeedNoHostThatKnowsThem) {
  const HostSide old(false);
  EXPECT_EQ(old.table().get_extension(old.table().context, AB_DEBUG_EXTENSION), nullptr);
  EXPECT_EQ(host.table().get_extension(host.table().context, "avoidbench.debug/2"), nullptr);
  EXPECT_EQ(host.table().get_extension(host.table().context, nullptr), nullptr);
  ab_host older = old.table();
  older.get_extension = nullptr;
  for (const Canvas& nowhere : {Canvas(), Canvas(old.table()), Canvas(older)}) {
    EXPECT_FALSE(nowhere.is_wanted());
    nowhere.text("nobody reads this", 0, {0.0, 0.0, 0.0});
  }
}

TEST_F(Drawings, LoseWhatIsNotFinite) {
  canvas.points("p", 0, std::vector<Vec3>{{kNan, 0, 0}, {1, 0, 0}, {0, kInfinity, 0}});
  canvas.line("l", 0, std::vector<Vec3>{{0, 0, 0}, {0, 0, -kInfinity}, {2, 0, 0}});
  canvas.segments("s", 0,
                  std::vector<Vec3>{{0, 0, 0}, {kNan, 0, 0}, {3, 0, 0}, {4, 0, 0}, {5, 0, 0}});
  canvas.points("none", 0, std::vector<Vec3>{{kNan, 0, 0}});
  const std::vector<Drawing> drawn = host.take_drawings();
  ASSERT_EQ(drawn.size(), 3U);
  EXPECT_THAT(drawn[0].points_world, testing::ElementsAre(Eigen::Vector3d(1, 0, 0)));
  EXPECT_EQ(drawn[1].points_world.size(), 2U);
  EXPECT_THAT(drawn[2].points_world,
              testing::ElementsAre(Eigen::Vector3d(3, 0, 0), Eigen::Vector3d(4, 0, 0)));
}

TEST_F(Drawings, AreBounded) {
  const std::vector<Vec3> many(kMostDrawnPoints - 1);
  canvas.points("many", 0, many);
  canvas.segments("pair", 0, std::vector<Vec3>(2));  // one point is free: no half pair
  canvas.points("more", 0, std::vector<Vec3>(5));
  const std::vector<Drawing> drawn = host.take_drawings();
  ASSERT_EQ(drawn.size(), 2U);
  EXPECT_EQ(drawn[0].points_world.size(), many.size());
  EXPECT_EQ(drawn[1].label, "more");
  EXPECT_EQ(drawn[1].points_world.size(), 1U);
  EXPECT_THAT(host.take_log(),
              testing::ElementsAre(testing::HasSubstr("beyond 200000 points in one call")));
  canvas.points("again", 0, std::vector<Vec3>(5));
  EXPECT_EQ(host.take_drawings().at(0).points_world.size(), 5U);
  EXPECT_TRUE(host.take_log().empty());
}

TEST_F(Drawings, OfOddStructsDoNoHarm) {
  const auto* debug = static_cast<const ab_debug*>(
      host.table().get_extension(host.table().context, AB_DEBUG_EXTENSION));
  const Vec3 point{1.0, 2.0, 3.0};
  const std::string endless(5000, 'x');
  ab_drawing drawing{sizeof(ab_drawing), 77, 0, 1, point.data(), 0.0, nullptr};
  debug->draw(debug->context, nullptr);
  debug->draw(debug->context, &drawing);  // of no kind
  drawing.kind = AB_DRAW_POINTS;
  drawing.points_world_m = nullptr;
  debug->draw(debug->context, &drawing);
  EXPECT_TRUE(host.take_drawings().empty());
  drawing.points_world_m = point.data();
  drawing.size_px = kNan;
  drawing.label = endless.c_str();
  debug->draw(debug->context, &drawing);
  drawing.struct_size = 24;  // an older one, without size and label
  debug->draw(debug->context, &drawing);
  const std::vector<Drawing> drawn = host.take_drawings();
  ASSERT_EQ(drawn.size(), 2U);
  EXPECT_EQ(drawn[0].size_px, 0.0);
  EXPECT_LT(drawn[0].label.size(), 200U);
  EXPECT_EQ(drawn[1].label, "");
}

TEST(DrawingPlanner, DrawsWhenAskedTo) {
  const PlannerLibrary library = PlannerLibrary::load(C_PLANNER);
  PlannerInstance planner(library, conformance_setup(),
                          resolve_parameters(library.description(), {}));
  PlannerView view;
  view.position_world = view.velocity_world = view.rates_body = Eigen::Vector3d::Zero();
  view.q_world_body.setIdentity();
  PlannerMission mission;
  mission.goal_world = {10.0, 1.0, 2.0};
  ASSERT_EQ(planner.reset(mission), "");
  planner.plan(view);
  EXPECT_TRUE(planner.take_drawings().empty());
  planner.want_drawings(true);
  planner.plan(view);
  const std::vector<Drawing> drawn = planner.take_drawings();
  ASSERT_EQ(drawn.size(), 1U);
  EXPECT_EQ(drawn[0].label, "goal");
  EXPECT_THAT(drawn[0].points_world, testing::ElementsAre(mission.goal_world));
}

}  // namespace
}  // namespace avoidbench
