#include "trial/perception.hpp"

#include <gtest/gtest.h>

#include <map>
#include <set>

#include "base/digest.hpp"
#include "support/flight_worlds.hpp"
#include "trial/planner_view.hpp"

namespace avoidbench {
namespace {

constexpr std::uint32_t kAllNeeds =
    AB_INPUT_STATE | AB_INPUT_DEPTH | AB_INPUT_STEREO | AB_INPUT_COLOR | AB_INPUT_IMU;

/// What the planner saw at one of its calls.
struct Seen {
  double call_s = 0.0;
  double state_s = 0.0;
  std::vector<double> image_s;
  std::vector<std::uint32_t> cameras;
  std::vector<std::size_t> pixels;
  std::vector<std::string> digests;
  std::vector<double> imu_s, states_s;
  Eigen::Vector3d position, image_position, last_state_position;
};

TrialSpec small_trial() {
  TrialSpec spec;
  spec.sensor.width_px = 32;
  spec.sensor.height_px = 24;
  return spec;
}

/// Straight flight along x for `duration_s`.
std::vector<Seen> flown(const TrialSpec& spec, double duration_s, std::uint32_t needs = kAllNeeds,
                        double speed_mps = 2.0) {
  World world = test::flight_world();
  const Scene scene(world);
  const VehicleModel model = make_model(spec.vehicle);
  const VehicleState start = hovering_at(spec.vehicle, {0.0, 0.0, 2.0}, 0.0);
  Perception perception = make_perception(spec, needs, start);
  const Tick plan_period = *period_ticks(spec.rates.plan_hz);
  std::vector<Seen> all;
  for (Tick now = 0; now <= ticks(duration_s);) {
    VehicleState truth = start;
    truth.tick = now;
    truth.position_world.x() += speed_mps * seconds(now);
    truth.velocity_world.x() = speed_mps;
    sense(perception, scene, model, truth, {});
    if (now % plan_period == 0) {
      const PlannerView view = planner_view(perception, truth);
      Seen seen{.call_s = seconds(now),
                .state_s = view.time_s,
                .image_s = {},
                .cameras = {},
                .pixels = {},
                .digests = {},
                .imu_s = {},
                .states_s = {},
                .position = view.position_world,
                .image_position = {},
                .last_state_position = {}};
      for (const DepthView& image : view.depth) {
        seen.image_s.push_back(image.time_s);
        seen.cameras.push_back(image.camera);
        seen.pixels.push_back(image.depth_m.size());
        seen.digests.push_back(Digest().add_array(image.depth_m).hex());
        seen.image_position = image.T_world_camera.translation();
      }
      EXPECT_EQ(view.stereo.size(), (needs & AB_INPUT_STEREO) != 0 ? view.depth.size() : 0U);
      EXPECT_EQ(view.color.size(), (needs & AB_INPUT_COLOR) != 0 ? view.depth.size() : 0U);
      for (const ImuView& sample : view.imu) seen.imu_s.push_back(sample.time_s);
      for (const StateView& state : view.states) {
        seen.states_s.push_back(state.time_s);
        seen.last_state_position = state.position_world;
      }
      EXPECT_EQ(view.call_time_s, seconds(now));
      forget_seen(perception, now);
      all.push_back(seen);
    }
    now = std::min(next_sensing(perception, now), (now / plan_period + 1) * plan_period);
  }
  EXPECT_GT(all.size(), 5U);
  return all;
}

TEST(PlannerMissionOf, SaysTheLatencyWhereItIsKnown) {
  TrialSpec spec = small_trial();
  const Aabb bounds(Eigen::Vector3d(-1.0, -2.0, -3.0), Eigen::Vector3d(4.0, 5.0, 6.0));
  spec.latency.ms = 40.0;
  const PlannerMission mission = planner_mission(spec, {}, bounds);
  EXPECT_EQ(mission.lowest_world, bounds.min());
  EXPECT_EQ(mission.highest_world, bounds.max());
  EXPECT_DOUBLE_EQ(mission.command_latency_s, 0.04);
  spec.latency.mode = LatencyMode::zero;
  EXPECT_EQ(planner_mission(spec, {}, bounds).command_latency_s, 0.0);
  for (const LatencyMode mode : {LatencyMode::measured, LatencyMode::replay}) {
    spec.latency.mode = mode;
    EXPECT_TRUE(std::isnan(planner_mission(spec, {}, bounds).command_latency_s));
  }
}

TEST(Perception, ShowsEachStateOnceAtTheRateOfTheImu) {
  for (const double delay_ms : {0.0, 47.0}) {
    TrialSpec spec = small_trial();
    spec.odometry.delay_ms = delay_ms;
    std::vector<double> all_s;
    for (const Seen& seen : flown(spec, 0.5, AB_INPUT_STATES)) {
      all_s.insert(all_s.end(), seen.states_s.begin(), seen.states_s.end());
      if (seen.states_s.empty()) continue;
      EXPECT_LE(seen.states_s.back(), seen.call_s - 0.001 * delay_ms + 1e-9);
      EXPECT_GT(seen.states_s.back(), seen.call_s - 0.001 * delay_ms - 0.005);
      EXPECT_NEAR(seen.last_state_position.x(), 2.0 * seen.states_s.back(), 1e-9);
    }
    ASSERT_GT(all_s.size(), 80U) << delay_ms;
    for (std::size_t i = 0; i < all_s.size(); ++i) {
      EXPECT_NEAR(all_s[i], 0.005 * static_cast<double>(i), 1e-9) << delay_ms;
    }
  }
  EXPECT_TRUE(flown(small_trial(), 0.2).back().states_s.empty()) << "nobody asked";
}

TEST(Perception, AnImageIsSeenAtOnceWithoutDelay) {
  for (const Seen& seen : flown(small_trial(), 0.5)) {
    ASSERT_EQ(seen.image_s.size(), 1U);
    EXPECT_EQ(seen.image_s[0], seen.call_s);
    EXPECT_EQ(seen.state_s, seen.call_s);
    EXPECT_NEAR(seen.image_position.x(), 2.0 * seen.call_s + 0.2, 1e-12);
  }
}

TEST(Perception, ADelayedImageKeepsItsTimeAndPlace) {
  TrialSpec spec = small_trial();
  spec.sensor.delay_ms = 50.0;  // one and a half periods
  const std::vector<Seen> all = flown(spec, 0.5);
  EXPECT_TRUE(all[0].image_s.empty());
  EXPECT_TRUE(all[1].image_s.empty());
  for (std::size_t i = 2; i < all.size(); ++i) {
    ASSERT_EQ(all[i].image_s.size(), 1U);
    EXPECT_NEAR(all[i].image_s[0], all[i].call_s - 2.0 / 30.0, 1e-9);
    EXPECT_NEAR(all[i].image_position.x(), 2.0 * all[i].image_s[0] + 0.2, 1e-9);
  }
}

TEST(Perception, AFastCameraShowsAllImagesNewestFirst) {
  TrialSpec spec = small_trial();
  spec.sensor.rate_hz = 90.0;
  const std::vector<Seen> all = flown(spec, 0.3);
  for (std::size_t i = 1; i < all.size(); ++i) {
    ASSERT_EQ(all[i].image_s.size(), 3U);
    for (std::size_t k = 0; k < 3; ++k) {
      EXPECT_NEAR(all[i].image_s[k], all[i].call_s - static_cast<double>(k) / 90.0, 1e-9);
    }
  }
}

TEST(Perception, JitterMakesImagesLateByUpToThatMuch) {
  TrialSpec spec = small_trial();
  spec.sensor.jitter_ms = 10.0;
  std::set<double> lateness;
  double most = 0.0;
  std::size_t count = 0;
  for (const Seen& seen : flown(spec, 3.0, AB_INPUT_DEPTH)) {
    for (const double image_s : seen.image_s) {
      const double late_s = image_s - std::floor(image_s * 30.0 + 1e-9) / 30.0;
      lateness.insert(std::round(late_s * 36000.0));
      most = std::max(most, late_s);
      ++count;
    }
  }
  EXPECT_GT(count, 85U);
  EXPECT_GT(lateness.size(), 60U);
  EXPECT_LE(most, 0.010001);
  EXPECT_GT(most, 0.008);
}

TEST(Perception, ARigShowsEveryCamera) {
  TrialSpec spec = small_trial();
  MountingSpec back;
  back.position_body_m = {-0.2, 0.0, 0.05};
  back.yaw_deg = 180.0;
  spec.sensor.more_mountings = {back};
  for (const Seen& seen : flown(spec, 0.2)) {
    EXPECT_EQ(seen.cameras, (std::vector<std::uint32_t>{1, 0}));
  }
}

TEST(Perception, EachImageOfEachCameraHasItsOwnNoise) {
  TrialSpec spec = small_trial();
  spec.sensor.method = DepthNoisySpec{};
  // Two of a kind at one place, and a third kind's there too: only noise tells their images apart.
  spec.sensor.more_mountings = {spec.sensor.mounting};
  CameraSpec like_it = spec.sensor;
  like_it.more_mountings.clear();
  spec.sensor.more_cameras = {like_it};
  std::set<std::string> digests;
  std::size_t count = 0;
  for (const Seen& seen : flown(spec, 0.3, AB_INPUT_DEPTH, 0.0)) {
    EXPECT_EQ(seen.digests.size(), 3U);
    count += seen.digests.size();
    digests.insert(seen.digests.begin(), seen.digests.end());
  }
  EXPECT_EQ(digests.size(), count);
}

/// The left image that a camera exposes at tick 0 on a vehicle that moves and turns.
std::vector<std::uint8_t> turning_image(const TrialSpec& spec, const Scene& scene,
                                        const VehicleState& truth) {
  Perception perception = make_perception(spec, AB_INPUT_STEREO, truth);
  sense(perception, scene, make_model(spec.vehicle), truth, {});
  const PlannerView view = planner_view(perception, truth);
  const auto left = view.stereo.at(0).left;
  return {left.begin(), left.end()};
}

TEST(Perception, ACameraOffTheCentreIsBlurredByItsOwnWay) {
  TrialSpec spec = small_trial();
  spec.sensor.width_px = 160;
  spec.sensor.height_px = 120;
  spec.sensor.exposure_ms = 40.0;
  spec.sensor.image.full_well_e = 0.0;
  spec.sensor.image.brightness = 0.0;
  spec.sensor.image.blur_samples = 8;
  spec.sensor.mounting.position_body_m = {1.5, 0.4, 0.2};
  World world = test::flight_world();
  test::add_obstacle(world, test::box_mesh(Eigen::Vector3f(0.5F, 16, 8)), {4, 0, 4}, "wall");
  const Scene scene(world);
  VehicleState truth = hovering_at(spec.vehicle, {0.0, 0.0, 2.0}, 0.2);
  truth.velocity_world = {0.3, -0.5, 0.1};
  truth.rates_body = {0.2, -0.3, 2.0};

  // The camera's velocity by its places a little before and after.
  const auto camera_at = [&](double time_s) {
    const Eigen::Vector3d turn = truth.rates_body * time_s;
    const Pose body = Eigen::Translation3d(truth.position_world + truth.velocity_world * time_s) *
                      truth.q_world_body * Eigen::AngleAxisd(turn.norm(), turn.normalized());
    return Pose(body * T_body_camera(spec.sensor.mounting));
  };
  const Eigen::Vector3d before = camera_at(-1e-4).translation();
  CameraMotion motion{.velocity_world = (camera_at(1e-4).translation() - before) / 2e-4,
                      .rates_world_radps = truth.q_world_body * truth.rates_body};
  const auto difference_to = [&](const CameraMotion& own) {
    CameraImages images;
    Camera(spec.sensor).expose(scene, camera_at(1e-9), own, {.stereo = true}, 1, images);
    const std::vector<std::uint8_t> seen = turning_image(spec, scene, truth);
    double sum = 0.0;
    for (std::size_t i = 0; i < seen.size(); ++i) {
      sum += std::abs(static_cast<double>(seen[i]) - images.left[i]);
    }
    return sum / static_cast<double>(seen.size());
  };
  EXPECT_LT(difference_to(motion), 0.1);
  // What the test can see: the body's velocity alone, and the arm's with the other sign.
  const Eigen::Vector3d of_arm = motion.velocity_world - truth.velocity_world;
  motion.velocity_world = truth.velocity_world;
  EXPECT_GT(difference_to(motion), 0.5);
  motion.velocity_world = truth.velocity_world - of_arm;
  EXPECT_GT(difference_to(motion), 0.5);
}

TEST(Perception, UnlikeCamerasComeAtTheirOwnRatesAndDelays) {
  TrialSpec spec = small_trial();
  CameraSpec side;
  side.method = DepthNoisySpec{};
  side.width_px = 16;
  side.height_px = 8;
  side.fov_x_deg = 60.0;
  side.rate_hz = 10.0;
  side.delay_ms = 70.0;  // older than images of camera 0 that were seen before
  side.mounting.yaw_deg = 90.0;
  spec.sensor.more_cameras = {side};
  std::map<std::uint32_t, std::vector<double>> times_s;
  for (const Seen& seen : flown(spec, 1.0)) {
    for (std::size_t i = 0; i < seen.cameras.size(); ++i) {
      times_s[seen.cameras[i]].push_back(seen.image_s[i]);
      const double delay_s = seen.cameras[i] == 1 ? 0.07 : 0.0;
      EXPECT_LE(seen.image_s[i] + delay_s, seen.call_s + 1e-9);
      EXPECT_GT(seen.image_s[i] + delay_s, seen.call_s - 1.0 / 30.0 - 1e-9);
      EXPECT_EQ(seen.pixels[i], seen.cameras[i] == 1 ? 16U * 8U : 32U * 24U);
    }
  }
  ASSERT_EQ(times_s.size(), 2U);
  ASSERT_GE(times_s[0].size(), 30U);
  ASSERT_GE(times_s[1].size(), 9U);
  for (std::size_t i = 0; i < times_s[0].size(); ++i) {  // each once, in order
    EXPECT_NEAR(times_s[0][i], static_cast<double>(i) / 30.0, 1e-9);
  }
  for (std::size_t i = 0; i < times_s[1].size(); ++i) {
    EXPECT_NEAR(times_s[1][i], static_cast<double>(i) / 10.0, 1e-9);
  }
}

TEST(Perception, AFurtherKindOfCameraLeavesTheFirstOneAsItIs) {
  TrialSpec spec = small_trial();
  spec.sensor.method = DepthNoisySpec{};
  spec.sensor.jitter_ms = 5.0;
  const std::vector<Seen> alone = flown(spec, 0.5);
  CameraSpec other = spec.sensor;
  other.rate_hz = 15.0;
  spec.sensor.more_cameras = {other};
  const std::vector<Seen> with_other = flown(spec, 0.5);
  ASSERT_EQ(alone.size(), with_other.size());
  for (std::size_t k = 0; k < alone.size(); ++k) {
    std::size_t first = 0;
    for (std::size_t i = 0; i < with_other[k].cameras.size(); ++i) {
      if (with_other[k].cameras[i] != 0) continue;
      ASSERT_LT(first, alone[k].image_s.size());
      EXPECT_EQ(with_other[k].image_s[i], alone[k].image_s[first]);
      EXPECT_EQ(with_other[k].digests[i], alone[k].digests[first]);
      ++first;
    }
    EXPECT_EQ(first, alone[k].image_s.size());
  }
}

/// A planner whose sweep names a camera flies as if there were no other.
TEST(Perception, APlannersOneCameraIsAllThatItSees) {
  TrialSpec spec = small_trial();
  spec.sensor.method = DepthNoisySpec{};
  CameraSpec side = spec.sensor;
  side.mounting.yaw_deg = 90.0;
  side.width_px = 40;
  TrialSpec alone = spec;
  static_cast<CameraSpec&>(alone.sensor) = side;
  const std::vector<Seen> expected = flown(alone, 0.3);
  spec.sensor.more_cameras = {side};
  EXPECT_EQ(planner_setup(spec).cameras.size(), 2U);
  spec.planner.camera = 1;
  ASSERT_EQ(planner_setup(spec).cameras.size(), 1U);
  EXPECT_EQ(planner_setup(spec).cameras[0].width_px, 40);
  const std::vector<Seen> seen = flown(spec, 0.3);
  ASSERT_EQ(seen.size(), expected.size());
  for (std::size_t k = 0; k < seen.size(); ++k) {
    EXPECT_EQ(seen[k].cameras, expected[k].cameras);
    EXPECT_EQ(seen[k].digests, expected[k].digests);
  }
}

TEST(Perception, TheSetupHasEachCameraAsItIs) {
  TrialSpec spec = small_trial();
  MountingSpec back;
  back.yaw_deg = 180.0;
  spec.sensor.more_mountings = {back};
  CameraSpec side;
  side.width_px = 64;
  side.height_px = 32;
  side.rate_hz = 12.0;
  side.max_range_m = 4.0;
  spec.sensor.more_cameras = {side};
  const PlannerSetup setup = planner_setup(spec);
  ASSERT_EQ(setup.cameras.size(), 3U);
  EXPECT_EQ(setup.cameras[1].width_px, 32);
  EXPECT_EQ(setup.cameras[2].width_px, 64);
  EXPECT_EQ(setup.cameras[2].height_px, 32);
  EXPECT_EQ(setup.cameras[2].rate_hz, 12.0);
  EXPECT_EQ(setup.cameras[2].max_range_m, 4.0);
}

TEST(Perception, ImuSamplesComeOnceAndInOrder) {
  TrialSpec spec = small_trial();
  const std::vector<Seen> all = flown(spec, 1.0);
  std::vector<double> times;
  for (const Seen& seen : all) times.insert(times.end(), seen.imu_s.begin(), seen.imu_s.end());
  ASSERT_GE(times.size(), 200U);
  for (std::size_t i = 0; i < times.size(); ++i) {
    EXPECT_NEAR(times[i], static_cast<double>(i) / 200.0, 1e-9);
  }
}

TEST(Perception, DelayedOdometryIsThatOfThePast) {
  TrialSpec spec = small_trial();
  spec.odometry.delay_ms = 20.0;
  for (const Seen& seen : flown(spec, 0.5)) {
    const double then_s = std::max(0.0, seen.call_s - 0.02);
    EXPECT_NEAR(seen.state_s, then_s, 1e-9);
    EXPECT_NEAR(seen.position.x(), 2.0 * then_s, 1e-9);
  }
}

TEST(Perception, ImagesCarryTheBelievedPose) {
  TrialSpec spec = small_trial();
  spec.odometry.position_drift_ratio = 0.1;
  const std::vector<Seen> all = flown(spec, 3.0);
  const Seen& last = all.back();
  EXPECT_GT(std::abs(last.position.x() - 2.0 * last.call_s), 1e-3);  // it has drifted
  EXPECT_NEAR(last.image_position.x() - 0.2, last.position.x(), 1e-9);
}

TEST(Perception, NoiseDoesNotDependOnWhatThePlannerAsksFor) {
  TrialSpec spec = small_trial();
  spec.odometry.position_sigma_m = 0.05;
  spec.sensor.jitter_ms = 5.0;
  const std::vector<Seen> all = flown(spec, 1.0), few = flown(spec, 1.0, AB_INPUT_DEPTH);
  ASSERT_EQ(all.size(), few.size());
  for (std::size_t i = 0; i < all.size(); ++i) {
    EXPECT_EQ(all[i].position, few[i].position);
    EXPECT_EQ(all[i].image_s, few[i].image_s);
  }
}

}  // namespace
}  // namespace avoidbench
