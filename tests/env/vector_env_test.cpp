#include "env/vector_env.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstring>
#include <limits>
#include <map>
#include <set>

#include "base/input_error.hpp"
#include "base/random.hpp"
#include "metrics/metric_table.hpp"
#include "support/input_error_message.hpp"
#include "trial/flight.hpp"
#include "trial/map_scene.hpp"

namespace avoidbench {
namespace {

using testing::HasSubstr;

/// Two small halls with two missions each, small pictures and short flights.
EnvSpec env_spec(std::int64_t slots = 3, std::int64_t threads = 1) {
  EnvSpec spec;
  spec.sweep.name = "tests";
  spec.sweep.base.map = HallSpec{.area_m = {14.0, 16.0}, .poisson_radius_m = 3.0};
  spec.sweep.base.sensor.width_px = 16;
  spec.sweep.base.sensor.height_px = 12;
  spec.sweep.base.mission.time_limit_s = 3.0;
  spec.sweep.axes = {{.path = "map_seed", .values = {1, 2}}};
  spec.sweep.trials = 2;
  spec.slots = slots;
  spec.threads = threads;
  spec.needs = AB_INPUT_DEPTH | AB_INPUT_IMU;
  return spec;
}

/// A vector with its arrays.
struct Stepped {
  explicit Stepped(const EnvSpec& spec) : env(spec) {
    const auto slots = static_cast<std::size_t>(spec.slots);
    const ViewShape& shape = env.shape();
    depth.resize(slots * shape.pixels());
    imu.resize(slots * shape.imu_samples * kImuWidth);
    state.resize(slots * kStateWidth);
    goal.resize(slots * kGoalWidth);
    pose.resize(slots * kPoseWidth);
    reward.resize(slots);
    terminated.resize(slots);
    truncated.resize(slots);
    actions.resize(slots * action_width(spec.action));
    arrays = {.view = {.depth = depth.data(),
                       .imu = imu.data(),
                       .state = state.data(),
                       .goal = goal.data(),
                       .pose = pose.data()},
              .reward = reward.data(),
              .terminated = terminated.data(),
              .truncated = truncated.data()};
  }

  void reset(std::optional<std::uint64_t> seed = 1) { env.reset(seed, {}, arrays); }
  void step(bool begins_next = true) { env.step(actions, begins_next, arrays); }

  /// Toward the goal at this speed, in every slot.
  void steer(double speed_mps) {
    for (std::size_t i = 0; i < reward.size(); ++i) {
      const Eigen::Map<const Eigen::Vector3f> to_goal(&goal[i * kGoalWidth]);
      const Eigen::Vector3d velocity = speed_mps * to_goal.cast<double>().normalized();
      std::copy(velocity.begin(), velocity.end(),
                actions.begin() + static_cast<std::ptrdiff_t>(4 * i));
    }
  }

  VectorEnv env;
  std::vector<float> depth, imu, state, goal;
  std::vector<double> pose, reward;
  std::vector<std::uint8_t> terminated, truncated;
  std::vector<double> actions;
  EnvArrays arrays;
};

std::string error_of(const std::function<void()>& call) {
  return test::message_of([&] { call(); });
}

template <class T>
void append(std::string& bytes, const std::vector<T>& values) {
  bytes.append(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T));
}

/// All that `steps` steps of random actions wrote, and what ended.
std::string bytes_of_random_flights(EnvSpec spec, int steps) {
  Stepped stepped(spec);
  RandomStream random = stream(7, "actions");
  std::string bytes;
  stepped.reset(5);
  for (int i = 0; i < steps; ++i) {
    for (double& number : stepped.actions) number = random.uniform(-3.0, 3.0);
    stepped.step();
    append(bytes, stepped.depth);
    append(bytes, stepped.imu);
    append(bytes, stepped.state);
    append(bytes, stepped.goal);
    append(bytes, stepped.pose);
    append(bytes, stepped.reward);
    append(bytes, stepped.terminated);
    append(bytes, stepped.truncated);
    for (const EpisodeEnd& end : stepped.env.ended()) {
      bytes += end.trial_key + end.reason + std::to_string(end.steps);
      append(bytes, end.metrics);
    }
  }
  return bytes;
}

TEST(VectorEnv, GivesTheSameBytesForAnyNumberOfThreads) {
  const std::string one = bytes_of_random_flights(env_spec(5, 1), 120);
  EXPECT_EQ(one, bytes_of_random_flights(env_spec(5, 2), 120));
  EXPECT_EQ(one, bytes_of_random_flights(env_spec(5, 5), 120));
  EnvSpec few_maps = env_spec(5, 2);
  few_maps.kept_maps = 1;
  EXPECT_EQ(one, bytes_of_random_flights(few_maps, 120)) << "which maps are kept changes nothing";
}

/// What a slot's trial is when it is flown with these actions by hand.
TrialRecord flown_by_hand(const TrialSpec& spec, const std::vector<std::vector<double>>& actions,
                          std::vector<double>& metrics) {
  const MapScene place(spec);
  const MapRecord map = make_map_record(spec, place.scene, spec.mission_index + 1);
  const MissionRecord& mission = map.missions.back();
  Flight flight = begin_flight(spec, place.scene, mission.mission, AB_INPUT_DEPTH);
  std::size_t step = 0;
  while (const PlannerView* view = next_plan(flight)) {
    answer(flight, plan_result({}, actions.at(step++), *view, 0.0));
  }
  TrialRecord record = end_flight(std::move(flight));
  metrics = compute_metrics({spec, mission, record});
  return record;
}

TEST(VectorEnv, AnEpisodeIsTheTrialThatItsKeySays) {
  EnvSpec spec = env_spec(2);
  Stepped stepped(spec);
  stepped.reset();
  std::vector<std::vector<double>> actions;
  while (stepped.env.ended().empty() || stepped.env.ended()[0].slot != 0) {
    stepped.steer(2.0);
    actions.emplace_back(stepped.actions.begin(), stepped.actions.begin() + 4);
    stepped.step();
  }
  const EpisodeEnd& end = stepped.env.ended()[0];
  const TrialSpec trial = stepped.env.trial(0);
  EXPECT_EQ(end.trial_key, trial_key(trial));
  EXPECT_EQ(trial.planner.label, "policy");
  EXPECT_EQ(end.steps, static_cast<std::int64_t>(actions.size()));
  std::vector<double> metrics;
  const TrialRecord record = flown_by_hand(trial, actions, metrics);
  const TrialRecord& stored = stepped.env.record(0);
  EXPECT_EQ(end.outcome, record.outcome);
  EXPECT_EQ(end.reason, record.reason);
  EXPECT_EQ(end.end_time_s, record.end_time_s);
  ASSERT_EQ(stored.samples.size(), record.samples.size());
  for (std::size_t i = 0; i < record.samples.size(); ++i) {
    ASSERT_EQ(stored.samples[i].position_world, record.samples[i].position_world) << i;
    ASSERT_EQ(stored.samples[i].clearance_m, record.samples[i].clearance_m) << i;
  }
  ASSERT_EQ(end.metrics.size(), metrics.size());
  EXPECT_EQ(0, std::memcmp(end.metrics.data(), metrics.data(), metrics.size() * sizeof(double)));
}

TEST(VectorEnv, GoalsFollowEachOther) {
  EnvSpec spec = env_spec(1);
  spec.sweep.base.map = HallSpec{.area_m = {14.0, 16.0}, .poisson_radius_m = 7.0};
  spec.sweep.base.mission.waypoints = 2;
  spec.sweep.base.mission.max_collisions = 100;  // of columns it knows nothing
  spec.sweep.base.mission.time_limit_s = 60.0;
  spec.reward = {.progress_per_m = 1.0, .time_per_s = 0.0, .crash = 0.0, .goal = 0.0};
  Stepped stepped(spec);
  stepped.reset();
  int jumps = 0;
  while (stepped.env.ended().empty()) {
    const Eigen::Vector3f before(stepped.goal[0], stepped.goal[1], stepped.goal[2]);
    stepped.steer(2.0);
    stepped.step(false);
    const Eigen::Vector3f now(stepped.goal[0], stepped.goal[1], stepped.goal[2]);
    // Of the vehicle's own motion and turning there is far less in a step.
    if (now.norm() > before.norm() + 0.5F) ++jumps;
  }
  const EpisodeEnd& end = stepped.env.ended()[0];
  EXPECT_EQ(end.outcome, Outcome::reached_goal) << end.reason;
  EXPECT_EQ(jumps, 2);
  // Progress along all legs is d_min, less what is left within the last circle.
  const MapScene place(stepped.env.trial(0));
  const MapRecord map =
      make_map_record(stepped.env.trial(0), place.scene, stepped.env.trial(0).mission_index + 1);
  EXPECT_NEAR(end.reward_sum, map.missions.back().reference_length_m, 0.5);
}

TEST(VectorEnv, WhatNobodyMeasuredIsNoNumber) {
  Stepped stepped(env_spec(1));
  stepped.reset();
  while (stepped.env.ended().empty()) stepped.step();
  const auto table = metric_table();
  for (std::size_t i = 0; i < table.size(); ++i) {
    if (table[i].is_measured) {
      EXPECT_TRUE(std::isnan(stepped.env.ended()[0].metrics[i])) << table[i].name;
    }
  }
}

TEST(VectorEnv, ShowsWhatTheVehicleBelieves) {
  Stepped stepped(env_spec(2));
  stepped.reset();
  const Eigen::Vector3d start(stepped.pose[1], stepped.pose[2], stepped.pose[3]);
  EXPECT_EQ(stepped.pose[0], 0.0);
  EXPECT_THAT(std::vector<float>(stepped.state.begin(), stepped.state.begin() + 9),
              testing::ElementsAre(0, 0, 0, 0, 0, 1, 0, 0, 0))
      << "at rest and level";
  // The nose points to the goal at the start.
  EXPECT_GT(stepped.goal[0], 5.0F);
  EXPECT_NEAR(stepped.goal[1], 0.0, 1e-5);
  for (int i = 0; i < 15; ++i) {
    stepped.steer(2.0);
    stepped.step();
  }
  const Eigen::Vector3d later(stepped.pose[1], stepped.pose[2], stepped.pose[3]);
  EXPECT_NEAR(stepped.pose[0], 0.5, 1e-12);
  EXPECT_GT((later - start).norm(), 0.2);
  EXPECT_GT(stepped.state[0], 0.5F) << "forward";
  // 200 Hz and 30 Hz: the newest sample is of now or a little before.
  const std::size_t last = stepped.env.shape().imu_samples - 1;
  EXPECT_NEAR(stepped.imu[last * kImuWidth], 0.5, 0.0051);
}

TEST(VectorEnv, DepthIsWrittenAsAsked) {
  EnvSpec spec = env_spec(1);
  Stepped inverse(spec);
  inverse.reset();
  spec.depth = DepthEncoding::metric;
  Stepped metric(spec);
  metric.reset();
  std::size_t near = 0;
  for (std::size_t i = 0; i < metric.depth.size(); ++i) {
    ASSERT_GT(metric.depth[i], 0.0F);
    ASSERT_LE(metric.depth[i], 15.0F);
    ASSERT_FLOAT_EQ(inverse.depth[i], 0.1F / metric.depth[i]);
    near += metric.depth[i] < 15.0F ? 1U : 0U;
  }
  EXPECT_GT(near, 0U);
}

/// How a picture of these depths is written.
std::vector<float> written_depth(const std::vector<float>& depth_m, DepthEncoding encoding) {
  const ViewShape shape{.cameras = 1,
                        .height_px = 1,
                        .width_px = depth_m.size(),
                        .min_range_m = 0.5,
                        .max_range_m = 10.0};
  std::vector<float> written(depth_m.size(), -1.0F);
  PlannerView view;
  view.q_world_body.setIdentity();
  view.depth.push_back({.depth_m = depth_m});
  write_view(view, Eigen::Vector3d::Zero(), shape, encoding, {.depth = written.data()});
  return written;
}

TEST(Observations, TellNothingInRangeFromNothingKnown) {
  const auto infinity = std::numeric_limits<float>::infinity();
  const std::vector<float> depth_m{0.5F, 2.0F, 10.0F, infinity, static_cast<float>(math::kNaN)};
  EXPECT_THAT(written_depth(depth_m, DepthEncoding::metric),
              testing::ElementsAre(0.5F, 2.0F, 10.0F, 10.0F, 0.0F));
  EXPECT_THAT(written_depth(depth_m, DepthEncoding::inverse),
              testing::ElementsAre(1.0F, 0.25F, 0.05F, 0.05F, 0.0F));
}

TEST(Observations, BeforeTheFirstImageNothingIsKnown) {
  const ViewShape shape{.cameras = 2, .height_px = 2, .width_px = 3};
  std::vector<float> depth(12, 7.0F);
  std::vector<std::uint8_t> stereo(24, 7), color(36, 7);
  clear_images(shape, {.depth = depth.data(), .stereo = stereo.data(), .color = color.data()});
  EXPECT_THAT(depth, testing::Each(0.0F));
  EXPECT_THAT(stereo, testing::Each(0));
  EXPECT_THAT(color, testing::Each(0));
  // A camera without a new picture keeps its last one.
  const std::vector<float> image(6, 1.0F);
  PlannerView view;
  view.q_world_body.setIdentity();
  view.depth.push_back({.camera = 1, .depth_m = image});
  const ViewShape ranged{
      .cameras = 2, .height_px = 2, .width_px = 3, .min_range_m = 0.5, .max_range_m = 10.0};
  write_view(view, Eigen::Vector3d::Zero(), ranged, DepthEncoding::metric, {.depth = depth.data()});
  EXPECT_THAT(depth, testing::ElementsAre(0, 0, 0, 0, 0, 0, 1, 1, 1, 1, 1, 1));
}

TEST(VectorEnv, RewardsAreProgressLessTimeAndTheEnd) {
  EnvSpec spec = env_spec(1);
  spec.sweep.base.mission.time_limit_s = 60.0;
  spec.reward = {.progress_per_m = 2.0, .time_per_s = 0.3, .crash = 5.0, .goal = 7.0};
  Stepped stepped(spec);
  std::map<Outcome, int> outcomes;
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    stepped.reset(seed);
    double sum = 0.0;
    do {
      stepped.steer(2.0);
      stepped.step();
      sum += stepped.reward[0];
    } while (stepped.env.ended().empty());
    const EpisodeEnd& end = stepped.env.ended()[0];
    ++outcomes[end.outcome];
    EXPECT_NEAR(end.reward_sum, sum, 1e-12);
    const double time_s = static_cast<double>(end.steps) / 30.0;
    const bool is_there = end.outcome == Outcome::reached_goal;
    const double gained_m = (sum + 0.3 * time_s - (is_there ? 7.0 : -5.0)) / 2.0;
    EXPECT_GT(gained_m, 0.0);
    EXPECT_LT(gained_m, 16.0);
    EXPECT_EQ(stepped.terminated[0], 1);
    EXPECT_EQ(stepped.truncated[0], 0);
  }
  EXPECT_GT(outcomes[Outcome::reached_goal] + outcomes[Outcome::collided], 5);
}

TEST(VectorEnv, LeavingTheMapIsPunishedAsACrash) {
  EnvSpec spec = env_spec(1);
  // A hall's bounds are behind its ceiling and walls.
  spec.sweep.base.map = ForestSpec{.area_m = {15.0, 16.0}, .poisson_radius_m = 6.0};
  spec.sweep.base.mission.time_limit_s = 60.0;
  spec.reward = {.progress_per_m = 0.0, .time_per_s = 0.3, .crash = 5.0, .goal = 7.0};
  Stepped stepped(spec);
  stepped.reset();
  do {
    stepped.actions = {0.0, 0.0, 3.0, 0.0};
    stepped.step();
    const double end = stepped.env.ended().empty() ? 0.0 : -5.0;
    ASSERT_NEAR(stepped.reward[0], end - 0.3 / 30.0, 1e-12);
  } while (stepped.env.ended().empty());
  EXPECT_EQ(stepped.env.ended()[0].outcome, Outcome::left_bounds);
  EXPECT_EQ(stepped.terminated[0], 1);
  EXPECT_EQ(stepped.truncated[0], 0);
}

TEST(VectorEnv, AnEndByTimeIsTruncation) {
  Stepped stepped(env_spec(1));
  stepped.reset();
  while (stepped.env.ended().empty()) stepped.step();  // hovers
  EXPECT_EQ(stepped.env.ended()[0].outcome, Outcome::timed_out);
  EXPECT_EQ(stepped.terminated[0], 0);
  EXPECT_EQ(stepped.truncated[0], 1);
  EXPECT_EQ(error_of([&] { stepped.step(false); }),
            "slot 0: its episode has ended: reset it before the next step");
  stepped.step(true);
  EXPECT_EQ(stepped.reward[0], 0.0);
  EXPECT_EQ(stepped.truncated[0], 0);
  EXPECT_EQ(stepped.pose[0], 0.0) << "the next episode has begun";
}

/// The trials that a slot flies, in order.
std::vector<std::string> trials_flown(const EnvSpec& spec, std::size_t slot, std::size_t count) {
  Stepped stepped(spec);
  stepped.reset(spec.seed);
  std::vector<std::string> flown;
  while (flown.size() < count) {
    const TrialSpec& trial = stepped.env.trial(slot);
    flown.push_back(std::to_string(trial.map_seed) + "/" + std::to_string(trial.mission_index));
    std::vector<std::uint8_t> mask(static_cast<std::size_t>(spec.slots), 0);
    mask[slot] = 1;
    stepped.env.reset({}, mask, stepped.arrays);
  }
  return flown;
}

TEST(VectorEnv, WhatIsFlownFollowsFromSeedSlotAndEpisodeAlone) {
  EnvSpec spec = env_spec(3);
  const std::vector<std::string> flown = trials_flown(spec, 2, 12);
  EXPECT_EQ(std::set<std::string>(flown.begin(), flown.end()).size(), 4U) << "all come";
  EXPECT_EQ(trials_flown(spec, 2, 12), flown);
  EXPECT_NE(trials_flown(spec, 1, 12), flown);
  spec.slots = 7;
  EXPECT_EQ(trials_flown(spec, 2, 12), flown) << "other slots change nothing";
  spec.seed = 2;
  EXPECT_NE(trials_flown(spec, 2, 12), flown);
}

TEST(VectorEnv, InTurnEachTrialIsFlownOnce) {
  EnvSpec spec = env_spec(2);
  spec.order = EpisodeOrder::in_turn;
  EXPECT_THAT(trials_flown(spec, 0, 3), testing::ElementsAre("1/0", "2/0", "1/0"));
  EXPECT_THAT(trials_flown(spec, 1, 3), testing::ElementsAre("1/1", "2/1", "1/1"));
}

TEST(VectorEnv, InTurnASlotFliesItsOwnTrialsAgainAndNoOthers) {
  EnvSpec spec = env_spec(3);  // of four trials
  spec.order = EpisodeOrder::in_turn;
  EXPECT_THAT(trials_flown(spec, 0, 4), testing::ElementsAre("1/0", "2/1", "1/0", "2/1"));
  EXPECT_THAT(trials_flown(spec, 1, 2), testing::ElementsAre("1/1", "1/1"));
  EXPECT_THAT(trials_flown(spec, 2, 2), testing::ElementsAre("2/0", "2/0"));
}

/// How often each trial was flown in round 0, all slots being reset until none is in it.
std::map<std::string, int> flown_in_round_0(const EnvSpec& spec) {
  Stepped stepped(spec);
  std::map<std::string, int> flown;
  bool goes_on = true;
  for (stepped.reset(); goes_on; stepped.reset(std::nullopt)) {
    goes_on = false;
    for (std::size_t slot = 0; slot < stepped.reward.size(); ++slot) {
      if (stepped.env.round(slot) > 0) continue;
      goes_on = true;
      const TrialSpec& trial = stepped.env.trial(slot);
      ++flown[std::to_string(trial.map_seed) + "/" + std::to_string(trial.mission_index)];
    }
  }
  return flown;
}

TEST(VectorEnv, InTurnRoundZeroIsEachTrialThatCanBeFlownOnce) {
  // So wide that some missions have no free start or goal.
  EnvSpec spec = env_spec();
  spec.order = EpisodeOrder::in_turn;
  spec.sweep.base.mission.free_radius_m = 1.7;
  spec.sweep.axes = {{.path = "map_seed", .values = {1, 2, 3, 4, 5, 6}}};
  std::map<std::string, int> valid;
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    TrialSpec trial = spec.sweep.base;
    trial.map_seed = seed;
    for (const MissionRecord& mission : make_map_record(trial, MapScene(trial).scene, 2).missions) {
      if (mission.is_valid) valid[std::to_string(seed) + "/" + std::to_string(mission.index)] = 1;
    }
  }
  ASSERT_GT(valid.size(), 2U);
  ASSERT_LT(valid.size(), 12U);
  for (const std::int64_t slots : {1, 2, 3, 5, 7, 12, 15}) {
    spec.slots = slots;
    EXPECT_EQ(flown_in_round_0(spec), valid) << slots << " slots";
  }
}

TEST(VectorEnv, SaysWhatIsWrong) {
  Stepped stepped(env_spec(2));
  EXPECT_EQ(error_of([&] { stepped.step(); }), "slot 0: call reset() before step()");
  stepped.reset();
  stepped.actions[5] = math::kNaN;
  const std::vector<double> pose = stepped.pose;
  EXPECT_EQ(error_of([&] { stepped.step(); }), "slot 1: number 1 of the action is not finite");
  EXPECT_EQ(stepped.pose, pose) << "nothing was flown";
  stepped.actions[5] = 0.0;
  stepped.step();
  const std::vector<std::uint8_t> one{1, 0};
  EXPECT_THAT(error_of([&] { stepped.env.reset(3, one, stepped.arrays); }), HasSubstr("a seed"));
  EXPECT_THAT(error_of([&] {
                stepped.env.reset({}, {one.data(), 1}, stepped.arrays);
              }),
              HasSubstr("one value per slot: 2"));
}

TEST(VectorEnv, RefusesWhatCantBeStepped) {
  const auto refused = [](const auto& change) {
    EnvSpec spec = env_spec();
    change(spec);
    return error_of([&] { const VectorEnv env(spec); });
  };
  EXPECT_THAT(refused([](EnvSpec& s) { s.slots = 0; }), HasSubstr("slots must be"));
  EXPECT_THAT(refused([](EnvSpec& s) { s.threads = 0; }), HasSubstr("threads must be"));
  EXPECT_THAT(refused([](EnvSpec& s) { s.action.points = 0; }), HasSubstr("points"));
  EXPECT_THAT(refused([](EnvSpec& s) { s.action.horizon_s = math::kNaN; }), HasSubstr("horizon"));
  EXPECT_THAT(refused([](EnvSpec& s) { s.sweep.base.latency.mode = LatencyMode::measured; }),
              HasSubstr("latency.mode"));
  EXPECT_THAT(refused([](EnvSpec& s) {
                s.sweep.axes.push_back({.path = "sensor.width_px", .values = {16, 20}});
              }),
              HasSubstr("one shape"));
  EXPECT_THAT(refused([](EnvSpec& s) {
                s.sweep.axes.push_back({.path = "vehicle.max_speed_mps", .values = {3, 4}});
              }),
              HasSubstr("one range"));
}

TEST(VectorEnv, AnInterruptedResetLeavesNothingHalfBegun) {
  EnvSpec spec = env_spec(60);
  std::vector<nlohmann::json> seeds;
  for (int seed = 1; seed <= 60; ++seed) seeds.emplace_back(seed);  // takes seconds to make
  spec.sweep.axes = {{.path = "map_seed", .values = seeds}};
  spec.order = EpisodeOrder::in_turn;
  Stepped stepped(spec);
  const auto interrupt = [] { throw std::runtime_error("interrupted"); };
  EXPECT_THROW(stepped.env.reset(1, {}, stepped.arrays, interrupt), std::runtime_error);
  EXPECT_EQ(error_of([&] { stepped.step(); }), "slot 0: call reset() before step()");
}

TEST(VectorEnv, AnInterruptedSearchForAMissionEndsInEveryThread) {
  // Bodies with more free space around them than the hall has: no mission can be flown.
  EnvSpec spec = env_spec(4, 2);
  spec.sweep.base.mission.free_radius_m = 6.0;
  Stepped stepped(spec);
  int polls = 0;
  const auto interrupt = [&polls] {
    if (++polls > 3) throw std::runtime_error("interrupted");
  };
  EXPECT_THROW(stepped.env.reset(1, {}, stepped.arrays, interrupt), std::runtime_error);
  EXPECT_THAT(error_of([&] { stepped.reset(); }), HasSubstr("missions of the sweep can be flown"));
}

TEST(VectorEnv, AFlightThatStartsAtItsGoalEndsInItsFirstStep) {
  EnvSpec spec = env_spec(1);
  spec.sweep.base.mission.goal_radius_m = 100.0;
  Stepped stepped(spec);
  stepped.reset();
  EXPECT_EQ(stepped.terminated[0], 0);
  stepped.step();
  EXPECT_EQ(stepped.terminated[0], 1);
  ASSERT_EQ(stepped.env.ended().size(), 1U);
  EXPECT_EQ(stepped.env.ended()[0].outcome, Outcome::reached_goal);
  EXPECT_EQ(stepped.env.ended()[0].steps, 1);
}

TEST(VectorEnv, InverseDepthNeedsALeastRange) {
  EnvSpec spec = env_spec(1);
  spec.sweep.base.sensor.min_range_m = 0.0;
  EXPECT_THAT(error_of([&] { const VectorEnv env(spec); }), HasSubstr("min_range_m, which is 0"));
  spec.depth = DepthEncoding::metric;
  const VectorEnv metric(spec);
}

TEST(VectorEnv, AForkedProcessIsToldAndEnds) {
  auto stepped = std::make_unique<Stepped>(env_spec(4, 2));
  stepped->reset();
  const pid_t child = ::fork();
  if (child == 0) {
    const std::string error = error_of([&] { stepped->step(); });
    stepped.reset();  // must not wait for threads that are not there
    ::_exit(error.find("another process") != std::string::npos ? 0 : 1);
  }
  int status = -1;
  ASSERT_EQ(::waitpid(child, &status, 0), child);
  EXPECT_EQ(status, 0);
  stepped->step();
}

}  // namespace
}  // namespace avoidbench
