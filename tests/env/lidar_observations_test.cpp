#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/random.hpp"
#include "base/spec_json.hpp"
#include "env/vector_env.hpp"
#include "support/input_error_message.hpp"

namespace avoidbench {
namespace {

using testing::Each;
using testing::ElementsAre;
using testing::HasSubstr;

/// Two lidars, of four and of two shots in 0.1 s; the widest range is from 0.5 to 20 m.
ViewShape two_lidars() {
  ViewShape shape;
  shape.lidars = {{.shots = 4, .period_s = 0.1, .min_range_m = 0.5, .max_range_m = 10.0},
                  {.shots = 2, .period_s = 0.1, .min_range_m = 1.0, .max_range_m = 20.0}};
  shape.widest_lidar = {.shots = 4, .period_s = 0.1, .min_range_m = 0.5, .max_range_m = 20.0};
  return shape;
}

/// Of a lidar that met something in its shots 0 and 2 of 4, and nothing in the other two.
const std::vector<ab_lidar_point> kMet = {{{3.0F, 0.0F, 4.0F}, -0.075F, 0.5F},
                                          {{0.0F, -1.0F, 0.0F}, -0.025F, 0.2F}};

CloudView sweep_of(std::uint32_t lidar, const std::vector<ab_lidar_point>& points) {
  CloudView sweep;
  sweep.lidar = lidar;
  sweep.points = points;
  return sweep;
}

PlannerView view_of(std::vector<CloudView> clouds) {
  PlannerView view;
  view.q_world_body.setIdentity();
  view.clouds = std::move(clouds);
  return view;
}

TEST(LidarObservations, EachShotHasItsPlace) {
  const ViewShape shape = two_lidars();
  std::vector<float> points(24, 7.0F), ranges(8, 7.0F);
  const ViewArrays to{.points = points.data(), .ranges = ranges.data()};
  clear_images(shape, to);
  EXPECT_THAT(points, Each(0.0F));
  EXPECT_THAT(ranges, Each(0.0F)) << "nothing is known";
  const PlannerView view = view_of({sweep_of(0, kMet)});
  write_view(view, Eigen::Vector3d::Zero(), shape, DepthEncoding::metric, to);
  EXPECT_THAT(points, ElementsAre(3, 0, 4, 0, 0, 0, 0, -1, 0, 0, 0, 0,  // the first lidar
                                  0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0));
  EXPECT_THAT(ranges, ElementsAre(5, 20, 1, 20, 0, 0, 0, 0)) << "the second one has not ended";
  write_view(view, Eigen::Vector3d::Zero(), shape, DepthEncoding::inverse, to);
  EXPECT_THAT(ranges, ElementsAre(0.1F, 0.025F, 0.5F, 0.025F, 0, 0, 0, 0));
}

TEST(LidarObservations, AreOfTheNewestSweep) {
  const ViewShape shape = two_lidars();
  std::vector<float> points(24, 0.0F), ranges(8, 0.0F);
  const ViewArrays to{.points = points.data(), .ranges = ranges.data()};
  const std::vector<ab_lidar_point> last = {{{0.0F, 2.0F, 0.0F}, 0.0F, 0.1F}};
  // Newest first; and the second lidar meets something in its last shot, which is no shot of the
  // first one's place.
  const PlannerView view = view_of({sweep_of(0, last), sweep_of(1, last), sweep_of(0, kMet)});
  write_view(view, Eigen::Vector3d::Zero(), shape, DepthEncoding::metric, to);
  EXPECT_THAT(ranges, ElementsAre(20, 20, 20, 2, 20, 2, 0, 0));
  EXPECT_THAT(points, ElementsAre(0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 2, 0,  // of four shots
                                  0, 0, 0, 0, 2, 0, 0, 0, 0, 0, 0, 0));
  // Without a new sweep the last one stays.
  write_view(view_of({}), Eigen::Vector3d::Zero(), shape, DepthEncoding::metric, to);
  EXPECT_THAT(ranges, ElementsAre(20, 20, 20, 2, 20, 2, 0, 0));
}

/// A hall, seen by a lidar without noise that looks straight down in its lower ring and level in
/// the upper one; no camera.
EnvSpec lidar_env(std::int64_t slots = 1, std::int64_t threads = 1) {
  EnvSpec spec;
  spec.sweep.name = "tests";
  spec.sweep.base.map = HallSpec{.area_m = {14.0, 16.0}, .poisson_radius_m = 3.0};
  spec.sweep.base.mission.time_limit_s = 3.0;
  spec.sweep.trials = 2;
  spec.sweep.base.sensor.method = NoCameraSpec{};
  LidarSpec lidar;
  lidar.scan = LidarSpinningSpec{
      .rings = 2, .lowest_elevation_deg = -90.0, .highest_elevation_deg = 0.0, .columns = 36};
  spec.sweep.base.sensor.lidars = {lidar};
  spec.slots = slots;
  spec.threads = threads;
  spec.needs = AB_INPUT_POINTS;
  spec.depth = DepthEncoding::metric;
  return spec;
}

/// A vector of flights by lidar, with its arrays.
struct LidarFlights {
  explicit LidarFlights(const EnvSpec& spec)
      : env(spec),
        points(static_cast<std::size_t>(spec.slots) * 3 * env.shape().shots()),
        ranges(static_cast<std::size_t>(spec.slots) * env.shape().shots()),
        pose(static_cast<std::size_t>(spec.slots) * kPoseWidth),
        reward(static_cast<std::size_t>(spec.slots)),
        ends(2 * reward.size()),
        actions(4 * reward.size()) {
    arrays = {.view = {.points = points.data(), .ranges = ranges.data(), .pose = pose.data()},
              .reward = reward.data(),
              .terminated = ends.data(),
              .truncated = ends.data() + reward.size()};
    env.reset(1, {}, arrays);
  }
  void step() { env.step(actions, true, arrays); }

  VectorEnv env;
  std::vector<float> points, ranges;
  std::vector<double> pose, reward;
  std::vector<std::uint8_t> ends;
  std::vector<double> actions;
  EnvArrays arrays;
};

TEST(LidarObservations, AreSeenWithoutACamera) {
  LidarFlights flights(lidar_env());
  EXPECT_EQ(flights.env.shape().cameras, 0U);
  ASSERT_EQ(flights.env.shape().shots(), 72U);
  EXPECT_THAT(flights.points, Each(0.0F)) << "before the first sweep";
  EXPECT_THAT(flights.ranges, Each(0.0F));
  // The third sweep ends at 0.3 s, with the ninth step.
  for (int i = 0; i < 9; ++i) flights.step();
  ASSERT_NEAR(flights.pose[0], 0.3, 1e-9);
  std::size_t level = 0;
  for (std::size_t shot = 0; shot < 72; ++shot) {
    const Eigen::Map<const Eigen::Vector3f> point(&flights.points[3 * shot]);
    if (shot % 2 == 0) {
      // It sits 0.1 m above the centre of a vehicle that hovers.
      EXPECT_NEAR(flights.ranges[shot], flights.pose[3] + 0.1, 1e-3) << shot;
      EXPECT_NEAR(point.z(), -(flights.pose[3] + 0.1), 1e-3) << shot;
    }
    const bool is_met = !point.isZero();
    EXPECT_EQ(flights.ranges[shot], is_met ? point.norm() : 100.0F) << shot;
    level += shot % 2 == 1 && is_met ? 1U : 0U;
  }
  EXPECT_GT(level, 0U) << "walls and columns";
}

/// All that 60 steps of random actions write.
std::string bytes_by_lidar(std::int64_t threads) {
  LidarFlights flights(lidar_env(3, threads));
  RandomStream random = stream(7, "actions");
  std::string bytes;
  for (int i = 0; i < 60; ++i) {
    for (double& number : flights.actions) number = random.uniform(-2.0, 2.0);
    flights.step();
    for (const std::vector<float>* values : {&flights.points, &flights.ranges}) {
      bytes.append(reinterpret_cast<const char*>(values->data()), values->size() * sizeof(float));
    }
  }
  return bytes;
}

TEST(LidarObservations, AreTheSameForAnyNumberOfThreads) {
  EXPECT_EQ(bytes_by_lidar(1), bytes_by_lidar(3));
}

std::string refusal_of(const EnvSpec& spec) {
  return test::message_of([&] { const VectorEnv env(spec); });
}

TEST(LidarObservations, NeedALidarAndImagesACamera) {
  EnvSpec spec = lidar_env();
  spec.needs |= AB_INPUT_DEPTH;
  EXPECT_THAT(refusal_of(spec), HasSubstr("the sensor has none: observe ranges or points"));
  spec = lidar_env();
  spec.sweep.base.sensor.method = DepthIdealSpec{};
  spec.sweep.base.sensor.lidars.clear();
  EXPECT_THAT(refusal_of(spec),
              HasSubstr("points and ranges come from lidars, and the sensor has"));
  spec = lidar_env();
  spec.sweep.base.sensor.lidars[0].min_range_m = 0.0;
  spec.depth = DepthEncoding::inverse;
  EXPECT_EQ(refusal_of(spec), "") << "points alone have no least range";
  spec.sees_ranges = true;
  EXPECT_THAT(refusal_of(spec), HasSubstr("the lidars' min_range_m, which is 0"));
}

TEST(LidarObservations, NeedOneShape) {
  EnvSpec spec = lidar_env();
  const LidarSpec slow = spec.sweep.base.sensor.lidars[0];
  LidarSpec fast = slow;
  fast.rate_hz = 20.0;
  const auto alone = [](const LidarSpec& lidar) {
    return nlohmann::json::array({spec_to_json(lidar)});
  };
  spec.sweep.axes = {{.path = "sensor.lidars", .values = {alone(slow), alone(fast)}}};
  EXPECT_THAT(refusal_of(spec), HasSubstr("changes the cameras, the lidars"));
  spec.needs = 0;
  EXPECT_EQ(refusal_of(spec), "") << "nobody sees them";
}

}  // namespace
}  // namespace avoidbench
